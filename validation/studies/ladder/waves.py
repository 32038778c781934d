"""Rungs of waves: frequencies in torsion and along the string, those of a long segment, the first jump of a start.

Pipe that the mud carries hangs at rest, so that what swings is the mode that is struck alone.
"""

from functools import partial
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import brentq

from fctd import Case
from fctd.mechanics import state
from fctd.simulation.run import Run
from validation.studies.ladder.in_time import completed, moved, ringing, tone
from validation.studies.ladder.rung import GRAVITY, MUD, Rung, Section, Tables, section
from validation.studies.ladder.wells import PIPE, straight, well

LENGTH, ASSEMBLY = 1000.0, 200.0  # of the string and of its collars [m]
CUT_BELOW = 300.0  # [m] of cut pipe between collars and long segment
CARRIED: dict[str, Any] = {"density": MUD * (1 + 1e-9)}
COLLAR: dict[str, Any] = {
    "name": "drill collar", "outer_diameter": 0.165, "inner_diameter": 0.0714, "linear_mass": 136.0, **CARRIED,
}  # fmt: skip
PERIODS, PER_PERIOD = 24, 24  # of a mode: how long it is read, and readings in one
JUMP, RAMP = 0.5, 0.1  # speed of the start [m/s], reached within [s]


class Kind(NamedTuple):
    """A kind of wave: stiffness and inertia of a section, and the row of the state with its speed."""

    stiffness: str
    inertia: str
    speed: int

    def of(self, part: Section) -> tuple[float, float]:
        """Speed of a wave [m/s] and impedance of a section."""
        k, m = getattr(part, self.stiffness), getattr(part, self.inertia)
        return float(np.sqrt(k / m)), float(np.sqrt(k * m))


TORSION, AXIAL = Kind("GJ", "inertia", state.WZ), Kind("EA", "mass", state.VZ)


def hanging(cut: float, long: bool = False) -> Tables:
    """Collars below pipe, in a vertical hole without wall; ``long`` : pipe above CUT_BELOW is one long segment."""
    collar = {**COLLAR, "length": ASSEMBLY, "segment_length": cut}
    pipe = {**PIPE, "linear_mass": 27.0, **CARRIED}
    cut_pipe = {**pipe, "segment_length": cut}
    string = [collar, {**cut_pipe, "length": CUT_BELOW}, {**pipe, "segments": 1}] if long else [collar, cut_pipe]
    turning = {"kind": "rotate_off_bottom", "at_md": LENGTH, "duration": 1.0, "rpm": 10.0, "ramp_time": 0.5}
    tables = well(straight(LENGTH, 0.0), string, contact={"enabled": False}, operations=[turning], rig={})
    return {**tables, "mud": {"density": MUD, "viscosity": 0.0}}


def frequency(kind: Kind, mode: int, case: Case) -> float:
    """ω [rad/s] of a mode, counted from 1: Z₁ cos(ωL₁/c₁) cos(ωL₂/c₂) = Z₂ sin(ωL₁/c₁) sin(ωL₂/c₂)."""
    (above, first), (below, second) = kind.of(section(case, 1)), kind.of(section(case, 0))

    def balance(w: float) -> float:
        up, down = w * (LENGTH - ASSEMBLY) / above, w * ASSEMBLY / below
        return float(first * np.cos(up) * np.cos(down) - second * np.sin(up) * np.sin(down))

    grid = np.linspace(1e-3, (mode + 1) * np.pi * above / LENGTH, 400 * (mode + 1))
    signs = np.sign([balance(w) for w in grid])
    k = np.flatnonzero(np.diff(signs))[mode - 1]
    return float(brentq(balance, grid[k], grid[k + 1], xtol=1e-12))


def squared(kind: Kind, mode: int, case: Case) -> float:
    """ω² [rad²/s²], which is in proportion to stiffness over inertia."""
    return frequency(kind, mode, case) ** 2


