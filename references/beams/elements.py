"""A geometrically exact planar beam in a hole, by finite elements (scikit-fem): forces, tangents, statics.

Simo–Reissner beam (Simo 1985): position (z, x) and rotation θ of the section along the string, strains

    Γ₁ = z' cos θ + x' sin θ − 1,   Γ₂ = −z' sin θ + x' cos θ,   κ = θ',

with EA, κGA and EI.  Quadratic elements; strains at two Gauss points, with which a quadratic beam neither
locks in shear nor has a mechanism.  The wall is a penalty per metre at separate Gauss points, with the exact geometry
of the bend, and friction acts at the surface of the pipe that touches the wall.  All tangents are exact derivatives.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu
from skfem import Basis, ElementLineP2, ElementVector, MeshLine

from fctd.arrays import Array
from fctd.model.section import Section
from references.beams.planar_hole import PlanarHole

# Components of a state.
Z, X, TURN = 0, 1, 2
STRAIN_POINTS = 3  # degree that two Gauss points integrate exactly
WALL_POINTS = 9  # degree that five Gauss points integrate exactly
MOST_ITERATIONS = 25
# Newton's iteration has converged when the largest unbalanced force is below this share of the load, or rounding.
CONVERGED = 1e-7
# Pseudo-time steps of a relaxation [s], and their growth.
FIRST_STEP, SHORTEST_STEP, LAST_STEP, GROWTH = 0.01, 1e-6, 1e6, 4.0


class ConvergenceError(Exception):
    """Newton's iteration did not converge; the text gives the remaining imbalance."""


class Surroundings(NamedTuple):
    """Hole, mud and weight of the beam along its length.

    hole : None without a hole; clearance [m]; wall stiffness [N/m/m]; friction factor; contact radius [m];
    creep [m/s] : sliding speed at which friction has reached tanh 1 of its limit;
    lateral, axial mud damping [N s/m^2]; weight [N/m], along +z.
    """

    hole: PlanarHole | None = None
    clearance: float = np.inf
    stiffness: float = 0.0
    friction: float = 0.0
    radius: float = 0.0
    creep: float = 1e-3
    lateral_damping: float = 0.0
    axial_damping: float = 0.0
    weight: float = 0.0


class WallLoad(NamedTuple):
    """Loads of wall and mud on the beam at Gauss points, shape (elements, points) after the leading axes.

    resistance (3, ...) [N/m, N] against z, x, θ and its derivatives (3, 3, ...) by position and by velocity;
    pressure (...) [N/m], positive on the high side and negative on the low side; md (...) [m];
    energy (...) [J/m] stored in the wall; friction_loss, mud_loss (...) [W/m].
    """

    resistance: Array
    by_position: Array
    by_velocity: Array
    pressure: Array
    md: Array
    energy: Array
    friction_loss: Array
    mud_loss: Array


class _Points:
    """Quadrature points of a basis: values of a state at these points, and nodal forces of densities at them.

    scikit-fem calls a form once for every pair of the nine functions of an element, which takes most of the time on
    meshes of few elements.  Here the functions are tabulated, and one product evaluates all of them.
    """

    def __init__(self, basis: Basis, slopes: list[int], values: list[int]) -> None:
        """slopes, values : components of a state (0 to 2) of which the derivative, or the value, is taken; r in all."""
        fields = [field for (field,) in basis.basis]
        table = [np.concatenate([field.grad[slopes, 0], np.asarray(field)[values]]) for field in fields]
        # (elements, points, r, functions)
        self.table: Array = np.ascontiguousarray(np.array(table).transpose(2, 3, 1, 0))
        self.dofs: NDArray[np.int64] = basis.element_dofs.T
        self.size: int = basis.N
        self._flat = self.table.reshape(len(self.dofs), -1, self.dofs.shape[1])
        weighted = self.table * basis.dx[:, :, None, None]
        self._weighted: Array = np.ascontiguousarray(weighted.reshape(self._flat.shape).transpose(0, 2, 1))

    def of(self, q: Array) -> Array:
        """The components in state q, shape (r, elements, points)."""
        found = self._flat @ q[self.dofs][:, :, None]
        return found.reshape(self.table.shape[:3]).transpose(2, 0, 1)

    def forces(self, density: Array) -> Array:
        """Nodal forces of a density (r, elements, points) that is conjugate to the components."""
        elements = self._weighted @ density.transpose(1, 2, 0).reshape(len(self.dofs), -1, 1)
        return np.asarray(np.bincount(self.dofs.ravel(), elements.ravel(), self.size), np.float64)

    def tangents(self, density: Array) -> Array:
        """Tangents (elements, functions, functions) of forces whose density has the derivative (r, r, ...)."""
        product = density.transpose(2, 3, 0, 1) @ self.table
        return self._weighted @ product.reshape(self._flat.shape)

    def matrix(self, tangents: Array) -> csc_matrix:
        """The tangents of all elements as one matrix."""
        rows = np.broadcast_to(self.dofs[:, :, None], tangents.shape)
        columns = np.broadcast_to(self.dofs[:, None, :], tangents.shape)
        entries = tangents.ravel(), (rows.ravel(), columns.ravel())
        return csc_matrix(entries, shape=(self.size, self.size))


