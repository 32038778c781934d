"""Block Thomas elimination against dense linear algebra."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from fctd.arrays import Array
from fctd.steady.block_thomas import SIZE, eliminate, negative_pivots, solve_with_pivoting


def system(n: int, seed: int) -> tuple[Array, Array, Array, Array]:
    """Random symmetric blocks in rows 1..n; row 0 and U[1] and A[1] are never read."""
    rng = np.random.default_rng(seed)
    D, A = rng.normal(size=(n + 1, SIZE, SIZE)), rng.normal(size=(n + 1, SIZE, SIZE))
    D = D + D.transpose(0, 2, 1)
    return D, A, A.transpose(0, 2, 1).copy(), rng.normal(size=(n + 1, SIZE))


def dense(D: Array, A: Array, U: Array, n: int) -> Array:
    M = np.zeros((n * SIZE, n * SIZE))
    for j in range(1, n + 1):
        here = slice((j - 1) * SIZE, j * SIZE)
        M[here, here] = D[j]
        if j > 1:
            above = slice((j - 2) * SIZE, (j - 1) * SIZE)
            M[here, above], M[above, here] = A[j], U[j]
    return M


@given(n=st.integers(1, 12), seed=st.integers(0, 1000), shift=st.floats(-6, 6))
@settings(max_examples=40)
def test_solution_and_inertia_are_those_of_the_dense_matrix(n: int, seed: int, shift: float) -> None:
    D, A, U, R = system(n, seed)
    D = D + shift * np.eye(SIZE)
    M = dense(D, A, U, n)
    eigenvalues = np.linalg.eigvalsh(M)
    assume(np.abs(eigenvalues).min() > 1e-6)  # of a singular system any answer is as good
    exact = np.linalg.solve(M, R[1:].ravel()).reshape(n, SIZE)
    np.testing.assert_allclose(solve_with_pivoting(D, A, U, R, n), exact, rtol=1e-6, atol=1e-8)
    solution = R.copy()
    sound = eliminate(D, A, U, solution, n, np.zeros((n + 1, SIZE, SIZE + 1)))
    worst = np.abs(solution[1:] - exact).max() / np.abs(exact).max()
    assert worst < 1e-3 or not sound
    assert negative_pivots(D, A, U, n) == (eigenvalues < 0).sum()


def test_a_system_with_a_near_singular_block_is_reported_and_solved_with_pivoting() -> None:
    """A block of zeros on the diagonal has no pivot of its own; the whole matrix is a permutation."""
    n = 2
    D, A, U = np.zeros((n + 1, SIZE, SIZE)), np.zeros((n + 1, SIZE, SIZE)), np.zeros((n + 1, SIZE, SIZE))
    A[2] = U[2] = np.eye(SIZE)
    R = np.arange((n + 1) * SIZE, dtype=float).reshape(n + 1, SIZE)
    assert not eliminate(D, A, U, R.copy(), n, np.zeros((n + 1, SIZE, SIZE + 1)))
    np.testing.assert_allclose(solve_with_pivoting(D, A, U, R, n), R[[2, 1]])


def test_a_singular_matrix_is_refused() -> None:
    n = 1
    zero = np.zeros((n + 1, SIZE, SIZE))
    with pytest.raises(np.linalg.LinAlgError):
        solve_with_pivoting(zero, zero, zero, np.ones((n + 1, SIZE)), n)
