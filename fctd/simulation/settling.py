"""Settling: the string comes to rest in its hole before a run, without friction and with artificial damping."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from fctd.arrays import Array
from fctd.mechanics import state, topdrive, waves
from fctd.mechanics.energy import penetration
from fctd.mechanics.faults import UnstableError
from fctd.mechanics.moving_string import STILL
from fctd.mechanics.rock import NO_ROCK, NOTHING
from fctd.model.drilling import above_bottom
from fctd.simulation.preparation import LONGEST_SETTLING, own_wall
from fctd.simulation.run import Run

# The string is settled when no force is out of balance by more than this share of its weight.
SETTLED = 1e-6
# The same for another contact method's wall, averaged over a window, and the smallest number of windows.
SETTLED_ON_AVERAGE, LEAST_WINDOWS = 1e-3, 3
VELOCITY, PLACE = (state.VX, state.VY, state.VZ), (state.X, state.Y, state.Z)
# Called while a string settles, with simulated time [s] and the largest force out of balance over the weight.
Settling = Callable[[float, float], None]


def settle(run: Run, tolerance: float = SETTLED, progress: Settling | None = None) -> float:
    """Relax the frictionless string at rest; returns the largest force out of balance over the weight.

    Raises UnstableError when the string does not come to rest or leaves the hole.

    The damping is proportional to mass and a few times critical for the slowest swing of the hanging string.  With
    damping critical for the axial modes, the swing would take minutes to decay.
    """
    if run.wall.jumps:
        settle(replace(run, wall=own_wall(run.case, run.hole)), tolerance, progress)
        return _settle_on_average(run, progress)
    laws, weight = relaxing(run)
    residual = np.inf
    for k in range(int(LONGEST_SETTLING * laws.settling)):
        run.advance(STILL, 1 / laws.settling, laws)
        before = _three(run, VELOCITY)
        run.advance(STILL, run.step, laws)
        after = _three(run, VELOCITY)
        # The imbalance is the sum of all forces without the artificial drag.
        pull = (after - before) / run.step + laws.settling * after
        residual = float(np.abs(state.row(run.S, state.MASS, run.segments) * pull).max()) / weight
        run.refresh()
        run.check()
        if progress is not None:
            progress((k + 1) / laws.settling, residual)
        if residual < tolerance:
            return residual
    raise UnstableError(f"forces are out of balance by {residual:.2g} of the weight after {LONGEST_SETTLING:g} s")


def _settle_on_average(run: Run, progress: Settling | None) -> float:
    """Relax a string, already settled on the hole's own pieces, against a wall whose contacts jump.

    Returns the imbalance as ``settle`` does, but of forces averaged over a window: no single step is in balance.
    """
    laws, weight = relaxing(run)
    residual, window = np.inf, 1 / laws.settling
    for k in range(int(LONGEST_SETTLING * laws.settling)):
        speed, place = _three(run, VELOCITY), _three(run, PLACE)
        run.advance(STILL, window, laws)
        pull = (_three(run, VELOCITY) - speed + laws.settling * (_three(run, PLACE) - place)) / window
        residual = float(np.abs(state.row(run.S, state.MASS, run.segments) * pull).max()) / weight
        run.refresh()
        run.check()
        if progress is not None:
            progress((k + 1) * window, residual)
        if residual < SETTLED_ON_AVERAGE and k + 1 >= LEAST_WINDOWS:
            return residual
    raise UnstableError(f"forces are out of balance by {residual:.2g} of the weight after {LONGEST_SETTLING:g} s")


def relaxing(run: Run) -> tuple[state.Laws, float]:
    """The laws with which a string settles, and its weight [N]."""
    weight = float(np.abs(run.string.weight * run.string.length).sum())
    rate = 12 * np.sqrt(topdrive.GRAVITY / float(run.string.length.sum()))
    return run.laws._replace(friction_scale=0.0, settling=rate, rock=NOTHING), weight


def _three(run: Run, rows: tuple[int, int, int]) -> Array:
    """A vector of every segment (3, n), copied."""
    return np.stack([state.row(run.S, row, run.segments) for row in rows])


def start_from_rest(run: Run) -> None:
    """Set the settled string's velocities, clock, sums and losses to zero, for the start of the run."""
    for offset in (state.VX, state.VY, state.VZ, state.WX, state.WY, state.WZ, state.LAYER_SPEED):
        state.row(run.S, offset, run.segments)[:] = 0.0
    waves.still(run.S)
    if run.case.mud.cake is not None:
        rests = penetration(run.S, run.segments) > 0
        state.row(run.S, state.CAKE_AGE, run.segments)[:] = np.where(rests, run.case.mud.cake.rested, 0.0)
    run.clear()
    run.top[topdrive.TOP_TIME] = 0.0
    if run.laws.rock.law != NO_ROCK:
        run.top[topdrive.PRESSED] = -above_bottom(run.case)
        run.top[topdrive.TARE] = topdrive.load_on_top(run.S, run.top, run.pipe)
        run.top[topdrive.FED] = 0.0
    run.refresh()
