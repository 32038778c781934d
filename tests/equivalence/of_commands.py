"""Statements about the options of commands, which reach what the functions compute, and about runs in time."""

import math
from typing import Any

import numpy as np
import pandas as pd
from python_calamine import CalamineWorkbook

from fctd.answers.run import simulate
from fctd.case.load import load_case
from fctd.hydraulics.channel import has_flow_curve
from fctd.hydraulics.pressures import hydraulics_of
from fctd.mechanics import state
from fctd.model.operations import steady_rates
from fctd.simulation.flowing_mud import let_flow
from fctd.simulation.preparation import prepare
from fctd.steady.equilibrium import equilibrium
from fctd.steady.laid_string import LaidString
from fctd.steady.torque_drag import chart_rows
from tests.equivalence.answers import FLOW, ROUNDING, apart, base, changed, plain
from tests.equivalence.draws import Drawn
from tests.equivalence.holes import Raw
from tests.equivalence.of_answers import assert_same_rows
from tests.equivalence.of_files import command, folder_of
from tests.equivalence.table import applies, statement


def shut(drawn: Drawn) -> bool:
    """Whether no mud can be pumped through the string."""
    return drawn.case.end == "closed" or drawn.has("plug")


@statement("bare numbers of options = with the units of the field", slow=True)
def bare_options(drawn: Drawn) -> None:
    """A speed is in ft/min, a flow in gpm, a depth in ft, whatever the units of the case are."""
    dice = drawn.dice(50)
    speed, flow = dice.whole(20, 80), 0 if shut(drawn) else dice.whole(200, 500)
    depth = drawn.depth / 0.3048
    name = dice.pick(["chart", "limits"])
    bare = (speed, flow, f"{depth!r}:{depth!r}:1" if name == "chart" else f"{depth!r}")
    typed = (
        f"{speed} ft/min",
        f"{flow} gpm",
        f"{depth!r} ft:{depth!r} ft:1 ft" if name == "chart" else f"{depth!r} ft",
    )
    tables = []
    with folder_of(drawn) as folder:
        for k, (at, pumped, where) in enumerate((bare, typed)):
            command(
                name, folder / "well.toml", "--operation", "back_ream", "--depths", where, "--speed", at, "--flow",
                pumped, "--rpm", 60, "--units", "field", "--quiet", "--out", folder / f"{k}.csv",
            )  # fmt: skip
            tables.append(pd.read_csv(folder / f"{k}.csv"))
    one = dict(zip(("speed_ft_min", "flow_gpm"), (speed, flow), strict=True))
    for column, value in one.items():
        apart({column: tables[0][column][0] / 100}, {column: value / 100}, 1e-9)
    assert_same_rows(*tables, ROUNDING)


@statement("fctd equilibrium = the function with its arguments", slow=True)
def equilibrium_command(drawn: Drawn) -> None:
    """Friction, rotation, speed and flow; the profile as a CSV."""
    dice = drawn.dice(51)
    friction = dice.number(0.1, 0.4, 2)
    rates = {"speed": dice.number(0.05, 0.4), "rpm": float(dice.whole(30, 120)), "flow": 0.0 if shut(drawn) else FLOW}
    point = equilibrium(drawn.case, "back_ream", drawn.depth, **rates, friction=friction)
    applies(point.answered)
    with folder_of(drawn) as folder:
        command(
            "equilibrium", folder / "well.toml", "--operation", "back_ream", "--bit-depth", f"{drawn.depth!r} m",
            "--friction", friction, "--speed", f"{rates['speed']!r} m/s", "--rpm", rates["rpm"], "--flow",
            f"{rates['flow']!r} m^3/s", "--units", "si", "--quiet", "--out", folder / "profile.csv",
        )  # fmt: skip
        found = pd.read_csv(folder / "profile.csv")
    assert_same_rows(found[list(point.profile.columns)], point.profile, ROUNDING, but=("buckling",))


@statement("fctd hydraulics = the function with its arguments", slow=True)
def hydraulics_command(drawn: Drawn) -> None:
    """Flow, depth and eccentricity; of a mud with a viscosity, where the case says nothing of its flow."""
    curve = {} if has_flow_curve(drawn.case) else {"viscosity": 0.02}
    drawn = Drawn(drawn.seed, drawn.index, drawn.raw | {"mud": drawn.raw["mud"] | curve})
    applies(base(drawn).hydraulics)
    beside = drawn.dice(52).number(0.1, 0.9, 2)
    row = hydraulics_of(drawn.case, FLOW, drawn.depth, beside).iloc[0]
    with folder_of(drawn) as folder:
        command(
            "hydraulics", folder / "well.toml", "--flow", f"{FLOW!r} m^3/s", "--depths", f"{drawn.depth!r} m",
            "--eccentricity", beside, "--units", "si", "--quiet", "--out", folder / "rows.csv",
        )  # fmt: skip
        found = pd.read_csv(folder / "rows.csv").iloc[0]
    for name in ("standpipe_Pa", "annulus_drop_Pa", "ecd_bit_kg_m3"):
        apart({name: found[name] / 1e6}, {name: row[name] / 1e6}, ROUNDING)


