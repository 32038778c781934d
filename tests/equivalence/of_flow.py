"""Statements about fluids: pressures on the string and its packer, drag, losses, and a caliper in a file."""

import math
import tempfile
from pathlib import Path

import numpy as np

from fctd.calibration.forward import Forward
from fctd.calibration.rows import Row as MeasuredRow
from fctd.calibration.setup import Setup, UnknownSpec
from fctd.calibration.unknowns import find_unknowns
from fctd.case.load import Case, load_case
from fctd.hydraulics.channel import has_flow_curve
from fctd.model.fluids import depth_at
from fctd.model.operations import SteadyRates, steady_rates
from fctd.model.section import section_of
from fctd.results.limits import LIMITS
from fctd.steady.batch import Row, solve_batch
from fctd.steady.laws import hole_of
from fctd.steady.problem import Workspace
from tests.equivalence.answers import FLOW, ROUNDING, Answers, alike, apart, base, changed, plain, some_kinds
from tests.equivalence.draws import Drawn
from tests.equivalence.holes import Raw
from tests.equivalence.of_parts import GRAVITY, measured
from tests.equivalence.table import applies, statement

FLUIDS = ("inside", "outside", "inside_pressure", "outside_pressure", "float", "packer_bore", "cake")
CURVES = ("viscosity", "rheology", "fann", "eccentricity", "axial_damping", "rotational_damping")


def in_mud(drawn: Drawn, mud: Raw, bit: Raw | None = None, without: tuple[str, ...] = FLUIDS) -> Case:
    """The drawn case without operations, in other fluids: some keys of its mud and bit are others."""

    def change(raw: Raw) -> None:
        raw["mud"] = {key: value for key, value in raw["mud"].items() if key not in without} | mud
        raw["bit"] = {key: value for key, value in raw.get("bit", {}).items() if key != "end"} | (bit or {})
        raw["operations"] = []
        for row in raw["wellbore"]["intervals"]:
            row.pop("overbalance", None)

    return changed(drawn, change)


@statement("burst and collapse = excess pressure over what the body bears")
def excess_pressures(drawn: Drawn) -> None:
    """Of mud at rest as of mud that flows: the share of a limit is at least that of a profile's rows."""
    dice = drawn.dice(60)
    side = dice.pick(["inside", "outside"])
    case = in_mud(drawn, {"float": True, f"{side}_pressure": dice.number(2e6, 9e6)}, without=(*FLUIDS, *CURVES))
    answers = Answers(case, drawn.depth)
    point = answers[some_kinds(drawn)[0]]
    applies(point.answered)
    of, code = point.profile, {"inside": "burst", "outside": "collapse"}[side]
    excess = (of["inside_pressure_Pa"] - of["outside_pressure_Pa"]).to_numpy(float) * {"inside": 1, "outside": -1}[side]
    bears = answers.laid.string.of(code)
    most = float((excess / np.append(bears[0], bears)).max())
    used = float(point.shares[[limit.code for limit in LIMITS].index(code), 0])
    assert used >= most * (1 - ROUNDING) > 0, f"{code}: share {used:.9g}, of a profile {most:.9g}"


@statement("pressures of a profile = weights of their columns")
def columns_weigh(drawn: Drawn) -> None:
    """Of fluids at rest: the density of the row at each depth, from the surface downwards.

    A string is longer than its tally by its stretch, and its contact points lie beside the axis.
    """
    dice, kind = drawn.dice(67), some_kinds(drawn)[0]
    mud: Raw = {"float": True}
    for side, lower in (("inside", 1500.0), ("outside", 1650.0)):
        met = round(dice.number(0.2, 0.9) * drawn.depth, 1)
        mud[side] = [{"to_md": met, "density": 1000.0}, {"density": lower}]
        mud[f"{side}_pressure"] = dice.number(1e5, 1e6)
    answers = Answers(in_mud(drawn, mud, without=(*FLUIDS, *CURVES)), drawn.depth)
    applies(answers[kind].answered)
    profile, hole = answers[kind].profile, answers.solver.hole
    md = profile["md_m"].to_numpy(float)
    tvd = depth_at(hole, md)
    for side in ("inside", "outside"):
        met, (above, below) = mud[side][0]["to_md"], (row["density"] for row in mud[side])
        deep = float(depth_at(hole, np.array([met]))[0])
        weight = np.where(md < met, above * tvd, above * deep + below * (tvd - deep))
        clear = np.abs(md - met) > 2.0
        found = mud[f"{side}_pressure"] + GRAVITY * weight
        shown = profile[f"{side}_pressure_Pa"].to_numpy(float)
        apart({side: shown[clear] / 1e7}, {side: found[clear] / 1e7}, 8e-4)


