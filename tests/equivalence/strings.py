"""Drawn strings: bit, assembly and pipe, with all that a component can have."""

from typing import Any

from tests.equivalence.dice import Dice
from tests.equivalence.holes import INCH, Raw, Size

# Pipe by open hole [in]: outer and inner diameter, that of its tool joints, and its name in the catalogue.
PIPES = {
    12.25: ((5.0, 4.276, 6.625, "5 in 19.5 S-135 NC50"), (5.5, 4.778, 7.0, "5 1/2 in 21.9 S-135 HT55 7 x 4")),
    8.5: ((5.0, 4.276, 6.625, "5 in 19.5 S-135 NC50"), (4.0, 3.34, 5.25, "4 in 14 S-135 XT39")),
    6.0: ((3.5, 2.764, 4.75, "3 1/2 in 13.3 S-135"), (2.875, 2.151, 4.125, "2 7/8 in 10.4 G-105")),
}
COLLARS = {12.25: (8.0, 2.8125), 8.5: (6.5, 2.8125), 6.0: (4.75, 2.25)}


def string(dice: Dice, size: Size, total: float) -> Raw:
    """The table of the string, from the bit upwards."""
    outer, inner, joint, name = dice.pick(PIPES[size.open_hole])
    parts = [*assembly(dice, size), *pipes(dice, size, outer, inner, joint, name, total)]
    for part in parts:
        touch_up(dice, part)
    table: Raw = {"components": parts}
    if dice.chance(0.15):
        table["top_md"] = round(dice.number(0.02, 0.25) * total, 1)
    return table


def assembly(dice: Dice, size: Size) -> list[Raw]:
    """A bit, a motor, stabilisers and collars, or some of these."""
    outer, inner = COLLARS[size.open_hole]
    wide, diameters = (size.open_hole - 0.125) * INCH, {"outer_diameter": outer * INCH, "inner_diameter": inner * INCH}
    parts: list[Raw] = []
    if dice.chance(0.3):
        parts.append({"name": "bit", **diameters, "length": 0.4, "contact_diameter": wide, "contact": "point"})
    if dice.chance(0.3):
        motor = {"name": "motor", **diameters, "length": 8.0, "segments": 4}
        if dice.chance(0.4):
            motor |= {"bend": dice.number(0.005, 0.02), "toolface": dice.number(0, 6)}
        if dice.chance(0.7):
            motor |= {"pressure_drop": dice.number(5e5, 4e6), "at_flow": dice.number(0.02, 0.04)}
            if dice.chance(0.5):
                motor["at_density"] = dice.number(1000, 1400)
        parts.append(motor)
    if dice.chance(0.3):
        parts.append({"name": "stabiliser", **diameters, "length": 1.5, "contact_diameter": wide, "segments": 1})
    if dice.chance(0.7):
        collars = {"name": "collars", **diameters, "length": dice.number(18, 90, 3)}
        collars |= dice.pick([{}, {"segments": dice.whole(4, 9)}, {"segment_length": dice.number(6, 11, 2)}])
        parts.append(collars)
    return parts


def pipes(dice: Dice, size: Size, outer: float, inner: float, joint: float, name: str, total: float) -> list[Raw]:
    """Pipe to the table, some of it with fittings, joints or a swivel."""
    body: Raw = {"outer_diameter": outer * INCH, "inner_diameter": inner * INCH}
    kind = dice.pick(["plain", "plain", "plain", "joint", "joints", "catalogue", "centralisers", "reducers"])
    short = total / dice.number(30, 45, 3)
    cut = dice.pick([{}, {"segment_length": short}, {"segment_length": short}])
    wide = {"every": dice.number(14, 40, 3), "diameter": (size.open_hole - 0.25) * INCH, "segments": dice.whole(2, 4)}
    last: Raw = {"name": "pipe", **body, **cut}
    below: list[Raw] = []
    if kind == "plain" and dice.chance(0.8):
        last["contact_diameter"] = joint * INCH
    elif kind == "joint":
        last["joint"] = joint_table(dice, joint)
    elif kind == "joints":
        resolved = {"name": "joints", **body, "joint": joint_table(dice, joint), "joint_segments": dice.whole(2, 3)}
        below.append(resolved | {"length": dice.number(45, 150, 3)})
        last["contact_diameter"] = joint * INCH
    elif kind == "catalogue":
        last = {"name": "pipe", "pipe": name + dice.pick(["", ", premium"]), **cut}
    elif kind == "centralisers":
        of: Raw = dict(wide)
        if dice.chance(0.5):
            of |= {"stiffness": dice.number(2e5, 8e5)}
            if dice.chance(0.6):
                of["starting_force"] = dice.number(100, 1500)
        if dice.chance(0.4):
            of["friction"] = dice.number(0.1, 0.4, 2)
        if dice.chance(0.3):
            of["length"] = dice.number(0.2, 1.0)
        below.append({"name": "casing", **body, "length": dice.number(60, 250, 3), "centralisers": of})
    elif kind == "reducers":
        of = wide | {"friction": dice.number(0.02, 0.15, 2)}
        if dice.chance(0.3):
            of["length"] = dice.number(0.2, 1.0)
        below.append({"name": "pipe with reducers", **body, "length": dice.number(60, 250, 3), "friction_reducers": of})
    if dice.chance(0.2):
        lower = {**last, "name": "lower pipe", "length": dice.number(0.2, 0.4) * total}
        below.append(lower)
    if below and dice.chance(0.15):
        below[-1]["swivel"] = True
    if dice.chance(0.2):
        last["length"] = total
    return [*below, last]


def joint_table(dice: Dice, diameter: float) -> Raw:
    """Joints of some nine metres."""
    table: Raw = {
        "length": dice.number(9, 13, 3), "tool_joint_length": dice.number(0.4, 0.7),
        "tool_joint_diameter": diameter * INCH,
    }  # fmt: skip
    if dice.chance(0.5):
        table["tool_joint_inner"] = 0.5 * diameter * INCH
    return table


def touch_up(dice: Dice, part: Raw) -> None:
    """Keys that any component may have."""
    steel: dict[str, Any] = {
        "youngs_modulus": dice.number(1.9e11, 2.1e11), "poisson_ratio": dice.number(0.25, 0.33),
        "density": dice.number(7700, 7900), "thermal_expansion": dice.number(1.1e-5, 1.3e-5),
        "yield_strength": dice.pick(["G-105", 7e8]), "eccentricity": dice.number(0.0005, 0.003),
    }  # fmt: skip
    for key, value in steel.items():
        if dice.chance(0.1):
            part[key] = value
    if "pipe" in part:
        return
    outer, inner = part["outer_diameter"], part["inner_diameter"]
    area, second = 0.785 * (outer**2 - inner**2), 0.0491 * (outer**4 - inner**4)
    given = {
        "linear_mass": 7850 * area * dice.number(1.02, 1.15), "axial_stiffness": 2e11 * area * dice.number(0.9, 1.1),
        "bending_stiffness": 2e11 * second * dice.number(0.9, 1.1),
        "torsional_stiffness": 1.6e11 * second * dice.number(0.9, 1.1),
        "shear_stiffness": 4e10 * area * dice.number(0.9, 1.1),
    }  # fmt: skip
    for key, value in given.items():
        if dice.chance(0.1):
            part[key] = float(f"{value:.5g}")
