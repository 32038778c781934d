"""What a string of a case may need of the stepper that moves it, and the refusal of what a stepper leaves out.

Every stepper names the features that it honours; a case that uses another one is refused.  So is a key that is neither
among the ``keys`` of a feature nor ``EVERYWHERE``, unless FCTD's own stepper moves the string.
"""

import re
from collections.abc import Callable, Collection, Iterator, Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from fctd.case.errors import InputError, Table
from fctd.case.message import quantity
from fctd.case.rheology import RheologySpec
from fctd.case.solver import SolverSpec
from fctd.mechanics.law_names import STICKING
from fctd.mechanics.rock import NO_ROCK
from fctd.model.joints import Kind
from fctd.simulation.run import Run

# Key and value of a case that use a feature, or None where it is not used.
Use = tuple[str, Any] | None
# Inclination below which a hole is vertical [rad].
VERTICAL = 1e-6


class Feature(NamedTuple):
    """A part of the model that a stepper may leave out.

    what : it is, in the plural or with an article.  without : what the case has to have where it is left out.
    keys : of a case from which it follows, indices left out.  used : where a run uses it.
    """

    what: str
    without: str
    keys: tuple[str, ...]
    used: Callable[[Run], Use]


def _key(key: str, without: Any) -> Callable[[Run], Use]:
    """Used where a key of the case has another value."""
    table, name = key.split(".")

    def used(run: Run) -> Use:
        value = getattr(getattr(run.case, table), name)
        return None if value == without or not value else (key, value)

    return used


def _at_wall(used: Callable[[Run], Use]) -> Callable[[Run], Use]:
    """Used where the string may touch the wall."""
    return lambda run: used(run) if run.case.contact.enabled else None


def _law(wanted: Callable[[str], bool]) -> Callable[[Run], Use]:
    def used(run: Run) -> Use:
        law = run.case.contact.friction_law
        return ("contact.friction_law", law) if wanted(law) else None

    return _at_wall(used)


def _of_component(key: str) -> Callable[[Run], Use]:
    """Used where a component of the string has a value of a key other than 0."""

    def used(run: Run) -> Use:
        values = [getattr(component, key) for component in run.case.string.components]
        return next(((f"string.components[{k}].{key}", value) for k, value in enumerate(values) if value), None)

    return used


def _along_hole(*keys: str) -> Callable[[Run], Use]:
    """Used where an interval of the hole has another value of a key than the first."""

    def used(run: Run) -> Use:
        first, *others = run.case.wellbore.intervals
        for k, interval in enumerate(others, 1):
            for key in keys:
                if getattr(interval, key) != getattr(first, key):
                    return f"wellbore.intervals[{k}].{key}", getattr(interval, key)
        return None

    return _at_wall(used)


def _orthotropic(run: Run) -> Use:
    pairs = enumerate(run.case.wellbore.intervals)
    differ = [
        (f"wellbore.intervals[{k}].rotational_friction", one.rotational_friction)
        for k, one in pairs
        if one.friction_around != one.friction
    ]
    return differ[0] if differ else None


def _cake(run: Run) -> Use:
    pressed = [
        (f"wellbore.intervals[{k}].overbalance", one.overbalance) for k, one in enumerate(run.case.wellbore.intervals)
    ]
    return next((use for use in pressed if use[1]), None) if run.laws.cake_thickness > 0 else None


def _touches_at_middle(run: Run) -> Use:
    middle = np.flatnonzero(run.string.mid_contact())
    if not len(middle):
        return None
    key, part = run.string.key_of(middle[0]), run.string.parts[run.string.component[middle[0]]]
    if part.kind == Kind.WHOLE:
        return f"{key}.contact", "point"
    if part.kind == Kind.FITTING:
        return f"{key}.{part.component.repeat_key}", "a table"
    return f"{key}.joint_segments", part.component.joint_segments


def _own_friction(run: Run) -> Use:
    fittings = [(k, part) for k, part in enumerate(run.case.string.components) if part.fittings is not None]
    return next(
        (
            (f"string.components[{k}].{part.repeat_key}.friction", part.fittings.friction)
            for k, part in fittings
            if part.fittings is not None and part.fittings.friction is not None
        ),
        None,
    )


def _bows(run: Run) -> Use:
    parts = enumerate(run.case.string.components)
    return next(((f"string.components[{k}].centralisers", "bow springs") for k, part in parts if part.has_bows), None)


