"""Statements about other answers than a row: limits, jar, free point, wear, flow, surge, sweep, monitor, tables."""

import math
from typing import Any

import numpy as np
import pandas as pd

import fctd
from fctd.case.load import load_case
from fctd.hydraulics.channel import has_flow_curve
from fctd.hydraulics.pressures import circulation, hydraulics_of
from fctd.hydraulics.surge import fastest_trips, surge_pressures
from fctd.model.fluids import depth_at
from fctd.model.operations import rates_of_all
from fctd.monitoring.chart import FACTORS, Chart
from fctd.report.answers import Asked, answer
from fctd.results.unit_systems import in_field_units
from fctd.steady.equilibrium import equilibrium, lie_along
from fctd.steady.free_point import free_point
from fctd.steady.jar import jar_forces
from fctd.steady.margin_table import limits_of
from fctd.steady.torque_drag import chart_rows
from fctd.steady.wear import casing_wear
from fctd.sweep.design import sample_of
from fctd.sweep.run import prepare
from fctd.sweep.spec import read_sweep
from tests.equivalence.answers import ARM, EXACT, FLOW, ROUNDING, Answers, apart, base, changed, plain, some_kinds
from tests.equivalence.draws import Drawn
from tests.equivalence.holes import INCH, Raw
from tests.equivalence.of_files import assert_rows, command, folder_of
from tests.equivalence.of_parts import GRAVITY
from tests.equivalence.rigs import flow_of
from tests.equivalence.table import applies, statement
from tests.equivalence.ways_in import assert_equal

FOOT, POUND = 0.3048, 0.45359237 * 9.80665
GALLON = 231 * INCH**3
# How many SI units a unit at the end of a column's name is, the longer ends first.
OF_FIELD = {
    "_kft_lbf": 1e3 * FOOT * POUND, "_ft_lbf": FOOT * POUND, "_lbf_ft": POUND / FOOT, "_klbf": 1e3 * POUND,
    "_lbf": POUND, "_ft_min": FOOT / 60, "_ft_s": FOOT, "_ft_h": FOOT / 3600, "_ft": FOOT, "_in": INCH,
    "_ksi": 1e3 * POUND / INCH**2, "_psi": POUND / INCH**2, "_gpm": GALLON / 60, "_ppg": 0.45359237 / GALLON,
    "_in2": INCH**2, "_hp": 550 * FOOT * POUND,
}  # fmt: skip
# The load of a limit is found within 2e-3 of it, or exactly.
AT_LIMIT = 5e-3
# Cubics between the factors of a chart; of the weight, and of the weight times ``ARM``.
BETWEEN_FACTORS = 5e-3


def assert_same_rows(one: pd.DataFrame, other: pd.DataFrame, within: float, but: tuple[str, ...] = ()) -> None:
    """Raise AssertionError unless two tables have the same rows, numbers within a share of their largest."""
    assert list(one.columns) == list(other.columns), f"columns {sorted(set(one.columns) ^ set(other.columns))}"
    assert len(one) == len(other), f"{len(one)} and {len(other)} rows"
    for name in one.columns:
        mine, others = one[name], other[name]
        if name in but:
            continue
        if mine.dtype.kind not in "fiu":
            assert list(mine) == list(others), f"{name}: {list(mine)[:3]} and {list(others)[:3]}"
            continue
        a, b = mine.to_numpy(float), others.to_numpy(float)
        scale = max(float(np.nanmax(np.abs(a), initial=0.0)), 1e-300) if np.isfinite(a).any() else 1.0
        apart({name: a / scale}, {name: b / scale}, within)


@statement("a table in field units = the same in SI", slow=True)
def field_table(drawn: Drawn) -> None:
    """Every column by the unit at the end of its name; a profile has lengths across the hole, too."""
    point = base(drawn)[some_kinds(drawn)[0]]
    applies(point.answered)
    chart = fctd.chart(drawn.case, some_kinds(drawn)[0], drawn.depth, threads=1, units="si")
    pairs = [(chart.rows, chart.to_units("field").table), (point.profile, in_field_units(point.profile))]
    for metric, field in pairs:
        for old, new in zip(metric.columns, field.columns, strict=True):
            if old == new:
                continue
            factor = next((one for end, one in OF_FIELD.items() if new.endswith(end)), math.nan)
            a, b = metric[old].to_numpy(float), factor * field[new].to_numpy(float)
            scale = max(float(np.nanmax(np.abs(a), initial=0.0)), 1e-300) if np.isfinite(a).any() else 1.0
            apart({f"{old} as {new}": a / scale}, {f"{old} as {new}": b / scale}, 1e-9)


