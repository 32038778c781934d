"""How far a steady string is from its limits: loads at the bit grow until the first limit is reached.

Pulling up, a stuck bit holds the string with an overpull; going down, the string is set down on its bit; turning, a
torque at the bit holds it.  Every load is a steady string of its own, so that friction, bends and bending stress are
those of the string under that load.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any, ClassVar, Final, NamedTuple

import numpy as np

from fctd.case.message import Message, joined, quantity, within
from fctd.case.operations import KINDS
from fctd.case.string import ComponentSpec
from fctd.model.fatigue import dogleg_of, endless_amplitude
from fctd.model.operations import BitLoads, SteadyRates, bit_loads
from fctd.model.section import Section, bearing
from fctd.results.buckling import HELICAL, MODES, NEITHER, SINUSOIDAL
from fctd.results.limits import LIMITS, ROW, SHARE, place_of
from fctd.results.notes import Note, codes_of, crushed_at
from fctd.steady.equilibrium import Solver
from fctd.steady.laid_string import LaidString
from fctd.steady.limit_search import CLOSE, NAN, last_of, root_of
from fctd.steady.steady_string import Equilibrium

# No more than so many weights of the string are set down.
MOST_WEIGHT = 2.0
LACKING: Final = "less than limits.overpull_margin"
SNAKING, HELIX, SLACK_OFF, LOCK_UP = "snaking", "helix", "slack_off", "lock_up"
OVERPULL, SET_DOWN, TORQUE, SLIPS, FATIGUE = "overpull", "set_down", "torque", "slips", "fatigue"
# What follows first from each limit, in words.
MEANINGS: Final = {
    **{limit.code: limit.headline for limit in LIMITS if limit.of_steel},
    "hoist": "the hoist lifts no more",
    "drive": "the drive turns no more",
    "slips": "slips crush the uppermost pipe",
    SNAKING: "the string snakes",
    HELIX: "the string winds itself into a helix",
    SLACK_OFF: "no weight is left at the hook but that of the block",
    LOCK_UP: "no push moves the bit",
    FATIGUE: "turning bends the steel to and fro",
}


class Margin(NamedTuple):
    """What is left until a limit, SI; NaN where a number does not apply.

    margin : which load grows; limit : the one that is reached first; part, md : where; share : of the limit that is
    used already.  force, torque : at the bit in all, with those of the case; hookload, surface_torque : at the limit,
    and what is left of them.  bending_stress : its amplitude; cycles_per_hour : of it; reason : why there is no number,
    or what else is to be said.
    """

    margin: str
    limit: str
    part: str = "none"
    md: float = NAN
    share: float = NAN
    force: float = NAN
    hookload: float = NAN
    hookload_left: float = NAN
    torque: float = NAN
    surface_torque: float = NAN
    surface_torque_left: float = NAN
    bending_stress: float = NAN
    cycles_per_hour: float = NAN
    reason: str = "none"
    notes: str = "none"


class First(NamedTuple):
    """The limit of which a string uses the largest share, counted as it may be used: code, share, part and depth."""

    code: str
    share: float
    part: str
    md: float


# The limit of a string of which it uses a share; with a code, the share of that one.
LimitOf = Callable[[Equilibrium, str | None], First]
# Notes on a string at its limit that say how far its bending can be trusted.
SAID: Final = ("body", "tool_joints", "penetration")


def first_limit(point: Equilibrium, only: str | None = None) -> First:
    """The limit of the steel that a string uses most; only : the code of the one that is looked at."""
    shape, asked = point._shape, point.case.limits
    string = shape.laid.string
    worst, row, code = 0.0, 0.0, only or "yield"
    for limit, found in zip(LIMITS, point.shares, strict=True):
        share = limit.scale(asked) * float(found[SHARE])
        if limit.of_steel and share > worst and only in (None, limit.code):
            worst, row, code = share, float(found[ROW]), limit.code
    md, section = place_of(row, shape.walls.md, string)
    return First(code, worst, string.parts[section].component.name, md)


@dataclass
class Loaded:
    """A string of an operation whose loads at the bit grow: pull and torque from those of the case, weight from none.

    solver : of its case; rates : of the operation; laid : the string.  One that is stuck above its bit is loaded at its
    stuck point in place of the bit (stuck.py).
    """

    stuck: ClassVar[bool] = False
    at: ClassVar[str] = "on the bit"
    solver: Solver
    operation: str
    rates: SteadyRates
    laid: LaidString

    @cached_property
    def own(self) -> BitLoads:
        """The loads at the bit, to which others are added."""
        own = bit_loads(self.solver.case, self.operation)
        return own._replace(weight=max(own.weight, 0.0))

    @cached_property
    def free(self) -> Equilibrium:
        """The string without loads that are added."""
        return self.pulled(0.0) if KINDS[self.operation].direction < 0 else self.pressed(0.0, 0.0)

    @property
    def notes(self) -> str:
        """The codes of the notes on the string without loads that are added."""
        return codes_of(_at_once(self.free))

    def pulled(self, overpull: float, **contact: Any) -> Equilibrium:
        """The string that a stuck bit holds with a force [N]; contact : other keys of contact."""
        return self._solve(self.operation, {"overpull": overpull}, contact)

    def pressed(self, weight: float, torque: float, **contact: Any) -> Equilibrium:
        """The string with more weight on its bit [N], and more torque at it [N m]; contact : other keys of contact."""
        loads = {"weight_on_bit": self.own.weight + weight, "torque": self.own.torque + torque}
        return self._solve("drill_rotating" if self.rates.spin else "drill_sliding", loads, contact)

    def set_down(self, weight: float, **contact: Any) -> Equilibrium:
        """The string with a weight on its bit [N] in place of the case's; contact : other keys of contact."""
        return self.pressed(weight - self.own.weight, 0.0, **contact)

    def as_it_is(self, **contact: Any) -> Equilibrium:
        """The string without loads that are added, which a limit's own are compared with; contact : of that limit."""
        return self.free if self.stuck or not contact else self.pressed(0.0, 0.0, **contact)

    def _solve(self, operation: str, bit: dict[str, float], contact: dict[str, Any]) -> Equilibrium:
        case = self.solver.case
        changed: dict[str, Any] = {
            "bit": case.bit.model_copy(update=bit),
            # The closed forms say when it buckles, and have the wall force of its waves.
            "solver": case.solver.model_copy(update={"buckling": "detect"}),
            "contact": case.contact.model_copy(update={"helical_force": "none"} | contact),
        }
        solver = Solver(case.model_copy(update=changed), self.solver.hole, self.solver.work)
        return solver.solve_string(operation, self.rates, self.laid)


