"""Sheets of a rig: a row for each depth, with a column for each weight, become a row for each reading."""

from collections.abc import Collection
from dataclasses import replace
from typing import Final

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.tables.fields import Column, Field
from fctd.case.tables.readings import HOOK_LOAD
from fctd.case.tables.rows import Rows
from fctd.case.units import FORCE, TORQUE, Quantity

_WEIGHT: Final = "free weight weights wt hook load hookload hkld hkl measured actual average avg mean rig"


def _weight(key: str, names: str) -> Field:
    return replace(
        HOOK_LOAD, key=key, names=names, beside=_WEIGHT, quantity=Quantity(dimension=FORCE, at_least=0.0, at_most=1e9)
    )


# The weights of a sheet, readings of the indicator, and the kind of operation in which each was read.
WEIGHTS: Final = {
    "pick_up": (_weight("pick_up", "pick up, P U, P U W, picking up, pulling, up"), "trip_out"),
    "slack_off": (_weight("slack_off", "slack off, S O, S O W, slacking off, down, dn"), "trip_in"),
    "rotating": (
        _weight("rotating", "rotating, rotate, rot, free rotating, rotating off bottom, rotate off bottom, rob, rtw"),
        "rotate_off_bottom",
    ),
}
TURNING: Final = "rotating"


def is_wide(found: Collection[str]) -> bool:
    """Whether a table with these fields is such a sheet."""
    return bool(WEIGHTS.keys() & {*found})


def unfolded(
    rows: Rows, numbers: dict[str, Array], load: str, operation: Field, name: Field, *, empty: bool
) -> tuple[Rows, dict[str, Array]]:
    """A row for each weight of a sheet; torques and rotation are those of its rotating string.  Others as they are.

    numbers : by field [SI]; load : key of the hook load; operation, name : fields of the new columns; empty : whether
    a row without a reading is kept.  Raises InputError for a sheet that has such columns already.
    """
    weights = [key for key in WEIGHTS if key in rows.columns]
    if not weights:
        return rows, numbers
    for key in (operation.key, load):
        if key in rows.columns:
            expected = f"no such column beside {', '.join(rows.columns[of].header for of in weights)}"
            raise InputError(expected, key=rows.columns[key].row, value=rows.columns[key].header)
    torques = [key for key in numbers if rows.columns[key].field.dimension == TORQUE]
    of_turning = [*torques, *({"rpm"} & numbers.keys())]
    read = {key: ~np.isnan(numbers[key]) for key in weights}
    if torques:
        weights = [key for key in WEIGHTS if key in weights or key == TURNING]
        turned = np.any([~np.isnan(numbers[key]) for key in torques], axis=0)
        read[TURNING] = turned | read.get(TURNING, False)
    picked = [(row, key) for row in range(len(rows)) for key in weights if empty or read[key][row]]
    at = np.array([row for row, _ in picked], int)
    turning = np.array([key == TURNING for _, key in picked], bool)
    none = np.full(len(rows), np.nan)
    found = {key: values[at] for key, values in numbers.items() if key not in WEIGHTS}
    found[load] = np.array([numbers.get(key, none)[row] for row, key in picked])
    for key in of_turning:
        found[key] = np.where(turning, found[key], np.nan)
    if "speed" in found:
        found["speed"] = np.where(turning, np.nan, found["speed"])
    kept = {key: column for key, column in rows.columns.items() if key not in WEIGHTS}
    names = rows.texts(name.key)
    cells = {key: [rows.cells[key][row] for row in at] for key in kept}
    cells[operation.key] = [WEIGHTS[key][1] for _, key in picked]
    cells[name.key] = [
        f"{names[row] or rows.one.format(rows.numbers[row])}, {key.replace('_', '-')}" for row, key in picked
    ]
    columns = kept | {field.key: Column(field, -1, field.key) for field in (operation, name)}
    return replace(rows, columns=columns, cells=cells, numbers=[rows.numbers[row] for row in at]), found