@statement("fctd.chart = rows of a chart with its rates", slow=True)
def public_chart(drawn: Drawn) -> None:
    """The public function passes on speed, rotation and flow; a trip beside what turns does not turn."""
    dice = drawn.dice(40)
    shut = drawn.case.end == "closed" or drawn.has("plug")
    rates: dict[str, Any] = {"rpm": dice.whole(30, 120), "speed": dice.number(0.05, 0.4), "flow": 0.0 if shut else FLOW}
    kinds = ["trip_out", dice.pick(["back_ream", "ream_in"])]
    found = fctd.chart(drawn.case, kinds, drawn.depth, **rates, threads=1).rows
    turning = chart_rows(drawn.case, kinds[1], drawn.depth, **rates, threads=1)
    applies(not turned(drawn, "trip_out"))
    trip = chart_rows(drawn.case, "trip_out", drawn.depth, **(rates | {"rpm": None}), threads=1)
    assert_rows([*trip, *turning], found, "fctd.chart")
    alone = equilibrium(drawn.case, kinds[1], drawn.depth, **rates)
    assert_equal("equilibrium", alone.hookload if alone.answered else math.nan, float(found["hookload_N"][1]))


def turned(drawn: Drawn, kind: str) -> float:
    """Rotation of the drawn operation of a kind."""
    return next((row.get("rpm", 0.0) for row in drawn.raw.get("operations", []) if row["kind"] == kind), 0.0)


@statement("limits = strings at their limits", slow=True)
def at_limits(drawn: Drawn) -> None:
    """The overpull of a limit, held by the bit, uses all of it: of the steel by its design factor, of the hoist."""
    applies(drawn.raw.get("solver", {}).get("buckling") is None and not drawn.has("helical_force"))
    own = base(drawn)["trip_out"]
    applies(plain(own))
    for row in limits_of(drawn.case, "trip_out", drawn.depth).to_dict("records"):
        force = row["force_at_bit_N"]
        if row["margin"] != "overpull" or not math.isfinite(force):
            continue
        held = changed(drawn, lambda raw, force=force: raw.__setitem__("bit", raw.get("bit", {}) | {"overpull": force}))
        point = Answers(held, drawn.depth)["trip_out"]
        apart({"hook load": point.hookload / 1e6}, {"hook load": row["hookload_N"] / 1e6}, AT_LIMIT)
        if row["limit"] == "hoist":
            used = point.weight_indicator / drawn.raw["rig"]["hoist_capacity"]
        else:
            used = float(max(point.shares[[1, 4, 5, 6, 7], 0] * shares_count(drawn)))
        apart({f"used of {row['limit']}": used}, {f"used of {row['limit']}": 1.0}, AT_LIMIT)


def shares_count(drawn: Drawn) -> np.ndarray:
    """How much more a share counts: of stress, make-up torque, hook load, burst and collapse."""
    limits = drawn.raw.get("limits", {})
    factor = limits.get("design_factor", 1.0)
    return np.array([factor, 1 / limits.get("torque_share", 1.0), factor, factor, factor])


@statement("a jar by its name = by its depth", slow=True)
def jar_by_name(drawn: Drawn) -> None:
    """The depth of a component is that of its middle."""
    parts = drawn.case.string.components
    applies(parts[0].length is not None and len(parts) > 1)
    below = 0.0
    for part in parts:
        length = drawn.depth - drawn.case.string.top_md - below if part.length is None else part.length
        if below and length > 0:
            break
        below += length
    place = drawn.depth - below - 0.5 * length
    applies(place > drawn.case.string.top_md and [one.name for one in parts].count(part.name) == 1)
    one, other = (jar_forces(drawn.case, where, bit_depth=drawn.depth, up=[50e3]) for where in (part.name, place))
    assert_same_rows(one, other, ROUNDING)


@statement("free point: pumps stand")
def pumps_stand(drawn: Drawn) -> None:
    """Readings are those of mud at rest, whatever the operations of the case pump."""
    applies(has_flow_curve(drawn.case) and not drawn.has("plug", "packer_bore") and drawn.case.end != "closed")

    def of(flow: float) -> pd.DataFrame:
        def pump(raw: Raw) -> None:
            trip = {"kind": "trip_out", "from_md": drawn.depth, "to_md": 0.9 * drawn.depth, "speed": 0.2, "flow": flow}
            raw["operations"] = [trip]

        return free_point(changed(drawn, pump), drawn.depth, pull=3e4, stretch=0.05)

    applies(base(drawn)["trip_out"].answered)
    assert_same_rows(of(0.0), of(FLOW), EXACT)


