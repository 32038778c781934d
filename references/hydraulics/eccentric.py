"""Laminar flow in an eccentric annulus, the pipe at rest: exact for a Newtonian mud, by finite elements for others.

In bipolar coordinates walls are lines of constant α, and the map (α, β) → (x, y) is conformal with the scale
c/(cosh α − cos β).  A Newtonian velocity is g/4μ times H − x² − y² with H harmonic, so that the pull of the mud on the
pipe follows from the constant part of H alone:

    lift/(π g) = c d/(α_pipe − α_hole),        d the distance of the axes.

It runs from (r_h² − r_o²)/(2 ln(r_h/r_o)) of the concentric annulus to r_o r_h of a pipe that touches the hole.  A pipe
that moves at v without a gradient drags the flow π(lift/(π g) − r_o²) v along with it, by reciprocity.

For other muds the unknowns are velocities at the nodes of bilinear elements and stresses at their Gauss points.  As in
`references.hydraulics.differences`, Newton's method seeks stresses in balance, and nothing is regularised.
"""

from typing import NamedTuple

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

from fctd.arrays import Array
from fctd.case.errors import InputError
from references.hydraulics.flow import Annulus, Mud, check, step_share

ACROSS, AROUND = 32, 64  # elements from pipe to hole, and around half of the annulus
ITERATIONS = 150
TOLERANCE = 1e-10  # of the work that the last step would save, relative
PLUGGED = 1e-8  # fluidity that Newton's matrix keeps where nothing is sheared, over that of the first guess
TERMS = 4000  # of Piercy's series, whose terms fall by e^(−2α_pipe)


class Eccentric(NamedTuple):
    """Flow [m³/s] at a gradient [Pa/m], and the pull of the mud on the pipe with its area times the gradient [N/m]."""

    gradient: float
    flow: float
    lift: float

    @property
    def square(self) -> float:
        """lift/(π g) [m²]: in a concentric annulus, the square of the radius of zero shear."""
        return self.lift / (np.pi * self.gradient)


class Bipolar(NamedTuple):
    """c [m]; α of pipe and hole, of which that of the pipe is larger; distance d of their axes [m]."""

    c: float
    pipe: float
    hole: float
    distance: float


def bipolar(annulus: Annulus, eccentricity: float) -> Bipolar:
    """Coordinates of an annulus; raises InputError unless 0 < eccentricity < 1 (offset over clearance)."""
    if not 0 < eccentricity < 1:
        raise InputError("above 0 and below 1", key="eccentricity", value=eccentricity)
    distance = eccentricity * annulus.gap
    axis = (annulus.hole**2 - annulus.pipe**2 + distance**2) / (2 * distance)  # of the hole
    c = float(np.sqrt((axis - annulus.hole) * (axis + annulus.hole)))
    return Bipolar(c, float(np.arcsinh(c / annulus.pipe)), float(np.arcsinh(c / annulus.hole)), distance)


def newtonian_square(annulus: Annulus, eccentricity: float) -> float:
    """lift/(π g) [m²] of a Newtonian mud, exact; eccentricities 0 and 1 included."""
    if eccentricity == 0:
        return (annulus.hole**2 - annulus.pipe**2) / (2 * float(np.log(annulus.hole / annulus.pipe)))
    if eccentricity == 1:
        return annulus.pipe * annulus.hole
    at = bipolar(annulus, eccentricity)
    return at.c * at.distance / (at.pipe - at.hole)


def newtonian_flow(annulus: Annulus, viscosity: float, eccentricity: float, gradient: float) -> float:
    """Flow [m³/s] at a gradient [Pa/m], exact (Piercy, Hooper & Winny 1933)."""
    at = bipolar(annulus, eccentricity)
    n, between = np.arange(1, TERMS), at.pipe - at.hole
    # e^(−n(α₁+α₂))/sinh n(α₁−α₂), without large numbers.
    terms = 2 * n * np.exp(-2 * n * at.pipe) / -np.expm1(-2 * n * between)
    less = 4 * (at.c * at.distance) ** 2 * (1 / between + 2 * float(terms.sum()))
    return float(np.pi * gradient / (8 * viscosity) * (annulus.hole**4 - annulus.pipe**4 - less))


def solve(
    annulus: Annulus, mud: Mud, eccentricity: float, gradient: float, *, across: int = ACROSS, around: int = AROUND
) -> Eccentric:
    """Any mud at a gradient above 0 [Pa/m]; the error falls with the square of the elements.

    Raises InputError as `check` and `bipolar`, and RuntimeError where Newton's method does not end: most of a mud that
    yields at more than half the stress at the walls is plug, whose stresses no flow tells.
    """
    check(annulus, mud)
    mesh = _mesh(bipolar(annulus, eccentricity), across, around)
    scale = 0.5 * gradient * annulus.gap
    even = np.broadcast_to(
        np.eye(2) * float(mud.fluidity(np.array(scale + mud.yield_stress))), (len(mesh.weight), 2, 2)
    )
    stress = mesh.balance(even, np.zeros((len(mesh.weight), 2)), gradient)[0]
    for _ in range(ITERATIONS):
        rate, compliance = _curve(mud, stress)
        compliance = compliance + PLUGGED * even
        rest = rate - np.einsum("gkl,gl->gk", compliance, stress)
        aim, sheared, velocity = mesh.balance(compliance, rest, gradient)
        change = aim - stress

        def slope(share: float, stress: Array = stress, change: Array = change, sheared: Array = sheared) -> float:
            """Of the dissipation less the work, along the step."""
            return float(mesh.weight @ ((_curve(mud, stress + share * change)[0] - sheared) * change).sum(axis=1))

        flow = float(mesh.load @ velocity)
        if -slope(0.0) <= TOLERANCE * gradient * flow:
            pull = gradient * mesh.load[mesh.pipe].sum() - mesh.forces(aim)[mesh.pipe].sum()
            return Eccentric(gradient, 2 * flow, 2 * float(pull) + annulus.displaced * gradient)
        stress = stress + step_share(slope) * change
    raise RuntimeError(f"no flow found for {annulus}, {mud}, eccentricity {eccentricity:g}, gradient {gradient:g}")


