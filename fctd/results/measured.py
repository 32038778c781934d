"""Measured hook loads and torques from a CSV file, to be drawn over the curves of a chart."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from fctd.case.errors import InputError, nearest
from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.case.units import FORCE, LENGTH, TORQUE
from fctd.model.operations import string_load, weight_indicator
from fctd.results.columns import COLUMNS
from fctd.results.measured_file import ENDS, Field, Line, Text, read_lines, require

if TYPE_CHECKING:
    import pandas as pd

_BELOW: Final = 30.0  # m: a measured depth may exceed the last station of the survey by a joint or two
DEPTH: Final = Field("bit_depth", "m", LENGTH, r"bit[ _]depth|depth|md", "m", at_least=0.0)
_LOADS: Final = (
    Field("hookload", "N", FORCE, r"hook[ _]?load|string[ _]load", "kN", ranged=True),
    Field("weight_indicator", "N", FORCE, r"weight[ _]indicator|indicator", "kN", ranged=True),
    Field("surface_torque", "N_m", TORQUE, r"(?:surface[ _])?torque", "kN_m", ranged=True),
)
_LOAD_COLUMNS: Final = tuple(field.column(end) for field in _LOADS for end in ENDS)
_HEADERS: Final = "such as bit_depth_m, operation, hookload_kN, hookload_low_kN, hookload_high_kN, torque_kN_m"


def measured_column(column: str, end: str) -> str:
    """Column of an end of a range, "low" or "high", beside a column such as ``hookload_N``."""
    stem = COLUMNS[column].stem
    return f"{stem}_{end}{column.removeprefix(stem)}"


def read_measured(path: Path, case: Case) -> pd.DataFrame:
    """Measured rows of a CSV file, SI: operation, bit_depth_m, and loads with the low and high ends of their ranges.

    Loads that the file does not have are NaN.  Hook loads are those of the string; a weight indicator's reading is
    converted by the rig of the case, and the other way round.  Raises InputError, which names file, row and column.
    """
    try:
        operation = Text("operation", "operation|kind", _kind)
        lines = read_lines(path, (DEPTH, *_LOADS), [operation], _HEADERS)
        require(lines, "bit depth", [DEPTH.column()], _HEADERS)
        require(lines, "operation", ["operation"], _HEADERS)
        require(lines, "load or torque", _LOAD_COLUMNS, _HEADERS)
        for line in lines:
            check_depth(line, case.depths[1])
    except InputError as error:
        raise error.in_file(path) from error.__cause__
    import pandas as pd

    table = pd.DataFrame([line.cells for line in lines])
    table = table.reindex(columns=["operation", DEPTH.column(), *_LOAD_COLUMNS])
    direction = table["operation"].map(lambda kind: KINDS[kind].direction)
    for end in ENDS:
        string, indicator = f"hookload{end}_N", f"weight_indicator{end}_N"
        known = table[string].copy()
        table[string] = known.fillna(string_load(case.rig, direction, table[indicator]))
        table[indicator] = table[indicator].fillna(weight_indicator(case.rig, direction, known))
    return table


def check_depth(line: Line, deepest: float) -> None:
    """Raise InputError for a row without a bit depth, or with one below the end of the hole, ``deepest`` [m]."""
    depth = line.number_of(DEPTH.column())
    if not depth <= deepest + _BELOW:
        expected = "a number" if depth != depth else f"a depth in the hole, which ends at {deepest:g} m"
        raise line.error(DEPTH.column(), expected)


def _kind(cell: str) -> str:
    if cell not in KINDS:
        raise InputError(nearest(cell, KINDS, "kind"))
    return cell
