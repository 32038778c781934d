"""Statements about the parts of a case that answers are made of: sections, fluids, calipers, catalogue and depths."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fctd.case.load import load_case
from fctd.hydraulics.channel import has_flow_curve
from fctd.model.depths import depths_of
from fctd.model.drillstring import lay_out
from fctd.model.fluids import Column, depth_at
from fctd.model.operations import string_load, weight_indicator
from fctd.model.section import section_of
from fctd.model.summary import summarise
from fctd.results.limits import LIMITS
from tests.equivalence.answers import ROUNDING, Answers, alike, apart, base, changed, some_kinds
from tests.equivalence.draws import Drawn
from tests.equivalence.holes import Raw
from tests.equivalence.of_strings import parts_of
from tests.equivalence.table import applies, statement

GRAVITY = 9.80665
# Share of the wall that RP 7G leaves to the strength of premium pipe.
PREMIUM = 0.8


@statement("segments laid out = their component in all")
def in_all(drawn: Drawn) -> None:
    """Mass, and compliances along and about in series, of all segments of a component."""
    string = base(drawn).laid.string
    for k, spec in enumerate(drawn.case.string.components):
        here, whole = string.origin == k, section_of(spec, drawn.case.mud.density)
        length = string.length[here]
        if not len(length):
            continue
        found = {"mass": float(string.of("mass")[here] @ length) / (whole.mass * length.sum())}
        for name in ("EA", "GJ"):
            found[name] = float((length / string.of(name)[here]).sum() * getattr(whole, name) / length.sum())
        apart(found, dict.fromkeys(found, 1.0), 1e-9, f"{spec.name}: ")


@statement("weights of fctd check = weights of the segments")
def checked_weights(drawn: Drawn) -> None:
    """Of every component in its fluids, with the bit as deep as it goes."""
    summary = summarise(drawn.case)
    string = lay_out(drawn.case, summary.bit_depth)
    for k, part in enumerate(reversed(summary.parts)):
        here = string.origin == k
        own = float(string.weight[here] @ string.length[here])
        apart({"weight": part.buoyed / part.air}, {"weight": own / part.air}, 1e-9, f"{part.name}: ")


def of_components(drawn: Drawn, what: Any) -> NDArray[np.float64]:
    """A number of the component of each row of a profile, that of the top first."""
    origin = base(drawn).laid.string.origin
    numbers = np.array([what(part) for part in drawn.case.string.components])
    return np.asarray(numbers[np.append(origin[0], origin)], float)


def worn(part: Any) -> float:
    """Outer diameter with the wall that the class of a pipe leaves to its strength [m]."""
    share = PREMIUM if part.pipe and "premium" in part.pipe else 1.0
    return float(part.inner_diameter + share * (part.outer_diameter - part.inner_diameter))


@statement("stress = its formula, and the limit's share of it")
def stresses(drawn: Drawn) -> None:
    """Tension, bending and torsion of a profile at the outer fibre of a body that pressures leave alone."""
    outer, inner = of_components(drawn, worn), of_components(drawn, lambda part: part.inner_diameter)
    strength = of_components(drawn, lambda part: part.yield_strength)
    codes = [limit.code for limit in LIMITS]
    point = base(drawn)[some_kinds(drawn)[0]]
    applies(point.answered and "inside_pressure_Pa" not in point.profile.columns)
    of = {name: point.profile[name].to_numpy(float) for name in point.profile.columns if name != "buckling"}
    second = np.pi / 64 * (outer**4 - inner**4)
    along = np.abs(of["effective_tension_N"]) / (np.pi / 4 * (outer**2 - inner**2))
    along = along + of["bending_moment_N_m"] * outer / (2 * second)
    stress = np.sqrt(along**2 + 3 * (of["torque_N_m"] * outer / (4 * second)) ** 2)
    apart({"stress": of["von_mises_Pa"] / 1e8}, {"stress": stress / 1e8}, ROUNDING)
    # The upper end of a part is a place of its own, so that the limit may find more.
    used, most = float(point.shares[codes.index("yield"), 0]), float((stress / strength).max())
    assert used >= most * (1 - ROUNDING), f"share {used:.9g} of the yield strength, of a profile {most:.9g}"


@statement("true tension = its formula")
def true_tension(drawn: Drawn) -> None:
    """Effective tension with the pressures inside and outside on their areas."""
    point = base(drawn)[some_kinds(drawn)[0]]
    applies(point.answered and "inside_pressure_Pa" in point.profile.columns)
    of = {name: point.profile[name].to_numpy(float) for name in point.profile.columns if name != "buckling"}
    outer, inner = (
        of_components(drawn, lambda part, name=name: getattr(part, name))
        for name in ("outer_diameter", "inner_diameter")
    )
    pressed = of["inside_pressure_Pa"] * inner**2 - of["outside_pressure_Pa"] * outer**2
    true = of["effective_tension_N"] + np.pi / 4 * pressed
    scale = base(drawn).weight
    apart({"true tension": of["true_tension_N"] / scale}, {"true tension": true / scale}, 1e-9)


@statement("mean pressure along a segment = mean of its pressures")
def mean_pressures(drawn: Drawn) -> None:
    """Fluids that meet within a segment press on it by the share that each has; an arc lies off its chord."""
    answers = base(drawn)
    string, hole = answers.laid.string, answers.solver.hole
    applies(string.fluids is not None)
    top, bottom = string.above_bit[:-1], string.above_bit[1:]
    depth = depth_at(hole, string.bit_depth - 0.5 * (top + bottom))
    ends = string.top_md + np.append(0.0, np.cumsum(string.length))
    turned = np.linalg.norm(np.diff(hole.at(ends)[1], axis=0), axis=1)
    bound = float((2000 * GRAVITY * string.length * turned / 8).max()) / 1e7 + 1e-4
    places = (np.arange(400) + 0.5) / 400
    for name in ("inside", "outside"):
        side: Column = getattr(string.fluids, name)
        if any(math.isfinite(start) for start in side.start):
            continue  # a plug, at which the pressure jumps
        mean = side.mean_pressure(top, bottom, depth, hole, string.bit_depth)
        at = (bottom[:, None] + places * (top - bottom)[:, None]).ravel()
        along = side.pressure(at, depth_at(hole, string.bit_depth - at), hole, string.bit_depth)
        apart({name: mean / 1e7}, {name: along.reshape(-1, 400).mean(axis=1) / 1e7}, bound)


@statement("pressure outside alone = beside a row of the mud")
def pressure_alone(drawn: Drawn) -> None:
    """A side without rows has the density of the mud, also where a case gives pressures alone."""
    applies(not drawn.has("packer_bore"))
    dice, side = drawn.dice(30), drawn.dice(31).pick(["inside", "outside"])
    pressure = dice.number(1e5, 3e6)

    def press(rows: list[Raw]) -> Answers:
        def change(raw: Raw) -> None:
            for key in ("inside", "outside", "inside_pressure", "outside_pressure"):
                raw["mud"].pop(key, None)
            raw.get("bit", {}).pop("end", None)
            raw["mud"] |= {"float": True, f"{side}_pressure": pressure} | ({side: rows} if rows else {})

        return Answers(changed(drawn, change), drawn.depth)

    alike(press([]), press([{"density": drawn.raw["mud"]["density"]}]), some_kinds(drawn, 1), ROUNDING)


@statement("catalogue pipe with other tool joints = the same written out")
def other_joints(drawn: Drawn) -> None:
    """Tool joints of the case touch and weigh, and not those of the catalogue."""
    parts = drawn.case.string.components
    applies(any(part.pipe and part.joint for part in parts))

    def write(part: Raw, spec: Any, names: tuple[str, ...]) -> Raw:
        if not (spec.pipe and spec.joint):
            return part
        wide = round(0.5 * (spec.outer_diameter + spec.joint.tool_joint_diameter), 4)
        if not names:
            return part | {"joint": {"tool_joint_diameter": wide}}
        del part["pipe"]
        joint = spec.joint.model_dump(exclude_none=True) | {"tool_joint_diameter": wide}
        return part | {name: getattr(spec, name) for name in names} | {"joint": joint}

    names = ("outer_diameter", "inner_diameter", "yield_strength")
    one, other = (
        Answers(changed(drawn, parts_of(drawn, lambda k, part, of=of: [write(part, parts[k], of)])), drawn.depth)
        for of in ((), names)
    )
    alike(one, other, some_kinds(drawn, 1), ROUNDING, loads_only=True)


@statement("reducers without friction = with next to none")
def no_friction(drawn: Drawn) -> None:
    """A factor of 0 is a factor, and not that of the hole."""
    applies(drawn.has("friction_reducers"))

    def of(factor: float) -> Answers:
        def write(_: int, part: Raw) -> list[Raw]:
            if "friction_reducers" in part:
                part["friction_reducers"]["friction"] = factor
            return [part]

        return Answers(changed(drawn, parts_of(drawn, write)), drawn.depth)

    alike(of(0.0), of(1e-9), some_kinds(drawn, 2), ROUNDING)


@statement("a tool's drop at another density = the same", slow=True)
def drop_at_density(drawn: Drawn) -> None:
    """It grows with the density of the mud."""
    applies(drawn.case.mud.eccentricity != "string")

    def with_tool(times: float) -> dict[str, Any]:
        def write(raw: Raw) -> None:
            if not has_flow_curve(drawn.case):
                raw["mud"]["viscosity"] = 0.02
            tool = {"pressure_drop": times * 1e6, "at_flow": 0.03, "at_density": times * 1100.0}
            raw["string"]["components"][-1] |= tool

        return dict(Answers(changed(drawn, write), drawn.depth).hydraulics)

    rows = with_tool(1.0), with_tool(1.3)
    applies(all(rows))
    apart(*({"drop": row["tool_drop_Pa"] / 1e7} for row in rows), ROUNDING)


@statement("joints in flow = pipe of their diameters")
def joints_in_flow(drawn: Drawn) -> None:
    """Mud flows past resolved tool joints, and through their bore, as past pipe that is as wide.

    In one fluid: where it changes within a segment the segment has the mean, and other segments are cut otherwise.
    """
    applies(drawn.has("joint") and len(drawn.raw["mud"].get("outside", ())) < 2)

    def resolve(raw: Raw) -> None:
        if drawn.raw["mud"].get("eccentricity") == "string":
            raw["mud"]["eccentricity"] = 0.3
        if not has_flow_curve(drawn.case):
            raw["mud"]["viscosity"] = 0.02
        for part in raw["string"]["components"]:
            if "joint" in part:
                part["joint_segments"] = 2
                for key in ("segments", "segment_length"):
                    part.pop(key, None)

    one = Answers(changed(drawn, resolve), drawn.depth)
    parts, string = one.case.string.components, one.laid.string

    def write(k: int, part: Raw) -> list[Raw]:
        if parts[k].joint_segments is None:
            return [part]
        joint, here = parts[k].joint, string.origin == k
        kinds = [string.parts[i].kind.value for i in string.component[here][::-1]]
        kept = {name: part[name] for name in ("name", "outer_diameter", "inner_diameter")}
        wide = {
            "outer_diameter": joint.tool_joint_diameter,
            "inner_diameter": joint.tool_joint_inner or parts[k].inner_diameter,
        }
        return [
            kept | (wide if kind == "tool joint" else {}) | {"length": length, "segments": 1, "contact": "sleeve"}
            for kind, length in zip(kinds, string.length[here][::-1].tolist(), strict=True)
        ]

    def written(raw: Raw) -> None:
        resolve(raw)
        parts_of(drawn, write)(raw)

    names = ("bore_drop_Pa", "annulus_drop_Pa", "tool_drop_Pa", "bit_drop_Pa")
    rows = one.hydraulics, Answers(changed(drawn, written), drawn.depth).hydraulics
    applies(all(rows))
    apart(*({name: row[name] / 1e7 for name in names} for row in rows), ROUNDING)


@statement("temperature below the string")
def below_string(drawn: Drawn) -> None:
    """The change is by true vertical depth: what it is deeper than the string does nothing."""
    answers = base(drawn)
    along = np.linspace(0.0, drawn.depth, 500)
    deepest = float(depth_at(answers.solver.hole, along).max()) + 1.0
    rows = [{"tvd": 0.0, "change": 5.0}, {"tvd": deepest, "change": 40.0}]
    beyond = {"tvd": deepest + 50.0, "change": 300.0}
    one, other = (
        Answers(changed(drawn, lambda raw, of=of: raw.__setitem__("temperature", of)), drawn.depth)
        for of in (rows, [*rows, beyond])
    )
    apart({"strain": one.laid.squeeze / 1e-4}, {"strain": other.laid.squeeze / 1e-4}, ROUNDING)


def measured(drawn: Drawn, diameters: int) -> Raw:
    """The hole with a caliper of so many diameters, over 40 m above its end, or that which it has already.

    Raises NotApplicableError where bow springs or cylinders take none, and where the hole is cased to its end.
    """
    hole = drawn.raw["wellbore"]
    applies(hole["geometry"] != "cylinders" and hole["intervals"][-1].get("kind") == "open")
    applies(not drawn.has("centralisers"))
    if len(hole.get("caliper", {}).get("rows", [[]])[0]) == 1 + diameters:
        return dict(hole)
    dice, total, size = drawn.dice(32), hole["stations"][-1][0], hole["intervals"][-1]["diameter"]
    rows = [
        [total - 70.0 + 20.0 * k, *(round(size * dice.number(1.01, 1.1), 5) for _ in range(diameters))]
        for k in range(3)
    ]
    reference = dice.pick(["high_side", "north"])
    return hole | {"geometry": "sampled", "cell": 0.4, "caliper": {"rows": rows, "reference": reference}}


@statement("diameters of a caliper = radii", slow=True)
def caliper_radii(drawn: Drawn) -> None:
    """Three arms or more measure diameters over half a turn: their radii are those of both ends."""
    hole = measured(drawn, 3)
    applies(hole["caliper"].get("values", "diameter") == "diameter")
    rows = [[md, *[0.5 * width for width in row] * 2] for md, *row in hole["caliper"]["rows"]]
    other = hole | {"caliper": hole["caliper"] | {"values": "radius", "rows": rows}}
    one, two = (
        Answers(changed(drawn, lambda raw, of=of: raw.__setitem__("wellbore", of)), drawn.depth) for of in (hole, other)
    )
    alike(one, two, some_kinds(drawn, 2), ROUNDING)


@statement("an interval that a caliper measured = the same in two", slow=True)
def split_measured(drawn: Drawn) -> None:
    """Cells run on where a case writes open hole in two pieces of one size."""
    hole = measured(drawn, 3)
    rows, md = hole["intervals"], [row[0] for row in hole["caliper"]["rows"]]
    end = round(0.5 * (md[0] + md[1]) + 1.037, 3)
    applies(not rows[:-1] or rows[-2]["to_md"] < end)
    other = hole | {"intervals": [*rows[:-1], rows[-1] | {"to_md": end}, rows[-1]]}
    one, two = (
        Answers(changed(drawn, lambda raw, of=of: raw.__setitem__("wellbore", of)), drawn.depth) for of in (hole, other)
    )
    alike(one, two, some_kinds(drawn, 2), ROUNDING, loads_only=True)


@statement("a vertical first station = none")
def first_station(drawn: Drawn) -> None:
    """A hole begins vertical at the table, with the azimuth of its first station; angles are interpolated."""
    rows = [row for row in drawn.raw["wellbore"]["stations"] if row[1] > 0]
    applies(len(rows) > 1 and rows[0][0] > 0)

    def of(stations: list[Any]) -> Answers:
        def write(raw: Raw) -> None:
            hole = raw["wellbore"]
            for key in ("survey_smoothing", "tortuosity", "caliper", "cell"):
                hole.pop(key, None)
            hole |= {"geometry": "cylinders", "survey_method": "average_angle", "stations": stations}

        return Answers(changed(drawn, write), drawn.depth)

    alike(of([[0.0, 0.0, rows[0][2]], *rows]), of(rows), some_kinds(drawn, 2), ROUNDING)


@statement("shoe = the deepest end of casing")
def last_shoe(drawn: Drawn) -> None:
    """The word stands for the last of several shoes."""
    rows = drawn.raw["wellbore"]["intervals"]
    applies(len(rows) > 1)
    end = rows[0]["to_md"]

    def split(raw: Raw) -> None:
        raw["wellbore"]["intervals"].insert(0, rows[0] | {"to_md": 0.5 * end})

    found = depths_of("shoe", changed(drawn, split), "bit_depths")
    assert found == [end], f"shoe at {found[0]:.9g}, not {end:.9g}"


@statement("weight indicator there and back")
def indicator(drawn: Drawn) -> None:
    """The string's load is that of which the rig reads the indicator."""
    load = base(drawn).weight
    for way in (-1, 0, 1):
        back = string_load(drawn.case.rig, way, weight_indicator(drawn.case.rig, way, load))
        apart({"load": back / load}, {"load": 1.0}, 1e-9, f"direction {way}: ")


@statement("factors of a kind leave the other's alone")
def other_kind(drawn: Drawn) -> None:
    """A choice by kind keeps both factors of the kinds that it does not name."""
    from fctd.case.load import with_friction

    rows = drawn.raw["wellbore"]["intervals"]
    applies(len(rows) > 1)

    def pair(raw: Raw) -> None:
        raw["wellbore"]["intervals"][1] |= {"friction": 0.21, "rotational_friction": 0.34}
        raw["wellbore"]["intervals"][1].pop("static_friction", None)

    case = changed(drawn, pair)
    for chosen in (
        with_friction(case, {"cased": 0.17}),
        load_case(case.model_dump(exclude_none=True), {"friction": {"cased": 0.17}}),
    ):
        kept = chosen.wellbore.intervals[1]
        assert (kept.friction, kept.friction_around) == (0.21, 0.34), f"{kept.friction}/{kept.friction_around}"