@statement("wear of casing = wear factor times force times way", slow=True)
def worn_casing(drawn: Drawn) -> None:
    """Twice the rotation in half of the time wears as much; a place slides by the circumference of what touches it."""
    rows = drawn.raw["wellbore"]["intervals"]
    applies(rows[0].get("kind", "cased") == "cased" and base(drawn)["rotate_off_bottom"].answered)
    applies(not drawn.has("rotational_damping", "viscosity", "rheology", "fann", "bend"))

    def case_it(raw: Raw) -> None:
        row = raw["wellbore"]["intervals"][0]
        if "casing" not in row:
            row |= {"outer_diameter": row["diameter"] + 0.03, "yield_strength": 5.5e8}

    case = changed(drawn, case_it)
    wear = {"operation": "rotate_off_bottom", "wear_factor": 3.0, "step": 50.0}
    slow, quick = (casing_wear(case, drawn.depth, rpm=rpm, duration=3.6e6 / rpm, **wear) for rpm in (60.0, 120.0))
    assert_same_rows(slow, quick, ROUNDING)
    string, end = base(drawn).laid.string, rows[0]["to_md"]
    lower = string.top_md + np.cumsum(string.length)
    near = lower - string.length < end + 50.0
    radius = string.contact_radius()[near]
    applies(float(np.ptp(radius)) == 0 and float(slow["high_worn"].max()) < 1)
    turns = 60.0 / 60.0 * 3.6e6 / 60.0
    way = 2 * np.pi * radius[0] * turns
    area = 3e-10 / (POUND / INCH**2) * slow["side_force_N"].to_numpy() / (30 * FOOT) * way
    scale = max(float(area.max()), 1e-12)
    apart({"area": slow["low_area_m2"].to_numpy() / scale}, {"area": area / scale}, ROUNDING)


@statement("hydraulics of the public function = of the case's eccentricity")
def public_hydraulics(drawn: Drawn) -> None:
    """Where a case says "string", the string lies where its steady state does."""
    row = base(drawn).hydraulics
    applies(row)
    found = dict(fctd.hydraulics_of(drawn.case, FLOW, drawn.depth).iloc[0])
    assert all(value == found[name] or value != value for name, value in row.items()), f"{row} and {found}"


@statement("surge of an end = surge of the case with that end")
def surge_end(drawn: Drawn) -> None:
    """The argument takes the place of the key."""
    mud = drawn.raw["mud"]
    applies(has_flow_curve(drawn.case) and not drawn.has("float", "plug", "packer_bore", "inside", "outside"))
    lie = lie_along if mud.get("eccentricity") == "string" else None
    applies(lie is None or base(drawn)["trip_out"].answered)
    end, way = drawn.dice(41).pick(["open", "closed", "float"]), drawn.dice(42).pick(["trip_in", "trip_out"])

    def shut(raw: Raw) -> None:
        raw["bit"] = raw.get("bit", {}) | {"end": end}
        raw["operations"] = []  # a closed end refuses their flow

    other = changed(drawn, shut)
    if lie is not None:
        lie = drawn.dice(43).number(0.1, 0.8)  # type: ignore[assignment]  # where it lies depends on the end
    one = surge_pressures(drawn.case, 0.4, drawn.depth, way, end, lie)
    assert_same_rows(one, surge_pressures(other, 0.4, drawn.depth, way, (), lie), EXACT)


@statement("surface lines = as much bore of pipe")
def surface_bore(drawn: Drawn) -> None:
    """A metre of them takes the pressure of a metre of pipe of their diameter."""
    answers = base(drawn)
    applies(answers.hydraulics and not drawn.has("inside"))
    string = answers.laid.string
    part = drawn.case.string.components[int(string.origin[0])]
    applies(part.joint_segments is None and part.pressure_drop is None)

    def add(raw: Raw) -> None:
        raw["rig"] = raw.get("rig", {}) | {"surface_length": 100.0, "surface_bore": part.inner_diameter}

    lost = circulation(changed(drawn, add), FLOW, drawn.depth, 0.2).parts()
    pipe = next(row for row in lost if row["part"] == "bore")
    own = pipe["pressure_drop_Pa"] / (pipe["to_md_m"] - pipe["from_md_m"])
    apart({"drop": lost[0]["pressure_drop_Pa"] / 1e7}, {"drop": 100.0 * own / 1e7}, ROUNDING)


