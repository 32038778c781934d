"""Second round of well 16A(78)-32, thought of after the look: what fewer rows and other priors would have said.

None of it is a prediction, and nothing of it enters the model that is judged.
"""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Final

import numpy as np

from fctd.calibration.forward import Forward
from fctd.calibration.setup import ScatterPrior, Setup
from fctd.case.load import Case
from validation.harness.study import Rows, table_of_rows
from validation.parts.forge_16a import FIT, JUDGED
from validation.parts.forge_16a_fits import MODELS, Frozen, base_setup, fit, freeze, posterior_of
from validation.parts.forge_16a_rows import report_rows
from validation.parts.forge_16a_strings import Assembly
from validation.parts.judged_well import STIFF
from validation.parts.judging import differences_of, forecast, judge, readings_of

# Rows from the curve down, where the hole is inclined.
INCLINED: Final = ("6507", "6724", "7990", "8391")


def changes() -> dict[str, tuple[tuple[str, ...], Setup]]:
    """The rows that fit and the setup of each change."""
    base = base_setup()
    return {
        "as judged": (FIT, base),
        "rows from 6,507 ft alone": (INCLINED, base),
        "scatter known before as without other wells": (FIT, base.model_copy(update={"scatter": ScatterPrior()})),
    }


@table_of_rows
def second_round(data: Path, strings: Mapping[str, Case], found: Mapping[str, Assembly], named: Iterable[str]) -> Rows:
    """A row for each change: friction, scatter between days, and the scores of 9,064 and 9,748 ft."""
    for name in named:
        keys, setup = changes()[name]
        one = freeze(fit(strings, report_rows(data, strings, keys), found, MODELS[STIFF], setup))
        yield {"change": name, **_values(one), **_scores(data, strings, found, one)}


def _values(one: Frozen) -> dict[str, float]:
    factors = {
        f"{kind}_{motion}": one.best[f"friction.{kind}.{motion}"][0]
        for kind in ("cased", "open")
        for motion in ("axial", "rotational")
    }
    scatter = {name: median for name, (median, _, _) in one.deviations.items()}
    return factors | {
        "scatter_friction": scatter["scatter.friction"], "scatter_kN": 1e-3 * scatter["scatter.hookload"]
    }  # fmt: skip


def _scores(data: Path, strings: Mapping[str, Case], found: Mapping[str, Assembly], one: Frozen) -> dict[str, float]:
    posterior = posterior_of(one, strings, found, JUDGED, MODELS[STIFF])
    rows = report_rows(data, strings, JUDGED)
    forward = Forward(rows, {key: strings[key] for key in JUDGED}, posterior.unknowns, posterior.setup)
    table = judge("", STIFF, forecast(posterior, forward, readings_of(forward)))
    pairs = forecast(posterior, forward, differences_of(forward))
    low, high = np.quantile(pairs.draws, [0.025, 0.975], axis=1)
    crps = table.groupby("unit")["crps"].mean()
    return {
        "crps_kN": crps["kN"], "crps_kN_m": crps["kN m"], "in_95": table["in_95"].sum(),
        "median_width": float(np.median((high - low) / pairs.middle)),
    }  # fmt: skip
