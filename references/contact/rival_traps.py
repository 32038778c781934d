"""Errors of rivals' packages when they are used in the obvious way; see ``traps``, whose form these have.

Those of free fall and of a joint's load are none of contact: who takes an engine for its contact meets them next.
"""

from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from references.contact.traps import RADIUS, Scene, Trap, scene
from references.contact.warp import ANYWHERE, plain

GRAVITY = 9.81  # [m/s²]
# Inclination and azimuth [deg] of the ray that Warp casts: (1, 1, 1), changed a little by a fixed seed.
RAY = (55.347, 46.537)


def warp_parity(warp: Any, _at: Scene) -> float:
    """Share [%] of points inside an open tube along Warp's ray that are given a distance of points outside."""
    at = scene(150, ((0.0, *RAY), (60.0, *RAY)))
    mesh = at.tube.mesh
    found = _signed_distances(warp, True, mesh.vertices, mesh.faces, at.points)
    return 100 * float((found > 0).mean())


def warp_normal(warp: Any, _at: Scene) -> float:
    """Largest distance [m] from a tetrahedron, whose edges have 1 m, of a point outside that is said to be inside."""
    vertices, faces = np.vstack([np.zeros(3), np.eye(3)]), np.array([[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]])
    points = np.random.default_rng(11).uniform(-2.0, 3.0, (20_000, 3))
    outside = (points < 0).any(axis=1) | (points.sum(axis=1) > 1)
    found = _signed_distances(warp, False, vertices, faces, points[outside])
    return max(-float(found.min()), 0.0)


def _signed_distances(warp: Any, parity: bool, vertices: Array, faces: NDArray[np.int64], points: Array) -> Array:
    """Distances (n,) [m] of points (n, 3) from a mesh, below 0 inside, by Warp's query of parity or of normals."""
    plain(warp)

    def signed(mesh, points, parity, found):  # type: ignore[no-untyped-def]
        k = warp.tid()
        near = warp.mesh_query_point_sign_normal(mesh, points[k], ANYWHERE)
        if parity:
            near = warp.mesh_query_point_sign_parity(mesh, points[k], ANYWHERE)
        found[k] = near.sign * warp.length(points[k] - warp.mesh_eval_position(mesh, near.face, near.u, near.v))

    def array(values: NDArray[Any], kind: Any) -> Any:
        return warp.array(values, dtype=kind, device="cpu")

    signed.__annotations__ = {
        "mesh": warp.uint64, "points": warp.array(dtype=warp.vec3), "parity": bool,
        "found": warp.array(dtype=warp.float32),
    }  # fmt: skip
    corners = array(np.asarray(vertices, np.float32), warp.vec3), array(np.asarray(faces, np.int32).ravel(), warp.int32)
    mesh, found = warp.Mesh(*corners), array(np.empty(len(points), np.float32), warp.float32)
    asked = array(np.asarray(points, np.float32), warp.vec3)
    warp.launch(warp.kernel(signed), len(points), [mesh.id, asked, parity], [found], device="cpu")
    return np.asarray(found.numpy())


def exudyn_torus(exudyn: Any, _at: Scene) -> float:
    """Largest error [m] of the gap of a sphere that presses 0.1 m into a torus of 10 m and 1 m, at eight places."""
    items, worst = import_module("exudyn.itemInterface"), 0.0
    for angle in np.linspace(0.0, 2 * np.pi, 8, endpoint=False):
        system = exudyn.SystemContainer().AddSystem()
        ground = system.AddObject(items.ObjectGround())
        place = [10 + 0.9 * np.cos(angle), 0.0, 0.9 * np.sin(angle)]
        sphere, torus = (
            system.AddMarker(items.MarkerBodyRigid(bodyNumber=ground, localPosition=at)) for at in (place, [0, 0, 0])
        )
        history = system.AddNode(items.NodeGenericData(numberOfDataCoordinates=4, initialCoordinates=[0] * 4))
        contact = system.AddObject(
            items.ObjectContactSphereTorus(
                markerNumbers=[sphere, torus], nodeNumber=history, sphereRadius=0.2, torusMajorRadius=10.0,
                torusMinorRadius=1.0, torusAxis=[0, 0, 1], contactStiffness=1.0,
            )
        )  # fmt: skip
        system.Assemble()
        gap = system.GetObjectOutput(contact, exudyn.OutputVariableType.DisplacementLocal)
        worst = max(worst, abs(gap + 0.1))
    return worst


def exudyn_sum(exudyn: Any, at: Scene) -> float:
    """Largest error [mm] of the depth of spheres, by their force, on triangles that face into the hole."""
    return 1e3 * float(np.abs(_exudyn_depths(exudyn, at, at.tube.mesh.faces[:, ::-1]) - at.depth).max())


