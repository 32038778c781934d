"""libigl's closest points are those of the triangles, in double precision."""

import numpy as np

from references import contact
from references.contact.box_tree import BoxTree
from tests.references.wells import RADIUS, bent_case, points_near_wall


def test_the_distance_is_that_of_the_nearest_triangle() -> None:
    """Against a tree of boxes of our own, whose distance from a triangle is in closed form."""
    method = contact.build("libigl", bent_case())
    triangles = BoxTree(np.asarray(method.tube.mesh.triangles))
    for region in ("straight", "build", "turn"):
        points, _ = points_near_wall(region, 200)
        wide = np.full(200, RADIUS + 0.05)  # all of them reach the wall
        expected = triangles.penetrations(points, wide)
        np.testing.assert_allclose(method.query(points, wide).penetration, expected, atol=1e-9)
