"""The paper's well with its vertical pipe as one long segment or cut, and the frequencies of its string."""

from typing import Any

import numpy as np
from scipy.optimize import brentq

from fctd import Case
from fctd.arrays import Array
from fctd.mechanics import state, waves
from fctd.model.section import section_of
from fctd.simulation.preparation import prepare
from validation.cases import load

BIT = 2450.0
PIPE = 37.5  # [m], the paper's own segments of pipe below the long one
MODES = 4


def the_case(vertical: float | None, **changes: Any) -> Case:
    """The paper's well; ``vertical`` [m]: segments of the vertical pipe, None for the paper's one."""
    cut = {"string__components__2__segments": None, "string__components__2__segment_length": vertical}
    return load("paper_well", **({} if vertical is None else cut), **changes)


def chain(S: Array, n: int, spring: int, inertia: int, kind: int) -> tuple[Array, Array]:
    """Stiffness (m, m) and masses (m,) of the hanging chain of n bodies, and of the waves within a long segment.

    spring, inertia : rows of the state; kind : of the waves, 0 or ``waves.TORSION``.
    """
    k, m = state.row(S, spring, n), state.row(S, inertia, n)
    matrix = np.diag(k + np.append(k[1:], 0.0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    for sign, mass, hanging in waves.hung(S, kind):
        # It hangs between the clamp, which stands, and the segment's lower end.
        tie = np.zeros(len(m) + 1)
        tie[0], tie[-1] = sign, -1.0
        matrix, m = np.pad(matrix, (0, 1)) + hanging * np.outer(tie, tie), np.append(m, mass)
    return matrix, m


def chain_frequencies(case: Case) -> tuple[Array, Array]:
    """Lowest axial and torsional frequencies [Hz] of the hanging chain, from its springs and masses."""
    run, _ = prepare(case)
    found = []
    for rows in ((state.K_AXIAL, state.MASS, 0), (state.K_TWIST, state.J_AXIAL, waves.TORSION)):
        matrix, m = chain(run.S, run.segments, *rows)
        squares = np.linalg.eigvalsh(matrix / np.sqrt(np.outer(m, m)))
        found.append(np.sqrt(squares[:MODES]) / (2 * np.pi))
    return found[0], found[1]


def continuous_frequencies(case: Case) -> tuple[Array, Array]:
    """The same of the continuous string, pipe held above and collars free below: Z₁ cot(ωL₁/c₁) = Z₂ tan(ωL₂/c₂)."""
    collar, pipe = (section_of(component, 0.0) for component in case.string.components[:2])
    assert case.string.components[0].length is not None
    lengths = BIT - case.string.components[0].length, case.string.components[0].length
    found = []
    for stiffness, inertia in (("EA", "mass"), ("GJ", "axial_inertia")):
        k, m = (np.array([getattr(part, name) for part in (pipe, collar)]) for name in (stiffness, inertia))
        speed, impedance = np.sqrt(k / m), np.sqrt(k * m)

        def balance(w: float, speed: Array = speed, impedance: Array = impedance) -> float:
            up, down = w * lengths[0] / speed[0], w * lengths[1] / speed[1]
            return float(impedance[0] * np.cos(up) * np.cos(down) - impedance[1] * np.sin(up) * np.sin(down))

        grid = np.arange(0.05, 60.0, 0.05)
        signs = np.sign([balance(w) for w in grid])
        crossings = np.flatnonzero(np.diff(signs))[:MODES]
        found.append(np.array([brentq(balance, grid[i], grid[i + 1]) for i in crossings]) / (2 * np.pi))
    return found[0], found[1]
