"""Friction that sticks on a belt, on a slope and in mud cake, and a wall by Hertz's law, against exact solutions."""

import time
from typing import Any

import numpy as np
import pandas as pd
from scipy.integrate import solve_ivp

from fctd import Case
from fctd.arrays import Array
from fctd.mechanics import state, topdrive
from fctd.mechanics.cake import sealed_width
from fctd.mechanics.dynamics import PUSHES
from fctd.mechanics.energy import penetration
from fctd.mechanics.jit import entry
from fctd.mechanics.law_names import CODES
from fctd.mechanics.moving_string import STILL
from fctd.mechanics.state import FX, FZ, K_WALL, LANES, PX, VX, VZ, Laws
from fctd.mechanics.wall_law import stiffen_walls
from fctd.simulation.preparation import contact_points
from fctd.simulation.simulate import Simulation
from references.timing.workloads import moving
from validation.cases import load, rotation
from validation.harness.study import (
    Check,
    Context,
    Outcome,
    Rows,
    Study,
    in_columns,
    quartiles_of,
    ratio_check,
    table_of_rows,
)

# One body on a belt: mass [kg], spring [N/m], speed of the belt [m/s], normal force [N], factors, decay speed [m/s].
MASS, SPRING, BELT, PRESSED, KINETIC, STATIC, DECAY = 1000.0, 4000.0, 0.1, 1e4, 0.2, 0.3, 0.02
STEPS = (7.3e-3, 3.65e-3, 1.825e-3)  # [s]; no whole number of them is a time of stick
CYCLES = 20
# The same body falls on the wall: stiffness K [N/m], reference penetration [m], speed [m/s], load [N].
STIFFNESS, REFERENCE, FALL, LOAD = 1e7, 1e-3, 0.1, 1e4
# A string on a slope: inclination [deg]; rest before the measurement and its duration [s].
INCLINATION, QUIET, WATCHED = 75.0, 100.0, 60.0
# The cost of a step: windows [s] of the curved chain, the laws in turn.
WINDOWS, WINDOW = 20, 2.5
# A string in mud cake: overbalance [Pa], thickness of the cake [m], length of the interval [m], hole and string [m].
OVERBALANCE, CAKE, INTERVAL, HOLE, COLLAR = 3e6, 2e-3, 60.0, 0.2159, 0.159
KARNOPP = CODES["karnopp"]
push_karnopp, push_stribeck = PUSHES[KARNOPP], PUSHES[CODES["stribeck"]]


@entry
def move_body(
    S: Array, top: Array, laws: Laws, spring: float, belt: float, dt: float, along: Array, depths: Array
) -> None:
    """Move one body on a flat wall, held by a spring whose end moves along z; its places along z and depths [m]."""
    stiffness, room = S[K_WALL + 1], S[PX + 1] - depths[0]
    z, depth = 0.0, depths[0]
    for k in range(along.shape[0]):
        along[k], depths[k] = z, depth
        S[FZ + 1] = spring * (belt * k * dt - z)
        S[K_WALL + 1], S[PX + 1] = stiffness, room + depth
        if laws.wall_exponent != 1:
            stiffen_walls(S, top, 1, laws)
        # These two alone: a choice of all laws compiles twice as long.
        if laws.friction == KARNOPP:
            push_karnopp(S, LANES, laws, dt)
        else:
            push_stribeck(S, LANES, laws, dt)
        z, depth = z + dt * S[VZ + 1], depth + dt * S[VX + 1]


def body_on_wall(depth: float, kinetic: float = 0.0, static: float = 0.0, decay: float = 0.0) -> Array:
    """A body too heavy to tilt, on the wall on its x side."""
    S = state.new_state(1)
    for row, inverse, value in (
        (state.MASS, state.INVERSE_MASS, MASS),
        (state.J_TRANSVERSE, state.INVERSE_JT, 1e15),
        (state.J_AXIAL, state.INVERSE_JA, 1e15),
    ):
        S[row + 1], S[inverse + 1] = value, 1 / value
    S[state.HOLE + 1], S[state.RADIUS + 1], S[K_WALL + 1], S[PX + 1] = 0.1, 0.05, STIFFNESS, 0.05 + depth
    S[state.FRICTION + 1], S[state.DECAY + 1], S[state.STUCK + 1] = kinetic, decay, 1.0
    S[state.EXCESS + 1] = static / kinetic - 1 if kinetic else 0.0
    return S


