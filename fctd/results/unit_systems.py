"""Result tables in other units: the values are converted, and the column's name ends in the new unit.

In memory and in files the columns are SI; screen and pictures show the same quantities in larger or smaller units.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from fctd.case.systems import (
    ACROSS,
    JET,
    KINDS,
    PRESSURE,
    SHOWN_APART,
    Kind,
    ending,
)
from fctd.case.systems import (
    Shown as Shown,
)
from fctd.case.systems import (
    System as System,
)
from fctd.case.units import conversion
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
        kind = kind_of(name)
        if kind is None:
            columns[name] = table[name].map(_reworded) if name in _SENTENCES else table[name]
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
