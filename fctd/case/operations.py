"""The kinds of operation of a case: the keys of each in a case file, and its properties as class attributes.

To add a kind, write its class here and add it to ``Operation``; every table of kinds is made from these classes.
"""

from typing import ClassVar, Final, Literal, Self, get_args

from pydantic import model_validator

from fctd.case import units
from fctd.case.errors import InputError, Table
from fctd.case.message import quantity


class _Operation(Table):
    """Base of all kinds of operation.

    start_key, end_key : names of the first and the last depth in the file.  label : the kind in the driller's words.
    direction : of the string along the hole, 1 down, −1 up, 0 at rest.  on_bottom : whether the bit carries weight
    and torque.  default_speed [m/s], default_rpm : rates of a steady string where neither call nor case gives any.
    turns : whether the string must rotate, as its name says; may_turn : whether it may, where an operation of a case
    says so.  flow : of mud that is pumped [m³/s].
    """

    start_key: ClassVar[str]
    end_key: ClassVar[str]
    label: ClassVar[str]
    direction: ClassVar[Literal[-1, 0, 1]]
    on_bottom: ClassVar[bool] = False
    default_speed: ClassVar[float]
    default_rpm: ClassVar[float] = 0.0
    turns: ClassVar[bool] = False
    may_turn: ClassVar[bool] = True
    ramp_time: units.PositiveTime = 10.0
    flow: units.Flow = 0.0

    @property
    def start_md(self) -> float:
        """Bit depth at the start [m]."""
        return float(getattr(self, self.start_key))

    @property
    def end_md(self) -> float:
        """Bit depth at the end [m]."""
        return float(getattr(self, self.end_key))


class _Move(_Operation):
    """The bit moves from one depth [m] to another at a speed [m/s]; the kind sets the direction."""

    start_key = "from_md"
    end_key = "to_md"
    from_md: units.Length
    to_md: units.Length
    speed: units.PositiveSpeed

    @model_validator(mode="after")
    def _check(self) -> Self:
        if (self.to_md - self.from_md) * self.direction <= 0:
            side = "below" if self.direction > 0 else "above"
            raise InputError(f"a depth {side} from_md, {quantity(self.from_md, 'm')}", key="to_md")
        return self


class Stay(_Operation):
    """The bit stays at one depth [m] for a duration [s]."""

    start_key = end_key = "at_md"
    direction = 0
    default_speed = 0.0
    at_md: units.Length
    duration: units.PositiveTime
    speed: ClassVar[float] = 0.0


class TripIn(_Move):
    """The string moves into the hole (slack-off)."""

    kind: Literal["trip_in"]
    label = "slacking off"
    direction = 1
    default_speed = 0.3
    rpm: units.Rpm = 0.0


class TripOut(_Move):
    """The string moves out of the hole (pick-up)."""

    kind: Literal["trip_out"]
    label = "picking up"
    direction = -1
    default_speed = 0.3
    rpm: units.Rpm = 0.0


class RotateOffBottom(Stay):
    """The string rotates at one depth, off bottom, for a duration [s]."""

    kind: Literal["rotate_off_bottom"]
    label = "rotating off bottom"
    default_rpm = 60.0
    turns = True
    rpm: units.PositiveRpm


class BackReam(_Move):
    """The string moves out of the hole and rotates."""

    kind: Literal["back_ream"]
    label = "back-reaming"
    direction = -1
    default_speed = 0.1
    default_rpm = 60.0
    turns = True
    rpm: units.PositiveRpm


class ReamIn(_Move):
    """The string moves into the hole and rotates."""

    kind: Literal["ream_in"]
    label = "reaming in"
    direction = 1
    default_speed = 0.1
    default_rpm = 60.0
    turns = True
    rpm: units.PositiveRpm


class DrillRotating(_Move):
    """The bit drills on bottom and the string rotates; `speed` is the rate of penetration."""

    kind: Literal["drill_rotating"]
    label = "drilling, rotating"
    direction = 1
    on_bottom = True
    default_speed = 0.003
    default_rpm = 120.0
    turns = True
    rpm: units.PositiveRpm


class DrillSliding(_Move):
    """A motor turns the bit on bottom and the string slides without rotation; `speed` is the rate of penetration."""

    kind: Literal["drill_sliding"]
    label = "drilling, sliding"
    direction = 1
    on_bottom = True
    default_speed = 0.003
    may_turn = False
    rpm: ClassVar[float] = 0.0


Operation = TripIn | TripOut | RotateOffBottom | BackReam | ReamIn | DrillRotating | DrillSliding
KINDS: Final[dict[str, type[Operation]]] = {
    get_args(kind.model_fields["kind"].annotation)[0]: kind for kind in get_args(Operation)
}
