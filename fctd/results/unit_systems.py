"""Result tables in other units: the values are converted, and the column's name ends in the new unit.

In memory and in files the columns are SI; screen and pictures show the same quantities in larger or smaller units.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Final, NamedTuple

from fctd.case.message import FIELD, SENTENCES, told
from fctd.case.message import System as System  # of what stands in this file, too
from fctd.case.units import conversion
from fctd.results.columns import COLUMNS

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pandas as pd


class Measure(NamedTuple):
    """The unit of a kind of quantity in SI tables, in metric pictures, and in field units everywhere."""

    table: str
    si: str
    field: str


# The order matters: a column that ends in `_N_m` is not a length.
MEASURES: Final = (
    Measure("N*m", "kN*m", "kft*lbf"),
    Measure("Pa", "MPa", "ksi"),
    Measure("N", "kN", "klbf"),
    Measure("m", "m", "ft"),
    Measure("m^2", "mm^2", "in^2"),
    Measure("kg/m^3", "kg/m^3", "ppg"),
    Measure("m^3/s", "L/min", "gpm"),
    Measure("m/s", "m/s", "ft/min"),
    Measure("W", "kW", "hp"),
)
# Lengths across the hole, for which metres and feet are too coarse.
ACROSS: Final = Measure("m", "mm", "in")
# By the ends of columns: pressures, for which MPa and ksi are too coarse, jets, which are fast, and grooves.
_PRESSURE: Final = Measure("Pa", "bar", "psi")
BY_END: Final = {
    "drop_Pa": _PRESSURE, "standpipe_Pa": _PRESSURE, "surge_Pa": _PRESSURE, "burst_Pa": _PRESSURE,
    "jet_speed_m_s": Measure("m/s", "m/s", "ft/s"), "groove_m": ACROSS,
}  # fmt: skip


class Shown(NamedTuple):
    """How the screen and pictures show an SI column: its values times ``factor``, in the unit ``label``."""

    factor: float
    label: str


def measure_of(column: str) -> Measure | None:
    """Units of a column of an SI table; None for names, counts, angles and plain numbers."""
    if column in COLUMNS and COLUMNS[column].across:
        return ACROSS
    own = next((measure for end, measure in BY_END.items() if column.endswith(end)), None)
    return own or next((measure for measure in MEASURES if column.endswith(_ending(measure.table))), None)


def shown(column: str, system: System) -> Shown:
    """How to show a column of an SI table; ValueError for one without a unit."""
    if column.endswith("_deg"):
        return Shown(1.0, "°")
    measure = measure_of(column)
    if measure is None:
        raise ValueError(f"column {column} has no unit to show")
    unit = measure.field if system == "field" else measure.si
    return Shown(_factor(measure.table, unit), unit.replace("*", "·").replace("^2", "²").replace("^3", "³"))


def shown_unit(unit: str, system: System) -> Shown:
    """How to show values in an SI unit, such as "N*m" or "kg/m^3"; "" for plain numbers."""
    measure = next((measure for measure in MEASURES if measure.table == unit), None)
    if measure is not None:
        label = measure.field if system == "field" else measure.si
    else:
        label = FIELD.get(unit, unit) if system == "field" else unit
    return Shown(conversion(unit, _PINTS.get(label, label)) if label != unit else 1.0, label.replace("*", "·"))


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
        measure = measure_of(name)
        if measure is None:
            columns[name] = table[name].map(partial(told, units="field")) if name in SENTENCES else table[name]
        else:
            # Division by 0.3048, which is exact, and rounding to 15 digits give 100 ft for 30.48 m.
            values = table[name] / _factor(measure.field, measure.table)
            columns[_in_field(name, measure)] = values.map("{:.15g}".format).astype(float)
    return pd.DataFrame(columns)


def long_in_field_units(table: pd.DataFrame, numbers: Sequence[str], scaled: pd.Series[bool]) -> pd.DataFrame:
    """A long SI table in field units, whose text ``column`` names the quantity of a row.

    numbers : columns with values of that quantity; scaled : rows whose values have its unit, where others have none.
    """
    converted = in_field_units(table)
    for name in table["column"].unique():
        measure = measure_of(name)
        if measure is not None:
            here = table["column"] == name
            converted.loc[here, "column"] = _in_field(name, measure)
            converted.loc[here & scaled, list(numbers)] /= _factor(measure.field, measure.table)
    return converted


def _in_field(column: str, measure: Measure) -> str:
    """The name of an SI column in field units."""
    return column.removesuffix(_ending(measure.table)) + _ending(measure.field)


_PINTS: Final = {"kft·lbf": "kft*lbf", "ppg": "lb/gal"}


def _factor(unit: str, target: str) -> float:
    """How many target units a unit is, both of a measure."""
    return conversion(_PINTS.get(unit, unit), _PINTS.get(target, target))


def _ending(unit: str) -> str:
    """The unit as the end of a column's name: "_N_m", "_m3_s"."""
    return "_" + unit.replace("*", "_").replace("/", "_").replace("^", "")