def swinging(kind: Kind, mode: int, case: Case) -> float:
    """The same of the string, struck with the speeds of its mode."""
    w = frequency(kind, mode, case)
    above, below = (kind.of(section(case, k))[0] for k in (1, 0))

    def strike(run: Run) -> None:
        md = np.cumsum(run.string.length) - 0.5 * run.string.length
        upper = np.sin(w * md / above) / np.sin(w * (LENGTH - ASSEMBLY) / above)
        lower = np.cos(w * (LENGTH - md) / below) / np.cos(w * ASSEMBLY / below)
        shape = np.where(md < LENGTH - ASSEMBLY, upper, lower)
        state.row(run.S, kind.speed, run.segments)[:] = 1e-3 * shape / np.abs(shape).max()

    sample = 2 * np.pi / w / PER_PERIOD
    readings = ringing(
        case, strike, lambda run: float(run.S[kind.speed + run.segments]), PERIODS * PER_PERIOD * sample, sample
    )
    return tone(readings, sample, w) ** 2


def started(cut: float) -> Tables:
    """Pipe that is picked up with a jerk, so short that no wave has come back from the bit."""
    pipe = {**PIPE, "linear_mass": 27.0, "segment_length": cut}
    up = moved("trip_out", LENGTH - 1.0, 0.4, JUMP, ramp_time=RAMP)
    return well(straight(LENGTH, 0.0), [pipe], contact={"enabled": False}, operations=up, record={"interval": 0.01},
                mud={"density": MUD, "viscosity": 0})  # fmt: skip


def jumped(case: Case) -> float:
    """Hook load beyond the weight [N], from the end of the ramp until the wave comes back."""
    history, pipe = completed(case).history, section(case)
    part = history[history["time_s"].between(RAMP + 0.05, 0.9 * 2 * LENGTH / AXIAL.of(pipe)[0])]
    hanging = pipe.weight * part["bit_depth_m"] + pipe.mass * GRAVITY * part["block_position_m"]
    return float((part["hookload_N"] - hanging).mean())


def jump(case: Case) -> float:
    """A √(Eρ) v [N]."""
    return AXIAL.of(section(case))[1] * JUMP


def modes(kind: Kind, numbers: tuple[int, ...], **keys: Any) -> list[Rung]:
    """A rung for each of these modes of a string that is cut throughout."""
    name = "torsional" if kind is TORSION else "axial"
    formula = "J_p cos cos = J_c sin sin (Rice)" if kind is TORSION else "the same with A√(Eρ) for J"
    return [
        Rung(
            f"{name} frequency {mode}, squared", f"{formula}, squared", hanging, partial(squared, kind, mode),
            {"stepper": partial(swinging, kind, mode)}, "rad²/s²", (7.3, 5.0), bound=0.5, **keys,
        )
        for mode in numbers
    ]  # fmt: skip


def long_modes(kind: Kind) -> list[Rung]:
    """Frequencies 1 to 4 of a string whose upper half is one long segment, at 1 %."""
    name = "torsional" if kind is TORSION else "axial"
    return [
        Rung(
            f"long segment, {name} frequency {mode}", "that of the string cut throughout", partial(hanging, long=True),
            partial(frequency, kind, mode),
            {"stepper": partial(lambda mode, case: float(np.sqrt(swinging(kind, mode, case))), mode)}, "rad/s",
            (7.3, 5.0),
        )
        for mode in (1, 2, 3, 4)
    ]  # fmt: skip


ORDERED: dict[str, Any] = {"refined": (40.0, 20.0, 10.0), "order": (1.7, 2.3)}
RUNGS = [
    *modes(TORSION, (1,)),
    *modes(TORSION, (3,), **ORDERED),
    *modes(AXIAL, (1,)),
    *modes(AXIAL, (3,), **ORDERED),
    *long_modes(TORSION),
    *long_modes(AXIAL),
    Rung("first jump of a start", "A √(Eρ) v", started, jump, {"stepper": jumped}, "N", (7.3, 5.0), bound=0.4),
]
