"""Workloads for timings: strings in motion, the contact query alone, and the energy error of a timed run.

States are those of ordinary runs.  Ahead of the first wave velocities are denormal numbers, which many processors add
many times more slowly, so that nothing is timed right after a start.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd
from numba import njit

from fctd.arrays import Array, Contacts
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.mechanics.dynamics import padded_columns
from fctd.mechanics.energy import Energy, penetration
from fctd.mechanics.moving_string import STILL
from fctd.mechanics.query import WALL_COLUMNS, query_walls
from fctd.mechanics.stored_walls import update_walls
from fctd.mechanics.topdrive import Motion
from fctd.results import ledger
from fctd.simulation.external_contact import QueriedWall
from fctd.simulation.preparation import contact_points, prepare
from fctd.simulation.run import Run
from fctd.simulation.settling import start_from_rest
from fctd.simulation.simulate import Simulation

# Damping rate of a string while it falls from the axis of the hole onto the wall [1/s].
BRAKE = 5.0


class NoWall:
    """A contact method without contacts: its time is that of the call from Python.

    In whose loop nothing looks where the string is, since it has left its hole.
    """

    name = "none"

    def query(self, points: Array, radii: Array) -> Contacts:
        """No contact at any point; see ``ContactMethod.query``."""
        n = len(points)
        return Contacts(np.full(n, -np.inf), np.empty((n, 3)), np.empty(n))


def moving(case: Case, after: float) -> tuple[Run, Motion]:
    """The string of a case ``after`` so many seconds of its schedule, and what its top drive then does."""
    simulation = Simulation(case, window=(after, 1.0))
    simulation.start()
    return simulation.run, simulation.intervals[-1].motion


def fallen(case: Case, seconds: float) -> tuple[Run, Motion]:
    """The string after a damped fall of ``seconds`` from the axis of its hole, with all segments turning.

    For thousands of segments, which would take minutes to settle.
    """
    run, phases = prepare(case)
    run.refresh()
    run.advance(STILL, seconds, run.laws._replace(settling=BRAKE))
    start_from_rest(run)
    motion = phases[-1].motion
    state.row(run.S, state.WZ, run.segments)[:] = motion.spin_to
    run.refresh()
    run.check()
    return run, motion


def copy_of(run: Run, **changes: Any) -> Run:
    """A copy of a run, with ``changes``, that shares no state with it."""
    return replace(run, S=state.copy_state(run.S), top=run.top.copy(), owner=run.owner.copy(), **changes)


def without_wall(run: Run) -> Run:
    """A copy of a run without the hole, whose points have no wall beside them."""
    free = copy_of(run, laws=run.laws._replace(geometry=state.OPEN))
    state.row(free.S, state.K_WALL, free.segments)[:] = 0.0
    return free


def asking(run: Run, method: Any) -> Run:
    """The same state with a contact method that is asked from Python at every step."""
    wall = QueriedWall(method, run.hole, run.segments, judged=not isinstance(method, NoWall))
    return copy_of(run, wall=wall)


def touching(run: Run) -> float:
    """Share of the contact points that touch the wall."""
    return float((penetration(run.S, run.segments) > 0).mean())


def energy_error(run: Run, before: Energy, now: Energy) -> float:
    """Energy error (``ledger.error``) of a run whose string held ``before`` at its start; exact is 0."""
    row = ledger.entry(run.S, run.top, run.segments, before, now)
    return ledger.error(pd.DataFrame([row]), motion=True)


@njit(error_model="numpy", cache=True)
def _walls(S, owner, n, packed, C, geometry, times):  # type: ignore[no-untyped-def]
    for _ in range(times):
        update_walls(S, owner, n, packed, C, geometry)


def find_walls(run: Run, times: int) -> None:
    """FCTD's contact query of all points as in its steps, ``times`` times."""
    n = run.segments
    _walls(run.S, run.owner, n, padded_columns(n), run.hole.pieces, run.laws.geometry, times)


def free_query(run: Run) -> Callable[[int], None]:
    """A function of a number of times that queries the wall at all contact points of a run as free points."""
    n = run.segments
    points = np.ascontiguousarray(contact_points(run.S, n))
    owner, out = run.owner[1 : n + 1].copy(), np.empty((n, WALL_COLUMNS))

    def ask(times: int) -> None:
        for _ in range(times):
            query_walls(run.hole.pieces, run.laws.geometry, points, owner, out)

    return ask
