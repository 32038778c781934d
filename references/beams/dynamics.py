"""Lowering a finite-element beam into its hole, in time (generalised-α) or through a sequence of equilibria.

The top of the beam has a prescribed depth and is fixed laterally and in rotation (§6.1).
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import pandas as pd
from scipy.sparse import csc_matrix

from fctd.arrays import Array
from references.beams.elements import Beam, ConvergenceError, WallLoad, newton, statics

# A step for which Newton's iteration fails is halved at most this many times.
MOST_HALVINGS = 8


class Scheme(NamedTuple):
    """Parameters of Chung and Hulbert (1993): of inertia, of the other forces, and Newmark's γ and β."""

    inertia: float
    force: float
    gamma: float
    beta: float


def generalised_alpha(high_frequency: float) -> Scheme:
    """The scheme with the spectral radius ``high_frequency`` (0 to 1) per step for the fastest modes."""
    inertia = (2 * high_frequency - 1) / (high_frequency + 1)
    force = high_frequency / (high_frequency + 1)
    return Scheme(inertia, force, 0.5 - inertia + force, 0.25 * (1 - inertia + force) ** 2)


@dataclass(frozen=True)
class Lowered:
    """The result of a lowering, a row for each of m recorded times.

    time (m,) [s]; states (m, N) and depths of the Gauss points md (m, elements, points) [m] at that time;
    pressure (m, elements, points) [N/m], positive on the high side, mean since the record before; ledger : energies
    [J] since the start; iterations : Newton iterations in all.
    """

    time: Array
    states: Array
    pressure: Array
    md: Array
    ledger: pd.DataFrame
    iterations: int


@dataclass
class _State:
    """Position, velocity and acceleration of the beam, and all forces but inertia."""

    time: float
    q: Array
    v: Array
    a: Array
    resistance: Array
    load: WallLoad


def lower(
    beam: Beam,
    top: Callable[[float], float],
    times: Array,
    step: float,
    scheme: Scheme | None,
) -> Lowered:
    """Lower a beam that hangs at rest with its top at ``top(times[0])`` and record it at the later times.

    top : depth of the top [m] at a time [s]; step [s] : longest step; scheme : None for a sequence of equilibria.
    Raises ConvergenceError.
    """
    return _Lowering(beam, top, times, step, scheme).run()


class _Lowering:
    def __init__(
        self, beam: Beam, top: Callable[[float], float], times: Array, step: float, scheme: Scheme | None
    ) -> None:
        self.beam, self.top, self.times, self.step, self.scheme = beam, top, times, step, scheme
        self.fixed = beam.dofs(float(beam.nodes[0]))
        self.free = np.setdiff1d(np.arange(beam.strains.N), self.fixed)
        self.tolerance = beam.tolerance(beam.around.weight * beam.length)
        self.iterations = 0
        self.sums = {"top_work_J": 0.0, "lost_mud_J": 0.0, "lost_friction_J": 0.0}

    def run(self) -> Lowered:
        """Find the equilibrium of the hanging beam, then advance from record to record."""
        beam = self.beam
        q = beam.straight(self.top(float(self.times[0])))
        q, still = statics(beam, q, self.fixed), np.zeros_like(q)
        force, _, load = beam.resistance(q, still)
        here = _State(float(self.times[0]), q, still, still.copy(), force, load)
        start = self._energy(here)
        states, pressures, depths, ledger = [], [], [], []
        for end in self.times[1:]:
            begin = here.time
            count = max(int(np.ceil((end - begin) / self.step - 1e-9)), 1)
            pressure = np.zeros_like(load.pressure)
            for k in range(count):
                before = here
                here = self._advance(here, begin + (end - begin) * (k + 1) / count, MOST_HALVINGS)
                pressure += 0.5 * (before.load.pressure + here.load.pressure) / count
            states.append(here.q)
            pressures.append(pressure)
            depths.append(here.load.md)
            stored = {name: value - start[name] for name, value in self._energy(here).items()}
            residual = sum(stored.values()) + self.sums["lost_mud_J"] + self.sums["lost_friction_J"]
            residual -= self.sums["top_work_J"]
            ledger.append({"time_s": here.time, **stored, **self.sums, "residual_J": residual})
        return Lowered(
            self.times[1:],
            np.array(states),
            np.array(pressures),
            np.array(depths),
            pd.DataFrame(ledger),
            self.iterations,
        )

    def _advance(self, here: _State, end: float, halvings: int) -> _State:
        """The state at time ``end``, in one step or, where Newton's iteration fails, in halves."""
        try:
            after, reaction = self._step(here, end)
        except ConvergenceError:
            if halvings == 0:
                raise
            middle = self._advance(here, 0.5 * (here.time + end), halvings - 1)
            return self._advance(middle, end, halvings - 1)
        beam, dt = self.beam, end - here.time
        self.sums["top_work_J"] += float(reaction[self.fixed] @ (after.q - here.q)[self.fixed])
        for name, loss in (("lost_mud_J", "mud_loss"), ("lost_friction_J", "friction_loss")):
            power = 0.5 * (getattr(here.load, loss) + getattr(after.load, loss))
            self.sums[name] += dt * beam.integrate(power)
        return after

    def _step(self, here: _State, end: float) -> tuple[_State, Array]:
        """One step; returns the state at its end and the force on the fixed dofs during the step."""
        beam, dt, scheme = self.beam, end - here.time, self.scheme
        trial = here.q + dt * here.v
        trial[self.fixed[0]] = self.top(end)
        # Evaluations by Newton's iteration: forces, their sum with inertia, wall. The last one is at the solution.
        seen: list[tuple[Array, Array, WallLoad]] = []

        if scheme is None:

            def motion(q: Array) -> tuple[Array, Array]:
                return (q - here.q) / dt, np.zeros_like(q)

            def residual(q: Array) -> tuple[Array, csc_matrix]:
                force, tangent, load = beam.resistance(q, motion(q)[0], 1 / dt)
                seen.append((force, force, load))
                return force, tangent

        else:
            am, af, gamma, beta = scheme

            def motion(q: Array) -> tuple[Array, Array]:
                a = (q - here.q - dt * here.v) / (beta * dt**2) - (0.5 - beta) / beta * here.a
                return here.v + dt * ((1 - gamma) * here.a + gamma * a), a

            def residual(q: Array) -> tuple[Array, csc_matrix]:
                v, a = motion(q)
                force, tangent, load = beam.resistance(q, v, gamma / (beta * dt))
                total = (1 - af) * force + af * here.resistance + beam.mass @ ((1 - am) * a + am * here.a)
                seen.append((force, total, load))
                return total, (1 - af) * tangent + (1 - am) / (beta * dt**2) * beam.mass

        q, taken = newton(residual, trial, self.free, self.tolerance)
        self.iterations += taken
        v, a = motion(q)
        force, total, load = seen[-1]
        return _State(end, q, v, a, force, load), total

    def _energy(self, at: _State) -> dict[str, float]:
        """Energies stored in the beam and the wall [J]."""
        beam = self.beam
        kinetic = 0.5 * float(at.v @ (beam.mass @ at.v)) if self.scheme is not None else 0.0
        return {
            "kinetic_J": kinetic,
            "gravity_J": -float(beam.gravity @ at.q),
            "strain_J": beam.strain_energy(at.q),
            "wall_J": beam.integrate(at.load.energy),
        }
