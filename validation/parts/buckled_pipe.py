"""A drill pipe under compression in its hole, laid in a given shape, and what its buckled shape measures."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from fctd import Case
from fctd.arrays import Array
from fctd.case.string import ComponentSpec
from fctd.mechanics import state
from fctd.mechanics.rotations import rotation_columns
from fctd.model.frames import hole_frame
from fctd.model.operations import steady_rates
from fctd.model.section import section_of
from fctd.steady.continuation import CONVERGED
from fctd.steady.equilibrium import Solver
from fctd.steady.first_guess import MD, OFFSET, TENSION
from fctd.steady.pose import PLACE, QUATERNION
from fctd.steady.relaxation import Creep
from fctd.steady.steady_string import Equilibrium
from references.beams.cosserat import Bit, rest
from references.buckling.onset import Pipe

Along = Callable[[Array], Array]

# 5 in pipe in 8½ in hole.
PIPE: dict[str, Any] = {"name": "pipe", "outer_diameter": 0.127, "inner_diameter": 0.1086}
HOLE, MUD = 0.2159, 1200.0  # [m], [kg/m³]
SECTION = section_of(ComponentSpec.model_validate({**PIPE, "segments": 1}), MUD)
BUCKLING = Pipe(SECTION.EI, SECTION.weight, 0.5 * (HOLE - PIPE["outer_diameter"]))
WALL = 2e7  # [N/m/m]: some 0.05 % of the clearance under the weight, 0.5 % under ten times that
BELOW_SURFACE = 60.0  # [m] of hole above the rig
OPERATION = "drill_sliding"
CREEP = Creep(3000, 0.05, 1.15, 0.5, 0.6, 0.04, 0.1, 0.0, 0.0)  # the last two are the problem's
# Of the rod: damping [1/s], largest unbalanced force over the weight, simulated time at most [s].
ROD_DAMPING, ROD_TOLERANCE, ROD_LONGEST = 5.0, 1e-4, 60.0
# Share of the pipe at either end in which its shape is that of the ends.
ENDS = 0.25


class UnsettledError(RuntimeError):
    """The pipe found no balance."""


class Rig:
    """A pipe clamped on the axis of its hole at the top and pushed at its lower end, which slides down the hole.

    length, segment [m]; stations : (md, inclination, azimuth) [m, deg] from the rig's top on, by default a level hole;
    friction : factor, or factors of stretches that end at depths [m] below the rig's top;
    held : a bit as wide as the hole holds the lower end on the axis, without a moment; otherwise it lies on the wall;
    hole : diameter [m]; ``pipe`` is the pipe with its clearance.
    """

    def __init__(
        self,
        length: float,
        segment: float,
        stations: list[tuple[float, float, float]] | None = None,
        friction: float | list[tuple[float, float]] = 0.0,
        held: bool = True,
        wall: float = WALL,
        hole: float = HOLE,
    ) -> None:
        stations = stations or [(0.0, 90.0, 0.0), (length, 90.0, 0.0)]
        above = (0.0, *stations[0][1:])
        shifted = [above, *((md + BELOW_SURFACE, inc, azi) for md, inc, azi in stations)]
        stretches = friction if isinstance(friction, list) else [(length, friction)]
        bit = [{**PIPE, "name": "bit", "length": 0.5 * segment, "segments": 1, "contact_diameter": hole}]
        string = {**PIPE, "length": length + 1.0, "segment_length": segment}
        self.length, self.segment, self.wall, self.diameter = length, segment, wall, hole
        self.pipe = BUCKLING._replace(clearance=0.5 * (hole - PIPE["outer_diameter"]))
        self.case = Case.model_validate(
            {
                "name": "buckled pipe",
                "wellbore": {
                    "stations": [list(station) for station in shifted],
                    "survey_method": "minimum_curvature",
                    "geometry": "arcs",
                    "stiffness_per_length": wall,
                    "intervals": [
                        {"to_md": BELOW_SURFACE + to, "diameter": hole, "friction": mu} for to, mu in stretches
                    ],
                },
                "string": {"top_md": BELOW_SURFACE, "components": [*(bit if held else []), string]},
                "mud": {"density": MUD, "viscosity": 0},
                "rig": {"block_weight": 1e9},  # it pushes as much as the pipe needs
            }
        )
        self.solver = Solver(self.case)
        self.problem = self.solver.problem(
            OPERATION, steady_rates(self.case, OPERATION, None, None), self.solver.lay_out(BELOW_SURFACE + length)
        )
        # Friction at the pipe's surface turns a helix about the hole's axis for ever; the closed forms have it act at
        # the pipe's axis.
        self.problem.at_axis = 1

    def lay_straight(self, force: float) -> None:
        """Lay the pipe on the side of the hole that a soft string presses on, with a compression [N] at its end."""
        self.problem.weight_on_bit = force
        self.problem.lay_guess()

    def lay(self, force: float, angle: Along, compression: Along | None = None) -> None:
        """Lay the pipe on the wall.

        angle [rad] : from the low side (in a vertical hole, from south), clockwise looking uphole; compression [N],
        by default that of a soft string; both at distances from the lower end [m].
        """
        self.lay_straight(force)
        nodes = self.problem.work.G[: self.problem.n + 1]
        md = nodes[:, MD].copy()
        above = np.maximum(BELOW_SURFACE + self.length - md, 0.0)
        if compression is not None:
            nodes[:, TENSION] = -compression(above)
        high, right = hole_frame(self.solver.hole.at(md)[1])
        at = angle(above)[:, None]
        # The ends come off the wall within half a wave.
        room = np.minimum(1.0, np.minimum(md - md[0], above) / (1.5 * self.pipe.wave))[:, None]
        nodes[:, OFFSET : OFFSET + 3] = self.pipe.clearance * room * (np.sin(at) * right - np.cos(at) * high)
        self.problem.lay_nodes()

    def wind(self, force: float, compression: Along | None = None) -> None:
        """Lay the pipe as a helix θ' = √(F/2EI); arguments as in ``lay``."""
        self.lay_straight(force)
        nodes = self.problem.work.G[self.problem.n :: -1]
        above = BELOW_SURFACE + self.length - nodes[:, MD]
        forces = -nodes[:, TENSION] if compression is None else compression(above)
        rate = np.sqrt(np.maximum(forces, 0.0) / (2 * BUCKLING.EI))
        angle = np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(above))])
        self.lay(force, lambda at: np.interp(at, above, angle), compression)

    def nodes(self, elements: int) -> Array:
        """Points (elements + 1, 3) [m] at equal distances along the pipe as it lies."""
        S, P, n = self.problem.work.S, self.problem.work.P, self.problem.n
        axes = np.array([rotation_columns(*P[j, QUATERNION])[6:] for j in range(1, n + 1)])
        lower = P[1 : n + 1, PLACE] + state.row(S, state.ARM_BOTTOM, n)[:, None] * axes
        ends = np.vstack([P[:1, PLACE], lower])
        along = np.insert(np.cumsum(self.problem.string.length), 0, 0.0)
        even = np.linspace(0, along[-1], elements + 1)
        return np.stack([np.interp(even, along, ends[:, k]) for k in range(3)], axis=1)

    def settle(self, force: float) -> Equilibrium:
        """The balance that the pipe finds from its pose under a compression [N] at its lower end.

        Raises UnsettledError.
        """
        problem = self.problem
        problem.weight_on_bit = force
        code, iterations = problem.relax(CREEP._replace(force=problem.allowed, moment=problem.allowed))
        if code != CONVERGED:
            raise UnsettledError(
                f"no balance at {force / self.pipe.onset:.4g} times the onset, {iterations} iterations"
            )
        return self.solver.answer(problem, code, iterations, problem.unstable_modes(), "relaxed")

    def rest_as_rod(self, force: float) -> pd.DataFrame:
        """The rows of a profile of PyElastica's rod, with elements as long as segments, relaxed from the pose."""
        count, hole = round(self.length / self.segment), self.solver.hole
        rod = rest(
            hole, SECTION, BELOW_SURFACE, BELOW_SURFACE + self.length, count, self.wall, ROD_DAMPING, ROD_TOLERANCE,
            ROD_LONGEST, Bit(force, 0.5 * self.diameter), self.nodes(count),
        )  # fmt: skip
        walls = hole.walls(rod.nodes)
        high, right = hole_frame(hole.at(walls.md)[1])
        return pd.DataFrame(
            {
                "md_m": walls.md,
                "offset_high_m": (walls.offset * high).sum(axis=1),
                "offset_right_m": (walls.offset * right).sum(axis=1),
                "contact_force_N": np.linalg.norm(rod.wall_force, axis=1),
            }
        )

    def onset(self, expected: float) -> tuple[float, float]:
        """Compression at the lower end at which the straight pipe becomes unstable [N], by bisection to 0.05 %.

        Also the largest compression in the pipe over that at the lower end.
        """
        low, high = 0.8 * expected, 1.2 * expected
        self.lay_straight(low)
        point = self.settle(low)
        if self.problem.unstable_modes():
            raise UnsettledError("the pipe buckles below the first force")
        while high - low > 5e-4 * expected:
            straight, force = self.problem.copy_pose(), 0.5 * (low + high)
            found = self.settle(force)
            if self.problem.unstable_modes():
                self.problem.put_pose(straight)
                high = force
            else:
                point, low = found, force
        return 0.5 * (low + high), -float(point.profile["effective_tension_N"].min()) / low

    def shortening(self, point: Equilibrium) -> float:
        """How far buckling has moved the lower end of a pipe without friction up a vertical hole [m]."""
        length = self.problem.string.length
        above = np.cumsum(length[::-1])[::-1] - 0.5 * length
        compression = self.problem.weight_on_bit - BUCKLING.weight * above
        S, n = self.problem.work.S, self.problem.n
        unloaded = state.row(S, state.ARM_TOP, n) + state.row(S, state.ARM_BOTTOM, n)  # in the mud, which presses on it
        straight = float((unloaded * (1 - compression / SECTION.EA)).sum())
        return BELOW_SURFACE + straight - float(point.profile["md_m"].iloc[-1])


