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
from fctd.results.measured_file import ENDS, LARGEST_FORCE, LARGEST_TORQUE, Field, Line, Text, read_lines, require

if TYPE_CHECKING:
    import pandas as pd

# Readings without a string in the hole's grip: in slips the hook carries the block alone; a tare turns the free drive.
STRINGLESS: Final = ("in_slips", "tare")
# Headers of what the gauge of the rig reads, the block included.
GAUGE: Final = r"hook[ _]?load|weight[ _]indicator|indicator"
_BELOW: Final = 30.0  # m: a measured depth may exceed the last station of the survey by a joint or two
DEPTH: Final = Field("bit_depth", "m", LENGTH, r"bit[ _]depth|depth|md", "m", at_least=0.0)
_LOADS: Final = (
    Field("string_load", "N", FORCE, r"string[ _]load", "kN", ranged=True, at_most=LARGEST_FORCE),
    Field("hookload", "N", FORCE, GAUGE, "kN", ranged=True, at_most=LARGEST_FORCE),
    Field("surface_torque", "N_m", TORQUE, r"(?:surface[ _])?torque", "kN_m", ranged=True, at_most=LARGEST_TORQUE),
)
_LOAD_COLUMNS: Final = tuple(field.column(end) for field in _LOADS for end in ENDS)
_HEADERS: Final = "such as bit_depth_m, operation, hookload_kN, hookload_low_kN, hookload_high_kN, torque_kN_m"


def measured_column(column: str, end: str) -> str:
    """Column of an end of a range, "low" or "high", beside a column such as ``hookload_N``."""
    stem = COLUMNS[column].stem
    return f"{stem}_{end}{column.removeprefix(stem)}"


def read_measured(path: Path, case: Case) -> pd.DataFrame:
    """Measured rows of a CSV file, SI: operation, bit_depth_m, and loads with the low and high ends of their ranges.

    Loads that the file does not have are NaN.  A measured hook load is the reading of the weight indicator, block
    included, as in a calibration; the rig of the case converts it into that of the string, and the other way round.
    Rows without a string (in slips, tare) have no place in a chart and are left out.  Raises InputError, which names
    file, row and column.
    """
    try:
        operation = Text("operation", "operation|kind", _kind)
        lines = read_lines(path, (DEPTH, *_LOADS), [operation], _HEADERS)
        require(lines, "bit depth", [DEPTH.column()], _HEADERS)
        require(lines, "operation", ["operation"], _HEADERS)
        require(lines, "load or torque", _LOAD_COLUMNS, _HEADERS)
        lines = [line for line in lines if line.cells["operation"] not in STRINGLESS]
        if not lines:
            raise InputError(f"a row with a string in the hole, not {' and '.join(STRINGLESS)} alone")
        for line in lines:
            check_depth(line, case.depths[1])
    except InputError as error:
        raise error.in_file(path) from error.__cause__
    import pandas as pd

    table = pd.DataFrame([line.cells for line in lines])
    table = table.reindex(columns=["operation", DEPTH.column(), *_LOAD_COLUMNS])
    direction = table["operation"].map(lambda kind: KINDS[kind].direction)
    for end in ENDS:
        string, gauge = table.pop(f"string_load{end}_N"), table.pop(f"hookload{end}_N")
        table[f"hookload{end}_N"] = string.fillna(string_load(case.rig, direction, gauge))
        table[f"weight_indicator{end}_N"] = gauge.fillna(weight_indicator(case.rig, direction, string))
    return table


def check_depth(line: Line, deepest: float) -> None:
    """Raise InputError for a row without a bit depth, or with one below the end of the hole, ``deepest`` [m]."""
    depth = line.number_of(DEPTH.column())
    if not depth <= deepest + _BELOW:
        expected = "a number" if depth != depth else f"a depth in the hole, which ends at {deepest:g} m"
        raise line.error(DEPTH.column(), expected)


def _kind(cell: str) -> str:
    if cell not in (*KINDS, *STRINGLESS):
        raise InputError(nearest(cell, KINDS, "kind"))
    return cell
