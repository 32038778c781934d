"""Stick-slip of a bit whose torque falls with its speed: thresholds against an ODE, and against linear stability."""

import math
from collections.abc import Callable

import numpy as np
import pandas as pd
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from fctd import Case
from fctd.arrays import Array
from fctd.model.operations import rad_per_s
from fctd.model.section import section_of
from fctd.simulation.preparation import prepare
from validation.harness.study import Check, Context, Outcome, Study
from validation.parts.swinging_bit import RAMP, SAMPLE, bit_spin, growth, threshold

ASSEMBLY = 200.0  # length of the collars [m]
PIPE = {"name": "pipe", "outer_diameter": 0.127, "inner_diameter": 0.1086}
COLLAR = {"name": "drill collar", "length": ASSEMBLY, "outer_diameter": 0.165, "inner_diameter": 0.0714, "segments": 1}
DEPTH = 2000.0  # [m]
MUD = 0.05  # rotational damping [N s]
TORQUE_OF_WEIGHT = 0.04  # torque of the bit at speed over its weight [m], that of the default drag bit at 100 kN
WEAKENING, DECAY = 1.0, 60.0  # torque at rest over that at speed, less 1; [rev/min]
SEGMENT, QUICK_SEGMENT = 20.0, 40.0  # of the continuous string [m]
DRIVES = ("stiff", "speed_control", "impedance")
TWO_DISCS, SLOW = 146.0, 70.0  # where the threshold of two discs is sought; a rotation with stick-slip [rev/min]
CREEP = 1e-2  # of the ODE's bit below the torque at rest [rad/s]


def the_case(weight: float, rpm: float, drive: str, segments: float | None = None) -> Case:
    """A vertical string in an open hole with given bit loads; ``segments`` [m] : of the pipe, by default one."""
    cut = {"segments": 1} if segments is None else {"segment_length": segments}
    interval = {"to_md": DEPTH + 10, "diameter": 0.2159, "friction": 0.0}
    rock = {"law": "given", "weakening": WEAKENING, "weakening_rpm": DECAY}
    return Case.model_validate(
        {
            "name": "stick-slip",
            "wellbore": {"stations": [[0, 0, 0], [DEPTH + 10, 0, 0]], "intervals": [interval]},
            "string": {"components": [COLLAR, {**PIPE, **cut}]},
            "mud": {"density": 1200.0, "rotational_damping": MUD},
            "contact": {"enabled": False},
            "rig": {"drive": drive},
            "bit": {"weight_on_bit": weight, "torque": TORQUE_OF_WEIGHT * weight, "rock": rock},
            "operations": [{"kind": "drill_rotating", "from_md": DEPTH, "to_md": DEPTH + 1, "speed": 0.01, "rpm": rpm}],
        }
    )


def ramp(at: float, start: float, duration: float = RAMP) -> float:
    """The smooth step of ``stages``, from 0 to 1."""
    u = min(max((at - start) / duration, 0.0), 1.0)
    return u * u * (3 - 2 * u)


def by_ode(weight: float, rpm: float, hold: float, tolerance: float) -> tuple[Array, Array]:
    """The same by scipy for two discs below a stiff drive: half of the pipe's inertia, and the collars on the bit.

    tolerance : of LSODA, relative; it turns implicit where the bit sticks.
    """
    collar, pipe = (section_of(part, 0.0) for part in the_case(weight, rpm, "stiff").string.components)
    long, short = DEPTH - ASSEMBLY, ASSEMBLY
    heavy, light = short * collar.axial_inertia, 0.5 * long * pipe.axial_inertia
    drag, drag_above = MUD * short, 0.5 * MUD * long
    spring, spring_above = 2 * collar.GJ / short, pipe.GJ / long
    damping = 1e-5  # [s], the default joint damping of a case
    planned, decay, torque = rad_per_s(rpm), rad_per_s(DECAY), TORQUE_OF_WEIGHT * weight

    def rates(t: float, y: Array) -> list[float]:
        twist_above, twist, spin_above, spin = y.tolist()
        slip = planned * (2 * ramp(t, 0.0) - ramp(t, 2 * RAMP, 2 * RAMP)) - spin_above
        below = spin - spin_above
        joint_above = spring_above * (twist_above - damping * slip)
        joint = spring * (twist + damping * below)
        law = torque * ramp(t, RAMP) * (1 + WEAKENING * math.exp(-abs(spin) / decay)) * math.tanh(spin / CREEP)
        return [
            -slip,
            below,
            (joint - joint_above - drag_above * spin_above) / light,
            (-joint - law - drag * spin) / heavy,
        ]

    time = np.arange(4 * RAMP + SAMPLE, 4 * RAMP + hold, SAMPLE)
    found = solve_ivp(rates, (0.0, time[-1]), np.zeros(4), "LSODA", time, rtol=tolerance, atol=1e-10)
    return found.t, found.y[3]


def cycle_of(time: Array, spin: Array) -> float:
    """Period [s] of stick-slip: mean time between two break-aways, where the spin rises through half of its peak."""
    half = 0.5 * spin.max()
    k = np.flatnonzero((spin[:-1] < half) & (spin[1:] >= half))
    at = time[k] + (half - spin[k]) / (spin[k + 1] - spin[k]) * np.diff(time)[k]
    return float((at[-1] - at[0]) / (len(at) - 1))


