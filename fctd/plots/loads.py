"""Which load a chart shows, and how far its axes reach; for pictures and pages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Literal, NamedTuple, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.model.operations import SteadyRates, weight_indicator
from fctd.results.columns import measured_column
from fctd.results.series import Series, frictions_of, has_fan, in_words
from fctd.results.status import SteadyStatus
from fctd.results.unit_systems import System, shown

if TYPE_CHECKING:
    import pandas as pd

Load = Literal["string", "indicator"]

LOAD_COLUMNS: Final[dict[Load, str]] = {"string": "hookload_N", "indicator": "weight_indicator_N"}
NAMES: Final = {
    "hookload_N": "hook load (string)",
    "weight_indicator_N": "weight indicator (string and block)",
    "surface_torque_N_m": "surface torque",
}
TORQUE: Final = "surface_torque_N_m"
MOST_CURVES = 10  # that can be told apart in one panel
MARKS = 8  # about as many markers on a line
# Axes show pushes up to this share of the span of the other loads.
BESIDE = 0.25
AIR = 0.05  # of the span of an axis, beyond the loads
# Least span of an axis as a share of the largest load, and of torques as a lever [m] times the largest of hook loads
# and contact forces: friction has ten times this lever, and less is the torque of a string that slides.
LEAST_SHARE, LEVER = 0.01, 2e-3


class OfCase(Protocol):
    """What a chart of several cases says of one of them, as a ``Chart`` does."""

    @property
    def case(self) -> Case:
        """The case."""

    @property
    def rates(self) -> Mapping[str, SteadyRates]:
        """The rates of its operations."""


# The case of a chart, or what is said of the cases that its column ``case`` names.
Compared: TypeAlias = Case | Mapping[str, OfCase] | None


@dataclass(frozen=True)
class ChartLook:
    """What a chart shows beside its rows, in a picture and on a page.

    load : hook load of the string, or the reading of the weight indicator; by default that of ``usual_load``.
    rates : of the operations, else the case's own.  measured : of ``read_measured``.  told : lines above the facts;
    warnings : lines below these, before the notes of the chart.  margins : of ``margin_table``, whose limits are drawn
    as lines.
    """

    load: Load | None = None
    rates: Mapping[str, SteadyRates] | None = None
    measured: pd.DataFrame | None = None
    warnings: Sequence[str] = ()
    margins: pd.DataFrame | None = None
    told: Sequence[str] = ()

    def load_of(self, cases: Mapping[str, Case | None]) -> Load:
        """The load that a chart of cases shows."""
        return self.load or usual_load([case for case in cases.values() if case is not None])


PLAIN: Final = ChartLook()


def cases_of(case: Compared) -> dict[str, Case | None]:
    """The cases of a chart by the names of their series: "" of one alone."""
    return {name: chart.case for name, chart in case.items()} if isinstance(case, Mapping) else {"": case}


class Limits(NamedTuple):
    """Ends of an axis, and those beyond which loads of locked-up strings are cut, in the units of the axis."""

    low: float
    high: float
    cut: bool


def groups_of(series: list[Series]) -> list[tuple[str, list[Series]]]:
    """The series in groups of at most ``MOST_CURVES``, with a heading each; a lone group has none.

    A group has one set of friction factors or one operation, whichever gives fewer groups; of several cases it has all,
    and where these are too many curves one set of one operation.
    """
    if len(series) <= MOST_CURVES:
        return [("", series)]
    if any(one.case for one in series):
        return _groups_of_cases(series)
    by_friction = [(in_words(name), [s for s in series if s.friction == name]) for name in frictions_of(series)]
    by_operation = []
    for kind in dict.fromkeys(s.operation for s in series):
        same, label = [s for s in series if s.operation == kind], KINDS[kind].label
        parts = -(-len(same) // MOST_CURVES)
        size = -(-len(same) // parts)
        for k in range(0, len(same), size):
            part = same[k : k + size]
            words = label if len(same) <= MOST_CURVES else f"{label}, μ {part[0].friction} to {part[-1].friction}"
            by_operation.append((words, part))
    return by_operation if len(by_operation) < len(by_friction) else by_friction


def _groups_of_cases(series: list[Series]) -> list[tuple[str, list[Series]]]:
    ways: list[dict[str, list[Series]]] = [{}, {}, {}]
    for one in series:
        operation, friction = KINDS[one.operation].label, in_words(one.friction)
        for way, words in zip(ways, (operation, friction, f"{operation}, {friction}"), strict=True):
            way.setdefault(words, []).append(one)
    if not has_fan(series):
        return list(ways[0].items())  # each case has its own factors
    fitting = [way for way in ways if max(map(len, way.values())) <= MOST_CURVES]
    return list(min(fitting or ways[-1:], key=len).items())


def usual_load(cases: Sequence[Case]) -> Load:
    """The load that pictures and screen show: what the rig reads, where all cases say what the block weighs."""
    return "indicator" if cases and all(case.rig.block_weight for case in cases) else "string"


def marked(value: Array) -> NDArray[np.bool_]:
    """Values with a marker: at even intervals of rows, and those whose neighbours are missing, as no line is there."""
    known = np.isfinite(value)
    above, below = np.append(False, known[:-1]), np.append(known[1:], False)
    spread = np.zeros(len(value), bool)
    spread[:: max(len(value) // MARKS, 1)] = True
    at: NDArray[np.bool_] = known & (spread | ~(above | below))
    return at


def push_of(case: Case | None) -> float:
    """The largest push of the block on the string [N]; 0 without a case."""
    return 0.0 if case is None else case.rig.push


def as_load(case: Case | None, kind: str, hookload: Array, load: Load) -> Array:
    """Hook loads [N] of an operation as the load that is shown."""
    if load == "string":
        return hookload
    if case is None:
        return np.full_like(hookload, np.nan)
    return np.array([weight_indicator(case.rig, KINDS[kind].direction, float(value)) for value in hookload])


def spent_at(cases: Mapping[str, Case | None], load: Load) -> float:
    """The load [N] at which slack-off is spent in every case: nothing but the block pulls the string down."""
    return -max(map(push_of, cases.values())) if load == "string" else 0.0


def limits_of_load(
    series: Sequence[Series], cases: Mapping[str, Case | None], load: Load, units: System,
    measured: pd.DataFrame | None, lines: Sequence[Array] = (),
) -> Limits:  # fmt: skip
    """Limits of the axis of hook loads; the pushes of locked-up strings do not set them.

    lines : other loads that it shows [N].
    """
    column = LOAD_COLUMNS[load]
    visible = [*_free(series, column), *_measured(measured, column), *lines]
    for end in ("hookload_low_N", "hookload_high_N"):
        for one, values in zip(series, _free(series, end), strict=True):
            visible.append(as_load(cases[one.case], one.operation, values[np.isfinite(values)], load))
    locked = any(_locked(one).any() for one in series)
    if locked:
        visible.append(np.array([spent_at(cases, load)]))
        # A chart of nothing but pushes shows the least of them.
        shown_loads, every = _finite(visible), _finite([one.columns[column] for one in series])
        if np.ptp(shown_loads) == 0 and len(every):
            visible.append(every.max(keepdims=True))
    blocks = [case.rig.block_weight for case in cases.values() if case is not None and load == "indicator"]
    largest = max(_largest(series, ["hookload_N"]), *blocks, 0.0)
    return _span(visible, LEAST_SHARE * largest, shown(column, units).factor, cut=locked)


def limits_of_torque(
    series: Sequence[Series], units: System, measured: pd.DataFrame | None, lines: Sequence[Array] = ()
) -> Limits:
    """Limits of the axis of torques, from 0: noise of the solver and strings that lock up do not set them.

    lines : other torques that it shows [N m].
    """
    least = LEVER * _largest(series, ["hookload_N", "total_contact_force_N"])
    visible = [np.array([0.0, least]), *_free(series, TORQUE), *_measured(measured, TORQUE), *lines]
    factor = shown(TORQUE, units).factor
    limits = _span(visible, least, factor, cut=False)
    below = any((one.columns[TORQUE][_locked(one)] * factor < limits.low).any() for one in series)
    return _span(visible, least, factor, cut=True) if below else limits


def _locked(one: Series) -> NDArray[np.bool_]:
    return np.asarray(one.columns["status"] == SteadyStatus.LOCKED_UP, bool)


def _free(series: Sequence[Series], column: str) -> list[Array]:
    """Values of a column of each series, but for those of rows that are locked up."""
    return [np.asarray(one.columns[column][~_locked(one)], float) for one in series]


def _finite(parts: Sequence[Array]) -> Array:
    values = np.concatenate(parts).astype(np.float64)
    found: Array = values[np.isfinite(values)]
    return found


def _largest(series: Sequence[Series], columns: Sequence[str]) -> float:
    """Largest of the loads of rows that are not locked up [N]; of all rows where every row is."""
    free = _finite([values for column in columns for values in _free(series, column)])
    every = free if len(free) else _finite([one.columns[column] for column in columns for one in series])
    return float(np.abs(every).max(initial=0.0))


def _measured(measured: pd.DataFrame | None, column: str) -> list[Array]:
    if measured is None:
        return []
    return [measured[name].to_numpy(float) for name in measured_columns(column)]


def measured_columns(column: str) -> tuple[str, str, str]:
    """Columns of measured rows for a column of a chart: value, low and high end of its range."""
    return column, measured_column(column, "low"), measured_column(column, "high")


def _span(visible: Sequence[Array], least: float, factor: float, *, cut: bool) -> Limits:
    """Limits that show all values [SI], at least ``least`` apart, with more room to the left where loads are cut."""
    values = _finite(visible)
    low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 0.0)
    # Where there are no loads, the axis spans 1.
    lacking = max((least or 1.0 / factor) - (high - low), 0.0) / 2
    low, high = low - lacking, high + lacking
    span = high - low
    return Limits((low - (BESIDE if cut else AIR) * span) * factor, (high + AIR * span) * factor, cut)
