"""What a report computes of a case: chart, margins, limits over depth, strings at the bottom, pumped mud."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from fctd.answers.steady import torque_drag
from fctd.case.errors import InputError
from fctd.case.friction import FrictionSet
from fctd.case.load import Case, naming_file, with_friction
from fctd.case.message import frame_of
from fctd.hydraulics.pressures import Circulation, Eccentricity, check_flows, circulations
from fctd.model.operations import SteadyRates, flow_of, rates_of_all
from fctd.results.status import SteadyStatus
from fctd.steady.equilibrium import Solver, lie_along
from fctd.steady.margin_table import USUAL, margin_rows, of_lines
from fctd.steady.steady_string import Equilibrium

if TYPE_CHECKING:
    import pandas as pd

LIMIT_DEPTHS: Final = 7  # of the lines of limits: each takes a second, the deepest up to twenty
# Called with what is computed, and with how many of its rows are done.
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True)
class Asked:
    """What a report is to have.

    kinds of operations; bit depths [m], rising; frictions : sets of factors, none for the case's own; drive : speed,
    rpm and flow as of ``torque_drag``; limits : whether to search for them; measured : of ``read_measured``, or None.
    """

    kinds: Sequence[str]
    bit_depths: Sequence[float]
    frictions: Sequence[FrictionSet] = ()
    drive: Mapping[str, Any] = field(default_factory=dict)
    limits: bool = True
    measured: pd.DataFrame | None = None


@dataclass(frozen=True)
class Answers:
    """The answers, SI.

    case : with the first set of factors, which all but the chart have; rates : of the operations; chart : of
    ``torque_drag``; margins, lines : of ``limits_of``, at the deepest possible depth, and of the usual kinds at some
    depths up to buckling, None where there are none or they are not asked for; points : strings at the deepest possible
    depth; flow [m³/s] and circulations : of the mud that is pumped, by depth; dry : why there are none.
    """

    case: Case
    asked: Asked
    rates: Mapping[str, SteadyRates]
    chart: pd.DataFrame
    margins: pd.DataFrame | None
    lines: pd.DataFrame | None
    points: tuple[Equilibrium, ...]
    flow: float
    circulations: tuple[Circulation, ...]
    dry: str

    @property
    def acceptable(self) -> bool:
        """Whether all rows of the chart have an answer."""
        return all(SteadyStatus(status).acceptable for status in self.chart["status"].unique())


def answer(case: Case, asked: Asked, progress: Progress = lambda what, done, total: None) -> Answers:
    """Compute what a report shows.  Raises InputError for unusable input, and where string and hole never fit."""
    kinds, drive = list(asked.kinds), dict(asked.drive)

    def show(what: str) -> Callable[[int, int], None]:
        return lambda done, total: progress(what, done, total)

    chart = torque_drag(
        case, kinds, list(asked.bit_depths), list(asked.frictions) or None, **drive, progress=show("chart")
    )
    fits = (chart["status"] != SteadyStatus.NOT_POSSIBLE).groupby(chart["bit_depth_m"]).any()
    depths = [float(depth) for depth in fits.index[fits]]
    one = with_friction(case, asked.frictions[0]) if asked.frictions else case
    with naming_file(one):
        solver, rates = Solver(one), rates_of_all(one, kinds, **drive)
        margins, lines = None, None
        if asked.limits:
            margins = _margins(solver, rates, [(kind, depths[-1]) for kind in kinds], show("margins"))
            at = [(kind, depth) for kind in kinds if kind in USUAL for depth in of_lines(depths, LIMIT_DEPTHS)]
            lines = _margins(solver, rates, at, show("limits"), beyond_buckling=False) if at else None
        points = tuple(solver.solve(kind, rates[kind], depths[-1]) for kind in kinds)
        # A flow that is asked for is that of all of the report.
        flow = flow_of(case) if drive.get("flow") is None else max(rate.flow for rate in rates.values())
        found, dry = _pumped(one, flow, depths, show("hydraulics"))
    return Answers(one, asked, rates, chart, margins, lines, points, flow, found, dry)


def _margins(
    solver: Solver, rates: Mapping[str, SteadyRates], at: Sequence[tuple[str, float]],
    progress: Callable[[int, int], None], **options: bool,
) -> pd.DataFrame:  # fmt: skip
    """The rows of ``limits_of`` for kinds at bit depths [m]; options : of ``margin_rows``."""
    rows = []
    for done, (kind, depth) in enumerate(at, start=1):
        rows += margin_rows(solver, [kind], rates, depth, **options)
        progress(done, len(at))
    return frame_of(rows)


def _pumped(
    case: Case, flow: float, depths: Sequence[float], progress: Callable[[int, int], None]
) -> tuple[tuple[Circulation, ...], str]:
    """The circulation at each bit depth, or why there is none."""
    if flow <= 0:
        return (), "no operation has a flow"
    beside: Eccentricity = lie_along if case.mud.eccentricity == "string" else None
    try:
        check_flows(case)
    except InputError as error:
        return (), f"{error.key} is missing: {error.expected}"
    try:
        found = circulations(case, [flow], depths, beside, progress=progress)
    except InputError as error:  # as of a column that falls freely
        return (), error.message
    return tuple(one for one in found if isinstance(one, Circulation)), ""