@statement("shoe's density = density with the bit's place at the shoe")
def at_last_shoe(drawn: Drawn) -> None:
    """The equivalent density at the last of several shoes is that of the annulus that ends there.

    The new end of an interval cuts a piece of the annulus in two. Where the fluid changes within one, its loss is that
    of the mean density.
    """
    rows = drawn.raw["wellbore"]["intervals"]
    applies(base(drawn).hydraulics and len(rows) > 1 and drawn.raw["mud"].get("eccentricity") != "string")
    end = rows[0]["to_md"]
    applies(drawn.case.string.top_md < 0.5 * end and end < drawn.depth - 1.0)

    def split(raw: Raw) -> None:
        raw["wellbore"]["intervals"].insert(0, rows[0] | {"to_md": 0.5 * end})

    row = hydraulics_of(changed(drawn, split), FLOW, drawn.depth).iloc[0]
    apart(
        {"density": row["ecd_shoe_kg_m3"] / 1e3}, {"density": base(drawn).hydraulics["ecd_shoe_kg_m3"] / 1e3},
        ROUNDING if len(drawn.raw["mud"].get("outside", ())) < 2 else 10 * ROUNDING,
    )  # fmt: skip


@statement("rates and factors of a sweep = arguments and overrides", slow=True)
def sweep_rates(drawn: Drawn) -> None:
    """Speed, rotation and flow of the work; a factor around the hole beside that of all directions."""
    dice = drawn.dice(44)
    along, around, kind = dice.number(0.1, 0.4, 2), dice.number(0.1, 0.4, 2), dice.pick(["back_ream", "ream_in"])
    shut = drawn.case.end == "closed" or drawn.has("plug")
    rates: dict[str, Any] = {"rpm": dice.whole(30, 120), "speed": dice.number(0.05, 0.4), "flow": 0.0 if shut else FLOW}
    case = load_case(
        load_case(drawn.raw, {"friction": along}).model_dump(exclude_none=True), {"rotational_friction": around}
    )
    row = chart_rows(case, kind, drawn.depth, **rates, threads=1)
    for work in ({"kind": "chart", "depths": [drawn.depth]}, {"kind": "equilibrium", "bit_depth": drawn.depth}):
        spec = read_sweep(
            {
                "name": "drawn", "case": drawn.raw, "method": "list",
                "parameters": [
                    {"key": "rotational_friction", "values": [around]}, {"key": "friction", "values": [along]},
                ],
                "work": {"operations": [kind], **work, **rates},
            }
        )  # fmt: skip
        runner, samples = prepare(spec)
        assert_rows(row, pd.DataFrame(runner.rows_of(sample_of(samples, 0))), f"sweep, {work['kind']}")


@statement("monitor's curves = equilibrium", slow=True)
def monitor_curves(drawn: Drawn) -> None:
    """What the rig reads of trips and of rotation in mud at rest: at a factor of its chart, and between two of them."""
    chart = Chart(drawn.case, "all")
    dice, depth = drawn.dice(45), round(drawn.depth) - 1.0
    mode, kind = dice.pick([("pick_up", "trip_out"), ("slack_off", "trip_in"), ("rotating", "rotate_off_bottom")])
    rpm = rates_of_all(chart.case, [kind], flow=0.0)[kind].spin * 30 / math.pi
    k = dice.whole(1, 3)
    for factor, bound in ((float(FACTORS[k]), ROUNDING), (dice.number(FACTORS[k], FACTORS[k + 1]), BETWEEN_FACTORS)):
        own = equilibrium(chart.case, kind, depth, flow=0.0, friction=factor)
        applies(plain(own))
        read, scale = own.weight_indicator, base(drawn).weight
        if kind == "rotate_off_bottom":
            read, scale = own.drive_torque, ARM * scale
        if factor == FACTORS[k]:  # a curve drops it where the load does not grow with the factor
            node = chart.readings(mode, depth, rpm)[k]  # type: ignore[arg-type]
            apart({"reading": node / scale}, {"reading": read / scale}, bound, f"{kind} at {factor:.9g}, node: ")
        found = chart.curve(mode, depth, factor, rpm)  # type: ignore[arg-type]
        applies(not math.isnan(found))
        apart({"reading": found / scale}, {"reading": read / scale}, bound, f"{kind} at {factor:.9g}: ")