class Beam:
    """A beam of one section, with its mesh and its surroundings.

    A state is a vector of z [m], x [m] and θ [rad] at the nodes, in scikit-fem's order.
    """

    def __init__(self, nodes: Array, section: Section, around: Surroundings, at_ends: bool = False) -> None:
        """nodes (n,) [m] : ends of the elements along the unstretched string, from the top.

        at_ends : wall and mud act only at the ends of the elements, each with its tributary length.
        """
        self.nodes, self.section, self.around = nodes, section, around
        mesh, element = MeshLine(nodes), ElementVector(ElementLineP2(), 3)
        self.strains = Basis(mesh, element, intorder=STRAIN_POINTS)
        whole = Basis(mesh, element, intorder=WALL_POINTS)
        ends = np.array([[0.0, 1.0]]), np.array([0.5, 0.5])
        self.wall = Basis(mesh, element, quadrature=ends) if at_ends else whole
        self.strained = _Points(self.strains, [Z, X, TURN], [TURN])
        self._touching = _Points(self.wall, [], [Z, X, TURN])
        carrying = _Points(whole, [], [Z, X, TURN])
        ones = np.ones(whole.dx.shape)
        self.gravity = carrying.forces(np.multiply.outer([around.weight, 0.0, 0.0], ones))
        inertia = np.diag([section.mass, section.mass, section.tilt_inertia])
        self.mass = carrying.matrix(carrying.tangents(np.multiply.outer(inertia, ones)))

    @property
    def length(self) -> float:
        """Unstretched length [m]."""
        return float(self.nodes[-1] - self.nodes[0])

    def tolerance(self, load: float) -> float:
        """Largest unbalanced force of a converged state [N]: a share of the load, or the rounding error."""
        finest = float(np.diff(self.nodes).min())
        rounding = 16 * np.finfo(float).eps * self.section.EA * self.length / finest
        return max(CONVERGED * load, rounding)

    def dofs(self, at: float) -> NDArray[np.int64]:
        """Numbers of z, x and θ in a state at the node nearest to ``at`` [m] along the string."""
        s = self.strains.doflocs[0]
        nearest = s[np.argmin(np.abs(s - at))]
        (found,) = np.nonzero(s == nearest)
        return found

    def points(self) -> tuple[Array, NDArray[np.int64]]:
        """Positions of all nodes along the string, midpoints too, (m,) [m], and their numbers in a state (m, 3)."""
        s = self.strains.doflocs[0]
        order = np.argsort(s, kind="stable").reshape(-1, 3)
        return s[order[:, 0]], order

    def straight(self, top: float) -> Array:
        """The state of the unstretched, vertical beam with its top at z = ``top`` [m]."""
        s, numbers = self.points()
        q = np.zeros(self.strains.N)
        q[numbers[:, 0]] = top + s - self.nodes[0]
        return q

    def _strains(self, q: Array) -> tuple[Array, Array, Array, Array, Array]:
        """Γ₁, Γ₂, κ, cos θ and sin θ at the strain points."""
        dz, dx, bend, turn = self.strained.of(q)
        cosine, sine = np.cos(turn), np.sin(turn)
        return dz * cosine + dx * sine - 1, -dz * sine + dx * cosine, bend, cosine, sine

    def internal(self, q: Array) -> tuple[Array, Array]:
        """Internal forces of state q, and their exact tangents for each element."""
        stretch, shear, bend, c, s = self._strains(q)
        section = self.section
        n, v = section.EA * stretch, section.shear * shear
        gradient = np.stack([n * c - v * s, n * s + v * c, section.EI * bend, n * shear - v * (1 + stretch)])
        first, second = np.stack([c, s, 0 * c, shear]), np.stack([-s, c, 0 * c, -(1 + stretch)])
        hessian = section.EA * first[:, None] * first + section.shear * second[:, None] * second
        hessian[2, 2] += section.EI
        # Second derivatives of the strains: only rotation enters them nonlinearly.
        for row, value in ((0, -n * s - v * c), (1, n * c - v * s)):
            hessian[row, 3] += value
            hessian[3, row] += value
        hessian[3, 3] -= n * (1 + stretch) + v * shear
        return self.strained.forces(gradient), self.strained.tangents(hessian)

    def strain_energy(self, q: Array) -> float:
        """Energy of stretching, shear and bending [J]."""
        stretch, shear, bend, _, _ = self._strains(q)
        section = self.section
        density = 0.5 * (section.EA * stretch**2 + section.shear * shear**2 + section.EI * bend**2)
        return float((density * self.strains.dx).sum())

    def integrate(self, density: Array) -> float:
        """Integral along the string of a density at the wall's Gauss points."""
        return float((density * self.wall.dx).sum())

    def wall_load(self, q: Array, velocity: Array) -> WallLoad:
        """Loads of wall and mud in state q with its ``velocity``."""
        at, v = self._touching.of(q), self._touching.of(velocity)
        around = self.around
        blank = np.zeros(at.shape[1:])
        resistance, loss = np.zeros(at.shape), blank.copy()
        by_position, by_velocity = np.zeros((3, *at.shape)), np.zeros((3, *at.shape))
        mud_loss, pressure, md = blank.copy(), blank.copy(), blank.copy()
        if around.lateral_damping or around.axial_damping:
            mud_loss = _add_mud(around, at[2], v, resistance, by_position, by_velocity)
        if around.hole is not None:
            axis = around.hole.axis(at[:2])
            md = axis.md
            side = np.sign(axis.offset)
            depth = np.maximum(np.abs(axis.offset) - around.clearance, 0.0)
            pressure = around.stiffness * side * depth
            n, t = axis.normal, axis.tangent
            resistance[:2] += pressure * n
            # The normal turns with the point along the hole: d n = −turn t (t·dr).
            elastic = around.stiffness * (depth > 0) * n[:, None] * n - pressure * axis.turn * t[:, None] * t
            by_position[:2, :2] += elastic
            if around.friction:
                loss = _add_friction(around, axis.turn, t, n, side, depth, v, resistance, by_position, by_velocity)
        energy = 0.5 * pressure**2 / around.stiffness if around.stiffness else blank
        return WallLoad(resistance, by_position, by_velocity, pressure, md, energy, loss, mud_loss)

    def resistance(self, q: Array, velocity: Array, rate: float = 0.0) -> tuple[Array, csc_matrix, WallLoad]:
        """All forces but inertia that resist a state, less gravity; their tangent; the loads of wall and mud.

        rate [1/s] : change of velocity with q, from the time integration.
        """
        force, tangents = self.internal(q)
        load = self.wall_load(q, velocity)
        force = force - self.gravity + self._touching.forces(load.resistance)
        tangents += self._touching.tangents(load.by_position + rate * load.by_velocity)
        return force, self.strained.matrix(tangents), load


