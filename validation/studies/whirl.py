"""Whirl of a collar: its critical speed, backward rolling whirl and impact, against planar rotors."""

from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from fctd import Case, Simulation, equilibrium, simulate
from fctd.arrays import Array
from fctd.mechanics import state
from fctd.model.mud import added_mass
from fctd.model.section import section_of
from validation.cases import rotation
from validation.harness.study import Check, Context, Outcome, Study

COLLAR = {"name": "collar", "outer_diameter": 0.165, "inner_diameter": 0.0714}
HOLE, BIT = 0.2159, 0.2157  # [m]: of the hole, and of the bit that centres the collar's lower end
MUD = 1200.0  # [kg/m³]
TOP = 100.0  # [m], in vertical hole
LENGTH, BIT_LENGTH, ECCENTRICITY = 24.0, 0.3, 1e-3  # [m] of the stabilised collar
# Length of its segments [m] and of its runs [s].
FINE, QUICK = (1.0, 150.0), (1.5, 60.0)
DAMPING = 20.0  # [N s/m²], under which its transient dies in a minute and a half
# Of the critical speed: nearer to it the first mode alone counts.
SHARES, QUICK_SHARES = (0.85, 0.9, 0.95), (0.9, 0.95)
ROLLING, FRICTION, ROLLING_RPM = 10.0, 0.5, 60.0  # [m] of a single body, factor, [rev/min]
KICK = 1.0  # [m/s] sideways, of its lower end
WALL, WALL_DAMPING = 1e8, 1e5  # [N/m], [N s/m]: so stiff that a whirling body goes into it by 0.2 % of its clearance
ELEMENTS = 40
CASING = {"name": "13 3/8 in casing", "outer_diameter": 0.3397, "inner_diameter": 0.3153, "segment_length": 25.0}
SETTLED = 1e-4  # [m/s]: wall speed at which regularised friction is full


def collar_case(operations: list[dict[str, Any]], **more: Any) -> Case:
    """A collar below a top drive in vertical hole."""
    interval = {"to_md": TOP + 100, "diameter": HOLE, "friction": more.pop("friction", 0.0), "stiffness": WALL}
    return Case.model_validate(
        {
            "name": "collar", "wellbore": {"stations": [[0, 0, 0], [TOP + 100, 0, 0]], "intervals": [interval]},
            "string": {"top_md": TOP, "components": more.pop("components")}, "operations": operations, **more,
        }
    )  # fmt: skip


def stabilised(rpm: float, segment: float, seconds: float) -> float:
    """Radius [m] of the whirl of an unbalanced collar at its middle, which is centred at its lower end by a bit."""
    bit = COLLAR | {"name": "bit", "length": BIT_LENGTH, "segments": 1, "contact_diameter": BIT}
    part = COLLAR | {"length": LENGTH, "segment_length": segment, "eccentricity": ECCENTRICITY}
    case = collar_case(
        rotation(TOP + LENGTH + BIT_LENGTH, seconds, ramp=5.0, rpm=rpm), components=[bit, part],
        mud={"density": MUD, "lateral_damping": DAMPING}, record={"interval": 0.5},
    )  # fmt: skip
    simulation, radii = Simulation(case), []
    for record in simulation:
        if record["time_s"] > seconds - 2.0:
            j = simulation.run.segments // 2
            radii.append(np.hypot(simulation.run.S[state.X + j], simulation.run.S[state.Y + j]))
    return float(np.mean(radii))


def rotor_speed() -> float:
    """Critical speed [rad/s] of a planar rotor: a beam in tension, clamped at its top and pinned at the bit.

    Hermite elements with the mass of the collar and of the mud that moves with it.
    """
    section = section_of(collar_case([], components=[COLLAR | {"length": 1.0}]).string.components[0], MUD)
    mass = section.mass + float(added_mass(section.outer, section.inner, 0.5 * HOLE, MUD))
    n, h = ELEMENTS, (LENGTH + BIT_LENGTH) / ELEMENTS
    stiff, heavy = np.zeros((2 * n + 2, 2 * n + 2)), np.zeros((2 * n + 2, 2 * n + 2))
    bend = np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2],
                     [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]]) * section.EI / h**3  # fmt: skip
    pull = np.array([[36, 3 * h, -36, 3 * h], [3 * h, 4 * h**2, -3 * h, -(h**2)],
                     [-36, -3 * h, 36, -3 * h], [3 * h, -(h**2), -3 * h, 4 * h**2]]) / (30 * h)  # fmt: skip
    inertia = np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2],
                        [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h**2, -22 * h, 4 * h**2]])  # fmt: skip
    inertia = inertia * mass * h / 420
    for k in range(n):
        at = slice(2 * k, 2 * k + 4)
        tension = section.weight * (n - k - 0.5) * h
        stiff[at, at] += bend + tension * pull
        heavy[at, at] += inertia
    free = [k for k in range(2, 2 * n + 2) if k != 2 * n]  # no deflection and turn at the top, no deflection at the bit
    return float(np.sqrt(eigh(stiff[np.ix_(free, free)], heavy[np.ix_(free, free)], eigvals_only=True)[0]))


