"""Drilling in time: the law of the bit, the balance of the string, the hole that it makes, autodriller and cost."""

import time
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, Simulation, SimulationResult, equilibrium
from fctd.arena.result import Quartiles
from fctd.mechanics import state, topdrive
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.frames import hole_frame
from fctd.model.section import section_of
from fctd.simulation.preparation import contact_points
from fctd.simulation.run import Run
from validation.harness.study import Check, Context, Outcome, Study, in_columns, quartiles_of, ratio_check

RPM, WEIGHT = 120.0, 60e3  # [rev/min]; [N] that the autodriller is to hold
SPEEDS = (0.006, 0.009, 0.012)  # of the block [m/s]
RADIUS, ENERGY, RATIO, FRICTION = 0.5 * 0.2159, 1e8, 0.6, 0.6  # of the bit [m]; ε [Pa], ζ and μ of the rock
STEADY = 20.0  # [s] at the end of a run over which loads are averaged
DEPTHS = np.arange(500.0, 3001.0, 250.0)  # [m] at which the cost is measured
WINDOW, QUICK_WINDOW = 60.0, 4.0  # [s] whose cost is measured
PARTS = 8  # of such a window, each timed by itself
ROCK = {
    "radius": RADIUS, "specific_energy": ENERGY, "force_ratio": RATIO, "friction": FRICTION, "wear_flat": "5 mm",
    "contact_strength": "100 MPa",
}  # fmt: skip


def drilled(depth: float, segment: float, speed: float, duration: float, inclination: float = 45.0, **rig: Any) -> Case:
    """A well that builds to an inclination [deg], drilled from ``depth`` [m] with segments of one length [m]."""
    build = [0.3 * depth, 0.5 * depth]
    bottom = depth + 100.0
    collar = {"name": "drill collar", "length": 100.0, "outer_diameter": 0.165, "inner_diameter": 0.07}
    pipe = {"name": "pipe", "outer_diameter": 0.127, "inner_diameter": 0.1086, "contact_diameter": 0.165}
    operation = {
        "kind": "drill_rotating", "from_md": depth, "to_md": depth + speed * (duration - 5.0), "speed": speed,
        "rpm": RPM, "ramp_time": 10.0,
    }  # fmt: skip
    return Case.model_validate(
        {
            "name": "drilled",
            "wellbore": {
                "stations": [[0, 0, 0], [build[0], 0, 0], [build[1], inclination, 0], [bottom, inclination, 0]],
                "intervals": [{"to_md": bottom, "diameter": 2 * RADIUS, "friction": 0.25}],
                "geometry": "arcs",
            },
            "string": {"components": [{**part, "segment_length": segment} for part in (collar, pipe)]},
            "mud": {"density": 1200.0, "lateral_damping": 50.0, "rotational_damping": 0.05, "axial_damping": 0.5},
            "bit": {"weight_on_bit": WEIGHT, "torque": 0.0, "rock": ROCK},
            "rig": {"feed": "stands", "stand_length": 30.0, **rig},
            "operations": [operation],
        }
    )


def stretch(run: Run) -> float:
    """Stretch of the string [m]: the loads of its joints over their stiffness, whole length of each included."""
    n = run.segments
    force = np.stack([state.row(run.S, row, n) for row in (state.FX, state.FY, state.FZ)], axis=1)
    axis = np.stack([state.row(run.S, row, n) for row in (state.AX, state.AY, state.AZ)], axis=1)
    return float((-(force * axis).sum(axis=1) / state.row(run.S, state.K_AXIAL, n)).sum())


def shortcut(run: Run) -> float:
    """Measured depth of the bit less the length of the string [m]: a string on the high side of a build is shorter."""
    n = run.segments
    points = contact_points(run.S, n)
    md = run.hole.walls(points, run.owner[1 : n + 1]).md
    axis, tangent = run.hole.at(md)
    high = ((points - axis) * hole_frame(tangent)[0]).sum(axis=1)
    return float((np.gradient(run.hole.inclination(md), md) * high * run.string.length).sum())