@statement("push on a packer = as much weight on bit", slow=True)
def packer_push(drawn: Drawn) -> None:
    """An open end in a seal bore is pushed up by the difference of pressures on the area of the bore."""
    dice, weight = drawn.dice(61), drawn.raw.get("bit", {}).get("weight_on_bit", 0.0)
    bore, pressure = dice.number(0.06, 0.12), dice.number(1e5, 2e6)
    push, bare = math.pi / 4 * bore**2 * pressure, (*FLUIDS, *CURVES)
    packed = in_mud(drawn, {"packer_bore": bore, "inside_pressure": pressure}, without=bare)
    pressed = in_mud(
        drawn, {"float": True, "inside_pressure": pressure}, {"weight_on_bit": weight + push}, without=bare
    )
    one, other = (Answers(case, drawn.depth)["drill_sliding"] for case in (packed, pressed))
    applies(plain(one) and plain(other))
    loads = [{"hook load": of.hookload, "contact force": of.total_contact_force} for of in (one, other)]
    apart(*({name: load / base(drawn).weight for name, load in of.items()} for of in loads), ROUNDING)


@statement("a damping along the string = in place of the mud's drag", slow=True)
def given_damping(drawn: Drawn) -> None:
    """Of a trip, pumps off: the mud that it displaces drags by the damping alone."""
    damping = {"axial_damping": drawn.dice(62).number(1, 8)}
    bare = (*FLUIDS, *CURVES)
    alone, beside = in_mud(drawn, damping, without=bare), in_mud(drawn, damping | {"viscosity": 0.02}, without=bare)
    one, other = Answers(alone, drawn.depth), Answers(beside, drawn.depth)
    alike(one, other, ("trip_in", "trip_out"), ROUNDING, loads_only=True)


@statement("flow squeezes steel by its pressures")
def squeezed(drawn: Drawn) -> None:
    """What flow adds to the strain is (1 - 2ν)(p_o A_o - p_i A_i)/(E A_s), of its pressures halfway along a segment."""
    applies(not drawn.has("plug", "packer_bore") and drawn.case.end != "closed" and has_flow_curve(drawn.case))
    laid = base(drawn).laid
    flowing = laid.in_flow(SteadyRates(0.0, 1.0, FLOW))
    string, circuit = laid.string, flowing.circuit
    spec = [drawn.case.string.components[k] for k in string.origin]
    inside, outside = (0.5 * (side[1:] + side[:-1]) for side in (circuit.inside, circuit.outside))
    bore, body = (np.array([getattr(one, f"{name}_diameter") ** 2 for one in spec]) for name in ("inner", "outer"))
    stiff = np.array([(1 - 2 * one.poisson_ratio) / one.youngs_modulus for one in spec])
    strain = stiff * (outside * body - inside * bore) / (body - bore)
    apart({"strain": (flowing.squeeze - laid.squeeze) / 1e-4}, {"strain": strain / 1e-4}, ROUNDING)