class Wave(NamedTuple):
    """Snaking: amplitude [deg], half wave [m], mean wall force [N/m]."""

    amplitude: float
    half_wave: float
    wall_force: float


class Turns(NamedTuple):
    """Helix: length of a turn [m], mean wall force [N/m], mean bending moment [N m]."""

    pitch: float
    wall_force: float
    moment: float


def middle(profile: pd.DataFrame, ends: float = ENDS) -> pd.DataFrame:
    """The part of a profile away from the ends, with the angle from the low side [deg] as ``angle_deg``."""
    md = profile["md_m"]
    share = (md - md.iloc[0]) / (md.iloc[-1] - md.iloc[0])
    part: pd.DataFrame = profile[share.between(ends, 1 - ends)]
    angle = np.degrees(np.arctan2(part["offset_right_m"], -part["offset_high_m"]))
    return part.assign(angle_deg=angle)


def wave_of(profile: pd.DataFrame) -> Wave | None:
    """Measure snaking between its first and last passage of the low side; None with fewer than three passages."""
    part = middle(profile)
    md, angle = part["md_m"].to_numpy(), part["angle_deg"].to_numpy()
    # Turning points, each by a parabola through three contact points.
    before, at, after = np.abs(angle[:-2]), np.abs(angle[1:-1]), np.abs(angle[2:])
    top = (at > before) & (at >= after)
    peaks = at[top] + (after[top] - before[top]) ** 2 / (8 * (2 * at[top] - before[top] - after[top]))
    k = np.flatnonzero(np.diff(np.sign(angle)))
    if len(k) < 3 or len(peaks) < 2:
        return None
    crossings = md[k] - angle[k] * (md[k + 1] - md[k]) / (angle[k + 1] - angle[k])
    force = _wall_force(part, crossings[0], crossings[-1])
    return Wave(float(peaks.mean()), float(np.diff(crossings).mean()), force)


