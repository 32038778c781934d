"""The table of a case file for the datum of its depths."""

from typing import Self

from pydantic import model_validator

from fctd.case import units
from fctd.case.errors import InputError, Table, exclusive


class DatumSpec(Table):
    """The datum, the rotary table, from which all depths of a case count downwards.

    On land its `elevation` above mean sea level [m]; at sea its `air_gap`, the height above the sea [m], and the
    `water_depth` [m]. A report states them; what is computed does not depend on them.
    """

    elevation: units.MeasuredDepth | None = None
    air_gap: units.PositiveLength | None = None
    water_depth: units.PositiveLength | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        exclusive(self, "elevation", "air_gap")
        if self.water_depth is not None and self.air_gap is None:
            expected = "the height of the rotary table above the sea, beside water_depth"
            raise InputError(expected + ("" if self.elevation is None else " and in place of elevation"), key="air_gap")
        if self.air_gap is not None and self.water_depth is None:
            raise InputError("a depth, beside air_gap", key="water_depth")
        return self

    @property
    def sea_bed(self) -> float | None:
        """Depth of the sea bed below the rotary table [m], None on land."""
        return None if self.air_gap is None or self.water_depth is None else self.air_gap + self.water_depth
