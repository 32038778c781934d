"""Numbers that a new case needs and nobody gives: where its shoe may be, and how stiff its wall."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from fctd.arrays import Array
from fctd.case.string import ComponentSpec
from fctd.model.default_layout import mean_curvature
from fctd.model.section import section_of
from fctd.model.templates import Part, Template

Laid = Sequence[tuple[ComponentSpec, float]]
"""Components of a string from the bit up, each with its length [m]."""

FOOT: Final = 0.3048
# The shoe is where the hole has this share of its greatest inclination, between these shares of its depth, on a round
# depth: casing is set below the build.
LANDED, SHALLOWEST_SHOE, DEEPEST_SHOE = 0.95, 0.4, 0.7
# Least clearance [m] that counts: a tool of nearly the hole's diameter would ask for a wall of any stiffness.
LEAST_CLEARANCE, USUAL_CLEARANCE = 0.005, 0.02


def round_up(number: float) -> float:
    """The least of 1, 2 or 5 times a power of ten that is not below a number above 0."""
    power = 10.0 ** np.floor(np.log10(number))
    return float(next(m * power for m in (1, 2, 5, 10) if m * power >= number))


def sensible_shoe(stations: Array, round_to: float) -> float:
    """A depth [m] at which casing may be set, a multiple of ``round_to``: where the build ends, in the middle part of
    the hole."""
    depth, inclination = float(stations[-1, 0]), stations[:, 1]
    landed = float(stations[np.argmax(inclination >= LANDED * inclination.max()), 0])
    first, last = np.ceil(SHALLOWEST_SHOE * depth / round_to), np.floor(DEEPEST_SHOE * depth / round_to)
    if last < max(first, 1):  # a hole too short for round depths
        return SHALLOWEST_SHOE * depth
    return float(np.clip(round(landed / round_to), first, last) * round_to)


def stiff_wall(parts: Laid, mud: float, narrowest: float, stations: Array) -> float:
    """A stiffness [N/m/m], 1, 2 or 5 times a power of ten: the string presses less than 1 % of its clearance into it.

    mud [kg/m^3]; narrowest : diameter of the hole [m], infinite where it is not known.  The side force of a metre is
    tension times curvature, and weight: with the weight of the whole string, the sharpest bend and the heaviest
    component it is the largest one without friction.  Short tools, such as a bit of the hole's diameter, do not count
    in the clearance.
    """
    weight, heaviest, clearance = 0.0, 0.0, np.inf
    for component, length in parts:
        section = section_of(component, mud)
        weight, heaviest = weight + section.weight * length, max(heaviest, section.weight)
        if component.contact == "sleeve":
            clearance = min(clearance, 0.5 * narrowest - section.contact_radius)
    clearance = max(clearance, LEAST_CLEARANCE) if np.isfinite(clearance) else USUAL_CLEARANCE
    sharpest = float(mean_curvature(stations, np.linspace(0.0, stations[-1, 0], 2000)).max())
    return round_up((weight * sharpest + heaviest) / (0.01 * clearance))


def narrowest_of(template: Template) -> float:
    """The least diameter of a template's hole [m]."""
    return 0.0254 * min(float(hole.diameter) for hole in (template.cased, template.open))


def laid(template: Template, shoe: float, depth: float) -> list[tuple[ComponentSpec, float]]:
    """The components of a template in a hole with a shoe and of a depth [m]."""
    found, above = [], depth
    for part in template.string:
        length = above if part.length is None else min(part.length or depth - shoe, above)
        above -= length
        found.append((component_of(part), length))
    return found


def component_of(part: Part) -> ComponentSpec:
    """A part of a template, without a length."""
    return ComponentSpec.model_validate({"name": part.name, **part.keys})