def exudyn_one_side(exudyn: Any, at: Scene) -> float:
    """Share [%] of touching spheres without a force on triangles that face out of the hole."""
    return 100 * float((_exudyn_depths(exudyn, at, at.tube.mesh.faces) == 0).mean())


def _exudyn_depths(exudyn: Any, at: Scene, faces: NDArray[np.int64]) -> Array:
    """Forces (n,) of exudyn's GeneralContact on spheres at the points, over the stiffness [m]."""
    items, stiffness = import_module("exudyn.itemInterface"), 1e6
    system = exudyn.SystemContainer().AddSystem()
    contact = system.AddGeneralContact()
    contact.SetFrictionPairings(np.zeros((1, 1)))
    contact.SetSearchTreeCellSize([20, 20, 20])
    contact.sphereSphereContact, contact.computeContactForces = False, True
    wall = system.AddMarker(items.MarkerBodyRigid(bodyNumber=system.AddObject(items.ObjectGround())))
    # Two springs in series, so each has twice the stiffness.
    contact.AddTrianglesRigidBodyBased(wall, 2 * stiffness, 0.0, 0, np.asarray(at.tube.mesh.vertices), faces, True)
    for point in at.points:
        node = system.AddNode(items.NodePoint(referenceCoordinates=point))
        system.AddObject(items.MassPoint(mass=1.0, nodeNumber=node))
        marker = system.AddMarker(items.MarkerNodePosition(nodeNumber=node))
        contact.AddSphereWithMarker(marker, RADIUS, 2 * stiffness, 0.0, 0)
    system.Assemble()
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.numberOfSteps, settings.timeIntegration.endTime = 1, 1e-9
    settings.solution.file.write = False
    system.SolveDynamic(settings, solverType=exudyn.DynamicSolverType.ExplicitEuler)
    forces = np.reshape(contact.GetSystemODE2RhsContactForces(copy=True), (-1, 3))
    return np.asarray(np.linalg.norm(forces, axis=1) / stiffness)


def newton_fall(newton: Any, _at: Scene) -> float:
    """How much [mm] a body 600 m above the origin falls too little in 0.1 s, in steps of 1 ms of Newton's VBD."""
    plain(import_module("warp"))
    height, step, steps = 600.0, 1e-3, 100
    builder = newton.ModelBuilder(gravity=(0.0, 0.0, -GRAVITY))
    builder.add_body(xform=(0, 0, height, 0, 0, 0, 1), mass=1.0, inertia=np.eye(3).ravel())
    builder.color()
    model = builder.finalize(device="cpu", skip_validation_inertia=True)
    solver = newton.solvers.SolverVBD(model, iterations=10)
    now, then, control = model.state(), model.state(), model.control()
    for _ in range(steps):
        now.clear_forces()
        solver.step(now, then, control, None, step)
        now, then = then, now
    fallen = height - float(now.body_q.numpy()[0, 2])
    return 1e3 * abs(0.5 * GRAVITY * (steps * step) ** 2 - fallen)


def rapier_load(rapier: Any, _at: Scene) -> float:
    """Error [%] of the load of a joint that holds a body at rest, as its impulse over the step."""
    mass, step = 10.0, 1 / 240
    world = rapier.PhysicsWorld(gravity=(0.0, 0.0, -GRAVITY))
    world.integration_parameters.dt = step
    top = world.add_body(rapier.RigidBody.fixed())
    body = world.add_body(rapier.RigidBody.dynamic(translation=(0, 0, -1), can_sleep=False, additional_mass=mass))
    ball = rapier.SphericalJoint.builder(local_anchor1=(0, 0, 0), local_anchor2=(0, 0, 1))
    joint = world.impulse_joints.insert(top, body, ball)
    for _ in range(240):
        world.step()
    load = float(np.linalg.norm(world.impulse_joints.get(joint).impulses[:3])) / step
    return 100 * abs(1 - load / (mass * GRAVITY))


SIDE, OWN = "the side of the nearest face", "a wall of one's own"
TRAPS = (
    Trap("signed distance of an open tube, by parity", "warp-lang", "warp", warp_parity, "%", SIDE),
    Trap("signed distance by normals", "warp-lang", "warp", warp_normal, "m", SIDE),
    Trap("a sphere in a torus, off the plane of its ring", "exudyn", "exudyn", exudyn_torus, "m", OWN),
    Trap("force of spheres on triangles", "exudyn", "exudyn", exudyn_sum, "mm", OWN),
    Trap("triangles that face out of the hole", "exudyn", "exudyn", exudyn_one_side, "%", "turned triangles"),
    Trap("free fall at 600 m in steps of 1 ms (VBD)", "newton", "newton", newton_fall, "mm", "a near origin"),
    Trap("impulse of a joint over the step", "rapier3d", "rapier3d", rapier_load, "%", "times the solver's iterations"),
)
