"""The columns of a caliper log, by the names that service companies give them."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from fctd.case.errors import show
from fctd.case.surveys.form import SURVEY
from fctd.case.tables.fields import Field
from fctd.case.tables.headers import TableForm
from fctd.case.units import ANGLE, LENGTH, Quantity

MOST_ROWS, MOST_ARMS = 200_000, 64
ARMS: Final = tuple(f"arm{k}" for k in range(1, MOST_ARMS + 1))
_NAMES: Final = ("arm", "c", "cal", "cali", "caliper", "r", "rad", "radius", "d", "diam", "diameter", "hcal")
# The curve of a log with one.
_ONE: Final = "cali, cal, caliper, hcal, hole size, hole diameter, diameter, radius"


def _arm(k: int) -> Field:
    names = ", ".join(f"{name} {k}" for name in _NAMES) + (f"; {_ONE}" if k == 1 else "")
    return Field(f"arm{k}", names, Quantity(dimension=LENGTH), "hole borehole mean", example="in", optional=k > 1)


def _remedy(key: str, headers: Sequence[str], unit: str) -> str:
    """How the case says which column is meant, or its unit."""
    named = f"{{header = {show(headers[0])}, unit = {show(unit)}}}" if unit else f"{{header = {show(headers[0])}}}"
    return f"in the case: wellbore.caliper.columns.{key} = {named}"


CALIPER: Final = TableForm(
    fields=(
        replace(SURVEY.field("md"), example="m"),
        Field(
            "orientation", "orientation, p1az, pad 1 azimuth, azimuth of pad 1, relative bearing, rb",
            Quantity(dimension=ANGLE), "arm 1 tool", bare="deg", example="deg", optional=True,
        ),
        *map(_arm, range(1, MOST_ARMS + 1)),
    ),
    example="md_m, arm1_in, arm2_in",
    needed=lambda found: [["md"], ["arm1"]],
    most=MOST_ROWS,
    option="wellbore.caliper.columns.",
    remedy=_remedy,
)  # fmt: skip