def _bit_loads(run: Run) -> Use:
    return None if run.laws.rock.law == NO_ROCK else ("bit.rock", "a table")


def _stands(run: Run) -> Use:
    return None if not run.upper_end.in_derrick else ("rig.feed", run.case.rig.feed)


def _feed(run: Run) -> Use:
    moving = [(f"operations[{k}].kind", one.kind) for k, one in enumerate(run.case.operations) if one.direction]
    fed = ("string.components", "one long segment") if run.string.long_segment else None
    return moving[0] if moving else fed


def _incline(run: Run) -> Use:
    reach = np.linspace(run.case.string.top_md, run.string.bit_depth, 200)
    tilt = float(run.hole.inclination(reach).max())
    return ("wellbore", f"an inclination of up to {np.degrees(tilt):.3g} deg") if tilt > VERTICAL else None


def _mud_moves(run: Run) -> Use:
    return ("mud.viscosity", quantity(1e3 * run.case.mud.unsteady, "mPa·s")) if run.case.mud.unsteady else None


def _flow(run: Run) -> Use:
    flows = enumerate(operation.flow for operation in run.case.operations)
    return next(((f"operations[{k}].flow", quantity(flow, "m^3/s")) for k, flow in flows if flow), None)


def _joint_damping(run: Run) -> Use:
    damping = run.case.solver.joint_damping
    usual = SolverSpec.model_fields["joint_damping"].default
    return ("solver.joint_damping", f"{damping:g} s") if damping > usual else None


