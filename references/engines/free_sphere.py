"""One free sphere in rivals that compute in single precision: whether it falls, by height and step.

Newton's solver VBD keeps places and derives velocity from them in every step; its solvers XPBD and SemiImplicit keep
the velocity of a rigid body, as Rapier does in each of the sub-steps into which it divides a step.
"""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

from fctd.mechanics.topdrive import GRAVITY
from references.registry import import_optional

RADIUS = 0.05  # [m]


class Sphere(NamedTuple):
    """A sphere in an engine: the package that brings it; whether places alone are kept; the sub-steps of a step.

    fall : of the sphere [m] from rest at a height [m] with a step [s] over a time [s].
    """

    distribution: str
    places_alone: bool
    sub_steps: int
    fall: Callable[[float, float, float], float]


def in_newton(solver: str, height: float, step: float, seconds: float) -> float:
    """Fall [m] in one of Newton's solvers on the processor.  InputError where it is not installed."""
    warp = import_optional("warp", "warp-lang", solver, "engine")
    warp.config.quiet = True  # else it prints every module that it loads
    newton = import_optional("newton", "newton", solver, "engine")
    builder = newton.ModelBuilder(up_axis=newton.Axis.Z, gravity=(0.0, 0.0, -GRAVITY))
    body = builder.add_body(xform=warp.transform((0.0, 0.0, height), warp.quat_identity()))
    builder.add_shape_sphere(body, radius=RADIUS)
    if solver == "SolverVBD":  # it solves bodies of one colour at once, here the only one
        builder.color()
    model = builder.finalize(device="cpu")
    moving = getattr(newton.solvers, solver)(model)
    now, then, control = model.state(), model.state(), model.control()
    for _ in range(round(seconds / step)):
        now.clear_forces()
        moving.step(now, then, control, None, step)
        now, then = then, now
    return height - float(now.body_q.numpy()[0][2])


def in_rapier(sub_steps: int, height: float, step: float, seconds: float) -> float:
    """Fall [m] in Rapier with this number of sub-steps.  InputError where it is not installed."""
    rapier = import_optional("rapier3d", "rapier3d", "Rapier", "engine")
    world = rapier.PhysicsWorld(gravity=(0.0, 0.0, -GRAVITY))
    world.integration_parameters.dt = step
    world.integration_parameters.num_solver_iterations = sub_steps
    body = world.add_body(
        rapier.RigidBody.dynamic(translation=(0.0, 0.0, height)), colliders=[rapier.Collider.ball(RADIUS)]
    )
    for _ in range(round(seconds / step)):
        world.step()
    return height - float(world.rigid_bodies[body].translation[2])


SPHERES: dict[str, Sphere] = {
    "Newton, VBD": Sphere("newton", True, 1, partial(in_newton, "SolverVBD")),
    "Newton, XPBD": Sphere("newton", False, 1, partial(in_newton, "SolverXPBD")),
    "Newton, SemiImplicit": Sphere("newton", False, 1, partial(in_newton, "SolverSemiImplicit")),
    "Rapier, 4 sub-steps": Sphere("rapier3d", False, 4, partial(in_rapier, 4)),
    "Rapier, 1 sub-step": Sphere("rapier3d", False, 1, partial(in_rapier, 1)),
}
