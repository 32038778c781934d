"""The tables of a case file for what the rig brings: mud, block and drive."""

from typing import Any, Final, Literal, Self

from pydantic import Field, StrictBool, field_validator, model_validator

from fctd.case import units
from fctd.case.drilling import DriveSpec
from fctd.case.errors import InputError, Table
from fctd.case.fluids import FluidsSpec
from fctd.case.rheology import USUAL_RATE
from fctd.case.wall import CakeSpec

# Viscosity of mud whose case gives none [Pa s]; it acts on motion that changes alone: steady loads do not depend on it.
UNSTEADY = 0.02
ECCENTRICITY: Final = units.Number(noun="'string' or a share", at_least=0.0, at_most=1.0)


class MudSpec(FluidsSpec):
    """Density [kg/m^3], viscosity [Pa*s]; damping per metre of string: axial and lateral [N*s/m^2], rotational [N*s].

    A string that moves in time takes mud along, and the mud damps its waves along itself and its motion sideways, by
    default with a viscosity of 20 mPa*s. A `viscosity` that is given damps the string along and around itself too, in
    steady states as well; 0 turns all of it off. A damping that is given replaces the one that follows from the
    viscosity. In place of `viscosity` stands a `rheology`, or `fann`, readings of a viscometer by speed such as
    `{600 = 60, 300 = 40, 6 = 8, 3 = 6}`; the viscosity of motion that changes is then that at 100 1/s. Mud flows past a
    pipe on the axis of the hole, or with an `eccentricity`, its offset over its clearance; "string" takes it from where
    the string lies.

    Where fluids differ along the string or between its two sides, `[[mud.inside]]` and `[[mud.outside]]` say so, with
    `inside_pressure` and `outside_pressure` [Pa] at the surface; a side without rows has the `density`. A `float`
    closes the lower end, where pressures may then differ. An open end that moves in a seal bore of the diameter
    `packer_bore` [m] is pushed up by the difference of pressures on the area of the bore, in steady strings alone.
    """

    density: units.Density = 0.0
    eccentricity: float | Literal["string"] = Field(default=0.0, description='a share from 0 to 1, or "string"')
    axial_damping: units.DampingPerLength | None = None
    lateral_damping: units.DampingPerLength | None = None
    rotational_damping: units.RotationalDamping | None = None
    cake: CakeSpec | None = None

    @field_validator("eccentricity", mode="before", json_schema_input_type=float | str)
    @classmethod
    def _read_eccentricity(cls, raw: Any) -> Any:
        return raw if raw == "string" else ECCENTRICITY.parse(raw)

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.resists and not self.densest:
            key = next(name for name in ("viscosity", "rheology", "fann") if getattr(self, name) is not None)
            raise InputError("left out, or a mud.density above 0 beside it", key=key)
        return self

    @property
    def densest(self) -> float:
        """The largest density of the fluids [kg/m^3]."""
        sides = (self.inside, self.outside)
        return max(density for rows in sides for density in ([row.density for row in rows] or [self.density]))

    @property
    def unsteady(self) -> float:
        """The viscosity of motion that changes in time [Pa s], 0 where the string takes no mud along."""
        if not self.densest:
            return 0.0
        return UNSTEADY if self.curve is None else float(self.curve.stress(USUAL_RATE)) / USUAL_RATE


class RigSpec(Table):
    """What the rig's sensors read in addition to the loads of the string, and how the rig trips.

    Block weight [N], friction in the guides of the block [N], torque offset [N*m], and `torque_per_rpm`, a torque that
    grows with the rotation [N*m for each rev/min].  Friction in the guides acts against the block's motion: it adds to
    the weight indicator while the block is hoisted.  Friction in the sheaves divides the weight indicator by
    `sheave_efficiency` while the block is lowered, and multiplies it by `sheave_efficiency` while the block is hoisted.

    A simulation with `feed` "stands" moves the block: stands of `stand_length` [m], within `derrick_height` [m],
    are added and racked back, and the string hangs in the slips for `connection_time` [s] each time. With
    "long_segment" the upper end stands still and the top segment grows, as in the paper. "auto" is "long_segment" where
    a long segment fits: the hole is vertical along it, and it is of one component; elsewhere it is "stands".

    In a run in time a "stiff" `drive` turns the top as planned whatever the torque; "speed_control" and "impedance" are
    motors with inertia and a controller, whose settings are in `control`. With an `autodriller` the block follows
    `bit.weight_on_bit`, by the hook load, in place of the `speed` of a drilling operation, which gives its duration.

    `hoist_capacity` [N] is the largest reading of the weight indicator that the hoist lifts, block included, and
    `largest_torque` [N*m] that of the drive; slips grip the uppermost pipe along `slip_length` [m]. A note says where
    more is needed; they do not limit what is computed.
    """

    block_weight: units.Force = 0.0
    guide_friction: units.Force = 0.0
    sheave_efficiency: units.Efficiency = 1.0
    torque_offset: units.Torque = 0.0
    torque_per_rpm: units.Torque = 0.0
    hoist_capacity: units.PositiveForce | None = None
    largest_torque: units.PositiveTorque | None = None
    slip_length: units.PositiveLength | None = None
    feed: Literal["auto", "long_segment", "stands"] = "auto"
    stand_length: units.PositiveLength = 28.5
    connection_time: units.PositiveTime = 60.0
    derrick_height: units.PositiveLength = 40.0
    drive: Literal["stiff", "speed_control", "impedance"] = "stiff"
    control: DriveSpec = DriveSpec()
    autodriller: StrictBool = False
    surface_length: units.Length = 0.0
    surface_bore: units.Diameter = 0.0971804  # 3.826 in, of 4½ in pipe of 16.6 lb/ft

    @property
    def push(self) -> float:
        """The largest push on the string [N]: the block's weight without what its guides hold back."""
        return self.block_weight - self.guide_friction
