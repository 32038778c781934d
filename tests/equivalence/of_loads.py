"""Statements about friction, fluids, rig and bit."""

import math

import numpy as np

from fctd.case.operations import KINDS
from fctd.hydraulics.channel import has_flow_curve
from tests.equivalence.answers import EXACT, ROUNDING, Answers, apart, base, changed, plain, same
from tests.equivalence.draws import Drawn
from tests.equivalence.holes import Raw
from tests.equivalence.table import applies, statement

# Columns of a profile that a case without fluids by depth leaves out.
PRESSURES = ("profile inside_pressure_Pa", "profile outside_pressure_Pa")


@statement("pair with equal factors = one factor")
def equal_pair(drawn: Drawn) -> None:
    """An ellipse of friction with equal half axes is a circle."""
    applies(not drawn.has("rotational_friction"))

    def pair(raw: Raw) -> None:
        for row in raw["wellbore"]["intervals"]:
            row["rotational_friction"] = row["friction"]

    same(drawn, changed(drawn, pair), ROUNDING)


@statement("friction 0 = the weight along the hole within O(h²)")
def frictionless(drawn: Drawn) -> None:
    """Virtual work: without friction the hook carries the weight times the height that a metre along the hole lifts it,
    less what the flow carries.

    Chords of segments of h [m] in a curvature κ are short by (hκ)²/24, and lie off the axis by h²κ/8 or the clearance;
    at its ends the string takes in and leaves its bending energy, EI κ²/2 a metre.  Among cylinders of ℓ each segment
    is lifted as its cylinder leads, up to half a kink, κℓ/2, off the direction of the hole.
    """
    applies(not drawn.has("axial_damping", "caliper", "centralisers", "packer_bore", "tortuosity", "swivel"))

    def smooth(raw: Raw) -> None:
        for row in raw["wellbore"]["intervals"]:
            row["friction"] = 0.0
            for key in ("rotational_friction", "static_friction", "decay_speed"):
                row.pop(key, None)
        for part in raw["string"]["components"]:
            part.get("friction_reducers", {}).update({"friction": 0.0} if "friction_reducers" in part else {})

    answers = Answers(changed(drawn, smooth), drawn.depth)
    string, hole, bit = answers.laid.string, answers.solver.hole, answers.case.bit
    ends = string.top_md + np.append(0.0, np.cumsum(string.length))
    turned = np.linalg.norm(np.diff(hole.at(ends)[1], axis=0), axis=1)
    weight = string.weights[0]
    lifted = float(weight @ np.diff(hole.at(ends)[0][:, 2]))
    # Of each segment its chord, and its place in the clearance, which turns with the hole.
    bound = float(np.abs(weight) @ (string.length * turned**2 / 24 + 0.15 * turned)) + 1e-6 * answers.weight
    bound = 2 * (bound + float(0.5 * string.of("EI").max() * (turned / string.length).max() ** 2))
    spec = answers.case.wellbore
    if spec.geometry == "cylinders":
        curvature = turned / string.length
        kink = (
            curvature * spec.cylinder_length if spec.cylinder_length else np.sqrt(8 * spec.chord_tolerance * curvature)
        )
        bound += float(np.abs(weight) @ (0.5 * kink * string.length))
    compared = 0
    for kind in KINDS:
        point, of = answers[kind], KINDS[kind]
        if not plain(point):
            continue
        compared += 1
        pushed = bit.weight_on_bit if of.on_bottom else -bit.overpull if of.direction < 0 else 0.0
        expected = lifted - pushed - point.lift
        short = abs(point.hookload - expected)
        allowed = bound + float(turned.max()) ** 2 * abs(pushed)
        assert short <= allowed, f"{kind}: hook load {point.hookload:.7g}, {expected:.7g} (bound {allowed:.3g})"
        if has_flow_curve(answers.case) or drawn.has("rotational_damping"):
            continue  # mud brakes a string that turns
        torque = bit.torque if of.on_bottom else 0.0
        slack = 1e-3 * torque + 2 * bend_of(drawn) + 1e-6 * answers.weight * 0.1
        assert abs(point.surface_torque - torque) <= slack, (
            f"{kind}: torque {point.surface_torque:.5g}, not {torque:.5g}"
        )
    applies(compared)


def bend_of(drawn: Drawn) -> float:
    """What a bent housing may hold without friction [N m]: one toolface is not a turn's mean."""
    return 5e3 if drawn.has("bend") else 0.0


@statement("two equal fluids = one")
def equal_fluids(drawn: Drawn) -> None:
    """Rows inside and outside with the density of the mud, split anywhere, weigh and press as the mud does."""
    applies(not drawn.has("inside", "outside", "inside_pressure", "outside_pressure", "packer_bore"))
    dice, density = drawn.dice(7), drawn.raw["mud"]["density"]

    def split(raw: Raw) -> None:
        for side in dice.pick([("inside",), ("outside",), ("inside", "outside")]):
            met = round(dice.number(0.1, 0.6) * drawn.depth, 1)
            raw["mud"][side] = [{"to_md": met, "density": density}, {"density": density}]

    same(drawn, changed(drawn, split), ROUNDING, but=PRESSURES)


@statement("a fluid = the same in two rows")
def split_fluid(drawn: Drawn) -> None:
    """Where a row of a fluid by depth is written twice, nothing meets."""
    sides = [side for side in ("inside", "outside") if side in drawn.raw["mud"]]
    applies(sides)
    dice = drawn.dice(8)

    def split(raw: Raw) -> None:
        for side in sides:
            rows = raw["mud"][side]
            upper = {key: value for key, value in rows[0].items() if key != "plug"}
            rows.insert(0, upper | {"to_md": dice.number(0.1, 0.9) * rows[0]["to_md"]})

    same(drawn, changed(drawn, split), ROUNDING)