def _add_mud(
    around: Surroundings, tilt: Array, v: Array, resistance: Array, by_position: Array, by_velocity: Array
) -> Array:
    """Add viscous drag along and across the pipe; returns the power lost [W/m]."""
    lateral, axial = around.lateral_damping, around.axial_damping
    t = np.stack([np.cos(tilt), np.sin(tilt)])
    n = np.stack([-t[1], t[0]])
    along, across = (t * v[:2]).sum(axis=0), (n * v[:2]).sum(axis=0)
    resistance[:2] += axial * along * t + lateral * across * n
    by_velocity[:2, :2] += axial * t[:, None] * t + lateral * n[:, None] * n
    by_position[:2, 2] += (axial - lateral) * (along * n + across * t)
    return np.asarray(axial * along**2 + lateral * across**2)


def _add_friction(
    around: Surroundings,
    turn: Array,
    t: Array,
    n: Array,
    side: Array,
    depth: Array,
    v: Array,
    resistance: Array,
    by_position: Array,
    by_velocity: Array,
) -> Array:
    """Add regularised Coulomb friction opposite to the sliding of the pipe's surface; returns the power lost [W/m].

    The wall touches the pipe at a contact radius from its axis, so that rotation of the section contributes to sliding.
    """
    # Sliding speed is arm·(ż, ẋ, θ̇).
    arm = np.stack([t[0], t[1], -around.radius * side])
    sliding = (arm * v).sum(axis=0)
    share = np.tanh(sliding / around.creep)
    steepness = (1 - share**2) / around.creep
    limit = around.friction * around.stiffness * depth
    slope = around.friction * around.stiffness * (depth > 0) * side
    resistance += limit * share * arm
    by_velocity += limit * steepness * arm[:, None] * arm
    by_position[:, :2] += (slope * share) * arm[:, None] * n
    # The tangent turns with the point: d t = turn n (t·dr).
    by_position[:2, :2] += limit * share * turn * n[:, None] * t
    across = (n * v[:2]).sum(axis=0)
    by_position[:, :2] += limit * steepness * across * turn * arm[:, None] * t
    return np.asarray(limit * share * sliding)


