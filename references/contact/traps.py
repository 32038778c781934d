"""Errors of the libraries when they are used in the obvious way, each measured on a short bent tube.

Every function returns one number, which would be 0 if the obvious way worked.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.model.wellbore import build_wellbore, find_contacts
from references.contact import bullet as bullet_method
from references.contact import coal as coal_method
from references.contact import fcl as fcl_method
from references.contact import mujoco as mujoco_method
from references.contact.tube_mesh import Tube, TubeOptions, build_tube
from references.registry import import_optional, version_of

RADIUS = 0.051  # of the string [m]
Stations = tuple[tuple[float, float, float], ...]
STATIONS: Stations = ((0.0, 0.0, 0.0), (40.0, 8.0, 0.0))  # a bend of 286 m radius
HOLE = 0.3112  # diameter [m]


class Scene(NamedTuple):
    """The tube, touching points (n, 3) [m], their depth (n,) [m], normals and tangents of the hole (n, 3)."""

    tube: Tube
    points: Array
    depth: Array
    normal: Array
    tangent: Array


class Trap(NamedTuple):
    """The call that fails, package and module of it, a function that measures the error, its unit, and the remedy."""

    tried: str
    distribution: str
    module: str
    measure: Callable[[Any, Scene], float]
    unit: str
    instead: str


def scene(count: int = 150, stations: Stations = STATIONS) -> Scene:
    """A tube, bent if not told otherwise, and seeded points that press up to 10 mm into its wall."""
    end = stations[-1][0]
    hole_spec = {
        "stations": stations, "geometry": "arcs", "intervals": [{"to_md": end, "diameter": HOLE, "friction": 0.2}],
    }  # fmt: skip
    pipe = {"name": "pipe", "outer_diameter": 2 * RADIUS, "inner_diameter": 0.06, "segments": 4}
    case = Case.model_validate({"name": "bend", "wellbore": hole_spec, "string": {"components": [pipe]}})
    hole = build_wellbore(case)
    rng = np.random.default_rng(11)
    md, angle = rng.uniform(3.0, end - 3.0, count), rng.uniform(0, 2 * np.pi, count)
    points = hole.off_axis(md, angle, 0.5 * HOLE - RADIUS + rng.uniform(0.003, 0.010, count))
    hits = find_contacts(hole, points, RADIUS)
    return Scene(build_tube(case, TubeOptions()), points, hits.penetration, hits.normal, hole.at(md)[1])


def fcl_capsule(fcl: Any, at: Scene) -> float:
    """Largest error [m] of the depth of a 2 m capsule along the hole; the bend itself accounts for 2 mm."""
    wall = fcl_method.wall_of(fcl, at.tube)
    capsule = fcl.CollisionObject(fcl.Capsule(RADIUS, 2.0), fcl.Transform())
    request, worst = fcl.CollisionRequest(num_max_contacts=1000, enable_contact=True), 0.0
    for point, depth, normal, tangent in zip(at.points, at.depth, at.normal, at.tangent, strict=True):
        capsule.setTransform(fcl.Transform(np.stack([normal, np.cross(tangent, normal), tangent], axis=1), point))
        result = fcl.CollisionResult()
        fcl.collide(wall, capsule, request, result)
        deepest = max((abs(c.penetration_depth) for c in result.contacts), default=0.0)
        worst = max(worst, abs(deepest - depth))
    return worst


def fcl_first_contact(fcl: Any, at: Scene) -> float:
    """Largest error [mm] of the depth when only one contact is requested, which is the default."""
    wall, worst = fcl_method.wall_of(fcl, at.tube), 0.0
    sphere = fcl.CollisionObject(fcl.Sphere(RADIUS), fcl.Transform())
    for point, depth in zip(at.points, at.depth, strict=True):
        sphere.setTranslation(point)
        result = fcl.CollisionResult()
        fcl.collide(wall, sphere, fcl.CollisionRequest(enable_contact=True), result)
        worst = max(worst, abs(-result.contacts[0].penetration_depth - depth))
    return 1e3 * worst


def fcl_penetrating_distance(fcl: Any, at: Scene) -> float:
    """Share [%] of penetrating spheres that are given a distance that is not negative."""
    wall = fcl_method.wall_of(fcl, at.tube)
    sphere, wrong = fcl.CollisionObject(fcl.Sphere(RADIUS), fcl.Transform()), 0
    for point in at.points:
        sphere.setTranslation(point)
        wrong += fcl.distance(wall, sphere, fcl.DistanceRequest(), fcl.DistanceResult()) >= 0
    return 100 * wrong / len(at.points)


def coal_penetrating_distance(coal: Any, at: Scene) -> float:
    """Largest error [mm] of the distance of a penetrating sphere."""
    model = coal_method.wall_of(coal, at.tube, coal.BVHModelOBBRSS())
    sphere, placement, worst = coal.Sphere(RADIUS), coal.Transform3s(), 0.0
    for point, depth in zip(at.points, at.depth, strict=True):
        placement.setTranslation(point)
        found = coal.distance(
            model, coal.Transform3s(), sphere, placement, coal.DistanceRequest(True), coal.DistanceResult()
        )
        worst = max(worst, abs(-found - depth))
    return 1e3 * worst


def bullet_offset_sphere(bullet: Any, at: Scene) -> float:
    """Share [%] of touching spheres that are missed when the sphere is 5 m from the origin of its body."""
    client = bullet.connect(bullet.DIRECT)
    try:
        wall = bullet_method.wall_of(bullet, client, np.asarray(at.tube.mesh.vertices), at.tube)
        ball = bullet.createCollisionShape(
            bullet.GEOM_SPHERE, radius=RADIUS, collisionFramePosition=[0, 0, 5], physicsClientId=client
        )
        sphere, seen = bullet.createMultiBody(1, ball, physicsClientId=client), 0
        for place in at.points - [0, 0, 5]:
            bullet.resetBasePositionAndOrientation(sphere, place, (0, 0, 0, 1), physicsClientId=client)
            seen += bool(bullet.getClosestPoints(sphere, wall, 0.0, physicsClientId=client))
        return 100 - 100 * seen / len(at.points)
    finally:
        bullet.disconnect(client)


def mujoco_fixed_sphere(mujoco: Any, at: Scene) -> float:
    """Share [%] of touching spheres that are missed when they are mocap bodies."""
    bodies = "".join(
        f'<body mocap="true" pos="{x!r} {y!r} {z!r}"><geom size="{RADIUS}"/></body>' for x, y, z in at.points.tolist()
    )
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><size memory="64M"/><worldbody>{bodies}</worldbody>{mujoco_method.wall_of(at.tube)}</mujoco>'
    )
    data = mujoco.MjData(model)
    mujoco.mj_fwdPosition(model, data)
    seen = len(set(data.contact.geom[:, 0].tolist())) if data.ncon else 0
    return 100 - 100 * seen / len(at.points)


TRAPS = (
    Trap("a capsule along the string", "python-fcl", "fcl", fcl_capsule, "m", "a sphere at the contact point"),
    Trap(
        "one contact asked for (the default)",
        "python-fcl",
        "fcl",
        fcl_first_contact,
        "mm",
        "all contacts, the deepest taken",
    ),
    Trap(
        "distance of a penetrating sphere",
        "python-fcl",
        "fcl",
        fcl_penetrating_distance,
        "%",
        "distance of its centre",
    ),
    Trap("distance of a penetrating sphere", "coal", "coal", coal_penetrating_distance, "mm", "distance of its centre"),
    Trap(
        "a sphere off its body's origin",
        "pybullet",
        "pybullet",
        bullet_offset_sphere,
        "%",
        "nothing: queries see it, steps may not",
    ),
    Trap("fixed (mocap) spheres", "mujoco", "mujoco", mujoco_fixed_sphere, "%", "bodies with free joints, set by hand"),
)


def measure(trap: Trap, at: Scene) -> float:
    """The number of a trap; InputError where its package is not installed."""
    return trap.measure(import_optional(trap.module, trap.distribution, trap.tried, "contact"), at)


def installed(trap: Trap) -> bool:
    """Whether the package of a trap is installed."""
    return version_of(trap.distribution) is not None
