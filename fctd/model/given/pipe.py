"""Pipe of the catalogue that a component of a WITSML string is, where all that the file has of it agrees."""

import math
from collections.abc import Mapping
from typing import Any, Final

from fctd.case.pipes.catalogue import FOOT, POUND, SAME_DIAMETER, Pipe, connection_of, of_grade, pipes_of_size
from fctd.case.pipes.filling import STEEL, lacks_joints
from fctd.case.pipes.grades import drill_pipe_grade_of, grade_of
from fctd.case.pipes.names import CASING, CLASSES, DRILL_PIPE, TUBING
from fctd.case.witsml.tubular import TubularPart

_STEELS: Final = ("", "steel", "steel alloy", "chrome alloy", "non-magnetic steel", "unknown")
_SAME_MASS, _ROUNDED = 0.01, 0.003  # shares of a mass


def pipe_of(part: TubularPart) -> Pipe | None:
    """The one pipe whose body, grade, connection, tool joints and mass are those of a component; else None.

    What the file does not have of diameters and mass the pipe gives; grade and connection it must have, connections of
    casing and tubing excepted, of which the catalogue has none.  Drill pipe has the class that the file tells.
    """
    share = CLASSES.get(part.service.casefold() or "new")
    if share is None or (share < 1 and part.kind != DRILL_PIPE):
        return None
    if not part.outer or not part.inner or not is_steel(part):
        return None
    found = [
        graded
        for pipe in pipes_of_size(part.kind or "", part.outer, part.inner)
        if (graded := _graded(pipe, part.grade)) is not None and _joins(pipe, part) and _weighs(pipe, part.mass)
    ]
    return found[0]._replace(wall_share=share) if len(found) == 1 else None


def _graded(pipe: Pipe, grade: str) -> Pipe | None:
    """The pipe where its grade is that of a text, or takes it; collars have none."""
    known = drill_pipe_grade_of(grade) if pipe.kind == DRILL_PIPE else grade_of(grade)
    if pipe.kind in (CASING, TUBING):
        graded = of_grade(pipe, known)
        return graded if graded.grade is not None else None
    return pipe if pipe.grade == known and (known is not None or not grade) else None


def _joins(pipe: Pipe, part: TubularPart) -> bool:
    """Whether the connection, and what touches, are those of a component, and the catalogue has all of the pipe."""
    if lacks_joints(pipe):
        return False
    if pipe.kind in (CASING, TUBING):
        return _same(part.touching, pipe.coupling)
    names = {connection_of(pipe.connection), connection_of(pipe.connection.split(" ")[0])}
    if not {*map(connection_of, part.connections)} & names:
        return False
    if pipe.joint is None:  # a collar, whose connections are no wider than it is
        return part.touching is None or part.touching <= pipe.outer + SAME_DIAMETER
    return _same(part.touching, pipe.joint.outer)


def _same(given: float | None, of_pipe: float | None) -> bool:
    return given is None or of_pipe is None or abs(given - of_pipe) <= SAME_DIAMETER


def _weighs(pipe: Pipe, mass: float | None) -> bool:
    """Whether a mass [kg/m] is that of the pipe with its tool joints, or not given."""
    whole = pipe.linear_mass or 0.25 * math.pi * (pipe.outer**2 - pipe.inner**2) * STEEL
    return not mass or abs(mass - whole) <= _SAME_MASS * whole


def nominal_of(part: TubularPart) -> float | None:
    """Nominal weight [lb/ft] of the drill pipe with the body of a component, where its mass is that weight."""
    if part.kind != DRILL_PIPE or not part.mass:
        return None
    weights = {pipe.second for pipe in pipes_of_size(DRILL_PIPE, part.outer or 0.0, part.inner or 0.0)}
    return next((one for one in weights if abs(one * POUND / FOOT / part.mass - 1) <= _ROUNDED), None)


def is_steel(part: TubularPart) -> bool:
    """Whether a component is of steel, or the file does not say of what."""
    return part.material.casefold() in _STEELS


def body_mass(keys: Mapping[str, Any]) -> float | None:
    """Mass of a steel body with the diameters of a component [kg/m]; None without them."""
    outer, inner = keys.get("outer_diameter"), keys.get("inner_diameter")
    return None if outer is None or inner is None else 0.25 * math.pi * (outer**2 - inner**2) * STEEL