INTERVAL = "wellbore.intervals."
FEATURES: dict[str, Feature] = {
    "wall": Feature(
        "a wall", "false", ("contact.enabled",),
        lambda run: ("contact.enabled", True) if run.case.contact.enabled else None,
    ),
    "no_wall": Feature(
        "strings without a wall", "true", ("contact.enabled",),
        lambda run: None if run.case.contact.enabled else ("contact.enabled", False),
    ),
    "wall_law": Feature(
        "walls that are not linear", '"linear"',
        ("contact.law", "contact.exponent", "contact.reference_penetration", "contact.largest_penetration"),
        _at_wall(_key("contact.law", "linear")),
    ),
    "stiffness_along_hole": Feature(
        "walls of several stiffnesses", "one stiffness of the whole hole",
        (INTERVAL + "stiffness", INTERVAL + "stiffness_per_length"),
        _along_hole("stiffness", "stiffness_per_length"),
    ),
    "friction_law": Feature(
        "other laws of friction", '"coulomb"', ("contact.friction_law",),
        _law(lambda law: law != "coulomb" and law not in STICKING),
    ),
    "sticking": Feature(
        "friction that sticks", '"coulomb"',
        ("contact.friction_law", INTERVAL + "static_friction", INTERVAL + "decay_speed"), _law(STICKING.__contains__),
    ),
    "friction_along_hole": Feature(
        "several friction factors", "one friction factor for the whole hole", (INTERVAL + "friction",),
        _along_hole("friction"),
    ),
    "orthotropic": Feature(
        "friction that differs along and around the hole", "the factor of the interval's friction",
        (INTERVAL + "rotational_friction",), _at_wall(_orthotropic),
    ),
    "caliper": Feature(
        "holes that are not round", "none",
        (*(f"wellbore.caliper.{key}" for key in (
            "log", "rows", "values", "reference", "first_arm", "columns.header", "columns.unit")), "wellbore.cell"),
        _at_wall(lambda run: None if run.hole.is_round else ("wellbore.caliper", "a table")),
    ),
    "cake": Feature(
        "mud cake", "no overbalance",
        (INTERVAL + "overbalance", "mud.cake.thickness", "mud.cake.time", "mud.cake.friction", "mud.cake.rested"),
        _cake,
    ),
    "middle_contact": Feature(
        "contact at the middle of a segment", '"sleeve"', ("string.components.contact",), _at_wall(_touches_at_middle),
    ),
    "bends": Feature(
        "bent housings", "0", ("string.components.bend", "string.components.toolface"), _of_component("bend"),
    ),
    "own_friction": Feature(
        "friction factors of fittings", "none",
        ("string.components.centralisers.friction", "string.components.friction_reducers.friction"),
        _at_wall(_own_friction),
    ),
    "bows": Feature(
        "bow springs", "rigid centralisers",
        ("string.components.centralisers.stiffness", "string.components.centralisers.starting_force"), _at_wall(_bows),
    ),
    "swivel": Feature("swivels", "false", ("string.components.swivel",), _of_component("swivel")),
    "unbalance": Feature(
        "masses beside the axis", "0", ("string.components.eccentricity",), _of_component("eccentricity"),
    ),
    "drive": Feature(
        "a top drive that gives way", '"stiff"',
        ("rig.drive", "rig.control.inertia", "rig.control.proportional", "rig.control.integral",
         "rig.control.compensation", "rig.control.torque_limit"),
        _key("rig.drive", "stiff"),
    ),
    "bit_loads": Feature(
        "the loads of a bit on bottom", "operations off bottom",
        ("bit.weight_on_bit", "bit.torque", "bit.rock.law", "bit.rock.stiffness", "bit.rock.radius",
         "bit.rock.specific_energy", "bit.rock.force_ratio", "bit.rock.friction", "bit.rock.bit_factor",
         "bit.rock.wear_flat", "bit.rock.contact_strength", "bit.rock.weakening", "bit.rock.weakening_rpm",
         "bit.motor.flow", "bit.motor.revolutions_per_liter", "rig.autodriller"),
        _bit_loads,
    ),
    "stands": Feature(
        "stands that a block adds", '"long_segment"',
        ("rig.feed", "rig.stand_length", "rig.connection_time", "rig.derrick_height"), _stands,
    ),
    "feed": Feature(
        "strings that move along the hole", "rotate_off_bottom", ("operations.kind", "operations.speed"), _feed
    ),
    "incline": Feature(
        "inclined holes", "a vertical hole", ("wellbore.survey", "wellbore.stations"), _incline,
    ),
    "mud_moves": Feature(
        "mud that moves with the string", "0",
        ("mud.viscosity", "mud.fann", *(f"mud.rheology.{key}" for key in RheologySpec.model_fields)), _mud_moves,
    ),
    "mud_axial": Feature("damping by mud", "0", ("mud.axial_damping",), _key("mud.axial_damping", 0.0)),
    "mud_lateral": Feature("damping by mud", "0", ("mud.lateral_damping",), _key("mud.lateral_damping", 0.0)),
    "mud_spin": Feature("damping by mud", "0", ("mud.rotational_damping",), _key("mud.rotational_damping", 0.0)),
    "flow": Feature("mud that is pumped", "0", ("operations.flow",), _flow),
    "joint_damping": Feature(
        "damping of the joints", "at most the default", ("solver.joint_damping",), _joint_damping,
    ),
    "loss_factor": Feature("damping of torsion", "0", ("solver.loss_factor",), _key("solver.loss_factor", 0.0)),
    "fluids": Feature(
        "fluids by depth", "one density of the mud",
        ("mud.inside.to_md", "mud.inside.density", "mud.inside.plug", "mud.inside.pressure", "mud.outside.to_md",
         "mud.outside.density", "mud.inside_pressure", "mud.outside_pressure", "mud.float", "bit.end"),
        lambda run: ("mud", "fluids by depth") if run.case.mud.given else None,
    ),
    "packer": Feature(
        "an end in a seal bore, which steady strings have", "none", ("mud.packer_bore",),
        lambda run: None if (bore := run.case.mud.packer_bore) is None else ("mud.packer_bore", quantity(bore, "m")),
    ),
    "temperature": Feature(
        "changes of temperature", "no rows", ("temperature.tvd", "temperature.change"),
        lambda run: ("temperature", "rows") if run.case.temperature else None,
    ),
    "overpull": Feature(
        "a stuck bit, which steady strings have", "0", ("bit.overpull",), _key("bit.overpull", 0.0)
    ),
    "helical_force": Feature(
        "the force of a helix, which fctd equilibrium and fctd chart have", '"none"',
        ("contact.helical_force",), _at_wall(_key("contact.helical_force", "none")),
    ),
}  # fmt: skip

