"""Fits with scatter between days, by any way to compute the loads of a string, and their frozen posteriors."""

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from fctd.calibration.days import fit_scatter
from fctd.calibration.fit import fit
from fctd.calibration.forward import Forward
from fctd.calibration.predict import Posterior
from fctd.calibration.result import Calibration
from fctd.calibration.rows import Row
from fctd.calibration.rules import left_out_by_rule
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import find_unknowns
from fctd.case.load import Case
from validation.parts.judging import Judged, readings_of

# Nodes of a frozen mixture have at least this share of the weight of the largest; digits of its numbers.
_LEAST, _DIGITS = 0.03, 9


def fit_by_day(
    strings: Mapping[str, Case], rows: Sequence[Row], setup: Setup, route: type[Forward] = Forward, starts: int = 2
) -> Calibration:
    """A calibration with scatter between days.  route : how the loads of a string are computed."""
    unknowns = find_unknowns({}, setup, list(strings.values()))
    forward = route(rows, strings, unknowns, setup)
    out = left_out_by_rule(rows, strings)
    found = fit(forward, [k for k in range(len(rows)) if k not in out], "soft_l1", starts)
    found, scattered = fit_scatter(forward, found)
    reasons = {rows[k].id: reason for k, reason in sorted({**out, **found.left_out}.items())}
    return Calibration(next(iter(strings.values())), forward, found, reasons, "soft_l1", scattered=scattered)


def one_factor(setup: Setup) -> Setup:
    """The setup with one factor for both directions, which has the bounds and the prior of the axial one."""
    kept = {n: spec for n, spec in setup.unknowns.items() if not n.endswith(".rotational")}
    return setup.model_copy(update={"unknowns": {n.removesuffix(".axial"): spec for n, spec in kept.items()}})


def freeze(found: Calibration, file: Path) -> None:
    """Write a posterior, shortened: what ``fctd.calibration.predict.read_posterior`` reads."""
    posterior = found.posterior
    assert posterior.mixture is not None
    replace(posterior, mixture=posterior.mixture.main(_LEAST)).write(file)
    shortened = _rounded(json.loads(file.read_text(encoding="utf-8")))
    file.write_text(json.dumps(shortened) + "\n", encoding="utf-8")


def furthest(again: Calibration, frozen: Posterior) -> float:
    """Largest difference of a repeated fit from frozen values, in standard deviations of these."""
    sd = np.sqrt(np.diag(frozen.covariance))
    return float((np.abs(again.fit.best - frozen.best) / sd).max())


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return float(f"{value:.{_DIGITS}g}")
    if isinstance(value, list):
        return [_rounded(one) for one in value]
    return {key: _rounded(one) for key, one in value.items()} if isinstance(value, dict) else value


def carried_on(
    fitted: Forward,
    judged: Forward,
    order: Callable[[Row], Any],
    quantities: Callable[[Forward], Sequence[Judged]] = readings_of,
) -> dict[tuple[str, str], float]:
    """The last reading that fitted before each judged one, of the same kind [kN, kN m], by id and quantity.

    order : key of rows, such as their date; where nothing fitted is earlier, the first that fitted.
    """

    def first_row(forward: Forward, one: Judged) -> Row:
        return forward.rows[forward.readings[one.parts[0][0]].row]

    def middle(one: Judged) -> float:
        return 1e-3 * sum(share * fitted.readings[i].range.middle for i, share in one.parts)

    old = [(one.quantity, order(first_row(fitted, one)), middle(one)) for one in quantities(fitted)]
    found = {}
    for one in quantities(judged):
        like = sorted((key, value) for quantity, key, value in old if quantity == one.quantity)
        before = [value for key, value in like if key < order(first_row(judged, one))]
        if like:
            found[one.id, one.quantity] = before[-1] if before else like[0][1]
    return found