def completed(case: Case) -> tuple[SimulationResult, dict[str, float]]:
    """A run, and its hole made, block travel and change of stretch [m]."""
    simulation = Simulation(case)
    simulation.start()
    run = simulation.run
    before, beside = stretch(run), shortcut(run)
    for _ in simulation:
        pass
    result = simulation.result()
    if result.status != "completed":
        raise RuntimeError(f"{case.name}: {result.status}, {result.message}")
    top = run.top
    return result, {
        "hole_made_m": float(top[topdrive.HOLE_MADE]),
        "in_the_rock_m": float(top[topdrive.PRESSED]),
        "block_travel_m": float(top[topdrive.FED]),
        "change_of_stretch_m": stretch(run) - before,
        "change_of_shortcut_m": shortcut(run) - beside,
    }


def row_of(case: Case, driller: str) -> dict[str, Any]:
    """The steady end of a run against the steady string with the same loads on its bit, and the law of the bit."""
    result, lengths = completed(case)
    history = result.history
    late = history[history["time_s"] > history["time_s"].max() - STEADY]
    mean = late.mean(numeric_only=True)
    span = late["time_s"].iloc[-1] - late["time_s"].iloc[0]
    rate = float(late["hole_made_m"].iloc[-1] - late["hole_made_m"].iloc[0]) / span
    weight, torque = float(mean["weight_on_bit_N"]), float(mean["bit_torque_N_m"])
    loaded = case.bit.model_copy(update={"weight_on_bit": weight, "torque": torque})
    depth = float(late["bit_depth_m"].mean())
    steady = equilibrium(case.model_copy(update={"bit": loaded}), "drill_rotating", depth, speed=rate, rpm=RPM)
    in_air = GRAVITY * section_of(case.string.components[-1], 0.0).mass
    cut = 60 * rate / float(mean["bit_rpm"])
    energy, strength = 2 * torque / (RADIUS**2 * cut), weight / (RADIUS * cut)
    return {
        "driller": driller,
        "rate_m_per_h": 3600 * rate,
        "weight_on_bit_kN": weight / 1e3,
        "bit_torque_kN_m": torque / 1e3,
        "drilling_strength_MPa": strength / 1e6,
        "specific_energy_MPa": energy / 1e6,
        "by_the_law_MPa": ((1 - FRICTION * RATIO) * ENERGY + FRICTION * strength) / 1e6,
        # The pipe above the rotary table hangs in air, and the steady string ends at the table.
        "hookload_kN": float(mean["hookload_N"] - mean["block_position_m"] * in_air) / 1e3,
        "steady_hookload_kN": steady.hookload / 1e3,
        "torque_kN_m": float(mean["surface_torque_N_m"]) / 1e3,
        "steady_torque_kN_m": steady.surface_torque / 1e3,
        "energy_error": result.run["energy_error"],
        **lengths,
    }


def real_time_factors(depth: float, segment: float, window: float) -> list[float]:
    """Simulated over processor time of each of the parts of a window while drilling."""
    simulation = Simulation(drilled(depth, segment, SPEEDS[1], 40.0 + WINDOW))
    simulation.start()
    motion = simulation.phases[-1].motion
    simulation.run.advance(motion, 1.0)
    moments = [time.process_time()]
    for _ in range(PARTS):
        simulation.run.advance(motion, window / PARTS)
        moments.append(time.process_time())
    return list(window / PARTS / np.diff(moments))