# Keys that work in the same way whatever moves the string: what is laid out, read or kept.
EVERYWHERE: Final = frozenset({
    "name", "units", "file", "datum.elevation", "datum.air_gap", "datum.water_depth",
    "wellbore.columns.header", "wellbore.columns.unit", "wellbore.sheet", "wellbore.survey_smoothing",
    "wellbore.tortuosity.amplitude", "wellbore.tortuosity.wavelength", "wellbore.tortuosity.seed",
    "wellbore.survey_method", "wellbore.geometry", "wellbore.cylinder_length", "wellbore.chord_tolerance",
    "wellbore.overlap", "wellbore.stiffness", "wellbore.stiffness_per_length",
    "wellbore.intervals.to_md", "wellbore.intervals.diameter", "wellbore.intervals.kind", "wellbore.intervals.name",
    "string.top_md",
    *(
        f"string.components.{key}" for key in (
            "name", "pipe", "length", "outer_diameter", "inner_diameter", "contact_diameter", "segments",
            "segment_length", "joint_segments", "linear_mass", "youngs_modulus", "poisson_ratio", "density",
            "yield_strength", "thermal_expansion", "axial_stiffness", "bending_stiffness", "torsional_stiffness",
            "shear_stiffness", "joint.length", "joint.tool_joint_length", "joint.tool_joint_diameter",
            "joint.tool_joint_inner",
            *(f"{fittings}.{key}" for fittings in ("centralisers", "friction_reducers")
              for key in ("every", "diameter", "length", "segments")),
        )
    ),
    # Of the wear of casing alone.
    *(f"wellbore.intervals.{key}" for key in ("casing", "outer_diameter", "yield_strength")),
    # Of flow alone.
    *(f"wellbore.window.{key}" for key in ("tvd", "pore", "fracture")),
    "mud.eccentricity", "rig.surface_length", "rig.surface_bore", "bit.nozzles", "bit.flow_area", "bit.discharge",
    *(f"string.components.{key}" for key in ("pressure_drop", "at_flow", "at_density")),
    *(
        f"mud.{side}.{key}" for side in ("inside", "outside")
        for key in ("viscosity", "fann", *(f"rheology.{key}" for key in RheologySpec.model_fields))
    ),
    "limits.design_factor", "limits.torque_share", "limits.overpull_margin",
    "mud.density", "rig.hoist_capacity", "rig.largest_torque", "rig.slip_length", "rig.block_weight",
    "rig.guide_friction", "rig.sheave_efficiency", "rig.torque_offset",
    "rig.torque_per_rpm", "contact.damping", "solver.step", "solver.shape_damping", "solver.buckling",
    "solver.resolve_work", "solver.perturbed", "record.interval", "record.profile_at",
    *(f"operations.{key}" for key in ("ramp_time", "from_md", "to_md", "rpm", "at_md", "duration")),
})  # fmt: skip
# Stands for keys that are in neither table.
UNKNOWN_KEYS: Final = "unknown keys"

# Features of FCTD's own stepper.
OWN = frozenset(FEATURES) - {"helical_force", "overpull", "packer"} | {UNKNOWN_KEYS}
# With another contact method: it finds walls, in whose cake nothing is pressed and which begin below the derrick, and
# does not know what touches them.
ASKED = OWN - {"no_wall", "cake", "stands", "own_friction", "bows", UNKNOWN_KEYS}


def _keys_set(table: Table, before: str = "") -> Iterator[tuple[str, Any]]:
    """Keys of a table, and of those within it, whose value is not the default, with their values."""
    for name, field in type(table).model_fields.items():
        value = getattr(table, name)
        several = tuple(value.values()) if isinstance(value, Mapping) else value
        inner = several if isinstance(several, tuple) else (value,)
        if inner and isinstance(inner[0], Table):
            for k, one in enumerate(inner):
                yield from _keys_set(one, f"{before}{name}[{k}]." if isinstance(value, tuple) else f"{before}{name}.")
        elif value is not None and value != field.get_default():
            yield before + name, value


def refuse(run: Run, honours: Collection[str], by: str) -> None:
    """Raise InputError for the first feature that a run uses and that is not among those that are honoured.

    by : what moves the string and would leave it out.
    """
    if UNKNOWN_KEYS not in honours:
        known = EVERYWHERE.union(*(feature.keys for feature in FEATURES.values()))
        for key, value in _keys_set(run.case):
            if re.sub(r"\[\d+\]", "", key) not in known:
                raise InputError(f"its default, since {by} may leave out what the key does", key=key, value=value)
    for name, feature in FEATURES.items():
        use = None if name in honours else feature.used(run)
        if use is not None:
            raise InputError(f"{feature.without}, since {by} leaves out {feature.what}", key=use[0], value=use[1])
