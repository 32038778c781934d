"""What a calibration is told beside case and rows: unknowns, sources of readings, override sets, model error."""

from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from fctd.case import units
from fctd.case.errors import InputError, Table
from fctd.case.raw_case import read_model

PositiveForce = Annotated[float, units.Quantity(dimension=units.FORCE, above=0.0)]
PositiveTorque = Annotated[float, units.Quantity(dimension=units.TORQUE, above=0.0)]
SignedForce = Annotated[float, units.Quantity(dimension=units.FORCE)]
Written = float | str  # a quantity whose unit depends on the unknown


class PriorSpec(Table):
    """What is known of an unknown before: its mean and its standard deviation."""

    mean: Written
    sd: Written


class UnknownSpec(Table):
    """Bounds, prior and first value of an unknown, each optional; quantities with their units."""

    bounds: tuple[Written, Written] | None = Field(default=None, description="a list of the lowest and highest value")
    prior: PriorSpec | None = None
    start: Written | None = None


class ForceBias(Table):
    """Prior of a bias of hook load: mean and standard deviation [N]."""

    mean: SignedForce = 0.0
    sd: PositiveForce


class TorqueBias(Table):
    """Prior of a bias of torque: mean and standard deviation [N m]."""

    mean: units.Torque = 0.0
    sd: PositiveTorque


class SourceSpec(Table):
    """A source of readings: its rule, its noise, one standard deviation, and its bias, which is then an unknown.

    A single reading stands for the range of readings that are rounded to it in steps of the resolution.

    A median carries its bias as it is.  A peak carries it in the direction in which the block moves: added to the hook
    load while hoisting, taken from it while lowering, none at rest, and added to the torque.
    """

    reading: Literal["median", "peak"] = "median"
    hookload_noise: PositiveForce = 10e3
    torque_noise: PositiveTorque = 500.0
    hookload_resolution: Annotated[float, units.Quantity(dimension=units.FORCE, at_least=0.0)] = 0.0
    torque_resolution: units.PositiveOrZeroTorque = 0.0
    hookload_bias: ForceBias | None = None
    torque_bias: TorqueBias | None = None


class ModelError(Table):
    """Declared error of the model, one standard deviation: hookload [N], torque [N m]."""

    hookload: units.Force = 0.0
    torque: units.PositiveOrZeroTorque = 0.0


class BitTorque(Table):
    """What a bit on bottom adds to the torque of a row: mean and standard deviation [N m], normal.

    Where it is unknown whether the bit was on bottom, either is as likely, by mean and variance of both together.
    """

    mean: units.PositiveOrZeroTorque = 3e3
    sd: PositiveTorque = 2e3

    def of(self, torque_read: str) -> tuple[float, float]:
        """Mean and standard deviation of what a bit adds to a torque that was read so [N m]."""
        if torque_read == "unknown":
            return 0.5 * self.mean, (0.5 * self.sd**2 + 0.25 * self.mean**2) ** 0.5
        return (self.mean, self.sd) if torque_read == "on_bottom" else (0.0, 0.0)


class ScatterPrior(Table):
    """Scatter from day to day: mean of the exponential prior of each standard deviation; 0 for none.

    friction : of the logarithm of the factors; hookload [N].  One deviation in twenty is above three times the mean.
    """

    friction: Annotated[float, units.Number(at_least=0.0, at_most=1.0)] = 0.05
    hookload: Annotated[float, units.Quantity(dimension=units.FORCE, at_least=0.0)] = 3e3


class Setup(Table):
    """A setup file.  ``strings`` : override sets, keys and values as of ``--set``."""

    unknowns: dict[str, UnknownSpec] = Field(default_factory=dict)
    sources: dict[str, SourceSpec] = Field(default_factory=dict)
    strings: dict[str, dict[str, Any]] = Field(default_factory=dict)
    model_error: ModelError = ModelError()
    bit_torque: BitTorque = BitTorque()
    scatter: ScatterPrior = ScatterPrior()

    @model_validator(mode="after")
    def _check(self) -> Self:
        if "" in self.strings:
            raise InputError("a name; rows without a string have the case's", key="strings")
        return self

    def source(self, name: str) -> SourceSpec:
        """A source of rows; one that the setup does not name has the defaults."""
        return self.sources.get(name, SourceSpec())


def read_setup(path: Path) -> Setup:
    """The setup of a TOML file; raises InputError, which names file, key and value."""
    return read_model(Setup, path, "a setup")