@statement("bore's loss = of the fluid inside alone", slow=True)
def inside_alone(drawn: Drawn) -> None:
    """Bore, tools and nozzles lose what they do in a well full of the fluid that is inside."""
    applies(drawn.case.mud.eccentricity != "string")
    density, curve = drawn.dice(63).number(1000, 1200), {} if has_flow_curve(drawn.case) else {"viscosity": 0.02}
    outside = {"float": True, "outside": [{"density": density + 150.0}], "density": density}
    rows = [Answers(in_mud(drawn, mud | curve), drawn.depth).hydraulics for mud in (outside, {"density": density})]
    applies(all(rows))
    names = ("bore_drop_Pa", "tool_drop_Pa", "bit_drop_Pa", "impact_force_N")
    apart(*({name: row[name] / 1e6 for name in names} for row in rows), ROUNDING)


@statement("shallow strings beside deep ones = alone")
def shallow_beside_deep(drawn: Drawn) -> None:
    """First attempts of a batch, of which the shallow strings have fewer components, to the bit."""
    kind, solver = some_kinds(drawn)[0], base(drawn).solver
    top, rates = drawn.case.string.top_md, steady_rates(drawn.case, some_kinds(drawn)[0])
    depths = [round(top + share * (drawn.depth - top), 3) for share in (0.04, 0.3)] + [drawn.depth]
    rows = [Row(solver.lay_out(depth), 0, kind, rates) for depth in depths]
    hole, work = hole_of(drawn.case, [solver.hole]), Workspace(max(row.laid.string.segments for row in rows))
    together = solve_batch(drawn.case, hole, rows, work)
    for depth, row, answer in zip(depths, rows, together, strict=True):
        alone = solve_batch(drawn.case, hole, [row], work)[0]
        assert np.array_equal(answer.numbers, alone.numbers, equal_nan=True), f"{kind} at {depth:.9g} m"


@statement("calibrate at another mass = equilibrium with that mass", slow=True)
def other_mass(drawn: Drawn) -> None:
    """Of pipe between unlike fluids, whose mass is an unknown."""
    density = drawn.dice(65).number(1000, 1200)
    unlike = {"float": True, "density": density, "outside": [{"density": density + 150.0}]}
    case = in_mud(drawn, unlike, {"overpull": 0.0})
    part, kind = case.string.components[-1], drawn.dice(66).pick(["trip_out", "trip_in"])
    applies([one.name for one in case.string.components].count(part.name) == 1)
    mass = 1.04 * section_of(part, density).mass
    setup, name = Setup(), f"mass.{part.name}"
    rows = [MeasuredRow(kind, "", drawn.depth, kind, steady_rates(case, kind))]
    found = Forward(rows, {"": case}, find_unknowns({name: UnknownSpec()}, setup, [case]), setup)
    last = f"string.components[{len(case.string.components) - 1}].linear_mass"
    own = Answers(load_case(case.model_dump(exclude_none=True), {last: mass}), drawn.depth)[kind]
    applies(plain(own))
    read = {
        load.load: value for load, value in zip(found.readings, found.evaluate(np.array([mass])).value, strict=True)
    }
    weight = base(drawn).weight
    apart({"indicator": own.weight_indicator / weight}, {"indicator": float(read["hookload"]) / weight}, ROUNDING)


@statement("rows of a caliper = its file", slow=True)
def caliper_file(drawn: Drawn) -> None:
    """A text in columns, whose orientation of the first arm is added to that of the case."""
    hole = measured(drawn, 3)
    table, turned = hole["caliper"], drawn.dice(64).whole(20, 100)
    own = table.get("first_arm", 0.0)
    rows = {"caliper": table | {"first_arm": own + math.radians(turned)}}
    with tempfile.TemporaryDirectory(prefix="fctd-equivalence-") as name:
        file = Path(name) / "caliper.csv"
        lines = [",".join(["md_m", "orientation_deg", *(f"arm{k}_m" for k in range(1, 4))])]
        lines += [",".join(map(repr, [md, turned, *row])) for md, *row in table["rows"]]
        file.write_text("\n".join([*lines, ""]))
        log = {"caliper": {key: value for key, value in table.items() if key != "rows"} | {"log": str(file)}}
        one, other = (Answers(load_case({**drawn.raw, "wellbore": hole | of}), drawn.depth) for of in (rows, log))
        alike(one, other, some_kinds(drawn), ROUNDING)
