"""Result tables in other units: the values are converted, and the column's name ends in the new unit.

In memory and in files the columns are SI; screen and pictures show the same quantities in larger or smaller units.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final, Literal, NamedTuple

from fctd.case.units import conversion
from fctd.results.columns import COLUMNS

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pandas as pd

System = Literal["si", "field"]


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
        label = IN_MESSAGES.get(unit, unit) if system == "field" else unit
    return Shown(conversion(unit, _PINTS.get(label, label)) if label != unit else 1.0, label.replace("*", "·"))


def in_words(value: float, column: str, system: System) -> str:
    """A value [SI] of a column with its unit, to four digits: "11800 ft"."""
    unit = shown(column, system)
    number = value * unit.factor
    return f"{number:.0f} {unit.label}" if abs(number) >= 1000 else f"{number:.4g} {unit.label}"


# Columns of sentences with SI units.
_SENTENCES: Final = ("friction_label", "left_out", "reason")


def _reworded(text: Any) -> Any:
    return reworded(text, "field") if isinstance(text, str) else text


def in_field_units(table: pd.DataFrame) -> pd.DataFrame:
    """An SI table in field units: ``hookload_N`` becomes ``hookload_klbf``, ``bit_depth_m`` ``bit_depth_ft``.

    Texts that the program wrote, such as the reason of a row, are reworded.
    """
    import pandas as pd

    columns = {}
    for name in table.columns:
        measure = measure_of(name)
        if measure is None:
            columns[name] = table[name].map(_reworded) if name in _SENTENCES else table[name]
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


# Units of messages, which the program writes in SI.
IN_MESSAGES: Final = {
    "m": "ft", "mm": "in", "km": "ft", "m/s": "ft/min", "m/h": "ft/h", "kN": "klbf", "N": "lbf", "kN·m": "kft·lbf",
    "MPa": "ksi", "bar": "psi", "kg/m^3": "ppg", "kg/m": "lb/ft",
}  # fmt: skip
_DOG_LEG: Final = re.compile(r"([\d.]+)°/30 m\b")
_NUMBER = r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?"
# A number or several with one unit, "540 to 1500 m"; what stands in quotes is the user's or an example.
_IN_MESSAGES: Final = re.compile(
    rf"(?<![\w.\"'(\[]){_NUMBER}(?:(?: to | and |, |–){_NUMBER})* "
    rf"(?P<unit>{'|'.join(sorted(map(re.escape, IN_MESSAGES), key=len, reverse=True))})(?![\w/^*·])"
)


def reworded(text: str, system: System) -> str:
    """A message of the program in a system of units: its lengths, loads and speeds with SI units are converted."""
    if system == "si":
        return text

    def convert(found: re.Match[str]) -> str:
        unit = found["unit"]
        factor = conversion(unit.replace("·", "*"), _PINTS.get(IN_MESSAGES[unit], IN_MESSAGES[unit]))
        numbers = found[0].removesuffix(unit)
        return re.sub(_NUMBER, lambda n: _short(float(n[0]) * factor, n[0]), numbers) + IN_MESSAGES[unit]

    text = _DOG_LEG.sub(lambda bend: f"{float(bend[1]) * _factor('ft', 'm') / 0.3:.3g}°/100 ft", text)
    return _IN_MESSAGES.sub(convert, text)


_PINTS: Final = {"kft·lbf": "kft*lbf", "ppg": "lb/gal"}


def _factor(unit: str, target: str) -> float:
    """How many target units a unit is, both of a measure."""
    return conversion(_PINTS.get(unit, unit), _PINTS.get(target, target))


def _short(value: float, before: str) -> str:
    """A number with one digit more than it had before, three or four."""
    digits = len(before.split("e")[0].lstrip("-0.").replace(".", ""))
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.{min(max(digits + 1, 3), 4)}g}"


def _ending(unit: str) -> str:
    """The unit as the end of a column's name: "_N_m", "_m3_s"."""
    return "_" + unit.replace("*", "_").replace("/", "_").replace("^", "")
