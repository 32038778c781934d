"""Loads of a joint and their derivatives: symmetry of the springs' potential, and packed code."""

import platform

import numpy as np
import pytest

from fctd.mechanics import state
from fctd.mechanics.jit import entry
from fctd.mechanics.rotations import turned
from fctd.steady import joint_tangent
from fctd.steady.block_thomas import SIZE
from fctd.steady.joint_tangent import LOADS, LOWER, UNKNOWNS, UPPER, add_joint, differentiate_joint
from fctd.steady.pose import POSE
from tests.mechanics.test_dynamics_compiled import compiled, operations

Array = np.ndarray
FORCE = slice(0, 3)
SHIFT, LOWER_TILT, SPIN, UPPER_TILT = slice(0, 3), slice(3, 5), 5, slice(6, 8)


@entry
def differentiate(S, P, kinks, L, K):
    """``differentiate_joint`` of joint 1."""
    differentiate_joint(S, 1, P, kinks, L, K)


@entry
def add(S, P, kinks, R, D, A, U, L, K):
    """``add_joint`` of joint 1."""
    add_joint(S, 1, P, kinks, R, D, A, U, L, K)


def joint(seed: int, bend: float = 0.0) -> tuple[Array, Array, Array]:
    """Two bodies that are shifted, bent and twisted against each other, and the bend of the upper one's end."""
    rng = np.random.default_rng(seed)
    S, P, kinks = state.new_state(1), np.zeros((2, POSE)), np.zeros((3, 4))
    S[state.ARM_BOTTOM], S[state.ARM_TOP + 1] = 4.0, 6.0
    for offset, k in ((state.K_AXIAL, 3e7), (state.K_SHEAR, 1e6), (state.K_BEND, 4e5), (state.K_TWIST, 2e5)):
        S[offset + 1] = k
    P[:, 3] = 1.0
    P[1, 2] = 10.0
    P[1, :3] += rng.normal(scale=1e-3, size=3)
    for j in range(2):
        for _ in range(3):
            P[j, 3:7] = turned(*P[j, 3:7], *rng.normal(scale=0.05, size=3))
    P[1, 7] = 0.3
    kinks[:, 0] = np.cos(bend)
    kinks[:, 1] = np.sin(bend)
    return S, P, kinks


def found(S: Array, P: Array, kinks: Array) -> tuple[Array, Array]:
    L, K = np.empty(LOADS), np.empty(LOADS * UNKNOWNS)
    differentiate(S, P, kinks, L, K)
    return L, K.reshape(LOADS, UNKNOWNS)


def added(S: Array, P: Array, kinks: Array) -> tuple[Array, Array, Array, Array]:
    """Forces out of balance of both bodies, and the blocks of the tangent (2, 6, 6)."""
    R, (D, A, U) = np.zeros((2, SIZE)), np.zeros((3, 2, SIZE, SIZE))
    add(S, P, kinks, R, D.ravel(), A.ravel(), U.ravel(), np.empty(LOADS), np.empty(LOADS * UNKNOWNS))
    return R, D, A, U


@pytest.mark.parametrize("bend", [0.0, 0.02])
def test_derivatives_are_those_of_central_differences(bend: float) -> None:
    S, P, kinks = joint(1, bend)
    _, K = found(S, P, kinks)

    def loads(k: int, h: float) -> Array:
        Q = P.copy()
        if k < 3:
            Q[1, k] += h
        elif k == SPIN:
            Q[1, 7] += h
        else:
            body, tilt = (1, k - 3) if k < 5 else (0, k - 6)
            Q[body, 3:7] = turned(*Q[body, 3:7], *(h * np.eye(3)[tilt]))
        return found(S, Q, kinks)[0]

    for k in range(UNKNOWNS):
        slope = (loads(k, 1e-6) - loads(k, -1e-6)) / 2e-6
        np.testing.assert_allclose(K[:, k], slope, atol=1e-7 * np.abs(K).max())


@pytest.mark.parametrize("seed", range(4))
def test_second_derivatives_of_the_potential_commute(seed: int) -> None:
    """Force by tilt against moment by shift, moment of one body by tilt of the other and the reverse."""
    _, K = found(*joint(seed, bend=0.01 * seed))
    size = np.abs(K).max()
    upper, lower = slice(UPPER, UPPER + 2), slice(LOWER, LOWER + 2)
    np.testing.assert_allclose(K[FORCE, SHIFT], K[FORCE, SHIFT].T, atol=1e-12 * size)
    np.testing.assert_allclose(K[FORCE, UPPER_TILT], K[upper, SHIFT].T, atol=1e-8 * size)
    np.testing.assert_allclose(K[FORCE, LOWER_TILT], K[lower, SHIFT].T, atol=1e-8 * size)
    np.testing.assert_allclose(K[upper, LOWER_TILT], K[lower, UPPER_TILT].T, atol=1e-8 * size)


def test_the_blocks_of_a_joint_are_those_of_central_differences() -> None:
    """Of each body on itself, and of each against the other; the loads enter the balance with opposite signs."""
    S, P, kinks = joint(2, bend=0.02)
    L, _ = found(S, P, kinks)
    R, D, A, U = added(S, P, kinks)
    np.testing.assert_array_equal(R[0], [*-L[FORCE], *L[UPPER : UPPER + 3]])
    np.testing.assert_array_equal(R[1], [*L[FORCE], *L[LOWER : LOWER + 3]])
    blocks = {(0, 0): D[0], (1, 1): D[1], (1, 0): A[1], (0, 1): U[1]}
    for k in range(SIZE):
        for moved in (0, 1):
            sides = []
            for h in (1e-6, -1e-6):
                Q = P.copy()
                if k in (3, 4):
                    Q[moved, 3:7] = turned(*Q[moved, 3:7], *(h * np.eye(3)[k - 3]))
                else:
                    Q[moved, k if k < 3 else 7] += h
                sides.append(added(S, Q, kinks)[0])
            slope = (sides[0] - sides[1]) / 2e-6
            for body in (0, 1):
                block = blocks[body, moved]
                np.testing.assert_allclose(block[:, k], -slope[body], atol=1e-7 * np.abs(D).max())


def test_the_torque_about_both_axes_is_that_of_the_twist() -> None:
    S, P, kinks = joint(3)
    L, K = found(S, P, kinks)
    assert L[UPPER + 2] == pytest.approx(-L[LOWER + 2], rel=1e-9)
    assert K[UPPER + 2, SPIN] == pytest.approx(S[state.K_TWIST + 1], rel=1e-9)
    assert K[LOWER + 2, SPIN] == pytest.approx(-S[state.K_TWIST + 1], rel=1e-9)


@pytest.mark.slow
@compiled
@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="reads x86-64 instructions")
def test_the_loop_over_the_unknowns_is_packed() -> None:
    S, P, kinks = joint(1)
    arguments = S, 1, P, kinks, np.empty(LOADS), np.empty(LOADS * UNKNOWNS)
    packed, scalar = operations(joint_tangent.differentiate_joint, *arguments)
    assert packed > 100
    assert packed > 0.5 * scalar
