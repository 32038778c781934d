"""Result tables in other units: the values are converted, and the column's name ends in the new unit.

In memory and in files the columns are SI; screen and pictures show the same quantities in larger or smaller units.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Final

from fctd.case.message import SENTENCES
from fctd.case.systems import ACROSS, JET, KINDS, PRESSURE, SHOWN_APART, Kind, ending, told
from fctd.case.systems import Shown as Shown  # of what stands in this file, too
from fctd.case.systems import System as System
from fctd.results.columns import COLUMNS

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pandas as pd

# The first kind with a unit of tables, by the end of a column, the longer ends first: what ends in `_N_m` is not a
# length.
_BY_UNIT: Final = sorted(
    {ending(kind.dimension.unit): kind for kind in reversed(SHOWN_APART)}.items(), key=lambda item: -len(item[0])
)
# Columns of another kind: pressures, for which MPa and ksi are too coarse, jets, which are fast, grooves and gaps.
_BY_END: Final = {
    **dict.fromkeys(("drop_Pa", "standpipe_Pa", "surge_Pa", "burst_Pa"), PRESSURE), "jet_speed_m_s": JET,
    **dict.fromkeys(("groove_m", "gap_m"), ACROSS),
}  # fmt: skip


def kind_of(column: str) -> Kind | None:
    """The kind of a column of an SI table; None for names, counts, times, angles and plain numbers."""
    if column in COLUMNS and COLUMNS[column].across:
        return ACROSS
    return next((kind for end, kind in (*_BY_END.items(), *_BY_UNIT) if column.endswith(end)), None)


def shown(column: str, system: System) -> Shown:
    """How to show a column of an SI table; ValueError for one without a unit."""
    if column.endswith("_deg"):
        return Shown(1.0, "°")
    kind = kind_of(column)
    if kind is None:
        raise ValueError(f"column {column} has no unit to show")
    return kind.shown(system)


def shown_if_any(column: str, system: System) -> Shown:
    """The same; the numbers as they are for a column without a unit."""
    return shown(column, system) if column.endswith("_deg") or kind_of(column) else Shown(1.0, "")


def digits_of(column: str, system: System) -> int:
    """Digits after the point of a column of an SI table: its own, or those of its kind."""
    own, kind = COLUMNS[column].digits if column in COLUMNS else None, kind_of(column)
    return own if own is not None else 3 if kind is None else kind.digits_in(system)


def shown_unit(unit: str, system: System) -> Shown:
    """How to show values in an SI unit, such as "N*m" or "kg/m^3"; "" for plain numbers."""
    kind = next((kind for kind in KINDS if kind.dimension.unit == unit), None)
    return Shown(1.0, unit) if kind is None else kind.shown(system)


def in_words(value: float, column: str, system: System) -> str:
    """A value [SI] of a column with its unit, to four digits: "11800 ft"."""
    unit = shown(column, system)
    number = value * unit.factor
    return f"{number:.0f} {unit.label}" if abs(number) >= 1000 else f"{number:.4g} {unit.label}"


def in_field_units(table: pd.DataFrame) -> pd.DataFrame:
    """An SI table in field units: ``hookload_N`` becomes ``hookload_klbf``, ``bit_depth_m`` ``bit_depth_ft``.

    Sentences of the program, such as the reason of a row, have field units too.
    """
    import pandas as pd

    columns = {}
    for name in table.columns:
        kind = kind_of(name)
        if kind is None:
            columns[name] = table[name].map(partial(told, system="field")) if name in SENTENCES else table[name]
        else:
            # Division by 0.3048, which is exact, and rounding to 15 digits give 100 ft for 30.48 m.
            values = table[name] / kind.si("field")
            columns[_in_field(name, kind)] = values.map("{:.15g}".format).astype(float)
    return pd.DataFrame(columns)


def long_in_field_units(table: pd.DataFrame, numbers: Sequence[str], scaled: pd.Series[bool]) -> pd.DataFrame:
    """A long SI table in field units, whose text ``column`` names the quantity of a row.

    numbers : columns with values of that quantity; scaled : rows whose values have its unit, where others have none.
    """
    converted = in_field_units(table)
    for name in table["column"].unique():
        kind = kind_of(name)
        if kind is not None:
            here = table["column"] == name
            converted.loc[here, "column"] = _in_field(name, kind)
            converted.loc[here & scaled, list(numbers)] /= kind.si("field")
    return converted


def _in_field(column: str, kind: Kind) -> str:
    """The name of an SI column in field units."""
    return column.removesuffix(ending(kind.dimension.unit)) + ending(kind.unit("field"))
