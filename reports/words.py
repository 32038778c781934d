"""How numbers, columns and names are printed: units out of column names, sensible digits, plain words."""

import math
import re
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import pandas as pd

from fctd.case.operations import KINDS
from fctd.results.columns import COLUMNS
from validation.harness.study import Check, between

# Endings of column names, longest first, so that ``_kN_m`` is not taken for metres.
UNITS = {
    "percent_of_weight": "% of the weight",
    "N_per_m_per_m": "N/m per m",
    "deg_per_100ft": "°/100 ft",
    "N_m_per_rad": "N·m/rad",
    "kg_per_m3": "kg/m³",
    "rad_per_s": "rad/s",
    "m_per_s": "m/s",
    "N_per_m": "N/m",
    "J_per_m": "J/m",
    "m_per_h": "m/h",
    "percent": "%",
    "per_s": "1/s",
    "kN_m": "kN·m",
    "N_m": "N·m",
    "Pa_s": "Pa·s",
    "m_s": "m/s",
    "MPa": "MPa",
    "deg": "°",
    "rpm": "rev/min",
    "Hz": "Hz",
    "kN": "kN",
    "MB": "MB",
    "mm": "mm",
    "ms": "ms",
    "us": "µs",
    "ns": "ns",
    "N": "N",
    "J": "J",
    "m": "m",
    "s": "s",
}

# Columns of times whose ending alone misleads.
TIMES = {
    "took_per_m_s": ("time per metre", "s"),
    "ms_per_simulated_s": ("time per simulated second", "ms"),
    "wall_s": ("wall time", "s"),
}

# Columns that say how fast an engine is; the pages strike them through where it failed the gate before any speed.
SPEEDS = (*TIMES, "time_per_m_ms", "segment_step_us", "real_time_factor", "ratio_to_fctd", "ratio", "value")

# What the words of a column's name stand for: the engine's own quantities, names and abbreviations.
SPELT = {
    COLUMNS[name].stem.replace("_", " "): COLUMNS[name].label
    for name in ("md_m", "hookload_N", "sum_r_mu_fn_N_m", "sum_r_ft_N_m")
}
SPELT |= {each.lower(): each for each in ("FCL", "FCTD", "Mitchell", "Newton", "RMS", "TVD")}
# Contact methods by the names of the paper and of the libraries.
METHODS = {
    "for_loop": "FOR-loop",
    "fcl": "FCL",
    "bullet": "Bullet",
    "mujoco": "MuJoCo",
    "sdf": "sampled distance",
    "axis_frame": "axis frame",
}

SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
SPACE, NARROW_SPACE = "\u00a0", "\u202f"  # neither breaks a line
MINUS = "\u2212"
NOTHING = "–"
ROUNDING = 1e-6  # a load below it is rounding alone [kN, kN·m]
NOISE = 1e-4  # of the largest number of a column: a smaller difference is not shown


def heading(column: str) -> tuple[str, str]:
    """A column's name in words and its unit: ``bit_depth_m`` gives ("bit depth", "m")."""
    if column in TIMES:
        return TIMES[column]
    for quartile in ("low", "high"):
        if column.endswith(f"_{quartile}"):
            label, unit = heading(column.removesuffix(f"_{quartile}"))
            return f"{label} {quartile}", unit
    for ending, unit in UNITS.items():
        if column.endswith(f"_{ending}"):
            return _label(column.removesuffix(f"_{ending}")), unit
    return _label(column), ""


def name(identifier: str) -> str:
    """An operation in the driller's words, a contact method and a status without underscores; other names as they
    stand."""
    if identifier in KINDS:
        return KINDS[identifier].label
    first, comma, rest = identifier.partition(",")
    if first in METHODS:
        return METHODS[first] + comma + rest
    return _label(identifier) if re.fullmatch(r"[a-z]+(_[a-z]+)+", identifier) else identifier


def typeset(text: str) -> str:
    """A sentence of a study as print has it: subscripts, powers of ten, no marks of code."""
    for plain, printed in (("F_n", "Fₙ"), ("F_t", "Fₜ"), ("N*m", "N·m"), ("`", "")):
        text = text.replace(plain, printed)
    return re.sub(r"\b(\d+(?:\.\d+)?)e\+?0*(\d+)\b", _power, text)


def _power(found: re.Match[str]) -> str:
    mantissa, exponent = found[1], found[2].translate(SUPERSCRIPT)
    return f"10{exponent}" if mantissa == "1" else f"{mantissa}{SPACE}×{SPACE}10{exponent}"