def critical_speed(quick: bool) -> pd.DataFrame:
    """Radii at speeds below the critical one, and the speed at which Ω²/radius, linear in Ω², is zero."""
    expected = rotor_speed()
    rows = []
    for share in QUICK_SHARES if quick else SHARES:
        speed = share * expected
        radius = stabilised(speed * 30 / np.pi, *(QUICK if quick else FINE))
        rows.append({"rad_per_s": speed, "radius_mm": 1e3 * radius})
    table = pd.DataFrame(rows)
    slope, offset = np.polyfit(table["rad_per_s"] ** 2, table["rad_per_s"] ** 2 / table["radius_mm"], 1)
    return table.assign(critical_rad_per_s=np.sqrt(-offset / slope), rotor_rad_per_s=expected)


class Rotor(NamedTuple):
    """A body that pivots at its top, seen at its lower end: mass [kg], stiffness [N/m], wall, rotation [rad/s]."""

    mass: float
    stiffness: float
    clearance: float
    wall: float
    wall_damping: float
    friction: float
    radius: float
    spin: float


def rolling_case(seconds: float) -> Case:
    """One body of a collar, clamped at its top by the spring of half its length."""
    return collar_case(
        rotation(TOP + ROLLING, seconds, ramp=1.0, rpm=ROLLING_RPM), friction=FRICTION,
        components=[COLLAR | {"length": ROLLING, "segments": 1}], mud={"density": MUD, "viscosity": 0},
        record={"interval": 0.01}, contact={"damping": WALL_DAMPING},
    )  # fmt: skip


def rotor_of(case: Case) -> Rotor:
    """The planar rotor of the single body: it turns about its upper end, at which the clamp's spring bends it."""
    section = section_of(case.string.components[0], MUD)
    clamp = section.EI / (0.5 * ROLLING)
    return Rotor(
        section.mass / 3 * ROLLING, (clamp + 0.5 * section.weight * ROLLING**2) / ROLLING**2,
        0.5 * HOLE - section.contact_radius, WALL, WALL_DAMPING, FRICTION, section.contact_radius,
        ROLLING_RPM * np.pi / 30,
    )  # fmt: skip


def rotor_motion(rotor: Rotor, seconds: float, step: float) -> Array:
    """Rows of time, place (2) and velocity (2) of the rotor, kicked sideways from the axis."""

    def rates(_: float, at: Array) -> Array:
        place, velocity = at[:2], at[2:]
        distance = float(np.hypot(*place))
        force = -rotor.stiffness * place
        if distance > rotor.clearance:
            out = place / distance
            around = np.array([-out[1], out[0]])
            pressed = rotor.wall * (distance - rotor.clearance) + rotor.wall_damping * float(velocity @ out)
            normal = max(pressed, 0.0)
            sliding = float(velocity @ around) + rotor.radius * rotor.spin
            force = force - normal * out - rotor.friction * normal * np.tanh(sliding / SETTLED / 10) * around
        return np.append(velocity, force / rotor.mass)

    times = np.arange(0.0, seconds, step)
    found = solve_ivp(rates, (0.0, seconds), [0.0, 0.0, KICK, 0.0], "LSODA", times, rtol=1e-7, atol=1e-9, max_step=1e-3)
    return np.column_stack([found.t, found.y.T])


def engine_motion(seconds: float) -> Array:
    """The same of the engine's body, at its contact point; time counts from the kick."""
    start, simulation = 3.0, Simulation(rolling_case(seconds + 3.0))
    rows = []
    for record in simulation:
        S = simulation.run.S
        if abs(record["time_s"] - start) < 1e-6:
            S[state.VX + 1] += 0.5 * KICK
            S[state.WY + 1], S[state.WX + 1] = _turned(S, KICK / ROLLING)
        if record["time_s"] > start - 1e-6:
            place = [S[state.PX + 1], S[state.PY + 1]]
            rows.append([record["time_s"] - start, *place, S[state.VX + 1] * 2, S[state.VY + 1] * 2])
    return np.array(rows)


def _turned(S: Array, rate: float) -> tuple[float, float]:
    """Components about the body's y and x of a spin about the global y axis [rad/s]; the body is all but vertical."""
    w, z = S[state.QW + 1], S[state.QZ + 1]
    angle = 2 * np.arctan2(z, w)
    return rate * np.cos(angle), rate * np.sin(angle)


def whirl_speed(motion: Array, last: float) -> float:
    """Mean angular speed [rad/s] of the place around the axis in the last seconds."""
    late = motion[motion[:, 0] > motion[-1, 0] - last]
    angle = np.unwrap(np.arctan2(late[:, 2], late[:, 1]))
    return float((angle[-1] - angle[0]) / (late[-1, 0] - late[0, 0]))