def newton(
    residual: Callable[[Array], tuple[Array, csc_matrix]],
    q: Array,
    free: NDArray[np.int64],
    tolerance: float,
    most: int = MOST_ITERATIONS,
) -> tuple[Array, int]:
    """Solve ``residual(q) = (r, tangent)`` for the free dofs; returns the solution and the number of iterations.

    tolerance [N] : largest r of a solution.  Raises ConvergenceError after ``most`` iterations.
    """
    q = q.copy()
    size = np.inf
    for iteration in range(most):
        r, tangent = residual(q)
        size = float(np.abs(r[free]).max())
        if not np.isfinite(size):
            break
        if size < tolerance:
            return q, iteration
        q[free] -= splu(tangent[free][:, free].tocsc()).solve(r[free])
    raise ConvergenceError(f"the largest unbalanced force is {size:.2g} N after {most} iterations")


def statics(
    beam: Beam, q: Array, fixed: NDArray[np.int64], load: Array | None = None, velocity: Array | None = None
) -> Array:
    """Equilibrium near q under gravity, wall and a nodal load; the ``fixed`` dofs keep their values.

    velocity : steady sliding velocity, against which friction acts.  Raises ConvergenceError.
    """
    free = np.setdiff1d(np.arange(len(q)), fixed)
    zero = np.zeros_like(q)
    extra, sliding = zero if load is None else load, zero if velocity is None else velocity

    def residual(trial: Array) -> tuple[Array, csc_matrix]:
        force, tangent, _ = beam.resistance(trial, sliding)
        return force - extra, tangent

    carried = beam.around.weight * beam.length + float(np.abs(extra).sum())
    return newton(residual, q, free, beam.tolerance(carried))[0]


def relaxed(beam: Beam, q: Array, fixed: NDArray[np.int64]) -> Array:
    """Equilibrium to which a damped beam moves from q, which may be far from it; the ``fixed`` dofs keep their values.

    Pseudo-transient continuation: implicit Euler with the damping of the mud, in steps that grow until damping is
    negligible.  The beam has to be damped along and across.  Raises ConvergenceError.
    """
    free = np.setdiff1d(np.arange(len(q)), fixed)
    tolerance = beam.tolerance(beam.around.weight * beam.length)
    step = FIRST_STEP
    while step < LAST_STEP:
        start, pace = q, 1 / step

        def residual(trial: Array, start: Array = start, pace: float = pace) -> tuple[Array, csc_matrix]:
            return beam.resistance(trial, pace * (trial - start), pace)[:2]

        try:
            q, _ = newton(residual, q, free, tolerance)
            step *= GROWTH
        except ConvergenceError:
            step /= GROWTH**2
            if step < SHORTEST_STEP:
                raise
    return statics(beam, q, fixed)
