"""The quantities of a series: what their headers are called, and their units.

A header is the name of a quantity in words ("Average Hookload"), as a mnemonic of a LAS or WITSML log ("HKLA"), or as
a column of this program ("weight_indicator"), with its unit in brackets, after an underscore, a point or a blank.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from fctd.case.errors import InputError, nearest, show
from fctd.case.units import FORCE, LENGTH, ROTATION, TIME, TORQUE, Dimension

FLOW: Final = Dimension(
    "a flow", "m^3/s", "'2000 L/min'", ("L/min", "m^3/min", "m^3/s", "gal/min"), {"gpm": "(gallon/minute)"}
)


@dataclass(frozen=True)
class Quantity:
    """A quantity of a series: column of the table [SI], dimension, and names without blanks in lower case.

    default : the unit of a header without one; else the unit must be told.
    """

    column: str
    dimension: Dimension | None
    names: frozenset[str]
    default: str | None = None


def _names(text: str) -> frozenset[str]:
    return frozenset(text.split())


# Mnemonics are those of the WITS records and of common service companies.
QUANTITIES: Final[dict[str, Quantity]] = {
    "time": Quantity("time_s", TIME, _names("time datetime timestamp date rigtime etim dateandtime datetimeutc")),
    "bit_depth": Quantity(
        "bit_depth_m", LENGTH, _names("bitdepth depthbit bitmd bitposition dbtm dbit bdep bitdep bitmeasureddepth")
    ),
    "hole_depth": Quantity(
        "hole_depth_m", LENGTH, _names("holedepth depthhole holemd totaldepth dmea hdep holemeasureddepth depthofhole")
    ),
    "hook_load": Quantity(
        "weight_indicator_N", FORCE, _names("hookload weightindicator hkla hkld hkl hklda hl whkl hookweight indicator")
    ),
    "torque": Quantity(
        "drive_torque_N_m", TORQUE, _names("torque drivetorque rotarytorque topdrivetorque tdtorque tqa stor torq trq")
    ),
    "rpm": Quantity(
        "rpm", ROTATION, _names("rpm rpma rotaryspeed rotaryrpm topdriverpm topdrivespeed tdrpm srpm rota"), "rpm"
    ),
    "block_position": Quantity(
        "block_position_m", LENGTH, _names("blockposition bpos blockheight blkpos blpos block hookposition hookheight")
    ),
    "flow": Quantity("flow_m3_s", FLOW, _names("flow mudflowin flowin flowrate flowratein mfia flwi pumpflow")),
    "weight_on_bit": Quantity("weight_on_bit_N", FORCE, _names("weightonbit wob woba swob")),
    "operation": Quantity("operation", None, _names("operation kind")),
}  # fmt: skip
# What a series over time must have, and a series by depth.
OVER_TIME: Final = ("time", "bit_depth", "hook_load", "torque", "rpm", "block_position")
BY_DEPTH: Final = ("bit_depth", "operation", "hook_load", "torque")
# Words before a name that say which of its readings it is.
_BEFORE: Final = frozenset({"average", "avg", "mean", "surface", "rig", "md"})
_SIGNS: Final = re.compile(r"[\W_]+")
_BRACKETS: Final = re.compile(r"(.*?)\s*[\[(]([^\])]*)[\])]\s*")


@dataclass(frozen=True)
class Column:
    """A column of a file: its place among the columns, its header, and its unit where one is told."""

    place: int
    header: str
    unit: str | None

    def factor(self, quantity: Quantity) -> float:
        """SI units in one of the column's."""
        assert quantity.dimension is not None
        return quantity.dimension.factor(self.unit or quantity.default or quantity.dimension.unit)


def parse_columns(texts: Sequence[str]) -> dict[str, tuple[str, str | None]]:
    """Header and unit of each quantity of "hook_load=HKLD" or "torque=TQ [kft.lbf]"; InputError for another form."""
    said: dict[str, tuple[str, str | None]] = {}
    for text in texts:
        key, sign, header = (part.strip() for part in text.partition("="))
        if not sign or not header:
            raise InputError("QUANTITY=HEADER, such as 'torque=TQA [kN.m]'", key="--columns", value=text)
        if key not in QUANTITIES:
            raise InputError(nearest(key, QUANTITIES, "quantity"), key="--columns", value=text)
        inside = _BRACKETS.fullmatch(header)
        said[key] = (inside[1], inside[2]) if inside else (header, None)
    return said


