"""The onshore S-well: which depths fit, which are judged, and how its readings are taken.

This file, the case and the setups of the well were committed before its readings were looked at.  Until the first
prediction is on record the deeper depths are read by ``measured_rows`` alone, which drops what is not asked for.

Rules of reading.

- ``PickUp``, ``Slackoff`` and ``Rotating`` are ``trip_out``, ``trip_in`` and ``rotate_off_bottom`` at default speeds
  and rotation: neither is recorded.  They are taken as medians, to the nearest 1,000 lbf.
- There is no torque: the well says nothing of friction around the hole, whose factor stays that of the case, and a pair
  of factors is one factor here.  "One factor" is therefore one number for casing and hole.
- There is no date: each depth is a day of its own.  That the weights were measured is the author's word.
- The weight of block and top drive is not recorded: an unknown without a prior.

Rules of judging: those of ``validation.parts.judging``, every weight by itself; pick-up minus slack-off by its width.
The last reading carried on is that of the deepest depth that fitted.  ``python -m validation.parts.s_well`` fits the
well and writes its frozen values.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Final

import pandas as pd

from fctd.calibration.forward import Forward
from fctd.calibration.predict import read_posterior
from fctd.calibration.result import Calibration
from fctd.calibration.rows import Range, Row
from fctd.calibration.setup import Setup, UnknownSpec, read_setup
from fctd.case.load import Case
from fctd.model.operations import steady_rates
from validation.cases import FOLDER as CASES
from validation.cases import load
from validation.harness.study import data_folder
from validation.parts.day_fits import carried_on, fit_by_day, freeze
from validation.parts.judged_well import ONE_FACTOR, SOFT, STIFF, judged_tables
from validation.parts.volve_f4_days import FOR_OTHERS
from validation.parts.volve_f4_soft import SoftForward

FOLDER: Final = "s-well-onshore"
SETUPS: Final = CASES / "s_well"
# Bit depths [ft].
FIT: Final = (1351, 1604, 1920, 2172, 2550, 2803)
JUDGED: Final = (3056, 3308, 3623, 4001, 4317, 4630, 5009)
# Operation and label of each column.
COLUMNS: Final = {
    "PickUp_Klbs": ("trip_out", "up"), "Slackoff_Klbs": ("trip_in", "down"),
    "Rotating_Klbs": ("rotate_off_bottom", "rotating"),
}  # fmt: skip
FOOT, KLBF = 0.3048, 4448.2216152605  # [m], [N]
ROUTES: Final[dict[str, type[Forward]]] = {STIFF: Forward, SOFT: SoftForward, ONE_FACTOR: Forward}


def case_of(data: Path) -> Case:
    """The case, with the survey of the public data."""
    return load("s_well_onshore", wellbore__survey=data / FOLDER / "survey.csv")


def setup_of(model: str = STIFF) -> Setup:
    """Unknowns of the well, with friction factors and scatter as of well F-4; one factor has the prior of open hole."""
    own, others = read_setup(SETUPS / "fit.toml"), read_setup(FOR_OTHERS)
    names = {"friction": "friction.open.axial"} if model == ONE_FACTOR else {
        name: name for name in ("friction.cased.axial", "friction.open.axial")
    }  # fmt: skip
    friction = {name: UnknownSpec(bounds=(0.02, 0.8), prior=others.unknowns[of].prior) for name, of in names.items()}
    return own.model_copy(update={"unknowns": friction | own.unknowns, "scatter": others.scatter})


def measured_rows(data: Path, case: Case, depths: Sequence[int]) -> list[Row]:
    """The readings at these bit depths [ft], and no other."""
    table = pd.read_csv(data / FOLDER / "measured.csv").set_index("MD_ft").loc[[*depths]].reset_index()
    return [
        Row(f"{cells['MD_ft']} ft {label}", "", float(cells["MD_ft"]) * FOOT, kind, steady_rates(case, kind),
            _reading(cells[column]), day=f"{cells['MD_ft']} ft")
        for cells in table.to_dict("records")
        for column, (kind, label) in COLUMNS.items()
        if pd.notna(cells[column])
    ]  # fmt: skip


def _reading(value: float) -> Range:
    return Range(value * KLBF, value * KLBF)


def fit_of(data: Path, case: Case, model: str = STIFF) -> Calibration:
    """The fit of the shallow depths."""
    return fit_by_day({"": case}, measured_rows(data, case, FIT), setup_of(model), ROUTES[model])


def frozen_file(model: str) -> Path:
    """Of the frozen values of a model."""
    return SETUPS / f"{model.replace(' ', '_')}.fit.json"


def tables_of(data: Path, case: Case) -> dict[str, pd.DataFrame]:
    """The tables of ``judged_tables`` from the frozen values."""
    rows, strings = measured_rows(data, case, JUDGED), {"": case}
    posteriors = {model: read_posterior(frozen_file(model)) for model in ROUTES}
    models = {
        model: (posterior, ROUTES[model](rows, strings, posterior.unknowns, posterior.setup))
        for model, posterior in posteriors.items()
    }
    first = posteriors[STIFF]
    fitted = Forward(measured_rows(data, case, FIT), strings, first.unknowns, first.setup)
    return judged_tables("S-well", models, carried_on(fitted, models[STIFF][1], lambda row: row.bit_depth))


if __name__ == "__main__":
    folder = data_folder()
    assert folder is not None, "the public data folder is missing"
    for kind in ROUTES:
        calibrated = fit_of(folder, case_of(folder), kind)
        print(kind, calibrated.table.to_string(), sep="\n", flush=True)
        freeze(calibrated, frozen_file(kind))