def exact_belt() -> tuple[float, float]:
    """Period [s] and amplitude [m] of a body that sticks and slips, with one kinetic factor.

    The spring stretches at the belt's speed V until its force is static; then its stretch less that of kinetic friction
    is d cos ωt + (V/ω) sin ωt with d = (F_s − F_k)/K, until the body stands still again.
    """
    omega, drop = np.sqrt(SPRING / MASS), (STATIC - KINETIC) * PRESSED / SPRING
    slip = (2 * np.pi - 2 * np.arctan(drop * omega / BELT)) / omega
    return float(2 * drop / BELT + slip), float(np.hypot(drop, BELT / omega))


def integrated_belt() -> tuple[float, float]:
    """The same with a factor that falls with the speed, by scipy to 1e-10; the stretch is from that of no force."""

    def rates(_: float, at: Array) -> list[float]:
        stretch, speed = at
        factor = KINETIC + (STATIC - KINETIC) / (1 + (speed / DECAY) ** 2)
        return [BELT - speed, (SPRING * stretch - factor * PRESSED) / MASS]

    def stops(_: float, at: Array) -> float:
        return float(at[1])

    stops.terminal, stops.direction = True, -1  # type: ignore[attr-defined]
    start = [STATIC * PRESSED / SPRING + 1e-9, 1e-9]
    slip = solve_ivp(rates, (0.0, 100.0), start, events=stops, rtol=1e-10, atol=1e-13, max_step=0.01)
    stretch = slip.y[0]
    period = slip.t[-1] + (start[0] - stretch[-1]) / BELT
    return float(period), float(0.5 * (stretch.max() - stretch.min()))


@table_of_rows
def belts() -> Rows:
    """Period and amplitude of both laws at three steps; the kernel of the stepper moves one body."""
    for law, decay, (period, amplitude) in (
        ("karnopp", 0.0, exact_belt()),
        ("stribeck", DECAY, integrated_belt()),
    ):
        for dt in STEPS:
            S = body_on_wall(PRESSED / STIFFNESS, KINETIC, STATIC, decay)
            S[FX + 1] = PRESSED
            along = np.empty(int((CYCLES + 2) * period / dt))
            laws = Laws(state.ARCS, CODES[law], 1.0, 0.0, 0.0, 0.0)
            top, depths = np.zeros(topdrive.TOP_SIZE), np.full(len(along), PRESSED / STIFFNESS)
            move_body(S, top, laws, SPRING, BELT, dt, along, depths)
            stretch, still = BELT * dt * np.arange(len(along)) - along, np.diff(along) < 1e-9 * BELT * dt
            starts = np.flatnonzero(still[:-1] & ~still[1:])
            found = dt * (starts[-1] - starts[1]) / (len(starts) - 2)
            swing = 0.5 * float(np.ptp(stretch[starts[1] : starts[-1]]))
            yield {
                "law": law, "step_ms": 1e3 * dt, "period_s": found, "exact_period_s": period,
                "amplitude_mm": 1e3 * swing, "exact_amplitude_mm": 1e3 * amplitude,
                "period_off_percent": 100 * abs(found / period - 1),
                "amplitude_off_percent": 100 * abs(swing / amplitude - 1),
            }  # fmt: skip


def observed_order(rows: pd.DataFrame, column: str) -> float:
    """Slope of an error over the step, both logarithmic."""
    return float(np.polyfit(np.log(rows["step_ms"]), np.log(rows[column]), 1)[0])


def hertz(steps: int = 400) -> dict[str, float]:
    """A body that falls on a wall of exponent 1.5, and one that rests on it, in per cent of Hertz's closed forms."""
    factor = STIFFNESS * REFERENCE**-0.5
    deepest = (5 * MASS * FALL**2 / (4 * factor)) ** 0.4
    lasting = 2.943275 * deepest / FALL  # 4/5 √π Γ(2/5)/Γ(9/10)
    laws = Laws(state.ARCS, 0, 1.0, 0.0, 0.0, 0.0, wall_exponent=1.5, wall_reference=REFERENCE)
    S, dt, top = body_on_wall(0.0), lasting / steps, np.zeros(topdrive.TOP_SIZE)
    S[VX + 1] = FALL
    depths = np.zeros(2 * steps)
    move_body(S, top, laws, 0.0, 0.0, dt, np.empty(2 * steps), depths)
    left = int(np.flatnonzero(depths[1:] <= 0)[0]) + 1
    speed = (depths[left] - depths[left - 1]) / dt
    time = dt * left - depths[left] / speed

    resting = body_on_wall(0.0)
    resting[FX + 1] = LOAD
    damped = laws._replace(contact_damping=2e5)
    low = np.zeros(40 * steps)
    move_body(resting, np.zeros(topdrive.TOP_SIZE), damped, 0.0, 0.0, dt, np.empty(len(low)), low)
    return {
        "contact_time_off_percent": 100 * abs(time / lasting - 1),
        "rebound_off_percent": 100 * abs(abs(speed) / FALL - 1),
        "static_depth_off_percent": 100 * abs(low[-1] / (LOAD / factor) ** (2 / 3) - 1),
    }


