"""Drawn holes: their paths, sizes, walls and calipers."""

from itertools import pairwise
from typing import Any, NamedTuple

from tests.equivalence.dice import Dice

INCH = 0.0254
Raw = dict[str, Any]


class Size(NamedTuple):
    """A size of hole: the open hole, the bore of the casing above it [in], and the casing's name in the catalogue."""

    open_hole: float
    cased: float
    casing: str


SIZES = (
    Size(12.25, 12.415, "13 3/8 in 68 L-80"),
    Size(8.5, 8.681, "9 5/8 in 47 N-80"),
    Size(8.5, 8.835, "9 5/8 in 40 N-80"),
    Size(6.0, 6.184, "7 in 29 P-110"),
)


def path(dice: Dice) -> list[list[float]]:
    """Stations of a well that can be drilled: corners alone, or one each 30 m or so."""
    total = dice.number(500, 1300, 3)
    kick = round(dice.number(0.15, 0.4) * total)
    built = round(dice.number(0.55, 0.75) * total)
    steep = min(dice.number(5, 92, 3), 0.12 * (built - kick))  # at most 3.6 degrees a joint of 30 m
    azimuth = dice.number(0, 359, 3)
    turn = dice.pick([0.0, 0.0, dice.number(-20, 20, 3)])
    shape = dice.pick(["build", "build", "drop", "straight", "vertical"])
    if shape == "vertical":
        corners = [[0.0, 0.0, azimuth], [total, 0.0, azimuth]]
    elif shape == "straight":
        tilt = dice.number(3, 50, 3)
        corners = [[0.0, tilt, azimuth], [total, tilt, azimuth]]
    else:
        dropped = steep * dice.number(0.4, 0.9) if shape == "drop" else steep
        corners = [
            [0.0, 0.0, azimuth], [kick, 0.0, azimuth], [built, steep, azimuth], [total, dropped, azimuth + turn],
        ]  # fmt: skip
    if dice.chance(0.4):
        return corners
    apart = dice.number(9, 60, 2)
    stations = [corners[0]]
    for above, below in pairwise(corners):
        count = max(round((below[0] - above[0]) / apart), 1)
        for k in range(1, count + 1):
            share = k / count
            stations.append([round(a + share * (b - a), 4) for a, b in zip(above, below, strict=True)])
    return stations


def wellbore(dice: Dice, size: Size, stations: list[list[float]]) -> Raw:
    """The table of the hole."""
    total = stations[-1][0]
    geometry = dice.pick(["arcs", "arcs", "cylinders", "cylinders", "sampled"])
    hole: Raw = {"stations": stations, "geometry": geometry, "intervals": intervals(dice, size, total)}
    if geometry == "cylinders":
        hole |= dice.pick([{}, {"chord_tolerance": dice.number(0.0005, 0.004)}, {"cylinder_length": dice.number(2, 8)}])
        if dice.chance(0.2):
            hole["survey_method"] = "average_angle"
    if dice.chance(0.3):
        hole["overlap"] = dice.number(0.05, 0.6)
    if dice.chance(0.4):
        hole["stiffness_per_length"] = dice.number(1e6, 2e7, 2)
    elif dice.chance(0.3):
        hole["stiffness"] = dice.number(5e6, 1e8, 2)
    if dice.chance(0.3):
        key = "stiffness_per_length" if "stiffness_per_length" in hole else "stiffness"
        dice.pick(hole["intervals"])[key] = dice.number(5e6, 5e7, 2)
    if dice.chance(0.1) and "survey_method" not in hole:
        wavelength = dice.number(300, 450, 3)  # of which segments of 40 m are an eighth
        hole["tortuosity"] = {
            "wavelength": wavelength,
            "amplitude": dice.number(0.002, 0.05),
            "seed": dice.whole(0, 99),
        }
    if dice.chance(0.1):
        hole["survey_smoothing"] = dice.number(0.0005, 0.003)
    if geometry == "sampled":
        if dice.chance(0.8):
            hole["caliper"] = caliper(dice, size, total)
        if dice.chance(0.3):
            hole["cell"] = dice.number(0.15, 0.4, 2)
    if dice.chance(0.3):
        pore = dice.number(1000, 1250)
        hole["window"] = [
            {"tvd": 0.0, "pore": pore, "fracture": pore + dice.number(200, 700)},
            {
                "tvd": dice.number(200, 900),
                "pore": pore + dice.number(0, 200),
                "fracture": pore + dice.number(500, 900),
            },
        ]
    return hole


def intervals(dice: Dice, size: Size, total: float) -> list[Raw]:
    """Cased hole above open hole, or one interval of either."""
    shoe = round(dice.number(0.3, 0.8) * total, 1)
    casing: Raw = {"to_md": shoe, "diameter": size.cased * INCH, "kind": "cased"}
    bottom: Raw = {"to_md": total, "diameter": size.open_hole * INCH, "kind": "open"}
    rows = dice.pick([[casing, bottom], [casing, bottom], [bottom], [casing | {"to_md": total}]])
    if rows[0]["kind"] == "cased" and dice.chance(0.3):
        rows[0] = {"to_md": rows[0]["to_md"], "casing": size.casing}
    elif rows[0]["kind"] == "cased" and dice.chance(0.3):
        rows[0] |= {"outer_diameter": (size.cased + 1.0) * INCH, "yield_strength": dice.pick(["N-80", 5.5e8])}
    smooth = dice.chance(0.05)
    for k, row in enumerate(rows):
        row["friction"] = 0.0 if smooth else dice.number(0.08, 0.45, 2)
        if not smooth and dice.chance(0.25):
            row["rotational_friction"] = dice.number(0.08, 0.45, 2)
        if dice.chance(0.2):
            row["name"] = f"section {k}"
    return rows


def caliper(dice: Dice, size: Size, total: float) -> Raw:
    """Rows of one to six arms, mostly a little wider than the bit."""
    arms, count = dice.pick([1, 1, 2, 3, 4, 6]), dice.whole(3, 9)
    top = dice.number(0.5, 0.9) * total
    values = dice.pick(["diameter", "radius"])
    scale = size.open_hole * INCH * (1.0 if values == "diameter" else 0.5)
    apart = min(dice.number(60, 180), total - top) / count
    table: Raw = {
        "rows": [
            [round(top + k * apart, 2), *(round(scale * dice.number(1.005, 1.12), 5) for _ in range(arms))]
            for k in range(count)
        ],
        "values": values,
    }
    if arms > 1:
        table["reference"] = dice.pick(["high_side", "north"])
        if dice.chance(0.5):
            table["first_arm"] = dice.number(0, 3)
    return table
