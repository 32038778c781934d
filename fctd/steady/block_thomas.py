"""Linear equations with a block tridiagonal matrix, as a chain of bodies has it: block Thomas elimination."""

import numpy as np

from fctd.arrays import Array
from fctd.mechanics.jit import entry, inlined

SIZE = 6
BLOCK = SIZE * SIZE
# Columns of a row of work: a block, the right-hand side and 0, whole packed operations.
WIDTH = 8
# All bits of an index in an array of blocks; see ``state.COLUMN_BITS``.
INDEX_BITS = 2**20 - 1
# A block whose pivots have a smaller ratio than this is near singular, and the solution inaccurate.
WORST_PIVOTS = 1e-13


@entry
def eliminate(D, A, U, R, n, W):
    """Solve the system of n blocks in rows 1..n in place; returns False when a block is near singular.

    D, A, U (n + 1, 6, 6) : diagonal, lower and upper blocks, U[j] in row j − 1; R (n + 1, 6) : right-hand side
    in, solution out.  W (n + 1, 6, 7) : work.  Gaussian elimination with partial pivoting inside the blocks.
    """
    sound = True
    M = np.empty((SIZE, 2 * SIZE + 1))
    for j in range(1, n + 1):
        # Row j with the solution of row j − 1 substituted: [diagonal | upper block | right-hand side].
        for r in range(SIZE):
            for c in range(SIZE):
                M[r, c] = D[j, r, c]
                M[r, SIZE + c] = U[j + 1, r, c] if j < n else 0.0
            M[r, 2 * SIZE] = R[j, r]
        if j > 1:
            for r in range(SIZE):
                for k in range(SIZE):
                    factor = A[j, r, k]
                    for c in range(SIZE):
                        M[r, c] -= factor * W[j - 1, k, c]
                    M[r, 2 * SIZE] -= factor * W[j - 1, k, SIZE]
        least, most = np.inf, 0.0
        for p in range(SIZE):
            best = p
            for r in range(p + 1, SIZE):
                if abs(M[r, p]) > abs(M[best, p]):
                    best = r
            if best != p:
                for c in range(p, 2 * SIZE + 1):
                    M[p, c], M[best, c] = M[best, c], M[p, c]
            size = abs(M[p, p])
            least, most = min(least, size), max(most, size)
            inverse = 1 / M[p, p]
            for c in range(p + 1, 2 * SIZE + 1):
                M[p, c] *= inverse
            for r in range(SIZE):
                if r != p:
                    factor = M[r, p]
                    for c in range(p + 1, 2 * SIZE + 1):
                        M[r, c] -= factor * M[p, c]
        sound = sound and least > WORST_PIVOTS * most
        for r in range(SIZE):
            for c in range(SIZE + 1):
                W[j, r, c] = M[r, SIZE + c]
    for r in range(SIZE):
        R[n, r] = W[n, r, SIZE]
    for j in range(n - 1, 0, -1):
        for r in range(SIZE):
            total = W[j, r, SIZE]
            for c in range(SIZE):
                total -= W[j, r, c] * R[j + 1, c]
            R[j, r] = total
    return sound


@inlined
def packed_width(D):
    """WIDTH, in a way that the compiler cannot know: it packs no loop whose few steps it can count."""
    return D.shape[2] + WIDTH - SIZE


@inlined
def find_step(M, F, p):
    """Fill column p of F and take its step on the columns of M behind p."""
    F[WIDTH * p + p] = 1 / M[WIDTH * p + p]
    for c in range(p + 1, SIZE):
        M[WIDTH * p + c] *= F[WIDTH * p + p]
    for r in range(SIZE):
        if r != p:
            F[WIDTH * r + p] = M[WIDTH * r + p]
            for c in range(p + 1, SIZE):
                M[WIDTH * r + c] -= F[WIDTH * r + p] * M[WIDTH * p + c]


@inlined
def take_steps(F, X, width):
    """Take the steps F on the right-hand sides X; see ``packed_width``."""
    for c in range(width):
        for p in range(SIZE):
            pivot = F[WIDTH * p + p] * X[WIDTH * p + c]
            for r in range(SIZE):
                X[WIDTH * r + c] -= F[WIDTH * r + p] * pivot
            X[WIDTH * p + c] = pivot


@inlined
def subtract_product(M, A, first, X, width):
    """Subtract from M the product of the block A[first:] (6 × 6) and X."""
    for c in range(width):
        for r in range(SIZE):
            total = M[WIDTH * r + c]
            for k in range(SIZE):
                total -= A[first + SIZE * r + k] * X[WIDTH * k + c]
            M[WIDTH * r + c] = total


@entry
def negative_pivots(D, A, U, n):
    """Number of negative eigenvalues of the symmetric part of the matrix, by the signs of its pivots.

    Sylvester: the pivots of an elimination without exchanges have the signs of the eigenvalues.
    """
    count = 0
    M, F, X = np.zeros(SIZE * WIDTH), np.zeros(SIZE * WIDTH), np.zeros(SIZE * WIDTH)
    upper, width = np.zeros(BLOCK), packed_width(D)
    D, A, U = D.reshape(-1), A.reshape(-1), U.reshape(-1)
    for j in range(1, n + 1):
        block = (j * BLOCK) & INDEX_BITS
        for r in range(SIZE):
            for c in range(SIZE):
                M[WIDTH * r + c] = 0.5 * (D[block + SIZE * r + c] + D[block + SIZE * c + r])
        if j > 1:
            subtract_product(M, upper, 0, X, width)
        for r in range(SIZE):
            for c in range(SIZE):
                below = block + BLOCK
                X[WIDTH * r + c] = 0.5 * (U[below + SIZE * r + c] + A[below + SIZE * c + r]) if j < n else 0.0
                upper[SIZE * c + r] = X[WIDTH * r + c]
        for p in range(SIZE):
            count += M[WIDTH * p + p] < 0
            find_step(M, F, p)
        take_steps(F, X, width)
    return count


def solve_with_pivoting(D: Array, A: Array, U: Array, R: Array, n: int) -> Array:
    """Solve the system with pivoting across blocks (LAPACK), for one with a near singular block; returns (n, 6).

    Raises LinAlgError when the matrix is singular.
    """
    from scipy.linalg import solve_banded  # seldom needed, and slow to import

    width = 2 * SIZE - 1
    banded = np.zeros((2 * width + 1, n * SIZE))
    for offset, blocks, first in ((0, D[1 : n + 1], 0), (-SIZE, A[2 : n + 1], 1), (SIZE, U[2 : n + 1], 0)):
        for r in range(SIZE):
            for c in range(SIZE):
                rows = (first + np.arange(len(blocks))) * SIZE + r
                columns = rows + offset - r + c
                banded[width + rows - columns, columns] = blocks[:, r, c]
    return np.asarray(solve_banded((width, width), banded, R[1 : n + 1].ravel())).reshape(n, SIZE)
