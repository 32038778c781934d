"""The subjects of the gate: a fixed workload for every kernel, on one settled, turning string.

The gate compares equal names of two commits, so that changed work or a changed unit needs a new name.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numba import njit

from benchmarks.strings import drilling, tripping
from fctd import Case, load_case
from fctd.mechanics.joints import update_joint_loads
from fctd.mechanics.query import query_walls
from fctd.mechanics.state import OPEN, copy_state
from fctd.mechanics.topdrive import Motion
from fctd.model.operations import steady_rates
from fctd.simulation.preparation import prepare
from fctd.simulation.run import Run
from fctd.simulation.settling import settle, start_from_rest
from fctd.simulation.simulate import Simulation
from fctd.steady.equilibrium import Solver
from fctd.steady.margin_table import limits_of
from fctd.steady.torque_drag import chart_rows
from references.timing import reference_kernel

CASE = Path(__file__).parents[1] / "validation" / "cases" / "curved_chain.toml"
REFERENCE, FREE, CYLINDERS, ARCS = "reference", "step, contact-free", "step, cylinders", "step, arcs"
SEGMENTS = 60
BIT_DEPTH = 2450.0  # [m]
ROTATION = {"kind": "rotate_off_bottom", "at_md": BIT_DEPTH, "duration": 60.0, "rpm": 60.0, "ramp_time": 4.0}
POINTS = 2_000  # per compiled query
SOLVERS = 6  # of a steady depth
JOINTS = 64  # a multiple of the width of packed instructions


@dataclass(frozen=True)
class Subject:
    """The workload of one kernel: a call of ``act`` does ``count`` units of about a millisecond or more in all."""

    act: Callable[[], object]
    count: int


def turning(segments: int, changes: Mapping[str, Any] = {}) -> tuple[Run, Motion]:
    """The curved chain, settled and turning.

    It has turned for 4 s: ahead of the first wave velocities are denormal numbers, which take many times longer.
    """
    case = load_case(CASE, {"string.components[0].segments": segments, "operations": [ROTATION], **changes})
    run, phases = prepare(case)
    settle(run)
    start_from_rest(run)
    run.advance(phases[0].motion, phases[0].motion.duration)
    return run, phases[1].motion


def moving(case: Case) -> tuple[Run, Motion]:
    """A string that has begun the first operation of its case, after its ramp."""
    simulation = Simulation(case)
    simulation.start()
    motion = simulation.phases[1].motion
    simulation.run.advance(motion, 2.0)
    return simulation.run, motion


@njit(error_model="numpy", cache=True)
def joint_loads(S, n, count):  # type: ignore[no-untyped-def]
    """The packed joint loads alone, springs and damping."""
    for _ in range(count):
        update_joint_loads(S, n, 1e-5, 1e-3)


def subjects() -> dict[str, Subject]:
    """All subjects, the reference kernel first."""
    touching, motion = turning(SEGMENTS)
    free = replace(
        touching,
        S=copy_state(touching.S),
        top=touching.top.copy(),
        owner=touching.owner.copy(),
        laws=touching.laws._replace(geometry=OPEN),
    )
    arcs, _ = turning(SEGMENTS, {"wellbore.geometry": "arcs"})
    return {
        REFERENCE: _reference(2_000),
        FREE: _steps(free, motion, 1_000),
        CYLINDERS: _steps(touching, motion, 1_000),
        ARCS: _steps(arcs, motion, 1_000),
        "joint loads": _joints(copy_state(touching.S), 3_000),
        "query, cylinders": _query(touching, 60),
        "query, arcs": _query(arcs, 20),
        "step, tripping": _steps(*moving(tripping()), 200),
        "step, drilling": _steps(*moving(drilling()), 200),
        "steady depth": _steady(touching),
        "chart row": _chart(touching),
        "limits": _limits(touching),
    }


def _reference(passes: int) -> Subject:
    """A column of the reference kernel."""
    S = reference_kernel.new_buffer()
    return Subject(lambda: reference_kernel.reference_kernel(S, passes), passes * reference_kernel.COLUMNS)


def _steps(run: Run, motion: Motion, count: int) -> Subject:
    """A step of a segment."""
    return Subject(lambda: run.advance(motion, count * run.step), count * run.segments)


def _joints(S: Any, count: int) -> Subject:
    """The loads of a joint."""
    return Subject(lambda: joint_loads(S, JOINTS, count), count * JOINTS)


def _query(run: Run, count: int) -> Subject:
    """A point near the wall, of points along the whole hole, each with the piece of its last query."""
    hole = run.hole
    md = np.linspace(10.0, hole.total_depth - 10.0, POINTS)
    points = hole.at(md)[0] + 0.1 * np.stack([np.cos(md), np.sin(md), np.zeros(POINTS)], axis=1)
    owner, out = hole.owners(points), np.empty((POINTS, 7))

    def act() -> None:
        for _ in range(count):
            query_walls(hole.pieces, hole.geometry, points, owner, out)

    return Subject(act, count * POINTS)


def _steady(run: Run) -> Subject:
    """A bit depth of ``SOLVERS`` solvers: one takes up to a tenth longer where its arrays lie badly."""
    solvers, rates = [Solver(run.case) for _ in range(SOLVERS)], steady_rates(run.case, "trip_out")

    def act() -> None:
        for solver in solvers:
            solver.solve("trip_out", rates, BIT_DEPTH)

    return Subject(act, SOLVERS)


def _chart(run: Run) -> Subject:
    """A bit depth of a chart of one operation, in this thread: the clock of a subject is that of its thread."""
    depths = [BIT_DEPTH - 20.0 * k for k in reversed(range(16))]
    return Subject(lambda: chart_rows(run.case, "trip_out", depths, threads=1), len(depths))


def _limits(run: Run) -> Subject:
    """The margins of one operation at one bit depth."""
    return Subject(lambda: limits_of(run.case, "trip_out", BIT_DEPTH), 1)
