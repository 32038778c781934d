"""Fits of well 15/9-F-4 and their frozen values: ``python -m validation.parts.volve_f4_fits STAGE ...`` writes them.

A stage is fitted and its file committed before the rows that it is judged on are read.
"""

import json
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from fctd.arrays import Array
from fctd.calibration.calibrate import calibrate
from fctd.calibration.fit import fit as fit_rows
from fctd.calibration.fit import residuals_of, weights_of
from fctd.calibration.forward import Forward
from fctd.calibration.identify import covariance_of
from fctd.calibration.result import Calibration
from fctd.calibration.rows import Row
from fctd.calibration.setup import PriorSpec, Setup, UnknownSpec, read_setup
from fctd.calibration.unknowns import find_unknowns
from fctd.case.load import Case
from fctd.model.operations import rad_per_s
from validation.cases import FOLDER
from validation.harness.study import data_folder
from validation.parts.volve_f4 import FIT_B, SERIES_STRING
from validation.parts.volve_f4_rows import cases, report_rows, series_rows

SETUPS = FOLDER / "volve_f4"
FROZEN = SETUPS / "frozen.json"
# Rotation speeds of the two groups of bins, within a tenth [rev/min].
SLOW, FAST = 60.0, 130.0


@dataclass(frozen=True)
class Frozen:
    """The best values of a fit [SI] by name, their covariance (k, k), and the ids of the fitted rows."""

    best: dict[str, float]
    covariance: Array
    rows: tuple[str, ...]

    @property
    def deviations(self) -> dict[str, float]:
        """Standard deviation of each unknown [SI]."""
        return dict(zip(self.best, np.sqrt(np.diag(self.covariance)).tolist(), strict=True))

    def correlation(self, one: str, other: str) -> float:
        """Of two unknowns."""
        i, j = (list(self.best).index(name) for name in (one, other))
        return float(self.covariance[i, j] / np.sqrt(self.covariance[i, i] * self.covariance[j, j]))


def setup_of(name: str, held: Mapping[str, tuple[float, float]] | None = None) -> Setup:
    """A setup of the well; held : priors, mean and standard deviation [SI], that take the place of its own."""
    setup = read_setup(SETUPS / f"{name}.toml")
    unknowns = dict(setup.unknowns)
    for key, (mean, sd) in (held or {}).items():
        own = unknowns.get(key, UnknownSpec())
        unknowns[key] = own.model_copy(update={"prior": PriorSpec(mean=mean, sd=sd)})
    return setup.model_copy(update={"unknowns": unknowns})


def turning_torques(rows: Sequence[Row]) -> list[Row]:
    """The torques of the rows in which the string rotates, off bottom."""
    return [replace(row, hookload=None) for row in rows if row.has_string and row.torque]


def at_speed(rows: Sequence[Row], rpm: float) -> list[Row]:
    """The rows within a tenth of a rotation speed [rev/min]."""
    return [row for row in rows if abs(row.rates.spin / rad_per_s(rpm) - 1) < 0.1]


def fit(
    strings: Mapping[str, Case], rows: Sequence[Row], setup: Setup, starts: int = 3, route: type[Forward] = Forward
) -> Calibration:
    """A calibration with a robust loss, from seeded starts.  route : how the loads of a string are computed."""
    base = strings[SERIES_STRING]
    if route is Forward:
        return calibrate(base, rows, setup=setup, strings=strings, starts=starts, refuse=False, scatter=False)
    forward = route(rows, strings, find_unknowns({}, setup, list(strings.values())), setup)
    return Calibration(base, forward, fit_rows(forward, range(len(rows)), "soft_l1", starts), {}, "soft_l1")


def fits_of_a(data: Path, strings: Mapping[str, Case], route: type[Forward] = Forward) -> dict[str, Calibration]:
    """Model A: all rotation speeds with the torque offset fitted; one speed alone with that of the free drive."""
    series = series_rows(data, strings)
    torques = turning_torques(series)
    free = [row.torque.middle for row in series if row.operation == "tare" and row.torque]
    held = setup_of("first_section", {"rig.torque_offset": (float(np.mean(free)), 100.0)})
    return {
        "A": fit(strings, torques, setup_of("first_section"), route=route),
        "A, 60 rpm alone": fit(strings, at_speed(torques, SLOW), held, 1, route),
        "A, 130 rpm alone": fit(strings, at_speed(torques, FAST), held, 1, route),
    }


def fit_of_rig(data: Path, strings: Mapping[str, Case], route: type[Forward] = Forward) -> Calibration:
    """Model B, first stage: the constants of the rig."""
    return fit(strings, series_rows(data, strings), setup_of("rig"), route=route)


def held_by(rig: Frozen) -> dict[str, tuple[float, float]]:
    """The values of the rig as priors, mean and standard deviation [SI]."""
    return {name: (rig.best[name], rig.deviations[name]) for name in rig.best if name.startswith("rig.")}


def setup_of_b(rig: Frozen) -> Setup:
    """Model B, second stage: the values of the rig are priors."""
    return setup_of("reports", held_by(rig))


def fit_of_b(data: Path, strings: Mapping[str, Case], rig: Frozen, route: type[Forward] = Forward) -> Calibration:
    """Model B, second stage: cased friction and the masses of three strings."""
    return fit(strings, report_rows(data, strings, FIT_B), setup_of_b(rig), route=route)


def freeze(found: Calibration) -> Frozen:
    """The values of a fit with the covariance of its Hessian, J'WJ with the weights of the robust loss."""
    used = tuple(sorted({found.forward.rows[k].id for k in found.fit.used}))
    residuals = residuals_of(found.forward, found.fit.evaluation, found.fit.best, found.fit.used)
    jacobian = np.sqrt(weights_of(residuals, found.loss))[:, None] * residuals.jacobian
    return Frozen(found.values, covariance_of(jacobian, np.array([u.size for u in found.unknowns])), used)


def frozen() -> dict[str, Frozen]:
    """The fits on record."""
    if not FROZEN.is_file():
        return {}
    stored = json.loads(FROZEN.read_text(encoding="utf-8"))
    return {
        name: Frozen(one["values"], np.array(one["covariance"]), tuple(one["rows"])) for name, one in stored.items()
    }


def _write(fits: Mapping[str, Frozen]) -> None:
    stored: dict[str, Any] = {
        name: {"values": one.best, "covariance": one.covariance.tolist(), "rows": one.rows}
        for name, one in fits.items()
    }
    FROZEN.write_text(json.dumps(stored, indent=1) + "\n", encoding="utf-8")


STAGES: dict[str, Callable[[Path, Mapping[str, Case]], dict[str, Calibration]]] = {
    "A": fits_of_a,
    "rig": lambda data, strings: {"rig": fit_of_rig(data, strings)},
    "B": lambda data, strings: {"B": fit_of_b(data, strings, frozen()["rig"])},
}

if __name__ == "__main__":
    folder = data_folder()
    assert folder is not None, "the public data folder is missing"
    for stage in sys.argv[1:]:
        for name, found in STAGES[stage](folder, cases(folder)).items():
            print(found.residuals.round(2).to_string())
            one = freeze(found)
            print(name, {key: (round(value, 4), round(one.deviations[key], 4)) for key, value in one.best.items()})
            _write({**frozen(), name: one})
