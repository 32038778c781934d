"""A Cosserat rod (PyElastica) at rest in a hole: a beam in three dimensions with which FCTD is compared.

The rod starts on the axis of the hole, or in a given shape, and is relaxed by damping.  The hole is FCTD's; the
mechanics of the pipe is PyElastica's (Gazzola and others 2018).
"""

from typing import Any, NamedTuple

import elastica
import numpy as np

from fctd.arrays import Array
from fctd.model.section import Section
from fctd.model.wellbore import Wellbore

# Step over the stable step, and steps between two checks of equilibrium.
STEP_SHARE = 0.5
CHECK_STEPS = 2000


class UnsettledError(Exception):
    """The rod did not come to rest; the text gives the remaining imbalance."""


class RestingRod(NamedTuple):
    """A rod at rest: nodes (n + 1, 3) [m], force of the wall on each (n + 1, 3) [N]; step [s], number of steps."""

    nodes: Array
    wall_force: Array
    step: float
    steps: int


class Bit(NamedTuple):
    """The lower end: its force uphole [N] and its radius [m]; one as wide as the hole is held on the axis."""

    weight_on_bit: float = 0.0
    radius: float = 0.0


FREE = Bit()


class _Surroundings(elastica.NoForces[Any]):
    """Wall, weight, clamp and the force on the bit.

    The wall is a penalty per metre at the nodes, each for its tributary length of rod.  The clamp is a bending spring,
    half an element of pipe above the middle of the first element: PyElastica's own clamp fixes that element, which
    clamps the pipe half an element too low.
    """

    def __init__(
        self, hole: Wellbore, section: Section, stiffness: float, share: Array, axis: Array, bit: Bit, downhole: Array
    ) -> None:
        super().__init__()
        self.axis, self.clamp = axis, section.EI / share[0]
        self.hole, self.stiffness, self.push = hole, stiffness * share, -bit.weight_on_bit * downhole
        self.radius = np.full(len(share), section.contact_radius)
        self.radius[-1] = max(bit.radius, section.contact_radius)
        self.weight = section.weight * share
        self.owner = np.zeros(len(share), dtype=np.int64)
        self.force = np.zeros((3, len(share)))

    def find(self, nodes: Array) -> None:
        """Update the force of the wall on nodes (3, n + 1) [m]."""
        walls = self.hole.walls(nodes.T, self.owner)
        distance = np.sqrt((walls.offset**2).sum(axis=1))
        depth = np.maximum(distance - walls.radius + self.radius, 0.0)
        self.force[:] = -(self.stiffness * depth / np.maximum(distance, 1e-12)) * walls.offset.T

    def apply_forces(self, system: Any, time: Any = 0.0) -> None:
        """Add wall and weight to the rod's external forces (called by PyElastica)."""
        self.find(system.position_collection)
        system.external_forces += self.force
        system.external_forces[2] += self.weight
        system.external_forces[:, -1] += self.push

    def apply_torques(self, system: Any, time: Any = 0.0) -> None:
        """Add the moment of the clamp to the first element, in the element's frame (called by PyElastica)."""
        directors = system.director_collection[:, :, 0]
        system.external_torques[:, 0] += directors @ (self.clamp * np.cross(directors[2], self.axis))


class _Simulator(elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing, elastica.Damping):
    """The system of PyElastica with the modules that the rod needs."""


