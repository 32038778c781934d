"""Measured hook loads and torques from a CSV file, to be drawn over the curves of a chart."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from fctd.calibration.measured_file import (
    ANY_FORCE,
    ANY_TORQUE,
    DEPTH,
    ENDS,
    HOOKLOAD,
    OPERATION,
    STRINGLESS,
    TORQUE_WORDS,
    Measured,
    measured_form,
    read_measured_file,
)
from fctd.calibration.misread import WEIGHTS, Weight, out_of_order
from fctd.calibration.rows import Range
from fctd.case.errors import InputError, naming
from fctd.case.load import Case
from fctd.case.message import Message, quantity, within
from fctd.case.operations import KINDS
from fctd.case.systems import told
from fctd.case.tables.fields import Field
from fctd.case.tables.readings import TORQUE_OF_STRING
from fctd.case.text import counted
from fctd.model.operations import string_load, weight_indicator
from fctd.results.unit_systems import System

if TYPE_CHECKING:
    import pandas as pd

NOISE: Final = 0.02  # of a hook load: by less may readings be out of order
_BELOW: Final = 30.0  # m: a measured depth may exceed the last station of the survey by a joint or two
_LOADS: Final = (
    Field("string_load", "string load", ANY_FORCE, HOOKLOAD.beside, example="kN"),
    HOOKLOAD,
    replace(
        TORQUE_OF_STRING, key="surface_torque", quantity=ANY_TORQUE, beside=f"{TORQUE_OF_STRING.beside} {TORQUE_WORDS}"
    ),
)
_LOAD_COLUMNS: Final = {
    f"{load.key}{end}": f"{load.key}{end}_{unit}"
    for load, unit in zip(_LOADS, ("N", "N", "N_m"), strict=True)
    for end in ENDS
}
_EXAMPLE: Final = "bit_depth_m, operation, hookload_kN, hookload_low_kN, hookload_high_kN, torque_kN_m"


def read_measured(
    path: Path, case: Case, units: System | None = None, tell: Callable[[str], None] | None = None
) -> "pd.DataFrame":
    """Measured rows of a text in columns or a workbook, SI.

    Columns: operation, bit_depth_m, and loads with the low and high ends of their ranges, NaN where the file does not
    have them.  A measured hook load is the reading of the weight indicator, block included, as in a calibration; the
    rig of the case converts it into that of the string, and the other way round.
    Rows without a string (in slips, tare) have no place in a chart and are left out.  units, tell : see ``read_rows``.
    Raises InputError, which names file, row and column.
    """
    with naming(path):
        form = measured_form(_EXAMPLE, _LOADS, (), (DEPTH.key, OPERATION.key, "load"), units)
        found = read_measured_file(path, form, _LOADS, tell)
        kinds = found.rows.texts(OPERATION.key)
        kept = [row for row, kind in enumerate(kinds) if kind not in STRINGLESS]
        if not kept:
            raise InputError(f"a row with a string in the hole, not {' and '.join(STRINGLESS)} alone")
        for row in kept:
            _check_depth(found, row, case.depths[1])
    import pandas as pd

    columns = {DEPTH.key: "bit_depth_m"} | _LOAD_COLUMNS
    numbers = {name: [found.number(row, key) for row in kept] for key, name in columns.items()}
    table = pd.DataFrame({"operation": [kinds[row] for row in kept]} | numbers)
    direction = table["operation"].map(lambda kind: KINDS[kind].direction)
    if tell is not None:
        _tell_swapped(table, direction, lambda sentence: tell(told(sentence, units or "si")))
    for end in ENDS:
        string, gauge = table.pop(f"string_load{end}_N"), table.pop(f"hookload{end}_N")
        table[f"hookload{end}_N"] = string.fillna(string_load(case.rig, direction, gauge))
        table[f"weight_indicator{end}_N"] = gauge.fillna(weight_indicator(case.rig, direction, string))
    return table


def _tell_swapped(table: "pd.DataFrame", direction: "pd.Series[int]", tell: Callable[[str], None]) -> None:
    """Say where hook loads of one depth are out of order, as they are where pick-up and slack-off are swapped."""
    ends = [table[f"hookload{end}_N"].fillna(table[f"string_load{end}_N"]) for end in ENDS]
    weighed = table.assign(low=np.fmin.reduce(ends), high=np.fmax.reduce(ends), name=direction.map(WEIGHTS))
    weighed = weighed[weighed["operation"].isin(("trip_in", "trip_out", "rotate_off_bottom")) & weighed["low"].notna()]
    found: list[str] = []
    for _, rows in weighed.groupby("bit_depth_m", sort=False):
        of_name = rows.groupby("name").agg(low=("low", "min"), high=("high", "max")).itertuples()
        loads = {name: Weight(0, Range(low, high), NOISE * high) for name, low, high in of_name}
        at = quantity(rows["bit_depth_m"].iloc[0], "m", ".6g")
        found += [sentence for _, sentence in out_of_order(loads, at)][:1]
    if found:
        more = f" (and at {counted(len(found) - 1, 'more depth')})" if len(found) > 1 else ""
        tell(Message(f"{within(found[0])}{more}"))


def _check_depth(found: Measured, row: int, deepest: float) -> None:
    """Raise InputError for a row without a bit depth, or with one below the end of the hole, ``deepest`` [m]."""
    depth = found.number(row, DEPTH.key)
    if not depth <= deepest + _BELOW:
        expected = "a number" if depth != depth else f"a depth in the hole, which ends at {quantity(deepest, 'm')}"
        raise found.rows.error(row, DEPTH.key, expected)