def margins(loaded: Loaded, *, beyond_buckling: bool = True) -> Iterator[Margin]:
    """The margins of a string in an operation.

    The overpull of one that moves up, the weight that can be set down by one that moves down, the torque and the
    bending to and fro of one that turns, and what slips bear of one that stands still.  beyond_buckling : whether to
    set down more weight than the helix has, which takes a hundred times as long.
    """
    notes = loaded.notes
    for found in _margins(loaded, beyond_buckling):
        yield found._replace(notes=notes)


def _margins(loaded: Loaded, beyond_buckling: bool) -> Iterator[Margin]:
    """Those of ``margins``, without their notes."""
    laid, rates, rig = loaded.laid, loaded.rates, loaded.solver.case.rig
    kind = KINDS[loaded.operation]
    if not loaded.free.answered:
        yield Margin("none", "none", reason=Message(f"{loaded.free.status}: {within(loaded.free.message)}"))
        return
    if kind.direction < 0:
        yield _pulled(loaded, first_limit, weakest(laid, "tension"))
        if (lifts := rig.hoist_capacity) is not None:
            yield _pulled(loaded, lambda point, _: First("hoist", point.weight_indicator / lifts, "none", NAN), lifts)
    if kind.direction > 0:
        yield from _set_down(loaded, beyond_buckling)
    if rates.spin > 0:
        if kind.direction >= 0 and (swivel := swivel_of(laid)):
            yield Margin(TORQUE, "none", swivel, reason=f"no torque passes the swivel above {swivel}")
        elif kind.direction >= 0:
            yield _turned(loaded, first_limit, weakest(laid, "torsion"))
            if (turns := rig.largest_torque) is not None:
                yield _turned(loaded, lambda point, _: First("drive", point.drive_torque / turns, "none", NAN), turns)
        if not loaded.stuck:
            yield _bent_to_and_fro(loaded.free, rates.spin)
    if not kind.direction and not kind.on_bottom and rig.slip_length is not None and not loaded.stuck:
        yield _in_slips(loaded.free, rig.slip_length, loaded.solver.case.limits.design_factor)