@statement("answers of a report = chart and equilibrium")
def report_answers(drawn: Drawn) -> None:
    """Its chart, and the strings at the deepest bit depth."""
    kinds, depths = list(some_kinds(drawn)), [drawn.depth - 13.0, drawn.depth]
    found = answer(drawn.case, Asked(kinds, depths, limits=False))
    assert_rows(chart_rows(drawn.case, kinds, depths, threads=1), found.chart, "report")
    for kind, point in zip(kinds, found.points, strict=True):
        own = base(drawn)[kind]
        assert point.status == own.status, f"{kind}: {point.status} and {own.status}"
        assert_equal(f"{kind}: hook load", point.hookload, own.hookload)


def in_one_mud(drawn: Drawn) -> Drawn:
    """The drawn hole and string in one fluid that has a flow curve, within a window that is narrowest at the bottom."""
    dice, density = drawn.dice(83), drawn.raw["mud"]["density"]
    deepest = float(depth_at(base(drawn).solver.hole, np.array([drawn.case.deepest]))[0])

    def window(tvd: float, margin: float) -> Raw:
        return {"tvd": tvd, "pore": density - margin, "fracture": density + margin}

    hole = drawn.raw["wellbore"] | {"window": [window(0.0, 600.0), window(deepest, dice.number(3, 30))]}
    hole["intervals"] = [
        {key: value for key, value in row.items() if key != "overbalance"} for row in hole["intervals"]
    ]
    mud = {"density": density} | flow_of(dice)
    kept = {key: value for key, value in drawn.raw.items() if key not in ("operations", "bit")}
    return Drawn(drawn.seed, drawn.index, kept | {"wellbore": hole, "mud": mud})


@statement("swab = surge turned round")
def swab(drawn: Drawn) -> None:
    """Without pumps and a float the mud flows back as it came."""
    case, end = in_one_mud(drawn).case, drawn.dice(80).pick(["open", "closed"])
    down, up = (surge_pressures(case, 0.4, drawn.depth, kind, end).iloc[0] for kind in ("trip_in", "trip_out"))
    for name in ("surge_Pa", "shoe_surge_Pa"):
        apart({name: down[name] / 1e6}, {name: -up[name] / 1e6}, ROUNDING)


@statement("the fastest trip fills the window")
def fastest_fills(drawn: Drawn) -> None:
    """At its speed mud at rest and the surge of a trip have the pressure of the window where it ends."""
    case, kind = in_one_mud(drawn).case, drawn.dice(81).pick(["trip_in", "trip_out"])
    fastest = fastest_trips(case, drawn.depth, kind, "closed").iloc[0]
    speed, md = float(fastest["fastest_m_s"]), float(fastest["md_m"])
    applies(speed > 0 and md >= drawn.depth)  # at the bit and below it the pressure changes by the surge
    surge = float(surge_pressures(case, speed, drawn.depth, kind, "closed")["surge_Pa"].iloc[0])
    tvd = float(depth_at(base(drawn).solver.hole, np.array([md]))[0])
    side = "fracture" if kind == "trip_in" else "pore"
    rows = case.wellbore.window
    density = np.interp(tvd, [row.tvd for row in rows], [getattr(row, side) for row in rows])
    rest = GRAVITY * tvd * case.mud.density
    apart({side: (rest + surge) / 1e7}, {side: float(density) * GRAVITY * tvd / 1e7}, AT_LIMIT)


@statement("fctd surge = the functions with their arguments", slow=True)
def surge_command(drawn: Drawn) -> None:
    """Speeds, depths, operations, ends and eccentricity; the fastest trips."""
    drawn = in_one_mud(drawn)
    case, beside = drawn.case, drawn.dice(82).number(0.1, 0.9, 2)
    ends = ["open", "closed"]
    rows = surge_pressures(case, [0.2, 0.5], drawn.depth, "trip_in", ends, beside)
    with folder_of(drawn) as folder:
        command(
            "surge", folder / "well.toml", "--speed", "0.2 m/s,0.5 m/s", "--depths", f"{drawn.depth!r} m",
            "--operation", "trip_in", "--end", ",".join(ends), "--eccentricity", beside, "--units", "si", "--quiet",
            "--out", folder / "rows.csv", "--trips", folder / "trips.csv",
        )  # fmt: skip
        assert_same_rows(pd.read_csv(folder / "rows.csv")[list(rows.columns)], rows, ROUNDING)
        fastest = fastest_trips(case, drawn.depth, "trip_in", ends, beside)
        assert_same_rows(pd.read_csv(folder / "trips.csv")[list(fastest.columns)], fastest, ROUNDING)