@statement("fctd report = rows of a chart with its rates", slow=True)
def report_command(drawn: Drawn) -> None:
    """Its workbook has the hook load and the torque of the rates, and of the friction, that are asked for."""
    dice = drawn.dice(53)
    friction = dice.number(0.1, 0.4, 2)
    rates = {"speed": dice.number(0.05, 0.4), "rpm": float(dice.whole(30, 120)), "flow": 0.0 if shut(drawn) else FLOW}
    (row,) = chart_rows(drawn.case, "back_ream", drawn.depth, friction, **rates, threads=1)
    applies(not math.isnan(row["hookload_N"]))
    with folder_of(drawn) as folder:
        file = folder / "report.xlsx"
        command(
            "report", folder / "well.toml", "--operation", "back_ream", "--depths",
            f"{drawn.depth!r} m:{drawn.depth!r} m:1 m", "--friction", friction, "--speed", f"{rates['speed']!r} m/s",
            "--rpm", rates["rpm"], "--flow", f"{rates['flow']!r} m^3/s", "--units", "si", "--no-limits", "--quiet",
            "--load", "string", "--out", file,
        )  # fmt: skip
        book = CalamineWorkbook.from_path(str(file))
        cells = [
            cell for name in book.sheet_names for line in book.get_sheet_by_name(name).to_python() for cell in line
        ]
    shown = np.array([cell for cell in cells if isinstance(cell, int | float)], float)
    for name in ("hookload_N", "surface_torque_N_m"):
        count = int((np.abs(shown - row[name] / 1e3) <= 1e-6 * abs(row[name] / 1e3) + 1e-9).sum())
        # In the chart, and in the profiles at the deepest bit depth.
        assert count >= 2, f"{name} {row[name] / 1e3:.9g} stands {count} times in the workbook"


@statement("flow's load on a run = on a steady string", slow=True)
def flow_on_run(drawn: Drawn) -> None:
    """Of a string whose pipe is fed too, half of whose top segment hangs on the top drive."""
    applies(not shut(drawn) and drawn.raw["mud"].get("eccentricity") != "string")
    applies(not drawn.has("axial_damping", "packer_bore", "swivel", "tortuosity"))

    def write(raw: Raw) -> None:
        raw["mud"] |= {"viscosity": 0.02}
        for key in ("rheology", "fann"):
            raw["mud"].pop(key, None)
        raw["operations"] = [
            {"kind": "rotate_off_bottom", "at_md": drawn.depth, "duration": 20.0, "rpm": 60.0, "flow": FLOW}
        ]
        raw["rig"] = {"feed": "long_segment"}
        raw["contact"], raw["record"] = {}, {}
        raw["mud"].pop("cake", None)
        for row in raw["wellbore"]["intervals"]:
            for key in ("static_friction", "decay_speed", "overbalance"):
                row.pop(key, None)
        raw["solver"] = {}
        raw.get("bit", {}).pop("overpull", None)
        raw["wellbore"]["stations"] = [[0.0, 0.0, 0.0], [raw["wellbore"]["stations"][-1][0], 0.0, 0.0]]
        last = raw["string"]["components"][-1]
        for key in ("length", "segment_length"):
            last.pop(key, None)
        last["segments"] = 1

    case = changed(drawn, write)
    run, _ = prepare(case)
    steady = LaidString(case, run.hole, run.string).in_flow(steady_rates(case, "rotate_off_bottom")).given
    assert run.string.long_segment
    pipe, _ = let_flow(run.S, case, run.string, run.hole, run.pipe, 0.0, FLOW)
    given = state.row(run.S, state.GIVEN_FORCE, run.string.segments).copy()
    weight = float(run.string.weight @ run.string.length)
    given[0] += 0.5 * pipe.given * run.string.length[0]
    apart({"load": given / weight}, {"load": steady / weight}, ROUNDING)


@statement("a run in time comes to the steady string", slow=True)
def comes_to_rest(drawn: Drawn) -> None:
    """A short, stiff string that is reamed out slowly: the means of its last seconds, with friction around the hole."""
    dice = drawn.dice(54)
    along, around = dice.number(0.1, 0.4, 2), dice.number(0.1, 0.4, 2)
    size = dice.number(0.2, 0.23)
    tables: dict[str, Any] = {
        "name": "short",
        "wellbore": {
            "stations": [[0.0, 0.0, 0.0], [50.0, 0.0, 0.0], [200.0, dice.number(20, 60), dice.number(0, 20)],
                         [300.0, dice.number(20, 60), 20.0]],
            "geometry": dice.pick(["arcs", "cylinders"]),
            "intervals": [{"to_md": 300.0, "diameter": size, "friction": along, "rotational_friction": around}],
        },
        "string": {"components": [
            {"name": "pipe", "outer_diameter": 0.127, "inner_diameter": 0.1086, "segment_length": 10.0,
             "contact_diameter": size - 0.006},
        ]},
        "mud": {"density": 1200.0, "lateral_damping": 1e3, "viscosity": 0.0},
        "operations": [
            {"kind": "back_ream", "from_md": 281.0, "to_md": 279.6, "speed": 0.1, "rpm": 15.0, "ramp_time": 2.0}
        ],
        "record": {"interval": 0.05},
    }  # fmt: skip
    case = load_case(tables)
    result = simulate(case)
    assert result.status == "completed", f"{result.status}: {result.message}"
    time = result.history["time_s"]
    rows = result.history[(time > 6.0) & (time <= 14.0)].mean(numeric_only=True)
    point = equilibrium(case, "back_ream", float(rows["bit_depth_m"]))
    applies(plain(point))
    assert abs(rows["hookload_N"] / point.hookload - 1) < 0.02, f"{rows['hookload_N']:.6g} and {point.hookload:.6g}"
    apart({"torque": rows["surface_torque_N_m"] / point.surface_torque}, {"torque": 1.0}, 0.04)