def rolling(quick: bool) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Speed of rolling whirl by engine, rotor and kinematics; and the paths of both."""
    seconds = 2.0 if quick else 6.0
    rotor = rotor_of(rolling_case(1.0))
    paths = {"FCTD": engine_motion(seconds), "planar rotor": rotor_motion(rotor, seconds, 0.002)}
    kinematic = -rotor.spin * rotor.radius / rotor.clearance
    speeds = {name: whirl_speed(path, 0.5 * seconds) for name, path in paths.items()}
    table = pd.DataFrame({"speed_rad_per_s": {**speeds, "-Ωr/(R-r)": kinematic}}).rename_axis("of").reset_index()
    frames = [
        pd.DataFrame(path, columns=["time_s", "x_m", "y_m", "vx", "vy"]).assign(of=k) for k, path in paths.items()
    ]
    return table, pd.concat(frames, ignore_index=True)


def casing(mud: dict[str, Any]) -> dict[str, float]:
    """Casing in horizontal hole at 120 rev/min, in coarse segments: the end of its run over its steady string."""
    stations = [[0, 0, 0], [240, 0, 0], [684, 90, 0], [3000, 90, 0]]
    case = Case.model_validate(
        {
            "name": "casing", "string": {"components": [CASING]}, "mud": {"density": MUD, **mud},
            "wellbore": {
                "stations": stations, "geometry": "arcs",
                "intervals": [{"to_md": 3000, "diameter": 0.4445, "friction": 0.5}],
            },
            "operations": rotation(3000.0, 60.0, ramp=10.0, rpm=120.0),
        }
    )  # fmt: skip
    result, still = simulate(case), equilibrium(case, "rotate_off_bottom", 3000, rpm=120)
    (row,), end = result.operations.to_dict("records"), result.history.iloc[-5:].mean(numeric_only=True)
    return {
        "hook_load_kN": row["hookload_mean_N"] / 1e3,
        "hook_load_off_percent": 100 * (row["hookload_mean_N"] / still.hookload - 1),
        "torque_off_percent": 100 * (row["surface_torque_mean_N_m"] / still.surface_torque - 1),
        "sideways_over_surface_speed": float(end["lateral_speed_m_s"] / (0.16985 * 4 * np.pi)),
        "sliding_fraction": float(end["sum_r_ft_N_m"] / end["sum_r_mu_fn_N_m"]),
        "notes": float("whirl" in {note.code for note in result.notes}),
    }


def run(context: Context) -> Outcome:
    """Critical speed, rolling whirl, and a casing that whirls without the mud's damping."""
    speeds, (rolled, paths) = critical_speed(context.quick), rolling(context.quick)
    cases = pd.DataFrame({name: casing(mud) for name, mud in (("without damping", {"viscosity": 0}), ("in mud", {}))}).T
    engine, rotor, kinematic = rolled["speed_rad_per_s"]
    critical = float(speeds["critical_rad_per_s"].iloc[0] / speeds["rotor_rad_per_s"].iloc[0])
    whirling = float(cases["sideways_over_surface_speed"].iloc[0])
    pull_off, torque_off = (float(abs(cases[f"{load}_off_percent"].iloc[1])) for load in ("hook_load", "torque"))
    return Outcome(
        tables={"critical_speed": speeds, "rolling": rolled, "paths": paths,
                "casing": cases.rename_axis("casing").reset_index()},
        checks=[
            Check("critical speed of a stabilised collar over that of the planar rotor", critical, (0.99, 1.01),
                  "within", "", "beam in tension, clamped and pinned, with the mud that moves along"),
            Check("speed of rolling whirl over that of the planar rotor", engine / rotor, (0.99, 1.01), "within", "",
                  "scipy's LSODA, regularised friction"),
            Check("speed of rolling whirl over −Ωr/(R − r)", engine / kinematic, (0.99, 1.01), "within", "",
                  "rolling without sliding"),
            Check("sideways speed over surface speed of a casing without damping",
                  whirling, 0.5, "at_least", "", "rolling whirl has 1"),
            Check("hook load of the casing in mud, off the steady string", pull_off,
                  0.1, "at_most", "%", "the mud's damping holds the string"),
            Check("torque of the casing in mud, off the steady string", torque_off,
                  0.1, "at_most", "%", "mean over whole torsional periods"),
        ],
        notes=[
            "The critical speed is that at which Ω² over the radius of forward whirl, a straight line in Ω², is zero: "
            "an unbalanced collar turns with radius e Ω²/(ω² − Ω²), apart from the share of its first mode.",
            "The body of the rolling whirl is kicked sideways from the axis, strikes the wall, and rolls backwards.",
        ],
        display={
            "critical_speed": "Radius of forward whirl at the middle of an unbalanced collar",
            "rolling": "Speed of backward rolling whirl",
            "casing": "13⅜ in casing in 17½ in hole, friction factor 0.5, 120 rev/min, in segments of 25 m",
        },
    )  # fmt: skip


STUDY = Study("whirl", "Does a collar whirl as a planar rotor does, and does mud hold a string that would whirl?", run)