def slope() -> float:
    """Creep of a string on a slope, after it was turned and stopped [m/h], from the largest way of a contact point."""
    pipe = {"name": "pipe", "outer_diameter": 0.127, "inner_diameter": 0.1086, "segment_length": 20.0}
    interval = {"to_md": 700.0, "diameter": HOLE, "friction": 0.3, "static_friction": 0.4}
    case = Case.model_validate(
        {
            "name": "slope",
            "wellbore": {
                "stations": [[0, INCLINATION, 0], [700, INCLINATION, 0]], "geometry": "arcs", "intervals": [interval],
            },
            "string": {"components": [pipe]},
            "mud": {"density": 1200.0, "lateral_damping": 50.0},
            "contact": {"friction_law": "karnopp"},
            "operations": [
                {"kind": "rotate_off_bottom", "at_md": 600.0, "duration": 5.0, "rpm": 10.0, "ramp_time": 1.0}
            ],
        }
    )  # fmt: skip
    simulation = Simulation(case)
    list(simulation)
    run = simulation.run
    run.advance(STILL, QUIET)
    run.refresh()
    before = contact_points(run.S, run.segments)
    run.advance(STILL, WATCHED)
    run.refresh()
    way = np.linalg.norm(contact_points(run.S, run.segments) - before, axis=1)
    return float(way[penetration(run.S, run.segments) > 0].max()) * 3600 / WATCHED


def stuck_well(overbalance: float | None, static: float | None, segment: float) -> Case:
    """Collars in a hole of 0.9°, on whose low side they lie; a part of it is permeable.  The string is pulled."""
    more: dict[str, Any] = {} if static is None else {"static_friction": static}
    ends = ((900.0, None), (900.0 + INTERVAL, overbalance), (1010.0, None))
    intervals = [
        {"to_md": end, "diameter": HOLE, "friction": 0.1, **more, **({"overbalance": p} if p else {})}
        for end, p in ends
    ]
    collar = {
        "name": "collar", "length": 200.0, "outer_diameter": COLLAR, "inner_diameter": 0.07, "segment_length": segment,
    }  # fmt: skip
    pipe = {"name": "pipe", "outer_diameter": 0.127, "inner_diameter": 0.07, "segments": 1}
    return Case.model_validate(
        {
            "name": "stuck",
            "wellbore": {"stations": [[0, 0.9, 0], [1010, 0.9, 0]], "geometry": "arcs", "intervals": intervals},
            "string": {"components": [collar, pipe]},
            "mud": {
                "density": 1200.0, "lateral_damping": 50.0, "axial_damping": 5.0,
                "cake": {"friction": 0.05, "rested": "300 h", "thickness": CAKE},
            },
            "contact": {"friction_law": "karnopp"},
            "record": {"interval": 0.5},
            "operations": [
                {"kind": "trip_out", "from_md": 1000.0, "to_md": 999.2, "speed": 0.02, "ramp_time": 10.0}
            ],
        }
    )  # fmt: skip


@table_of_rows
def overpulls(segment: float, statics: tuple[float | None, ...]) -> Rows:
    """Largest pull beyond that without mud pressure, with equal factors and with higher static ones."""
    closed = 0.05 * OVERBALANCE * sealed_width(0.5 * HOLE, 0.5 * COLLAR, CAKE) * INTERVAL
    for static in statics:
        pulled = []
        for overbalance in (None, OVERBALANCE):
            simulation = Simulation(stuck_well(overbalance, static, segment))
            pulled.append(np.array([record["hookload_N"] for record in simulation]))
        ratio = 1.0 if static is None else static / 0.1
        most = float((pulled[1] - pulled[0]).max())
        yield {
            "static_over_kinetic": ratio, "overpull_kN": most / 1e3, "all_at_once_kN": closed * ratio / 1e3,
            "share": most / (closed * ratio), "over_kinetic": most / closed,
        }  # fmt: skip


