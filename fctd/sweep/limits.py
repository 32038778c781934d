"""Limits of the results in a sweep file: numbers with their units, of which ``fctd uncertainty`` tells how probable it
is that they are exceeded.
"""

from typing import Final, Literal, Self

from pydantic import Field, field_validator, model_validator

from fctd.case import units
from fctd.case.errors import InputError, Table

# Quantities of the results by the ending of their column; a torque ends as a length does.
DIMENSIONS: Final = {
    "_N_m": units.TORQUE, "_Pa": units.STRESS, "_N": units.FORCE, "_m": units.LENGTH, "_s": units.TIME,
}  # fmt: skip
BARE: Final = units.Number(noun="a bare number, as this column has no unit")


class LimitSpec(Table):
    """A limit of a column of the results, whose probability of being exceeded is asked for.

    A limit is a quantity with its unit, or a bare number in the unit of the column.
    """

    column: str = Field(description="a column of the results, such as drive_torque_N_m")
    above: float | str | None = None
    below: float | str | None = None

    @field_validator("above", "below", mode="before")
    @classmethod
    def _check_kind(cls, value: object) -> object:
        if isinstance(value, bool) or not isinstance(value, int | float | str):
            raise InputError("a number, or a number with its unit such as '120 kN'", value=value)
        return value

    @model_validator(mode="after")
    def _check(self) -> Self:
        if (self.above is None) == (self.below is None):
            raise InputError("above or below, one of them", key="above")
        _ = self.bound  # raises InputError for a quantity that the column does not have
        return self

    @property
    def side(self) -> Literal["above", "below"]:
        """On which side of the limit a result exceeds it."""
        return "above" if self.above is not None else "below"

    @property
    def bound(self) -> float:
        """The limit in the unit of the column; InputError for one of another dimension."""
        written = getattr(self, self.side)
        dimension = next((of for ending, of in DIMENSIONS.items() if self.column.endswith(ending)), None)
        reader = BARE if dimension is None else units.Quantity(dimension=dimension)
        try:
            return reader.parse(written)
        except InputError as error:
            raise error.at(self.side) from None

    @property
    def event(self) -> str:
        """The limit in words, as the sweep file has it."""
        written = getattr(self, self.side)
        return f"{self.column} {self.side} {written if isinstance(written, str) else format(self.bound, 'g')}"
