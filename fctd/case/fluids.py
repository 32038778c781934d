"""The tables of a case file for fluids by depth, inside and outside the string, and for its change of temperature."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Self

from pydantic import Field, StrictBool, model_validator

from fctd.case import units
from fctd.case.errors import InputError, Table
from fctd.case.message import quantity
from fctd.case.rheology import FlowSpec


class OutsideSpec(FlowSpec):
    """Fluid outside the string, from the end of the row above to `to_md` [m]; the first row begins at the surface.

    Only the last row may omit `to_md`. Densities [kg/m^3], 0 for air. A row without `viscosity`, `rheology` or `fann`
    flows as the mud does.
    """

    to_md: units.PositiveLength | None = None
    density: units.Density


class InsideSpec(OutsideSpec):
    """Fluid inside the string, as that outside.

    A `plug` at the lower end of a row, such as a flotation collar, holds a difference of pressures. The fluid below
    it is sealed off: it begins with a `pressure` [Pa] of its own.
    """

    plug: StrictBool = False
    pressure: units.Pressure | None = None


class TemperatureSpec(Table):
    """Change of the string's temperature [K] at a true vertical depth `tvd` [m], against that at which its lengths were
    measured; linear between the rows, the same above the first and below the last."""

    tvd: units.Length
    change: units.TemperatureChange


class WindowSpec(Table):
    """Densities of mud whose pressure is that of the `pore` and that which opens a `fracture` [kg/m^3], at a true
    vertical depth `tvd` [m]; linear between the rows, the same above the first and below the last."""

    tvd: units.Length
    pore: units.Density
    fracture: units.PositiveDensity

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.fracture <= self.pore:
            raise InputError(f"more than pore, {quantity(self.pore, 'kg/m^3')}", key="fracture")
        return self


class FluidsSpec(FlowSpec):
    """Fluids by depth; a side without rows has the density of the mud."""

    inside: tuple[InsideSpec, ...] = Field(default=(), description="tables [[mud.inside]]")
    outside: tuple[OutsideSpec, ...] = Field(default=(), description="tables [[mud.outside]]")
    inside_pressure: units.Pressure = 0.0
    outside_pressure: units.Pressure = 0.0
    float: StrictBool = False
    packer_bore: units.Diameter | None = None

    @model_validator(mode="after")
    def _check_rows(self) -> Self:
        _check_order(self.inside, "inside")
        _check_order(self.outside, "outside")
        for i, row in enumerate(self.inside):
            if row.plug and row.to_md is None:
                raise InputError("false in a row without to_md, since `float` closes the end", key=f"inside[{i}].plug")
            if row.density == 0 and i and self.inside[i - 1].density > 0 and not self.inside[i - 1].plug:
                raise InputError("above 0, as what is above air falls without a plug", key=f"inside[{i}].density")
            if row.pressure is not None and not (i and self.inside[i - 1].plug):
                raise InputError("left out, since no plug is above the row", key=f"inside[{i}].pressure")
        if self.packer_bore is not None and self.float:
            raise InputError("left out beside a float, as the end in the bore is open", key="packer_bore")
        return self

    @property
    def given(self) -> bool:
        """Whether the case says more of its fluids than one density."""
        return bool(self.inside or self.outside or self.inside_pressure or self.outside_pressure)


def _check_order(rows: Sequence[OutsideSpec], name: str) -> None:
    for i, (above, row) in enumerate(pairwise(rows), start=1):
        if above.to_md is None:
            raise InputError("a depth, which only the last row may omit", key=f"{name}[{i - 1}].to_md")
        if row.to_md is not None and row.to_md <= above.to_md:
            raise InputError(
                f"more than {quantity(above.to_md, 'm')}, where the row above ends", key=f"{name}[{i}].to_md"
            )


def check_downwards(rows: Sequence[TemperatureSpec | WindowSpec], name: str) -> None:
    """Raise InputError for rows that do not run downwards."""
    for i, (above, row) in enumerate(pairwise(rows), start=1):
        if row.tvd <= above.tvd:
            raise InputError(
                f"more than {quantity(above.tvd, 'm')}, the depth of the row above", key=f"{name}[{i}].tvd"
            )