def _pulled(loaded: Loaded, limit_of: LimitOf, scale: float) -> Margin:
    """The overpull at which a limit is reached; scale : about its size [N]."""
    used, found = limit_of(loaded.free, None), _load_at(loaded.pulled, limit_of, scale)
    if not np.isfinite(found):
        return Margin(OVERPULL, used.code, used.part, used.md, used.share, reason=_why(used))
    point, asked = loaded.pulled(found), loaded.solver.case.limits.overpull_margin
    reached, left = limit_of(point, None), point.hookload - loaded.free.hookload
    used = limit_of(loaded.free, reached.code)
    lacking = [f"{LACKING} = {quantity(asked / 1e3, 'kN')} at the hook"] if left < asked else []
    return Margin(
        OVERPULL, reached.code, reached.part, reached.md, used.share, found, point.hookload, left,
        reason=_reason([*lacking, *_said(point)]),
    )  # fmt: skip


def _turned(loaded: Loaded, limit_of: LimitOf, scale: float) -> Margin:
    """The torque at the bit at which a limit is reached under the tension there; scale : about its size [N m]."""

    def at(torque: float) -> Equilibrium:
        return loaded.pressed(0.0, torque)

    used, found = limit_of(loaded.free, None), _load_at(at, limit_of, scale)
    if not np.isfinite(found):
        return Margin(TORQUE, used.code, used.part, used.md, used.share, reason=_why(used))
    point = at(found)
    reached = limit_of(point, None)
    used = limit_of(loaded.free, reached.code)
    unknown = _without_make_up(loaded.laid) if limit_of is first_limit else []
    return Margin(
        TORQUE, reached.code, reached.part, reached.md, used.share, torque=loaded.own.torque + found,
        surface_torque=point.surface_torque,
        surface_torque_left=point.surface_torque - loaded.free.surface_torque,
        reason=_reason([*unknown, *_said(point)]),
    )  # fmt: skip


def swivel_of(laid: LaidString) -> str:
    """The name of the component below a swivel, empty without one."""
    string = laid.string
    return next((part.component.name for part, of in zip(string.parts, string.sections, strict=True) if of.swivel), "")


def _said(point: Equilibrium) -> list[str]:
    """What the notes on a string at its limit say about its bending."""
    return [f"at the limit {within(note.text)}" for note in _at_once(point) if note.code in SAID]


def _at_once(point: Equilibrium) -> tuple[Note, ...]:
    """The notes on a string but for its other balances, which two more solves would find."""
    return replace(point, draw=None).notes


def _without_make_up(laid: LaidString) -> list[str]:
    """A sentence on the components whose connections have no known make-up torque."""
    string = laid.string
    names = dict.fromkeys(
        part.component.name for part, section in zip(string.parts, string.sections, strict=True)
        if not np.isfinite(section.make_up)
    )  # fmt: skip
    return [f"the torque that the connections of {', '.join(names)} bear is not known, and left out"] if names else []


def _reason(sentences: list[str]) -> str:
    return joined(sentences) if sentences else "none"


def _load_at(at: Callable[[float], Equilibrium], limit_of: LimitOf, scale: float) -> float:
    """The load at which a string uses all of a limit; see ``root_of``."""

    def excess(load: float) -> float:
        point = at(load)
        return limit_of(point, None).share - 1 if point.answered else NAN

    return root_of(excess, scale)


def _set_down(loaded: Loaded, beyond_buckling: bool) -> Iterator[Margin]:
    """The weights at which a string snakes, winds itself into a helix, yields, leaves no weight at the hook, locks up.

    Beyond buckling its waves have the wall force of the closed forms, and not their bending.  What becomes of a string
    that turns beyond its helix is not known: it rolls round the hole.
    """
    push, string = loaded.solver.case.rig.push, loaded.laid.string
    most = MOST_WEIGHT * float(np.abs(string.weight) @ string.length)

    @cache
    def mode(weight: float) -> int:
        point = loaded.set_down(weight)
        return MODES.index(point.buckling.mode) if point.answered else HELICAL

    @cache
    def pushed(weight: float) -> Equilibrium:
        return loaded.set_down(weight, helical_force="analytic")

    def arrives(weight: float, hookload: float) -> bool:
        point = pushed(weight)
        return point.answered and point.hookload >= hookload

    yield _at_weight(loaded, SNAKING, last_of(lambda weight: mode(weight) <= NEITHER, most))
    yield _at_weight(loaded, HELIX, last_of(lambda weight: mode(weight) <= SINUSOIDAL, most))
    if loaded.rates.spin or not beyond_buckling:
        return
    locks = last_of(lambda weight: arrives(weight, -np.inf), most)
    spent = last_of(lambda weight: arrives(weight, -push), locks if np.isfinite(locks) else most)
    # No rig pushes on from there.
    farthest = next((weight for weight in (spent, locks) if np.isfinite(weight)), most)
    bears = last_of(lambda weight: first_limit(pushed(weight)).share < 1, farthest)
    if np.isfinite(bears):
        yield _at_weight(loaded, first_limit(pushed(bears)).code, bears, helical_force="analytic")
    at_slack_off = _at_weight(loaded, SLACK_OFF, spent, helical_force="analytic")
    if spent > 0:  # the hook load falls steeply with the weight there
        left = loaded.as_it_is(helical_force="analytic").hookload + push
        at_slack_off = at_slack_off._replace(hookload=-push, hookload_left=left)
    elif np.isfinite(locks):
        at_slack_off = at_slack_off._replace(reason="the string locks up before")
    yield at_slack_off
    yield _at_weight(loaded, LOCK_UP, locks, helical_force="analytic")