@statement("a float of the mud = a float of the bit")
def float_of_bit(drawn: Drawn) -> None:
    """Two keys for one valve."""
    applies(drawn.raw["mud"].get("float"))

    def move(raw: Raw) -> None:
        raw["mud"].pop("float")
        raw["bit"] = raw.get("bit", {}) | {"end": "float"}

    same(drawn, changed(drawn, move), EXACT)


@statement("nozzles = their area")
def nozzle_area(drawn: Drawn) -> None:
    """The sum of their circles."""
    applies(drawn.has("nozzles"))

    def add(raw: Raw) -> None:
        raw["bit"]["flow_area"] = sum(math.pi / 4 * size**2 for size in raw["bit"].pop("nozzles"))

    same(drawn, changed(drawn, add), ROUNDING)


@statement("a flow curve = the same in other parameters")
def flow_curves(drawn: Drawn) -> None:
    """A Newtonian mud is a Bingham mud without yield point, this one of Herschel & Bulkley with the index 1."""
    mud = drawn.raw["mud"]
    dice = drawn.dice(9)
    applies("viscosity" in mud or "plastic_viscosity" in mud.get("rheology", {}))

    def rewrite(raw: Raw) -> None:
        table = raw["mud"]
        if "viscosity" in table:
            table["rheology"] = {"plastic_viscosity": table.pop("viscosity"), "yield_point": 0.0}
        if dice.chance(0.6):
            old = table["rheology"]
            new = {"consistency": old["plastic_viscosity"], "index": 1.0, "yield_stress": old["yield_point"]}
            table["rheology"] = new

    same(drawn, changed(drawn, rewrite), ROUNDING)


@statement("temperature = the same with a row between")
def temperature_row(drawn: Drawn) -> None:
    """The change is linear between the rows."""
    applies(drawn.has("tvd", "temperature") and "temperature" in drawn.raw)

    def between(raw: Raw) -> None:
        upper, lower = raw["temperature"]
        middle = {key: 0.4 * upper[key] + 0.6 * lower[key] for key in upper}
        raw["temperature"] = [upper, middle, lower, lower | {"tvd": lower["tvd"] + 500.0}]

    same(drawn, changed(drawn, between), ROUNDING)


@statement("datum moved, and what acts in time alone")
def in_time_alone(drawn: Drawn) -> None:
    """The datum, the drive, stands and control, the rock, a mass off the axis, steps and what is recorded."""
    dice = drawn.dice(10)
    in_time = ("feed", "stand_length", "connection_time", "derrick_height", "drive", "control", "autodriller")

    def strip(raw: Raw) -> None:
        raw["datum"] = dice.pick([{}, {"elevation": 333.0}, {"air_gap": 20.0, "water_depth": 90.0}])
        for key in in_time:
            raw.get("rig", {}).pop(key, None)
        for key in ("rock", "motor"):
            raw.get("bit", {}).pop(key, None)
        for key in ("step", "joint_damping", "shape_damping", "loss_factor"):
            raw.get("solver", {}).pop(key, None)
        for part in raw["string"]["components"]:
            part.pop("eccentricity", None)
        raw.get("mud", {}).pop("cake", None)
        for row in raw["wellbore"]["intervals"]:
            row.pop("overbalance", None)
        raw["record"] = {}
        raw["contact"] = {**raw.get("contact", {}), "damping": 1.3e5}

    same(drawn, changed(drawn, strip), EXACT)


@statement("surface lines added")
def surface_lines(drawn: Drawn) -> None:
    """They take pressure of the pumps, and no load of the string."""

    def add(raw: Raw) -> None:
        raw["rig"] = raw.get("rig", {}) | {"surface_length": 77.0, "surface_bore": 0.08}

    case = changed(drawn, add)
    same(drawn, case, EXACT, loads_only=True)
    other, own = Answers(case, drawn.depth).hydraulics, base(drawn).hydraulics
    if own:
        above = [row["standpipe_Pa"] - row["surface_drop_Pa"] for row in (own, other)]
        apart({"bore to annulus": above[0] / 1e7}, {"bore to annulus": above[1] / 1e7}, ROUNDING)


@statement("the rig's readings by their formulas")
def rig_readings(drawn: Drawn) -> None:
    """Sheaves, guides and block; the drive's offset and its torque by rotation."""
    answers, rig = base(drawn), drawn.raw.get("rig", {})
    for kind, of in KINDS.items():
        point = answers[kind]
        if not point.answered:
            continue
        hangs = point.hookload + rig.get("block_weight", 0.0) - of.direction * rig.get("guide_friction", 0.0)
        read = hangs / rig.get("sheave_efficiency", 1.0) ** of.direction
        rotation = answers.solver.case.operations
        turns = next((o.rpm for o in rotation if o.kind == kind), of.default_rpm)
        torque = point.surface_torque + rig.get("torque_offset", 0.0) + turns * rig.get("torque_per_rpm", 0.0)
        scale = answers.weight
        apart({"indicator": point.weight_indicator / scale, "drive": point.drive_torque / scale},
              {"indicator": read / scale, "drive": torque / scale}, 1e-12, f"{kind}: ")  # fmt: skip


@statement("limits asked for change no load")
def limits_apart(drawn: Drawn) -> None:
    """A design factor scales what may be used; loads stay."""

    def ask(raw: Raw) -> None:
        raw["limits"] = {"design_factor": 1.7, "torque_share": 0.5, "overpull_margin": 4e5}
        raw["rig"] = raw.get("rig", {}) | {"hoist_capacity": 3e5, "largest_torque": 9e3, "slip_length": 0.35}

    same(drawn, changed(drawn, ask), EXACT, loads_only=True)
