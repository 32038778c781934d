"""Exact laminar flow in a concentric annulus, second route: velocities and stresses on a grid, conserved in cells.

The unknowns are velocities at nodes, stresses between them, and the gradient g.  The balance of forces of each cell,
the flow curve γ(τ) = Δu/Δr between two nodes and the sum of the flow are one system, solved by Newton's method.  A
stress below the yield stress is an unknown like any other, so that nothing is regularised; the plug is not sought, and
where it lies does not matter.  The only error is that of the grid, of second order: nodes are closer towards the walls.
"""

import numpy as np
from scipy.linalg import solve_banded

from fctd.arrays import Array
from references.hydraulics.flow import REST, Annulus, Answer, Mud, check, read, start, step_share

CELLS = 16000
ITERATIONS = 200
TOLERANCE = 1e-11  # of the stresses, relative
PLUGGED = 1e-10  # fluidity that Newton's matrix keeps where nothing is sheared, over that of the first guess


def solve(annulus: Annulus, mud: Mud, flow: float, speed: float = 0.0, *, cells: int = CELLS) -> Answer:
    """Flow [m³/s] upwards past a pipe that moves down at a speed [m/s], on a number of cells.

    Raises InputError as `check`, and RuntimeError where Newton's method does not end.
    """
    check(annulus, mud)
    if flow == 0 and speed == 0:
        return REST
    middle, angle = 0.5 * (annulus.pipe + annulus.hole), np.linspace(0, np.pi, cells + 1)
    nodes = middle - 0.5 * annulus.gap * np.cos(angle)
    width, face = np.diff(nodes), 0.5 * (nodes[1:] + nodes[:-1])
    ring = 0.5 * np.diff(face**2)  # of the cells of the inner nodes, over 2π
    at_pipe = 0.5 * (face[0] ** 2 - nodes[0] ** 2)
    wanted = flow / (2 * np.pi) + speed * at_pipe  # Σ ring u
    rate, unit = start(annulus, mud, flow, speed)

    def newton(fluidity: Array, rest: Array) -> tuple[Array, Array, float]:
        """Stresses, velocities and gradient with Δu = Δr fluidity τ + rest; forces and flow balance."""
        band = np.zeros((3, 2 * cells - 1))
        band[1, ::2] = -width * fluidity
        band[0, 1::2], band[2, 1::2] = 1.0, -1.0  # u of the node below and above a face
        band[0, 2::2], band[2, 0:-1:2] = face[1:], -face[:-1]  # τ of the faces beside a node
        sides = np.zeros((2 * cells - 1, 2))
        sides[::2, 0] = rest
        sides[0, 0] -= speed
        sides[1::2, 1] = -ring
        still, by_gradient = solve_banded((1, 1), band, sides).T
        gradient = float((wanted - ring @ still[1::2]) / (ring @ by_gradient[1::2]))
        both = still + gradient * by_gradient
        return both[::2], both[1::2], gradient

    even = np.full(cells, rate / unit)
    stress = newton(even, np.zeros(cells))[0]
    for _ in range(ITERATIONS):
        fluidity = mud.fluidity(stress) + PLUGGED * even
        aim, velocity, gradient = newton(fluidity, width * (mud.shear_rate(stress) - fluidity * stress))
        change = aim - stress
        if np.abs(change).max() <= TOLERANCE * np.abs(aim).max():
            moment = face[0] * aim[0] + 0.5 * gradient * face[0] ** 2
            return read(annulus, mud, gradient, float(moment))
        sheared = np.diff(velocity, prepend=-speed, append=0.0)

        def slope(share: float, stress: Array = stress, change: Array = change, sheared: Array = sheared) -> float:
            """Of the dissipation less the work, along the step."""
            return float((face * (width * mud.shear_rate(stress + share * change) - sheared)) @ change)

        stress = stress + step_share(slope) * change
    raise RuntimeError(f"no flow found for {annulus}, {mud}, flow {flow:g}, speed {speed:g}")
