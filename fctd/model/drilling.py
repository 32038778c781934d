"""The rig's drive and driller and the rock under the bit as the step needs them, from the case."""

import numpy as np

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.message import quantity
from fctd.mechanics.drive import BY_SPEED, STIFF, Driller, Drive, least_inertia
from fctd.mechanics.rock import DRAG_BIT, GIVEN_LOADS, NO_ROCK, NOTHING, Rock
from fctd.model.drillstring import String
from fctd.model.operations import rad_per_s
from fctd.model.section import Section
from fctd.model.strokes import ExpectedDrilling
from fctd.model.torsion import axial_period_of

# Of a drive by default: P over the impedance of the pipe, I over P [1/s], share of the inertia that is hidden.
SPEED_CONTROL, IMPEDANCE = (100.0, 5.0, 0.0), (1.0, 1 / 3, 1.0)
TARE_PERIODS = 4  # axial periods over which the autodriller averages its tare
SLOWER = 2.0  # the autodriller's time over that of an axial wave, 4L/c


def torsional_impedance(section: Section) -> float:
    """ζ = I_p √(Gρ) of a pipe [N m s]: torque over rotation of a wave."""
    return float(np.sqrt(section.GJ * section.axial_inertia))


def drive_of(case: Case, string: String, spring: float, damper: float, step: float) -> Drive:
    """The drive of a case on top of a laid-out string.

    spring [N m/rad], damper [N m s/rad] : of the uppermost joint in torsion; step [s].  Inertia, and what the
    controller leaves of it, are no less than ``least_inertia``.
    """
    if case.rig.drive == "stiff":
        return STIFF
    control = case.rig.control
    of_pipe, of_proportional, hidden = IMPEDANCE if case.rig.drive == "impedance" else SPEED_CONTROL
    impedance = torsional_impedance(string.sections[string.component[0]])
    proportional = of_pipe * impedance if control.proportional is None else control.proportional
    integral = of_proportional * proportional if control.integral is None else control.integral
    share = hidden if control.compensation is None else control.compensation
    least = least_inertia(spring, damper, integral, step)
    inertia = max(control.inertia, least)
    limit = np.inf if control.torque_limit is None else control.torque_limit
    return Drive(False, inertia, max((1 - share) * inertia, least), proportional, integral, limit)


def driller_of(case: Case, string: String, rock: Rock) -> Driller:
    """The driller of a case for a laid-out string.

    The autodriller's loop is critically damped on the spring of string and rock, with a time of ``SLOWER`` times 4L/c.
    """
    if not case.rig.autodriller or rock.law == NO_ROCK:
        return BY_SPEED
    top = string.sections[string.component[0]]
    softness = float((1 / string.joints("EA")).sum()) + 1 / rock.stiffness
    time = SLOWER * 4 * float(string.length.sum()) / float(np.sqrt(top.EA / top.mass))
    return Driller(True, case.bit.weight_on_bit, 2 * softness / time, softness / time**2)


def expected_drilling(case: Case, string: String) -> ExpectedDrilling | None:
    """What the autodriller of a case is expected to do with its longest string; None without one.

    Raises InputError where the law of the bit says that it does not drill.
    """
    rock = rock_of(case)
    if not case.rig.autodriller or rock.law != DRAG_BIT:
        return None
    cut = rock.advance * (case.bit.weight_on_bit - rock.worn) / (2 * np.pi)
    if cut <= 0:
        raise InputError(
            f"above what the wear flats of the bit carry, {quantity(rock.worn, 'N', '.4g')}, so that it drills",
            key="bit.weight_on_bit",
            value=quantity(case.bit.weight_on_bit, "N"),
        )
    rates = [cut * (rad_per_s(operation.rpm) + rock.motor) for operation in case.operations]
    return ExpectedDrilling(rates, TARE_PERIODS * axial_period_of(string))


def rock_of(case: Case) -> Rock:
    """The rock of a case; NOTHING where no operation drills.  Raises InputError for what drilling in time lacks."""
    drilling = [i for i, operation in enumerate(case.operations) if operation.on_bottom]
    if not drilling:
        return NOTHING
    spec, motor = case.bit.rock, case.bit.motor
    if spec is None:
        raise InputError(
            f"a table [bit.rock], since operations[{drilling[0]}] drills (or fctd equilibrium, for a steady string)",
            key="bit.rock",
        )
    sliding = [i for i in drilling if not case.operations[i].may_turn]
    if sliding and motor is None:
        raise InputError(
            f"a table [bit.motor] with its flow, which turns the bit while operations[{sliding[0]}] slides",
            key="bit.motor",
        )
    spins = {
        "weakening": spec.weakening,
        "weakening_spin": rad_per_s(spec.weakening_rpm),
        "motor": 0.0 if motor is None else 2e3 * np.pi * motor.flow * motor.revolutions_per_liter,
    }
    if spec.law == "given":
        if case.rig.autodriller:
            raise InputError("false, where bit.rock.law gives the weight", key="rig.autodriller", value=True)
        return Rock(GIVEN_LOADS, weight=case.bit.weight_on_bit, torque=case.bit.torque, **spins)
    start = case.operations[drilling[0]].start_md
    hole = next((i for i in case.wellbore.intervals if i.to_md > start), case.wellbore.intervals[-1])
    radius = spec.radius or 0.5 * hole.diameter
    return Rock(
        DRAG_BIT,
        stiffness=spec.stiffness,
        worn=spec.contact_strength * radius * spec.wear_flat,
        advance=1 / (spec.force_ratio * spec.specific_energy * radius),
        cutting=0.5 * radius / spec.force_ratio,
        rubbing=0.5 * spec.friction * spec.bit_factor * radius,
        **spins,
    )


def check_weight(case: Case, along: float) -> None:
    """Raise InputError for a weight on bit above the string's weight along the hole [N], which must carry it."""
    drills = any(operation.on_bottom for operation in case.operations)
    uses = case.rig.autodriller or (case.bit.rock is not None and case.bit.rock.law == "given")
    if drills and uses and case.bit.weight_on_bit >= along + case.rig.push:
        raise InputError(
            f"less than the weight of string and block along the hole, {quantity(along + case.rig.push, 'N', '.4g')}",
            key="bit.weight_on_bit",
            value=quantity(case.bit.weight_on_bit, "N"),
        )


def above_bottom(case: Case) -> float:
    """Height of the bit above the bottom of the hole at the start of a run that drills [m].

    The bottom is the deepest point that the bit reaches before it drills.
    """
    operations = case.operations
    first = next(i for i, operation in enumerate(operations) if operation.on_bottom)
    return max(operation.start_md for operation in operations[: first + 1]) - operations[0].start_md
