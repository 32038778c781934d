"""Fits with scatter between days, by any way to compute the loads of a string, and their frozen posteriors."""

from collections.abc import Mapping, Sequence

from fctd.calibration.days import fit_scatter
from fctd.calibration.fit import fit
from fctd.calibration.forward import Forward
from fctd.calibration.result import Calibration
from fctd.calibration.rows import Row
from fctd.calibration.rules import left_out_by_rule
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import find_unknowns
from fctd.case.load import Case


def fit_by_day(
    strings: Mapping[str, Case], rows: Sequence[Row], setup: Setup, starts: int = 2, route: type[Forward] = Forward
) -> Calibration:
    """A calibration with scatter between days.  route : how the loads of a string are computed."""
    unknowns = find_unknowns({}, setup, list(strings.values()))
    forward = route(rows, strings, unknowns, setup)
    out = left_out_by_rule(rows, strings)
    found = fit(forward, [k for k in range(len(rows)) if k not in out], "soft_l1", starts)
    found, scattered = fit_scatter(forward, found)
    reasons = {rows[k].id: reason for k, reason in sorted({**out, **found.left_out}.items())}
    return Calibration(next(iter(strings.values())), forward, found, reasons, "soft_l1", scattered=scattered)
