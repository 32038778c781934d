"""The columns of a survey, and how the case says which they are where the headers do not."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Any, Final, get_args

from pydantic import BeforeValidator

from fctd.case.errors import InputError, Table, show
from fctd.case.surveys.stations import MOST_STATIONS, StationKey
from fctd.case.tables.fields import Field
from fctd.case.tables.headers import TableForm
from fctd.case.units import ANGLE, Dimension, Quantity

KEYS: Final[tuple[StationKey, ...]] = get_args(StationKey)
# Words of the accepted units, also with what the depths are measured from: "mRKB".
_METRES: Final = ("m", "meter", "meters", "metre", "metres", "mtr")
_FEET: Final = ("ft", "foot", "feet")
_REFERENCES: Final = ("md", "rkb", "kb", "rt", "brt")
_DEPTH: Final = Dimension(
    "a depth", "m", "'12 m' or '40 ft'", ("m", "ft", "usft"),
    dict.fromkeys((*_METRES, *(f"m{reference}" for reference in _REFERENCES)), "m")
    | dict.fromkeys((*_FEET, *(f"ft{reference}" for reference in _REFERENCES)), "ft") | {"ftus": "usft"},
    listed=True,
)  # fmt: skip
_DIRECTION: Final = replace(
    ANGLE, units=("deg", "rad"), words={**ANGLE.words, "degs": "deg", "dega": "deg", "º": "deg", "˚": "deg"}
)
_ANGLE: Final = Quantity(dimension=_DIRECTION, at_most=4 * math.pi)
_OF_HOLE: Final = "angle hole well wellbore borehole survey"
# "Depth" alone may be the vertical depth where another column says that it is the measured one.  The M of "M Depth" is
# that of "measured", and of "Depth M" nobody knows: it is no unit.
_DEPTHS: Final = (
    "md, m d, m depth, m dept, measured depth, meas depth, depth measured, depth meas, measured hole depth, "
    r"dep(?:th|t)[\s:-]+(?-i:M)(?!\s*[)\]]), along hole depth, depth along hole, ahd, mdrkb, mdkb, mdrt, mdbrt"
    "; depth, dept, dmea"
)
# A letter names an angle where its unit stands beside it ("I_deg") and no other header names the quantity.
_INCLINATIONS: Final = "inc, incl, inclin, inclination, devi, dev, deviation, drift; i"
_AZIMUTHS: Final = "az, azi, azim, azm, azmth, azimuth, hazi, direction; a"


def _remedy(key: str, headers: Sequence[str], unit: str) -> str:
    """How the case, or the command that makes one, says which column is meant, or its unit."""
    if unit:
        table = f"{{{key} = {{header = {show(headers[0])}, unit = {show(unit)}}}}}"
        return f'in the case: columns = {table} (or "ft"; for init: --columns {key}.unit={unit})'
    choices = " or ".join(f"{{header = {show(header)}}}" for header in headers)
    return f"in the case: columns.{key} = {choices} (for init: --columns '{key}={headers[0]}')"


SURVEY: Final = TableForm(
    fields=(
        Field(
            "md", _DEPTHS, Quantity(dimension=_DEPTH),
            "measured meas along hole survey station from below rkb kb rt rte brt", example="m",
        ),
        Field("inc", _INCLINATIONS, _ANGLE, _OF_HOLE, bare="deg", example="deg"),
        Field(
            "azi", _AZIMUTHS, _ANGLE,
            f"{_OF_HOLE} grid true magnetic mag north gn tn mn corrected", bare="deg", example="deg",
        ),
        Field(
            "tvd", "tvd, true vertical depth, vertical depth", Quantity(dimension=_DEPTH), "rkb kb rt rte brt",
            bare="", example="m", optional=True, checking=True,
        ),
    ),
    example="md_m, inc_deg, azi_deg",
    needed=lambda found: [[key] for key in KEYS],
    row="station",
    most=MOST_STATIONS,
    option="columns.",
    remedy=_remedy,
)  # fmt: skip


class ColumnSpec(Table):
    """A column of a survey: its header, its unit, or both; the unit goes before one that the header names."""

    header: str | None = None
    unit: str | None = None


def _as_column(raw: object) -> object:
    """A header alone is written as a text."""
    if isinstance(raw, str):
        return {"header": raw}
    if not isinstance(raw, Mapping | ColumnSpec):
        raise InputError('a header in quotes or a table such as {header = "DEPTH", unit = "m"}', value=raw)
    return raw


ColumnKey = Annotated[ColumnSpec, BeforeValidator(_as_column, json_schema_input_type=str | ColumnSpec)]


def check_units(columns: Mapping[Any, ColumnSpec] | None, form: TableForm) -> None:
    """Raise InputError for a unit of a chosen column that its field does not have."""
    for key, column in (columns or {}).items():
        field = form.field(key)
        if column.unit is not None and field.unit_of(column.unit) is None:
            raise InputError(field.accepted, key=f"{key}.unit", value=column.unit)
