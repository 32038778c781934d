"""The tables of a case file about the wall and the string's contact with it: intervals, tortuosity, cake, contact."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final, Literal, Self

from pydantic import Field, StrictBool, model_validator

from fctd.case import units
from fctd.case.errors import InputError, Table
from fctd.case.message import quantity
from fctd.case.pipes.filling import casing_filled
from fctd.case.pipes.grades import YieldStrength
from fctd.mechanics.law_names import LAWS, NAMES

IntervalKind = Literal["cased", "open"]
if TYPE_CHECKING:
    FrictionLaw = str
else:
    FrictionLaw = Literal[NAMES]  # the table's names

# A wave of the hole is at least so many amplitudes long; steeper ones are bends, which a survey shows.
STEEPEST: Final = 100


class IntervalSpec(Table):
    """A section of hole of one diameter, from the end of the interval above to `to_md` [m].

    The first interval begins at the surface. `friction` is the kinetic friction factor; `kind` lets
    `--friction cased=0.2,open=0.3` set it. `stiffness` or `stiffness_per_length` of an interval replaces the
    wellbore's key of the same name.

    With a `rotational_friction`, `friction` is the factor along the hole and this the one around it; together they are
    the half axes of an ellipse of friction. Without it both are the same.

    In a simulation with `contact.friction_law` "karnopp" or "stribeck" a string at rest sticks up to `static_friction`,
    without which the static factor is the kinetic one; `rotational_friction` is scaled by the same share. With
    "stribeck" half of their difference is left where the string slides at `decay_speed` [m/s]. `overbalance` [Pa], the
    pressure of the mud beyond that of the rock, makes the wall permeable: a string at rest sticks in mud cake there.

    `casing` is casing of the catalogue, which `fctd pipes` lists: it gives `diameter`, `outer_diameter`,
    `yield_strength` and the `kind` that you leave out. What wears of it depends on them, no load does.
    """

    to_md: units.PositiveLength
    casing: str | None = Field(default=None, description="the name of casing in quotes, such as '9 5/8 in 47 N-80'")
    diameter: units.Diameter
    friction: units.Friction
    rotational_friction: units.Friction | None = None
    kind: IntervalKind | None = None
    name: str | None = None
    outer_diameter: units.Diameter | None = None
    yield_strength: YieldStrength | None = None
    stiffness: units.PositiveStiffness | None = None
    stiffness_per_length: units.PositiveStiffnessPerLength | None = None
    static_friction: units.Friction | None = None
    decay_speed: units.PositiveSpeed | None = None
    overbalance: units.PositiveStress | None = None

    @model_validator(mode="before")
    @classmethod
    def _fill_in_casing(cls, raw: Any) -> Any:
        return casing_filled(raw) if isinstance(raw, Mapping) else raw

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.outer_diameter is not None:
            if self.outer_diameter <= self.diameter:
                inner = f"more than the diameter inside, {quantity(self.diameter, 'm')}"
                raise InputError(inner, key="outer_diameter", value=quantity(self.outer_diameter, "m"))
            if self.kind == "open":
                raise InputError('"cased" beside casing or outer_diameter', key="kind", value=self.kind)
        if (self.outer_diameter is None) != (self.yield_strength is None):
            missing = "outer_diameter" if self.outer_diameter is None else "yield_strength"
            raise InputError("outer_diameter and yield_strength together", key=missing)
        if self.static_friction is not None:
            if self.static_friction < self.friction:
                raise InputError(f"at least the kinetic factor, {self.friction:g}", key="static_friction")
            if self.static_friction > 0 and self.friction == 0:
                raise InputError("a kinetic factor above 0 beside a static one", key="friction")
        return self

    @property
    def wall(self) -> float:
        """The wall of the casing [m], 0 where it is not known."""
        return 0.0 if self.outer_diameter is None else 0.5 * (self.outer_diameter - self.diameter)

    @property
    def friction_around(self) -> float:
        """The kinetic friction factor around the hole."""
        return self.friction if self.rotational_friction is None else self.rotational_friction

    @property
    def static_excess(self) -> float:
        """What the static friction factor exceeds the kinetic one by, as a share of it."""
        return self.static_friction / self.friction - 1 if self.static_friction else 0.0


class TortuositySpec(Table):
    """Waves of the hole that are too short for a survey, added to its stations: in each direction across the hole the
    axis has the root mean square of a sine of the `amplitude` [m], with wavelengths about `wavelength` [m].

    Equal values of `seed` give equal holes. Segments must be at most an eighth of the wavelength; a steady string with
    longer ones is `under_resolved`.
    """

    amplitude: units.PositiveLength
    wavelength: units.PositiveLength
    seed: units.Seed = 0

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.amplitude > self.wavelength / STEEPEST:
            raise InputError(
                f"at most 1/{STEEPEST} of wavelength, {quantity(self.wavelength / STEEPEST, 'm')}", key="amplitude"
            )
        return self


class CakeSpec(Table):
    """Mud cake on permeable intervals.

    Below a string at rest it grows to its final `thickness` [m] within `time` [s]. A static factor of the interval
    scales its `friction` factor too. When a simulation starts, the string has `rested` [s].
    """

    thickness: units.PositiveLength = 0.002
    time: units.PositiveTime = 28800.0
    friction: units.Friction
    rested: units.Time = 0.0


class ContactSpec(Table):
    """Friction law, and damping of a contact point [N*s/m]; with `enabled` false there is no wall.

    With `law` "power" the wall presses with K d₀ (d/d₀)^p at penetration d: K is the wellbore's stiffness, p the
    `exponent` (1.5 is Hertz's), and d₀ [m] the `reference_penetration`, at which both laws press equally. The time step
    is stable up to a penetration of `largest_penetration` [m].

    Where a steady string is beyond the helical limit, on segments too long for a helix, `helical_force` "analytic"
    brings its wall force to that of the helix, r F²/4EI a metre, and the friction with it. Snaking beside it has the
    mean of Mitchell's equation.
    """

    enabled: StrictBool = True
    friction_law: FrictionLaw = "coulomb"
    damping: units.Damping = 1e5
    law: Literal["linear", "power"] = "linear"
    exponent: units.Exponent = 1.5
    reference_penetration: units.PositiveLength = 0.001
    largest_penetration: units.PositiveLength = 0.005
    helical_force: Literal["none", "analytic"] = "none"

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.law == "linear":
            for key in ("exponent", "reference_penetration", "largest_penetration"):
                if key in self.model_fields_set and getattr(self, key) != type(self).model_fields[key].default:
                    raise InputError(f'law = "power" beside {key}', key="law", value="linear")
        return self

    @property
    def wall_law(self) -> tuple[float, float]:
        """Exponent of the wall's law, 1 of the linear one, and its reference penetration [m]."""
        return (1.0 if self.law == "linear" else self.exponent), self.reference_penetration


def check_friction(contact: ContactSpec, intervals: Sequence[IntervalSpec], cake: CakeSpec | None) -> None:
    """Raise InputError for keys of friction or mud cake that the law does not use, or that lack another key."""
    law = contact.friction_law
    for i, interval in enumerate(intervals):
        at = f"wellbore.intervals[{i}]"
        for key in ("static_friction", "decay_speed", "overbalance"):
            if getattr(interval, key) is not None and key not in LAWS[law].keys:
                users = " or ".join(f'"{name}"' for name, other in LAWS.items() if key in other.keys)
                raise InputError(f"{users} beside {at}.{key}", key="contact.friction_law", value=law)
        if interval.static_friction and interval.decay_speed is None and "decay_speed" in LAWS[law].keys:
            raise InputError("a speed beside static_friction", key=f"{at}.decay_speed")
        if interval.overbalance is not None:
            if contact.law != "linear":
                raise InputError(f'"linear" beside {at}.overbalance', key="contact.law", value=contact.law)
            if cake is None:
                raise InputError(f"a table with the friction of the cake, beside {at}.overbalance", key="mud.cake")
            if cake.thickness >= 0.5 * interval.diameter:
                expected = f"less than the radius of the hole, {quantity(0.5 * interval.diameter, 'm')}"
                raise InputError(expected, key="mud.cake.thickness", value=quantity(cake.thickness, "m"))