@table_of_rows
def costs() -> Rows:
    """Processor time of a step of the curved chain, turning and at rest, by law: quartiles of windows in turn [ns]."""
    static = {"wellbore__intervals__0__static_friction": 0.3}
    laws: dict[str, dict[str, Any]] = {
        "coulomb": {}, "karnopp": static, "stribeck": static | {"wellbore__intervals__0__decay_speed": DECAY},
    }  # fmt: skip
    turning = {}
    for law, more in laws.items():
        chain = load(
            "curved_chain", operations=rotation(2450.0, 60.0, ramp=4.0), contact__friction_law=law, **more
        )  # fmt: skip
        turning[law] = moving(chain, 4.0)
    for state_of in ("turning", "at rest"):
        spent: dict[str, list[float]] = {law: [] for law in turning}
        for run, motion in turning.values():
            run.advance(motion if state_of == "turning" else STILL, 1.0 if state_of == "turning" else 60.0)
        for _ in range(WINDOWS):
            for law, (run, motion) in turning.items():
                began = time.process_time()
                run.advance(motion if state_of == "turning" else STILL, WINDOW)
                spent[law].append(1e9 * (time.process_time() - began) / (WINDOW / run.step * run.segments))
        for law, times in spent.items():
            both = {"segment_step_ns": times, "over_coulomb": np.divide(times, spent["coulomb"])}
            yield {"string": state_of, "law": law, **in_columns(both)}


def run(context: Context) -> Outcome:
    """One body on a belt and on a wall; a string on a slope; a string in mud cake."""
    belt, fallen, creep, spent = belts(), hertz(), slope(), costs()
    pulls = overpulls(10.0, (None, 0.3)) if context.quick else overpulls(5.0, (None, 0.15, 0.2, 0.3))
    karnopp, stribeck = (belt[belt["law"] == law] for law in ("karnopp", "stribeck"))
    off = ["period_off_percent", "amplitude_off_percent"]
    checks = [
        Check("period and amplitude of a body on a belt, law karnopp, three steps, largest difference",
              float(karnopp[off].to_numpy().max()), 1.0, "at_most", "%", "closed form"),
        Check("period and amplitude of a body on a belt, law stribeck, three steps, largest difference",
              float(stribeck[off].to_numpy().max()), 1.0, "at_most", "%", "ordinary differential equation by scipy"),
        Check("order of the amplitude over the step, law stribeck", observed_order(stribeck, off[1]), (0.7, 1.5),
              "within", "", "1 for a stepper of first order"),
        Check("creep of a string on a slope below the static limit", 1e6 * creep, 1.0, "at_most", "µm/h",
              f"it must not creep; extrapolated from {WATCHED:.0f} s"),
        Check("overpull out of mud cake with equal factors, against μ Δp b L",
              100 * abs(float(pulls["share"].iloc[0]) - 1), 1.0, "at_most", "%", "closed form"),
        Check("overpull with a static factor of three times the kinetic one, over μ_s Δp b L",
              float(pulls["share"].iloc[-1]), 0.9, "at_most", "", "the interval frees from the top"),
        ratio_check("step with friction that sticks, over one with law coulomb, largest",
                    quartiles_of(spent.iloc[int(spent["over_coulomb"].argmax())], "over_coulomb"), 1.2, "at_most",
                    "target of this project; windows that alternate"),
        *(
            Check(f"wall of exponent 1.5, {name}", fallen[key], 0.5, "at_most", "%", "Hertz 1882, closed form")
            for name, key in (
                ("contact time of a rebound", "contact_time_off_percent"),
                ("speed of a rebound", "rebound_off_percent"),
                ("depth at rest", "static_depth_off_percent"),
            )
        ),
    ]  # fmt: skip
    return Outcome(
        tables={"belt": belt, "overpull": pulls, "hertz": pd.DataFrame([fallen]), "cost": spent},
        checks=checks,
        notes=[
            f"The belt: {MASS:.0f} kg on {SPRING:.0f} N/m, pressed with {PRESSED / 1e3:.0f} kN, at {BELT:g} m/s; "
            f"factors {STATIC} and {KINETIC}, decay speed {DECAY:g} m/s. Belt and rebound use the stepper's own kernel "
            "on one body, not a case.",
            f"The slope: 600 m of pipe in a straight hole of {INCLINATION:.0f}°, whose slope of "
            f"{np.tan(np.radians(90 - INCLINATION)):.2f} is below the static factor of 0.4, turned for 5 s and then at "
            f"rest for {QUIET:.0f} s; mud damps its rolling, 50 N·s/m² a metre, which friction does not.",
            "Mud cake: with equal factors every point holds with its full force while those above slide. With a higher "
            "static factor the upper end breaks away before the lower end is pulled, so that less is needed than to "
            "free all of it at once.",
        ],
    )  # fmt: skip


STUDY = Study("sticking", "Does friction that sticks hold without creep, and let go where it should?", run)