def number(value: float, beside: Iterable[float] = ()) -> str:
    """A number by itself: three digits, powers of ten where it is very large or small.

    beside : numbers from which it has to differ as printed; 1 is always among them.
    """
    if math.isnan(value):
        return NOTHING
    if math.isinf(value):
        return "∞" if value > 0 else f"{MINUS}∞"
    size = abs(value)
    if value == round(value) and size < 1e9:
        return _fixed(value, 0)
    if 1e-3 <= size < 1e6:
        return _shortest(value, max(_decimals(size), *(_apart(value, other, size) for other in (1.0, *beside))))
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{_shortest(float(mantissa), 2)}{SPACE}×{SPACE}10{str(int(exponent)).translate(SUPERSCRIPT)}"


def quantity(value: float, unit: str) -> str:
    """A number and its unit on one line."""
    return "no number" if math.isnan(value) else f"{number(value)}{SPACE}{unit}".rstrip()


def found(check: Check) -> str:
    """The number of a check with its interval and unit, in as many digits as tell it from its bound."""
    if math.isnan(check.value):
        return "no number"
    digits = check.found(lambda value: number(value, check.limits)).removesuffix(f" {check.unit}")
    return f"{digits}{SPACE}{_sign(check.unit)}".rstrip()


def bound(check: Check) -> str:
    """The bound of a check in words, with its unit as print has it."""
    return replace(check, unit=_sign(check.unit)).requirement(number)


def columns(table: pd.DataFrame) -> dict[str, list[str]]:
    """The columns of a table by name, the quartiles of a measured number in brackets behind it."""
    found = {str(name): column(table[name]) for name in table.columns}
    for low, high in [(f"{name}_low", f"{name}_high") for name in found]:
        if low in found and high in found:
            name = low.removesuffix("_low")
            found[name] = [*map(measured, found[name], found.pop(low), found.pop(high))]
    return found


def measured(value: str, low: str, high: str) -> str:
    """A printed number with its quartiles in brackets, where it has any."""
    return value if NOTHING in (value, low, high) else between(value, low, high)


def column(values: "pd.Series[Any]") -> list[str]:
    """A table's column: numbers have equal decimals where their sizes allow it, for comparison.

    Numbers that differ by little have two digits of their difference, and shares close to 1 those of what is left.
    """
    if pd.api.types.is_bool_dtype(values):
        return ["yes" if value else "no" for value in values]
    if not pd.api.types.is_numeric_dtype(values):
        return [NOTHING if pd.isna(value) else name(str(value)) for value in values]
    numbers = [float(value) for value in values]
    if heading(str(values.name))[1] in ("kN", "kN·m"):
        numbers = [0.0 if abs(value) < ROUNDING else value for value in numbers]
    sizes = [abs(value) for value in numbers if math.isfinite(value) and value != 0]
    if not sizes or max(sizes) >= 1e6 or max(sizes) < 1e-3:
        return [number(value) for value in numbers]
    decimals = _decimals(max(sizes))
    if min(sizes) * 10**decimals < 10:
        return [number(value) for value in numbers]
    finite = [value for value in numbers if math.isfinite(value)]
    pairs = [(size, 1.0) for size in sizes if max(sizes) <= 1]
    if max(finite) - min(finite) > NOISE * max(sizes):
        pairs.append((max(finite), min(finite)))
    decimals = max([decimals, *(_apart(one, other, max(sizes)) for one, other in pairs)])
    while decimals and all(f"{size:.{decimals}f}".endswith("0") for size in sizes):
        decimals -= 1
    return [_fixed(value, decimals) if math.isfinite(value) else number(value) for value in numbers]


def is_speed(column: str) -> bool:
    """Whether a column says how fast an engine is, or is a quartile of one that does."""
    return column.removesuffix("_low").removesuffix("_high") in SPEEDS


def failed_gate(table: pd.DataFrame) -> "pd.Series[bool]":
    """Rows of engines that failed the gate before any speed; their times are struck through and never left out."""
    return table["gate"].str.startswith("failed")


def _sign(unit: str) -> str:
    """A unit as print has it."""
    return UNITS["deg"] if unit == "deg" else unit


def _label(identifier: str) -> str:
    return re.sub(rf"\b({'|'.join(SPELT)})\b", lambda found: SPELT[found[0]], identifier.replace("_", " "))


def _decimals(size: float) -> int:
    """Decimals that give a number of this size three digits."""
    return max(0, 2 - math.floor(math.log10(size)))


def _apart(one: float, other: float, size: float) -> int:
    """Decimals that show two digits of a difference, three more than the size asks for at most."""
    apart = abs(one - other)
    return min(1 - math.floor(math.log10(apart)), _decimals(size) + 3) if 0 < apart < math.inf else 0


def _fixed(value: float, decimals: int) -> str:
    return f"{value:z,.{decimals}f}".replace(",", NARROW_SPACE).replace("-", MINUS)


def _shortest(value: float, decimals: int) -> str:
    """At most so many decimals, without zeros at the end."""
    text = _fixed(value, decimals)
    return text.rstrip("0").rstrip(".") if "." in text else text