def find_columns(
    headers: Sequence[str], units: Sequence[str] = (), said: Mapping[str, tuple[str, str | None]] | None = None
) -> dict[str, Column]:
    """The columns of the quantities that a row of headers names; units : of each header, where they stand apart.

    said : header and unit of a quantity, which go before the names.  Raises InputError for two columns of one quantity
    and for a header that was told and is not there.
    """
    found: dict[str, Column] = {}
    for place, header in enumerate(headers):
        match = _recognise(header)
        if match is None:
            continue
        key, unit = match
        apart = units[place].strip() if place < len(units) else ""
        if key in (said or {}):
            continue
        if key in found:
            if key == "time":  # a date and a time of day stand in two columns: the reader joins them
                continue
            expected = (
                f"one column of {key}, found {show(found[key].header)} and {show(header)}: choose one by --columns"
            )
            raise InputError(expected, key="headers")
        found[key] = Column(place, header, unit or apart or None)
    for key, (header, unit) in (said or {}).items():
        places = [k for k, other in enumerate(headers) if other.strip().casefold() == header.casefold()]
        if len(places) != 1:
            others = ", ".join(map(show, headers))
            raise InputError(f"one of the headers {others}", key=f"--columns {key}", value=header)
        apart = units[places[0]].strip() if places[0] < len(units) else ""
        own = _recognise(headers[places[0]])
        found[key] = Column(places[0], headers[places[0]], unit or (own[1] if own else None) or apart or None)
    return found


def count_quantities(headers: Sequence[str], said: Mapping[str, tuple[str, str | None]]) -> int:
    """How many quantities a row of cells names, to tell a row of headers from others."""
    told = {header.casefold() for header, _ in said.values()}
    found = {match[0] for match in map(_recognise, headers) if match is not None}
    return len(found) + sum(header.strip().casefold() in told for header in headers)


def check_columns(found: Mapping[str, Column], headers: Sequence[str], *, text_time: bool) -> None:
    """Raise InputError for a series that lacks a quantity, and for a column without a unit or with a wrong one.

    text_time : whether times are dates, which have no unit.
    """
    needed = OVER_TIME if "time" in found or "operation" not in found else BY_DEPTH
    lacking = [key for key in needed if key not in found]
    if lacking:
        expected = f"columns of {', '.join(lacking)}, or their headers by --columns {lacking[0]}=HEADER"
        raise InputError(expected, key="headers", value=", ".join(headers))
    for key, column in found.items():
        quantity = QUANTITIES[key]
        if quantity.dimension is None or (key == "time" and text_time):
            continue
        if column.unit is None and quantity.default is None:
            expected = (
                f"a header with its unit, such as '{column.header} [{quantity.dimension.units[0]}]', or the unit "
            )
            expected += f"by --columns '{key}={column.header} [{quantity.dimension.units[0]}]'"
            raise InputError(expected, key="headers", value=column.header)
        try:
            column.factor(quantity)
        except ValueError:
            expected = f"{quantity.dimension.noun} with one of the {quantity.dimension.accepted}"
            raise InputError(expected, key=f"unit of {column.header}", value=column.unit) from None


def _recognise(header: str) -> tuple[str, str | None] | None:
    """Quantity and unit that a header names; None for another header, such as a number."""
    if not any(letter.isalpha() for letter in header):
        return None
    for name, unit in _readings(header):
        words = [word for word in _SIGNS.split(name.casefold()) if word]
        while len(words) > 1 and words[0] in _BEFORE:
            words = words[1:]
        while len(words) > 1 and words[-1] in _BEFORE:
            words = words[:-1]
        joined = "".join(words)
        for key, quantity in QUANTITIES.items():
            if joined in quantity.names and (not unit or _is_unit(quantity, unit)):
                return key, unit or None
    return None


def _readings(header: str) -> list[tuple[str, str]]:
    """Name and unit of a header, in every way that it may be read: with a unit first."""
    readings = []
    inside = _BRACKETS.fullmatch(header)
    if inside:
        readings.append((inside[1], inside[2]))
    parts = re.split(r"([\s_.]+)", header.strip())
    for count in (3, 2, 1):
        cut = len(parts) - 2 * count + 1
        if cut > 1:
            unit = "".join(parts[cut:]).strip(" _.").replace("_", "*")
            readings.append(("".join(parts[: cut - 1]), unit))
    return [*readings, (inside[1] if inside else header, ""), (header, "")]


def _is_unit(quantity: Quantity, unit: str) -> bool:
    if quantity.dimension is None:
        return False
    try:
        quantity.dimension.factor(unit)
    except ValueError:
        return False
    return True
