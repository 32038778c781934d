"""The description of a torque-and-drag chart, made from its table."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Final

import numpy as np

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.case.systems import told
from fctd.case.text import printable
from fctd.plots.description import Curve, DepthAxis, Description, Group, Key, Lane, Mark, Name, Panel, Points
from fctd.plots.limit_lines import limit_lines
from fctd.plots.loads import (
    LOAD_COLUMNS,
    MOST_CURVES,
    NAMES,
    PLAIN,
    TORQUE,
    ChartLook,
    Compared,
    as_load,
    cases_of,
    groups_of,
    limits_of_load,
    limits_of_torque,
    measured_columns,
    spent_at,
)
from fctd.plots.palette import BUCKLED, CASES, DASHES, LOOKS, QUIET, SOLID
from fctd.results.columns import DEPTH
from fctd.results.differences import in_a_row
from fctd.results.series import Chart, Series, frictions_of, has_fan, series_of
from fctd.results.status import SteadyStatus
from fctd.results.unit_systems import System, shown

if TYPE_CHECKING:
    import pandas as pd

# Labels of operations where those of ``KINDS`` do not fit.
SHORT: Final = {"rotate_off_bottom": "rotating", "drill_rotating": "drilling", "drill_sliding": "sliding"}
MOST_GROUPS: Final = 24  # in a chart
# Curves of an operation that are nowhere further apart than this share of the axis are drawn once: half a line's width.
SAME: Final = 0.0025
AIR: Final = 0.02  # of the span of depths, above and below them
# Where rows stand that have no place on their line: from the left edge of the axis, for the first curve, and from curve
# to curve, in shares of the axis.
EDGE, APART = 0.015, 0.025
LONGEST = 40  # characters of the name of a case
WIDEST, NARROWEST = 1.9, 0.9  # lines of the first and the last case, so that one below another is seen


def describe(chart: Chart, units: System = "si", case: Compared = None, look: ChartLook = PLAIN) -> Description:
    """The description of a chart; the arguments are those of ``chart_figure``."""
    cases, measured, series = cases_of(case), look.measured, series_of(chart, units)
    load, names = look.load_of(cases), list(dict.fromkeys(one.case for one in series))
    if len(names) > len(CASES):
        raise InputError(f"at most {len(CASES)} cases in a picture", key="cases", value=len(names))
    frictions, fan, several = frictions_of(series), has_fan(series), len({one.operation for one in series}) > 1
    columns = LOAD_COLUMNS[load], TORQUE
    lines = [limit_lines(look.margins, cases.get(""), load, column) for column in columns]
    values = [[line.value for line in of] for of in lines]
    limits = (
        limits_of_load(series, cases, load, units, measured, values[0]),
        limits_of_torque(series, units, measured, values[1]),
    )
    metre = shown(DEPTH.name, units)
    spans = [
        (limit.high - limit.low) / shown(column, units).factor for limit, column in zip(limits, columns, strict=True)
    ]
    drawn = [len(_distinct(series, column, span)) for column, span in zip(columns, spans, strict=True)]
    groups = [("", series)] if max(drawn) <= MOST_CURVES else groups_of(series)
    if len(groups) > MOST_GROUPS:
        raise InputError(f"at most {MOST_GROUPS} groups of curves in a picture", key="friction", value=len(groups))

    def panel(column: str, group: list[Series], lanes: dict[int, int]) -> Panel:
        k, unit = columns.index(column), shown(column, units)
        kinds = dict.fromkeys(one.operation for one in group)
        curves = []
        for at, of in enumerate(_distinct(group, column, spans[k])):
            one, factors = group[of[0]], _factors([group[i] for i in of], group)
            reasons = {text: told(text, units) for text in dict.fromkeys(one.columns["reason"])}
            rows, none = one.columns, np.full(len(one.columns[column]), np.nan)
            ends = (none, none) if k else (rows[end] for end in ("hookload_low_N", "hookload_high_N"))
            low, high = (as_load(cases[one.case], one.operation, end, load) * unit.factor for end in ends)
            edge = limits[k].low + (EDGE + APART * at) * (limits[k].high - limits[k].low)
            dash = DASHES[frictions.index(one.friction) % len(DASHES)] if fan and (factors or len(of) == 1) else SOLID
            name, (colour, width) = _name(one, factors, group), _look(one, names)
            key = _cut(one.case) or (KINDS[one.operation].label if several else name.full)
            curves.append(
                Curve(
                    one.operation, one.friction, name, dash, lanes.get(of[0], 0),
                    rows[DEPTH.name] * metre.factor, rows[column] * unit.factor,
                    low, high, rows["status"].astype(str), rows["buckling"].astype(str),
                    np.array([reasons[text] for text in rows["reason"]]), limits[k], edge, bool(k), key, colour, width,
                )
            )  # fmt: skip
        return Panel(
            column, f"{NAMES[column]}, {unit.label}", unit.label, limits[k], tuple(curves),
            tuple(_points(measured, kinds, column, unit.factor, metre.factor)),
            tuple(
                line._replace(depth=line.depth * metre.factor, value=line.value * unit.factor)
                for line in lines[k] if line.operation in kinds
            ),
            spent_at(cases, load) * unit.factor if limits[k].cut and not k else None,
        )  # fmt: skip

    described = []
    for name, group in groups:
        lanes, number_of = _lanes(group, metre.factor)
        described.append(Group(name, (panel(columns[0], group, number_of), panel(TORQUE, group, number_of)), lanes))
    depth = _depth_axis(series, measured, metre.factor, metre.label)
    keys = _keys(series, frictions) if names == [""] else _keys_of_cases(series, names, frictions if fan else [])
    return Description(depth, _marks(cases, depth, metre.factor), tuple(described), tuple(keys), names != [""])


def _distinct(group: list[Series], column: str, span: float) -> list[list[int]]:
    """Indices of the series of a group, those together that one curve draws; span : of the axis, SI."""
    found: list[list[int]] = []
    for k, one in enumerate(group):
        same = next((of for of in found if _same(group[of[0]], one, column, SAME * span)), None)
        if same is None:
            found.append([k])
        else:
            same.append(k)
    return found


def _same(one: Series, other: Series, column: str, most: float) -> bool:
    names = DEPTH.name, "status", "buckling"
    if one[:2] != other[:2] or not all(np.array_equal(one.columns[n], other.columns[n]) for n in names):
        return False
    return np.allclose(one.columns[column], other.columns[column], rtol=0.0, atol=most, equal_nan=True)


def _factors(of: list[Series], group: list[Series]) -> str:
    """The friction factors of a curve that draws some series of a group; empty where they make no difference."""
    same = [one for one in group if one[:2] == of[0][:2]]
    if len({one.friction for one in group}) == 1 or (len(of) == len(same) and (len(of) > 1 or of[0].case)):
        return ""
    return f"μ {' and '.join(one.friction for one in of)}"


def _look(one: Series, names: list[str]) -> tuple[str, float]:
    """Colour and width of a curve; names : of all cases."""
    if not one.case:
        return LOOKS[one.operation][0], 1.0
    at = names.index(one.case)
    return CASES[at], WIDEST + (NARROWEST - WIDEST) * at / max(len(names) - 1, 1)


def _name(one: Series, factors: str, group: list[Series]) -> Name:
    """The name of a curve of a group."""
    kind, label = one.operation, KINDS[one.operation].label
    if one.case:  # marker, colour and legend tell the operation and the case
        word = SHORT.get(kind, label) if len({of.operation for of in group}) > 1 else ""
        full, short = (", ".join(filter(None, [_cut(one.case), of, factors])) for of in (word, ""))
        return Name(full, short, factors)
    several = len({one.operation for one in group}) > 1 or not factors
    full, short = (
        ", ".join(filter(None, [word if several else "", factors])) for word in (label, SHORT.get(kind, label))
    )
    return Name(full, short, factors or short)


def _cut(name: str) -> str:
    """The name of a case as a label; of a long one its beginning and its end, in which names of one file differ."""
    text = printable(name)
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 15]}…{text[-14:]}"


def _lanes(group: list[Series], metre: float) -> tuple[tuple[Lane, ...], dict[int, int]]:
    """The lanes of a group, and the number of the lane of each of its series by index."""
    lanes: list[Lane] = []
    numbers: dict[int, int] = {}
    for k, one in enumerate(group):
        rows = one.columns
        modes, status = rows["buckling"].astype(str), rows["status"].astype(str)
        if (status == SteadyStatus.CONVERGED).all() and not np.isin(modes, list(BUCKLED)).any():
            continue
        lane = Lane(
            len(lanes) + 1, one.operation, rows[DEPTH.name] * metre, modes, status, np.isfinite(rows["hookload_N"]),
        )  # fmt: skip
        same = next((old for old in lanes if old.operation == one.operation and _alike(old, lane)), None)
        if same is None:
            lanes.append(lane)
        numbers[k] = (same or lane).number
    return tuple(lanes), numbers


def _alike(one: Lane, other: Lane) -> bool:
    pairs = zip(one[2:], other[2:], strict=True)
    return all(np.array_equal(mine, its) for mine, its in pairs)


def _points(
    measured: pd.DataFrame | None, kinds: Iterable[str], column: str, factor: float, metre: float
) -> list[Points]:
    """The measured points of operations, one for each that has any in a column."""
    found = []
    for kind in [] if measured is None else kinds:
        assert measured is not None
        rows = measured[measured["operation"] == kind]
        values = [rows[name].to_numpy(float) * factor for name in measured_columns(column)]
        at = np.isfinite(values[0]) | np.isfinite(values[1])
        if at.any():
            value, low, high = (of[at] for of in values)
            found.append(Points(kind, rows["bit_depth_m"].to_numpy(float)[at] * metre, value, low, high))
    return found


def _depth_axis(series: list[Series], measured: pd.DataFrame | None, factor: float, unit: str) -> DepthAxis:
    depths = [one.columns[DEPTH.name] for one in series]
    depths += [] if measured is None or measured.empty else [measured["bit_depth_m"].to_numpy(float)]
    ends = min(of.min() for of in depths), max(of.max() for of in depths)
    top, bottom = (float(end) * factor for end in ends)
    air = AIR * ((bottom - top) or max(0.01 * bottom, 1.0))
    return DepthAxis(f"{DEPTH.label}, {unit}", unit, top, bottom, top - air, bottom + air)


def _marks(cases: Mapping[str, Case | None], depth: DepthAxis, factor: float) -> tuple[Mark, ...]:
    """The marks of all cases from the top; one that not all of them have says whose it is."""
    owners: dict[Mark, list[str]] = {}
    for name, case in cases.items():
        for mark in _marks_of(case, depth, factor):
            owners.setdefault(mark, []).append(name)
    marks = [
        mark if len(of) == len(cases) else mark._replace(lines=(*mark.lines, in_a_row([*map(_cut, of)])))
        for mark, of in owners.items()
    ]
    return tuple(sorted(marks, key=lambda mark: mark.depth))


def _marks_of(case: Case | None, depth: DepthAxis, factor: float) -> tuple[Mark, ...]:
    """The ends of the intervals that are shoes or have names, from the top; that of the last lies at the last depth."""
    if case is None:
        return ()
    shoes, marks, above = case.shoes, list[Mark](), -np.inf
    for interval in case.wellbore.intervals:
        end, shoe = interval.to_md * factor, interval.to_md in shoes
        lines = tuple(filter(None, [interval.name, f"shoe {end:.0f} {depth.unit}" if shoe else ""]))
        if lines and end >= depth.top and above < depth.bottom and (interval.name or end <= depth.bottom):
            seen = end <= depth.bottom
            marks.append(Mark(min(end, depth.bottom), lines if seen else lines[:1], shoe and seen))
        above = end
    return tuple(marks)


def _keys(series: list[Series], frictions: list[str]) -> list[Key]:
    """What colours, markers and dashes stand for."""
    kinds = dict.fromkeys(one.operation for one in series)
    if len(kinds) == 1 and len(frictions) > 1:
        return [
            Key(f"μ {friction}", *LOOKS[next(iter(kinds))], DASHES[k % len(DASHES)])
            for k, friction in enumerate(frictions)
        ]
    keys = [Key(KINDS[kind].label, *LOOKS[kind], SOLID) for kind in kinds]
    if len(frictions) > 1:
        keys += [Key(f"μ {friction}", QUIET, "", DASHES[k % len(DASHES)]) for k, friction in enumerate(frictions)]
    return keys


def _keys_of_cases(series: list[Series], names: list[str], frictions: list[str]) -> list[Key]:
    """What the colours of cases, the markers of operations and the dashes of factors stand for."""
    kinds = dict.fromkeys(one.operation for one in series)
    keys = [Key(_cut(name), CASES[k], "", SOLID) for k, name in enumerate(names)]
    keys += [Key(KINDS[kind].label, QUIET, LOOKS[kind][1], SOLID) for kind in kinds if len(kinds) > 1]
    return keys + [Key(f"μ {friction}", QUIET, "", DASHES[k % len(DASHES)]) for k, friction in enumerate(frictions)]
