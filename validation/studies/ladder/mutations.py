"""Faults of 2 % that enter through the case: each has a rung that moves by 1 % or more for it, and breaks."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from fctd import Case
from validation.studies.ladder.rung import By, Rung, measure, section

SHARE = 0.02  # of the fault
LEAST = 1.0  # [%] by which a rung must move
Changes = Callable[[Case], dict[str, Any]]


@dataclass(frozen=True)
class Mutation:
    """A parameter, the rung that must notice, and the keys that change."""

    parameter: str
    rung: str
    by: By
    changes: Changes


def of_section(key: str, name: str, *components: int) -> Changes:
    """A property per metre of components, 2 % too large."""
    return lambda case: {
        f"string.components[{k}].{key}": (1 + SHARE) * getattr(section(case, k), name) for k in components or (0,)
    }


def of_key(key: str, value: Callable[[Case], float]) -> Changes:
    """A value of the case, 2 % too large."""
    return lambda case: {key: (1 + SHARE) * value(case)}


def friction(case: Case) -> float:
    """Of the hole."""
    return case.wellbore.intervals[0].friction


def wall(case: Case) -> float:
    """Stiffness of the wall per length [N/m²]."""
    assert case.wellbore.stiffness_per_length is not None
    return case.wellbore.stiffness_per_length


def clearance(case: Case) -> dict[str, Any]:
    """A hole that is wider by 2 % of its clearance."""
    diameter, pipe = case.wellbore.intervals[0].diameter, case.string.components[0].contact_diameter
    return {"wellbore.intervals[0].diameter": pipe + (1 + SHARE) * (diameter - pipe)}


MUTATIONS = (
    Mutation("EA", "stretch in air", "steady", of_section("axial_stiffness", "EA")),
    Mutation("EA in time", "axial frequency 1, squared", "stepper", of_section("axial_stiffness", "EA", 0, 1)),
    Mutation("κGA", "deep beam", "steady", of_section("shear_stiffness", "shear")),
    Mutation("EI", "helix, wall force", "steady", of_section("bending_stiffness", "EI")),
    Mutation("GJ", "torsional frequency 1, squared", "stepper", of_section("torsional_stiffness", "GJ", 0, 1)),
    Mutation("weight", "torque in a bend with weight", "steady", of_section("linear_mass", "mass")),
    Mutation("weight in time", "torque in a bend with weight", "stepper", of_section("linear_mass", "mass")),
    Mutation("μ", "bend with weight, hoisting", "steady", of_key("wellbore.intervals[0].friction", friction)),
    Mutation("μ in time", "bend with weight, hoisting", "stepper", of_key("wellbore.intervals[0].friction", friction)),
    Mutation(
        "μ around the hole", "wire with two factors, torque", "steady",
        of_key("wellbore.intervals[0].rotational_friction", lambda case: case.wellbore.intervals[0].friction_around),
    ),
    Mutation("clearance", "helix, wall force", "steady", clearance),
    Mutation("wall stiffness", "penetration of the wall", "steady", of_key("wellbore.stiffness_per_length", wall)),
    Mutation("inertia", "torsional frequency 1, squared", "stepper", of_section("linear_mass", "mass", 0, 1)),
    Mutation("mud density", "true tension of a free end", "steady", of_key("mud.density", lambda c: c.mud.density)),
    Mutation(
        "bend", "bent housing, side force", "steady",
        of_key("string.components[1].bend", lambda case: case.string.components[1].bend),
    ),
    Mutation("bit torque", "torque while drilling an incline", "steady", of_key("bit.torque", lambda c: c.bit.torque)),
    Mutation(
        "weight on bit", "helix, wall force", "steady", of_key("bit.weight_on_bit", lambda c: c.bit.weight_on_bit)
    ),
)  # fmt: skip


def broken(mutation: Mutation, rung: Rung) -> dict[str, Any]:
    """A row: by how much the rung moves, and its error with the fault; the exact number is that without it."""
    cut = rung.cuts[0]
    before = measure(rung, mutation.by, cut)
    after = measure(rung, mutation.by, cut, mutation.changes(rung.case(cut)))
    moved = abs(after["error_percent"] - before["error_percent"])
    return {
        "parameter": mutation.parameter, "rung": rung.name, "by": mutation.by, "moved_percent": moved,
        "bound_percent": rung.bound, "error_percent": before["error_percent"],
        "error_with_fault_percent": after["error_percent"],
        "error_over_bound": abs(after["error_percent"]) / rung.bound, "bound_over_movement": rung.bound / moved,
    }  # fmt: skip