def _at_weight(loaded: Loaded, code: str, weight: float, **contact: Any) -> Margin:
    """The margin of a string that is set down with a weight on its bit [N], NaN where no limit was found."""
    if not np.isfinite(weight):
        return Margin(SET_DOWN, code, reason=f"not below {MOST_WEIGHT:g} weights of the string")
    point, beyond = loaded.set_down(weight, **contact), loaded.set_down((1 + 2 * CLOSE) * weight)
    is_steel = code not in (SNAKING, HELIX, SLACK_OFF, LOCK_UP)
    part, md = first_limit(point)[2:] if is_steel else ("none", beyond.buckling.to_md)
    # The push on a string that locks up grows without bound.
    hookload = point.hookload if code != LOCK_UP else NAN
    reason = "none"
    if weight < loaded.own.weight:
        reason = Message(f"beyond it already with {quantity(loaded.own.weight / 1e3, 'kN')} {loaded.at}")
    elif weight == 0:
        reason = f"already so without weight {loaded.at}"
    return Margin(
        SET_DOWN, code, part, md, force=weight, hookload=hookload,
        hookload_left=loaded.as_it_is(**contact).hookload - hookload, reason=reason,
    )  # fmt: skip


def _bent_to_and_fro(point: Equilibrium, spin: float) -> Margin:
    """The largest amplitude of the bending stress of a string that turns, and how often the steel is bent so."""
    string, profile = point._shape.laid.string, point.profile
    modulus = np.array([bearing(of).section_modulus for of in string.sections])[string.component]
    stress = profile["bending_moment_N_m"].to_numpy() / np.append(modulus[0], modulus)
    row = int(np.argmax(stress))
    k = int(string.component[max(row - 1, 0)])
    tension = float(profile["effective_tension_N"].iloc[row])
    part = string.parts[k].component
    return Margin(
        FATIGUE, FATIGUE, part.name, float(profile["md_m"].iloc[row]), bending_stress=float(stress[row]),
        cycles_per_hour=3600 * spin / (2 * np.pi), reason=_endless(part, string.sections[k], tension),
    )  # fmt: skip


def _endless(part: ComponentSpec, section: Section, tension: float) -> str:
    """What RP 7G has of drill pipe that is bent to and fro under a tension [N], and the dog-leg that does so."""
    body = bearing(section)
    stress = endless_amplitude(section.yield_strength, max(tension, 0.0) / body.area)
    if part.joint is None or stress is None:
        return "none"
    # Of the pipe as it bends, whose stress where the wall is least is larger.
    whole = replace(body, wall_share=1.0)
    nominal = stress * body.section_modulus / whole.section_modulus
    bend = dogleg_of(nominal, tension, whole.outer, section.wave_stiffness, part.youngs_modulus, part.joint.length)
    return Message(
        f"RP 7G bears ±{quantity(stress / 1e6, 'MPa', '.0f')} without end in air under that tension, a dog-leg of "
        f"{quantity(np.degrees(30 * bend), '°/30 m', '.3g')}"
    )


def _in_slips(point: Equilibrium, length: float, design_factor: float) -> Margin:
    """What the slips bear beyond the string that hangs in them."""
    string = point._shape.laid.string
    top = string.sections[string.component[0]]
    capacity = crushed_at(top, length) / design_factor
    part = string.parts[string.component[0]].component.name
    return Margin(
        SLIPS, SLIPS, part, string.top_md, point.hookload / capacity, hookload=capacity,
        hookload_left=capacity - point.hookload, reason="tests of slips find up to a fifth less",
    )  # fmt: skip


def weakest(laid: LaidString, load: str) -> float:
    """The least capacity of the string's sections, of tension [N] or torsion [N m]."""
    bodies = map(bearing, laid.string.sections)
    return min(body.tension if load == "tension" else body.torsion for body in bodies)


def _why(used: First) -> str:
    """Why no load was found."""
    if used.share >= 1:
        return f"beyond it already: {100 * used.share:.0f} % of what may be used"
    return "no steady string was found on the way to the limit"