def _curve(mud: Mud, stress: Array) -> tuple[Array, Array]:
    """Shear rates (g, 2) of stresses (g, 2), and their derivatives (g, 2, 2)."""
    size = np.hypot(stress[:, 0], stress[:, 1])
    safe = np.where(size > 0, size, 1.0)
    secant, tangent = mud.shear_rate(size) / safe, mud.fluidity(size)
    unit = stress / safe[:, None]
    along = unit[:, :, None] * unit[:, None, :]
    return secant[:, None] * stress, secant[:, None, None] * np.eye(2) + (tangent - secant)[:, None, None] * along


class _Mesh(NamedTuple):
    """Half of an annulus, at its Gauss points g, four a cell.

    corners (g, 4) : nodes; gradients (g, 2, 4) of their shapes [1/m]; weight (g,) [m²]; load (n,) [m²] : integrals of
    the shapes; pipe (p,) : nodes on it; free (f,) : nodes off both walls.
    """

    corners: np.ndarray
    gradients: Array
    weight: Array
    load: Array
    pipe: np.ndarray
    free: np.ndarray

    def forces(self, stress: Array) -> Array:
        """What stresses (g, 2) give to the nodes (n,)."""
        each = np.einsum("gka,g,gk->ga", self.gradients, self.weight, stress)
        return np.bincount(self.corners.ravel(), each.ravel(), len(self.load)).astype(float)

    def balance(self, compliance: Array, rest: Array, gradient: float) -> tuple[Array, Array, Array]:
        """Stresses τ (g, 2) that balance the gradient, shear rates compliance τ + rest, and velocities (n,)."""
        stiffness = np.linalg.inv(compliance)
        each = np.einsum("gka,g,gkl,glb->gab", self.gradients, self.weight, stiffness, self.gradients, optimize=True)
        rows = np.broadcast_to(self.corners[:, :, None], each.shape).ravel()
        columns = np.broadcast_to(self.corners[:, None, :], each.shape).ravel()
        count = len(self.load)
        matrix = csc_matrix((each.ravel(), (rows, columns)), shape=(count, count))[self.free][:, self.free]
        push = gradient * self.load + self.forces(np.einsum("gkl,gl->gk", stiffness, rest))
        velocity = np.zeros(count)
        velocity[self.free] = splu(matrix).solve(push[self.free])
        sheared = np.einsum("gka,ga->gk", self.gradients, velocity[self.corners])
        return np.einsum("gkl,gl->gk", stiffness, sheared - rest), sheared, velocity


def _mesh(at: Bipolar, across: int, around: int) -> _Mesh:
    """Even in α; around, nodes keep to half β and half the length of the wall, for the narrow side and the wide one."""
    alpha = np.linspace(at.pipe, at.hole, across + 1)
    fine = np.linspace(0, np.pi, 20001)
    length = np.concatenate([[0], np.cumsum(1 / (np.cosh(at.hole) - np.cos(0.5 * (fine[1:] + fine[:-1]))))])
    beta = np.interp(np.linspace(0, 1, around + 1), 0.5 * length / length[-1] + 0.5 * fine / np.pi, fine)
    node = np.arange((across + 1) * (around + 1)).reshape(across + 1, around + 1)
    cells = np.stack([node[:-1, :-1], node[1:, :-1], node[:-1, 1:], node[1:, 1:]], axis=-1).reshape(-1, 4)
    da, db = (side.ravel() for side in np.meshgrid(np.diff(alpha), np.diff(beta), indexing="ij"))
    a0, b0 = (side.ravel() for side in np.meshgrid(alpha[:-1], beta[:-1], indexing="ij"))
    points = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3.0)
    gradients, weight, shapes = [], [], []
    for s in points:
        for t in points:
            scale = at.c / (np.cosh(a0 + s * da) - np.cos(b0 + t * db))
            shape = np.array([(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t])
            by_a = np.array([-(1 - t), 1 - t, -t, t]) / (da * scale)[:, None]
            by_b = np.array([-(1 - s), -s, 1 - s, s]) / (db * scale)[:, None]
            gradients.append(np.stack([by_a, by_b], axis=1))
            weight.append(0.25 * np.abs(da * db) * scale**2)
            shapes.append(weight[-1][:, None] * shape)
    corners = np.tile(cells, (4, 1))
    load = np.bincount(corners.ravel(), np.concatenate(shapes).ravel(), node.size).astype(float)
    return _Mesh(corners, np.concatenate(gradients), np.concatenate(weight), load, node[0], node[1:-1].ravel())