def turns_of(profile: pd.DataFrame) -> Turns | None:
    """Measure a helix over whole turns; None with fewer than two."""
    part = middle(profile)
    md, angle = part["md_m"].to_numpy(), np.unwrap(np.radians(part["angle_deg"])) / (2 * np.pi)
    angle = angle if angle[-1] > angle[0] else -angle
    whole = np.arange(np.ceil(angle[0]), np.floor(angle[-1]) + 1)
    if len(whole) < 3 or (np.diff(angle) <= 0).any():
        return None
    low = np.interp(whole, angle, md)
    force = _wall_force(part, low[0], low[-1])
    inside = (md > low[0]) & (md <= low[-1])
    moment = float(part["bending_moment_N_m"].to_numpy()[inside].mean())
    return Turns(float((low[-1] - low[0]) / (len(whole) - 1)), force, moment)


def energy(rig: Rig, point: Equilibrium) -> float:
    """Energy of pipe, wall, weight and force at the lower end [J], less a constant of the rig and the force."""
    profile, force = point.profile.iloc[1:], rig.problem.weight_on_bit
    length = rig.problem.string.length
    bending = (profile["bending_moment_N_m"] ** 2 * length).sum() / (2 * SECTION.EI)
    axial = (profile["effective_tension_N"] ** 2 * length).sum() / (2 * SECTION.EA)
    wall = (profile["contact_force_N"] ** 2 / length).sum() / (2 * WALL)
    lifted = SECTION.weight * (profile["offset_high_m"] * length).sum()
    return float(bending + axial + wall + lifted + force * profile["md_m"].iloc[-1])


def _wall_force(part: pd.DataFrame, start: float, end: float) -> float:
    """Mean wall force [N/m] between two depths [m]."""
    inside = part["md_m"].between(start, end, inclusive="right")
    return float(part.loc[inside, "contact_force_N"].sum() / (end - start))
