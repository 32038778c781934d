"""The tables of drilling: the controller of the rig's drive, the bit, the rock under it, and the motor above it."""

import math
from typing import Literal, Self

from pydantic import Field, model_validator

from fctd.case import units
from fctd.case.errors import InputError, Table


class DriveSpec(Table):
    """The drive of the rig where it is not stiff: inertia at the string [kg*m^2], P [N*m*s], I [N*m], `torque_limit`.

    By default `proportional` is the impedance ζ of the topmost pipe with an "impedance" drive, and 100 ζ with
    "speed_control"; `integral` is P/3 a second and 5 P a second. `compensation` is the share of the inertia that the
    controller hides from the string, by default all of it with an "impedance" drive.
    """

    inertia: units.Inertia = 2000.0
    proportional: units.AngularDamping | None = None
    integral: units.PositiveOrZeroTorque | None = None
    compensation: units.Share | None = None
    torque_limit: units.PositiveTorque | None = None


class RockSpec(Table):
    """The rock under the bit of a run in time, and the bit's cutters.

    `law` "drag_bit" is that of Detournay & Defournay (1992). Its keys are the intrinsic `specific_energy` ε [Pa], the
    `force_ratio` ζ of thrust to cutting force, the `bit_factor` γ, and of the wear flats their `friction` μ, their
    summed width `wear_flat` l [m] and their `contact_strength` σ [Pa]. The `radius` [m] is by default that of the hole.
    The weight on bit is the force of a spring of `stiffness` [N/m] between bit and bottom.
    "given" puts weight and torque of [bit] on the bit, and the bottom follows it.

    The torque of a bit that turns slowly is larger by the share `weakening` at rest, which falls off exponentially
    with the `weakening_rpm` [rev/min].
    """

    law: Literal["drag_bit", "given"] = "drag_bit"
    stiffness: units.PositiveStiffness = 2e7
    radius: units.PositiveLength | None = None
    specific_energy: units.PositiveStress = 1e8
    force_ratio: units.PositiveRatio = 0.6
    friction: units.Friction = 0.6
    bit_factor: units.PositiveRatio = 1.0
    wear_flat: units.Length = 0.005
    contact_strength: units.PositiveStress = 1e8
    weakening: units.Ratio = 0.0
    weakening_rpm: units.PositiveRpm = 30.0


class MotorSpec(Table):
    """A downhole motor that turns the bit against the string in a run in time, in proportion to the flow [m^3/s]."""

    flow: units.PositiveFlow
    revolutions_per_liter: units.PositiveRatio


class BitSpec(Table):
    """Loads on the bit while drilling: weight on bit [N], bit torque [N*m]. A run in time that drills needs `rock`,
    and one that slides also a `motor`.

    `overpull` [N] is the force with which a stuck bit holds a string that is pulled up, in steady strings alone.

    Mud leaves through `nozzles`, a list of their diameters, or through a `flow_area` [m^2], with the coefficient
    `discharge`. An `end` that is "open" lets mud in and out, one with a "float" out alone, and a "closed" one neither;
    by default it is open, or has the float of [mud].
    """

    weight_on_bit: units.Force = 0.0
    torque: units.PositiveOrZeroTorque = 0.0
    overpull: units.Force = 0.0
    rock: RockSpec | None = Field(default=None, description="a table [bit.rock]")
    motor: MotorSpec | None = Field(default=None, description="a table [bit.motor]")
    nozzles: tuple[units.NozzleDiameter, ...] = Field(
        default=(), description='a list of the nozzles\' diameters, such as ["12/32 in", "12/32 in"]'
    )
    flow_area: units.FlowArea | None = None
    discharge: units.DischargeCoefficient = 0.95
    end: Literal["open", "closed", "float"] | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.nozzles and self.flow_area is not None:
            raise InputError("nozzles or flow_area, not both", key="flow_area")
        return self

    @property
    def nozzle_area(self) -> float:
        """Area of all nozzles [m^2]; 0 where the case gives none."""
        return self.flow_area or 0.25 * math.pi * sum(diameter**2 for diameter in self.nozzles)
