"""What a torque-and-drag chart shows, in the units of its axes; pictures, pages and the live page draw it.

A chart has groups of curves, a group has a panel of loads and one of torques, and all groups have the same axes.
``describe`` in describe.py makes the description of a chart.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.operations import KINDS
from fctd.plots.limit_lines import LimitLine
from fctd.plots.loads import Limits, marked
from fctd.plots.palette import LOOKS, Dash
from fctd.results.status import SteadyStatus

Flags = NDArray[np.bool_]
Texts = NDArray[np.str_]


class Name(NamedTuple):
    """A curve's name by what differs in its group: in full, short, and by its friction factors where it has them."""

    full: str
    short: str
    factors: str


class Key(NamedTuple):
    """A look of curves, and what it stands for; without a marker a dash of every operation."""

    name: str
    colour: str
    marker: str
    dash: Dash


@dataclass(frozen=True)
class Curve:
    """A curve of a panel; arrays (n,) by rising depth, in the units of the axes.

    lane : number of its lane in the strip of states, 0 without one.  value : NaN without loads; low, high : of both
    shapes, NaN where they do not differ.  status, modes, reasons : texts of each row.  edge : where rows stand that
    have no place on the line.  key : its name in the legend, where several curves may share one.  colour : of its
    operation, or of its case among several; width : of its line, in that of other lines.
    """

    operation: str
    friction: str
    name: Name
    dash: Dash
    lane: int
    depth: Array
    value: Array
    low: Array
    high: Array
    status: Texts
    modes: Texts
    reasons: Texts
    limits: Limits
    edge: float
    torque: bool
    key: str
    colour: str
    width: float = 1.0

    @property
    def look(self) -> tuple[str, str]:
        """Colour and marker."""
        return self.colour, LOOKS[self.operation][1]

    @cached_property
    def locked(self) -> Flags:
        """Rows that are locked up."""
        found: Flags = self.status == SteadyStatus.LOCKED_UP
        return found

    @property
    def stuck(self) -> Flags:
        """Rows of a panel of loads that no push moves: they stand on the left edge of the axis."""
        return np.isnan(self.value) & self.locked & (not self.torque)

    @cached_property
    def beyond(self) -> tuple[Flags, Flags]:
        """Rows whose loads lie beyond the left and the right edge of the axis."""
        return self.value < self.limits.low, self.value > self.limits.high

    @cached_property
    def line(self) -> Array:
        """The values, cut at the edges of the axis: the line goes to the edge, and not along it."""
        low, high = self.beyond
        line = np.where(self.stuck, self.limits.low, np.clip(self.value, self.limits.low, self.limits.high))
        gone = self.stuck | low | high
        line[gone & np.append(True, gone[:-1]) & np.append(gone[1:], True)] = np.nan
        return line

    @property
    def marks(self) -> Flags:
        """Rows with a marker; see ``loads.marked``."""
        return marked(self.value)

    @property
    def care(self) -> Flags:
        """Rows with loads that are not plain answers; their markers are open."""
        low, high = self.beyond
        plain: Flags = self.status == SteadyStatus.CONVERGED
        return np.isfinite(self.value) & ~plain & ~low & ~high

    @property
    def lost(self) -> tuple[Flags, Array]:
        """Rows without loads, and where all rows would stand without them: in a gap on the line, else at ``edge``."""
        line, depth = self.line, self.depth
        found, at = np.isfinite(line), np.full(len(depth), self.edge)
        if found.any():
            at = np.interp(depth, depth[found], line[found], left=self.edge, right=self.edge)
        return np.isnan(self.value) & ~self.locked, at

    @property
    def end(self) -> tuple[float, float]:
        """Load and depth at the end of the line; NaN for a curve without loads."""
        line = self.line
        found = np.flatnonzero(np.isfinite(line))
        return (float(line[found[-1]]), float(self.depth[found[-1]])) if len(found) else (np.nan, np.nan)

    @property
    def has_band(self) -> bool:
        """Whether the loads of both shapes of any row reach the axis."""
        return bool(((self.high > self.limits.low) & (self.low < self.limits.high)).any())

    @property
    def texts(self) -> list[str]:
        """What the pointer says of each row beside its numbers; empty of a plain answer."""
        return [_told(*row) for row in zip(self.status, self.modes, self.reasons, strict=True)]


class Points(NamedTuple):
    """Measured points of an operation in a panel (n,), in its units.

    value : NaN where a range alone was measured; low, high : ends of the range, NaN without one.
    """

    operation: str
    depth: Array
    value: Array
    low: Array
    high: Array

    @property
    def name(self) -> str:
        """What they are in the legend."""
        return f"measured, {KINDS[self.operation].label}"

    @property
    def middle(self) -> Array:
        """Where each point stands."""
        return np.where(np.isnan(self.value), 0.5 * (self.low + self.high), self.value)

    @property
    def bars(self) -> tuple[Array, Array]:
        """Lengths of the range to the left and to the right of each point, 0 without one."""
        middle = self.middle
        return np.nan_to_num(middle - self.low), np.nan_to_num(self.high - middle)


@dataclass(frozen=True)
class Panel:
    """Loads or torques over depth; label : of its axis; spent : the load at which slack-off is spent, where cut."""

    column: str
    label: str
    unit: str
    limits: Limits
    curves: tuple[Curve, ...]
    points: tuple[Points, ...]
    lines: tuple[LimitLine, ...]
    spent: float | None = None


class Lane(NamedTuple):
    """The states of a string over depth (n,), in a strip beside the panels; loaded : rows with loads."""

    number: int
    operation: str
    depth: Array
    modes: Texts
    status: Texts
    loaded: Flags


class Group(NamedTuple):
    """Panels of loads and torques of a group of curves; lanes : of strings that are buckled, or no plain answers."""

    name: str
    panels: tuple[Panel, Panel]
    lanes: tuple[Lane, ...]


class DepthAxis(NamedTuple):
    """The axis of depths: its label and unit, the first and the last depth, and its upper and lower end."""

    label: str
    unit: str
    top: float
    bottom: float
    upper: float
    lower: float


class Mark(NamedTuple):
    """The lower end of an interval within the depths: its lines of text, and whether it is a casing shoe."""

    depth: float
    lines: tuple[str, ...]
    shoe: bool


@dataclass(frozen=True)
class Description:
    """A chart: axis of depths, ends of intervals, groups of panels, and what the looks of its curves stand for.

    compared : whether it has several cases.
    """

    depth: DepthAxis
    marks: tuple[Mark, ...]
    groups: tuple[Group, ...]
    keys: tuple[Key, ...]
    compared: bool = False

    @property
    def curves(self) -> list[Curve]:
        """The curves of all panels."""
        return [curve for group in self.groups for panel in group.panels for curve in panel.curves]


@lru_cache(maxsize=1024)
def _told(status: str, mode: str, reason: str) -> str:
    if status == SteadyStatus.CONVERGED and mode == "none":
        return ""
    words = [status.replace("_", " "), "" if mode in ("none", "unknown") else f"buckling {mode}"]
    return ": ".join(filter(None, [", ".join(filter(None, words)), "" if reason == "none" else reason]))