def predicted(weight: float, drive: str) -> float:
    """Threshold [rev/min] of the continuous string: above it, |r_top r_bit| exp(−2αL) < 1 at every mode.

    A mode is a frequency at which a wave comes back in phase from the way to the bit and to the top.  Impedance ζ and
    attenuation α of the pipe are those in its mud.
    """
    run, phases = prepare(the_case(weight, 100.0, drive, SEGMENT))
    collar, pipe = run.string.sections[:2]
    long, short = DEPTH - ASSEMBLY, ASSEMBLY
    w = np.linspace(0.02, 30.0, 6_000)
    at_top = np.ones(len(w), complex)
    inert = pipe.axial_inertia + MUD / (1j * w)
    zeta, wave = np.sqrt(inert * pipe.GJ), 1j * w * np.sqrt(inert / pipe.GJ)
    if drive != "stiff":
        of = phases[0].motion.drive
        impedance = of.proportional + 1j * w * of.apparent + of.integral / (1j * w)
        at_top = (impedance - zeta) / (impedance + zeta)
    decay, torque = rad_per_s(DECAY), TORQUE_OF_WEIGHT * weight
    inertia, compliance = short * collar.axial_inertia, 0.5 * short / collar.GJ

    def excess(rpm: float) -> float:
        slope = -torque * WEAKENING / decay * np.exp(-rad_per_s(rpm) / decay)
        bit = 1j * w * inertia + slope + MUD * short
        bit = bit / (1 + 1j * w * compliance * bit)
        loop = at_top * (bit - zeta) / (bit + zeta) * np.exp(-2 * wave * long)
        turns = np.unwrap(np.angle(loop)) / (2 * np.pi)
        modes = np.flatnonzero(np.floor(turns[:-1]) != np.floor(turns[1:]))
        return float(np.log(np.abs(loop[modes])).max())

    rpm = np.arange(300.0, 5.0, -2.0)
    last = next(k for k, at in enumerate(rpm) if excess(at) > 0)
    return float(brentq(excess, rpm[last], rpm[last - 1], rtol=1e-6))


def run(context: Context) -> Outcome:
    """Thresholds of two discs by engine and ODE; of a continuous string by engine and linear stability; one cycle."""
    hold, segment = (40.0, QUICK_SEGMENT) if context.quick else (80.0, SEGMENT)
    weights = (100e3,) if context.quick else (75e3, 100e3, 150e3)

    def by_engine(weight: float, drive: str, segments: float | None) -> Callable[[float], float]:
        return lambda rpm: growth(*bit_spin(the_case(weight, rpm, drive, segments), hold), rpm)

    discs = threshold(by_engine(1e5, "stiff", None), TWO_DISCS)
    ode = threshold(lambda rpm: growth(*by_ode(1e5, rpm, hold, 1e-8), rpm), TWO_DISCS)
    rows = []
    for weight in weights:
        for drive in DRIVES:
            guess, rate = predicted(weight, drive), by_engine(weight, drive, segment)
            found = threshold(rate, guess)
            rows.append(
                {
                    "weight_on_bit_kN": weight / 1e3,
                    "drive": drive,
                    "linear_rpm": guess,
                    "engine_rpm": found,
                    "off_percent": 100 * abs(found / guess - 1),
                    "growth_below_per_s": rate(0.9 * guess),
                    "growth_above_per_s": rate(1.1 * guess),
                }
            )
    table = pd.DataFrame(rows)
    wrong = (table["growth_below_per_s"] <= 0) | (table["growth_above_per_s"] >= 0)
    soft = table[table["drive"] == "impedance"]["engine_rpm"].to_numpy()
    stiff = table[table["drive"] == "stiff"]["engine_rpm"].to_numpy()
    time, spin = bit_spin(the_case(1e5, SLOW, "stiff"), hold)
    time_ode, spin_ode = by_ode(1e5, SLOW, hold, 1e-6)
    cycles = pd.concat(
        [
            pd.DataFrame({"time_s": time, "bit_rpm": spin / rad_per_s(1.0), "by": "engine"}),
            pd.DataFrame({"time_s": time_ode, "bit_rpm": spin_ode / rad_per_s(1.0), "by": "ODE"}),
        ]
    )
    late = time > time[-1] - 20.0
    peak, peak_ode = spin[late].max(), spin_ode[time_ode > time[-1] - 20.0].max()
    return Outcome(
        tables={"thresholds": table, "cycles": cycles},
        checks=[
            Check("threshold of two discs, engine against ODE", 100 * abs(discs / ode - 1), 3.0, "at_most", "%",
                  "scipy's LSODA; target of this project"),
            Check("threshold of a continuous string against linear stability, largest difference",
                  float(table["off_percent"].max()), 3.0, "at_most", "%", "reflection at top and bit"),
            Check("drives and weights that do not grow 10 % below the threshold and decay 10 % above it",
                  float(wrong.sum()), 0, "at_most", "", "linear stability"),
            Check("threshold with an impedance drive over that with a stiff one, largest", float((soft / stiff).max()),
                  1.0, "at_most", "", "soft torque removes stick-slip"),
            Check("largest spin of the bit in stick-slip, engine against ODE", 100 * abs(peak / peak_ode - 1), 3.0,
                  "at_most", "%", "scipy's LSODA, rest as creep at 0.01 rad/s; target of this project"),
            Check("period of stick-slip, engine against ODE",
                  100 * abs(cycle_of(time, spin) / cycle_of(time_ode, spin_ode) - 1), 3.0, "at_most", "%",
                  "the same"),
            Check("share of the time at which the bit sticks", float((np.abs(spin[late]) < 1e-6).mean()), 0.05,
                  "at_least", "", "stick-slip at half of the threshold"),
        ],
        notes=[
            f"The torque of the bit is {1 + WEAKENING:g} times that at speed at rest, and falls off with "
            f"{DECAY:g} rev/min; the mud's rotational damping is {MUD:g} N s.",
        ],
        display={"thresholds": "Threshold of stick-slip by weight on bit and drive"},
    )  # fmt: skip


STUDY = Study("stick_slip", "When does a bit stick and slip, and what does the drive change?", run)