def run(context: Context) -> Outcome:
    """Drilling at three block speeds and by an autodriller, and the cost of 3 km."""
    depth, segment = (1000.0, 15.0) if context.quick else (2000.0, 10.0)
    duration, speeds = (80.0, SPEEDS[::2]) if context.quick else (150.0, SPEEDS)
    rows = [row_of(drilled(depth, segment, speed, duration), f"block at {speed:g} m/s") for speed in speeds]
    autodriller = drilled(depth, segment, SPEEDS[0], duration, autodriller=True)
    rows.append(row_of(autodriller, "autodriller"))
    table = pd.DataFrame(rows)
    _, lengths = completed(drilled(depth, segment, SPEEDS[1], duration, inclination=0.0))
    vertical = pd.DataFrame([lengths])
    window, depths = (QUICK_WINDOW, DEPTHS[::10]) if context.quick else (WINDOW, DEPTHS)
    factors = {float(depth): real_time_factors(float(depth), 10.0, window) for depth in depths}
    speed = pd.DataFrame(
        [{"depth_m": depth, **in_columns({"real_time_factor": found})} for depth, found in factors.items()]
    )
    # Each part of the windows at all depths is a round of the whole well.
    whole = [
        DEPTHS[-1] / (np.trapezoid(1 / found, depths) + depths[0] / found[0])
        for found in np.array(list(factors.values())).T
    ]

    def left(lengths: pd.DataFrame) -> float:
        made = lengths["hole_made_m"] + lengths["in_the_rock_m"]
        return 1e3 * float((made - lengths["block_travel_m"] - lengths["change_of_stretch_m"]).abs().max())

    def off(ours: str, theirs: str) -> float:
        return 100 * float((table[ours] / table[theirs] - 1).abs().max())

    return Outcome(
        tables={"drilling": table, "vertical": vertical, "speed": speed},
        checks=[
            Check("specific energy against the line of the law, largest difference",
                  off("specific_energy_MPa", "by_the_law_MPa"), 0.1, "at_most", "%",
                  "Detournay & Defournay 1992: E = (1 − μγζ)ε + μγS"),
            Check("hook load against the steady string with the same bit loads, largest difference",
                  off("hookload_kN", "steady_hookload_kN"), 0.5, "at_most", "%", "target of this project"),
            Check("surface torque against the steady string with the same bit loads, largest difference",
                  off("torque_kN_m", "steady_torque_kN_m"), 0.5, "at_most", "%", "target of this project"),
            Check("hole made less block travel and change of stretch, vertical hole", left(vertical), 1.0, "at_most",
                  "mm", "the string neither grows nor shrinks; target of this project"),
            Check("hole made less block travel, change of stretch and of the way beside the axis, 45 deg",
                  left(table.assign(change_of_stretch_m=table["change_of_stretch_m"] + table["change_of_shortcut_m"])),
                  1.0, "at_most", "mm", "the string in a bend moves across its clearance; target of this project"),
            Check("weight on bit of the autodriller against its target",
                  100 * abs(float(table["weight_on_bit_kN"].iloc[-1]) * 1e3 / WEIGHT - 1), 1.0, "at_most", "%",
                  "rotating tare less hook load"),
            Check("energy ledger, largest residual over work", 100 * float(table["energy_error"].max()), 0.1,
                  "at_most", "%", "target of this project"),
            ratio_check("real-time factor of drilling 3 km with segments of 10 m", Quartiles.of(whole), 150.0,
                        "at_least",
                        f"target of this project; processor time of windows of {window:g} s, extrapolated"),
            ratio_check("real-time factor at 3 km, 300 segments of 10 m",
                        quartiles_of(speed.iloc[-1], "real_time_factor"), 150.0, "at_least",
                        f"target of this project; processor time of a window of {window:g} s"),
        ],
        notes=[
            "Hole made and what the bit is in the rock are the travel of the bit along itself.",
            f"The cost is that of windows of {window:g} s with the bit on bottom, every {depths[1] - depths[0]:g} m, "
            "on wells whose build is in the same part of their depth. The factor of the whole well takes the cost "
            "between two windows as the mean of both, above the first as that of the first, and one rate of "
            "penetration.",
        ],
        display={
            "drilling": "Drilling in time, and the steady string with the same loads on its bit",
            "speed": "Real-time factor by depth, segments of 10 m",
        },
    )  # fmt: skip


STUDY = Study("drilling", "Does a string that drills in time keep the balances of bit and string?", run)