def _rod(points: Array, length: float, section: Section) -> Any:
    """A rod of this section through points (n + 1, 3) [m], straight when unloaded."""
    count = len(points) - 1
    tangents = np.diff(points, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    # Directors without twist from one element to the next.
    directors, side = np.zeros((3, 3, count)), np.array([0.0, 1.0, 0.0])
    for k, tangent in enumerate(tangents):
        side = side - (side @ tangent) * tangent
        side /= np.linalg.norm(side)
        directors[:, :, k] = side, np.cross(tangent, side), tangent
    rod = elastica.CosseratRod.straight_rod(
        count,
        start=points[0],
        direction=tangents[0],
        normal=directors[0, :, 0].copy(),
        base_length=length,
        base_radius=section.outer,
        density=section.mass / (np.pi * section.outer**2),
        youngs_modulus=section.EA / (np.pi * section.outer**2),
        shear_modulus=section.shear / (np.pi * section.outer**2),
        position=np.ascontiguousarray(points.T),
        directors=directors,
    )
    # A hollow pipe.  Its rotary inertia is that of a rigid segment about its middle: it has no effect at rest, and that
    # of the cross-section would need steps a hundred times shorter.
    element = length / count
    for matrix, values in (
        (rod.shear_matrix, (section.shear, section.shear, section.EA)),
        (rod.bend_matrix, (section.EI, section.EI, section.GJ)),
        (rod.mass_second_moment_of_inertia, (section.mass * element**3 / 12,) * 3),
        (rod.inv_mass_second_moment_of_inertia, (12 / (section.mass * element**3),) * 3),
    ):
        matrix[:] = np.diag(values)[:, :, None]
    return rod


def rest(
    hole: Wellbore,
    section: Section,
    top_md: float,
    bit_md: float,
    elements: int,
    stiffness: float,
    damping: float,
    tolerance: float,
    longest: float,
    bit: Bit = FREE,
    start: Array | None = None,
) -> RestingRod:
    """Relax a pipe from ``top_md`` to ``bit_md`` [m], clamped along the hole at its top, until it is at rest.

    stiffness [N/m/m] of the wall; damping [1/s] of all motion; tolerance : largest unbalanced force over the weight;
    longest [s] : simulated time at most; start (elements + 1, 3) [m] : nodes of the unloaded pipe from which it starts,
    by default on the axis.  Raises UnsettledError.
    """
    length = bit_md - top_md
    element = length / elements
    points = hole.at(np.linspace(top_md, bit_md, elements + 1))[0] if start is None else start
    share = np.full(elements + 1, element)
    share[[0, -1]] *= 0.5
    rod = _rod(points, length, section)
    # The fastest modes of a chain of such elements: axial, and rotation of elements against shear.
    fastest = np.sqrt(max(4 * section.EA, 12 * section.shear + 4 * stiffness * element**2) / section.mass) / element
    step = STEP_SHARE * 2 / float(fastest)

    simulator = _Simulator()
    simulator.append(rod)
    simulator.constrain(rod).using(
        elastica.GeneralConstraint,
        constrained_position_idx=(0,),
        translational_constraint_selector=np.array([True, True, True]),
    )
    top_axis, bit_axis = hole.at(np.array([top_md, bit_md]))[1]
    around = hole, section, stiffness, share, top_axis, bit, bit_axis
    simulator.add_forcing_to(rod).using(_Surroundings, *around)
    simulator.dampen(rod).using(elastica.AnalyticalLinearDamper, uniform_damping_constant=damping, time_step=step)
    simulator.finalize()
    stepper, time = elastica.PositionVerlet(), np.float64(0.0)
    weight, imbalance, steps = section.weight * length, np.inf, 0
    probe = _Surroundings(*around)
    while steps * step < longest:
        for _ in range(CHECK_STEPS):
            time = stepper.step(simulator, time, np.float64(step))
        steps += CHECK_STEPS
        before = rod.velocity_collection.copy()
        time = stepper.step(simulator, time, np.float64(step))
        steps += 1
        # The unbalanced force on a node is the sum of its inertia and damping forces.
        pull = rod.mass * ((rod.velocity_collection - before) / step + damping * rod.velocity_collection)
        imbalance = float(np.abs(pull).max()) / weight
        if imbalance < tolerance:
            probe.find(rod.position_collection)
            return RestingRod(rod.position_collection.T.copy(), probe.force.T.copy(), step, steps)
        if not np.isfinite(imbalance):
            break
    raise UnsettledError(f"the largest unbalanced force is {imbalance:.2g} of the weight after {steps * step:.3g} s")
