"""Numbers that count their operations, and the box tree whose operations are counted."""

import math

import numpy as np
import pytest
from numba import njit

from fctd.mechanics import contact
from references.contact import build
from references.contact.box_tree import BoxTree, _near, penetration
from references.timing.operation_count import Counted, Number, arithmetic, counted, interpreted, operations_of


@njit
def _inner(x):
    return x * x + 1.0


@njit
def _outer(S, j):
    if S[j] > 2.0:
        S[j + 1] = np.sqrt(_inner(S[j])) / 2 - (-S[j])
    return S[j + 1]


def test_a_compiled_helper_counts_its_operations_and_keeps_its_result():
    values = np.array([3.0, 0.0])
    tally = operations_of(interpreted(_outer), Counted(values), 0)
    assert tally == {"multiply": 1, "add": 1, "root": 1, "divide": 1, "subtract": 1, "compare": 1}
    assert arithmetic(tally) == 5
    assert values[1] == pytest.approx(_outer(np.array([3.0, 0.0]), 0))


def test_operations_with_plain_numbers_count_on_either_side():
    x = Number(4.0)
    found, tally = counted(lambda: [2 - x, 2 / x, np.float64(3.0) * x, 1 + x, x - 1])
    assert [float(value) for value in found] == [-2.0, 0.5, 12.0, 5.0, 3.0]
    assert tally == {"subtract": 2, "divide": 1, "multiply": 1, "add": 1}


def test_the_search_tests_two_distances_with_and_without_a_change_of_cylinder():
    pieces = np.zeros((3, contact.COLUMNS))
    pieces[:, contact.START + 2] = [0.0, 10.0, 20.0]
    pieces[:, contact.DIRECTION + 2] = 1.0
    pieces[:, contact.LENGTH] = 10.0
    walk = interpreted(contact.cylinder_owner)

    def count(start, z):
        owner, tally = counted(walk, Counted(pieces), start, *map(Number, (0.0, 0.0, z)))
        return owner, arithmetic(tally)

    (stays, near), (moves, far) = count(1, 15.0), count(0, 15.0)
    assert (stays, moves) == (1, 1)
    assert near == 2 * 8  # its own cylinder and the one before
    assert far == 2 * 8  # the cylinder at the start and the next one


def test_box_tree_finds_the_nearest_triangle():
    import trimesh

    rng = np.random.default_rng(3)
    mesh = trimesh.creation.annulus(0.9, 1.0, 3.0, sections=13)
    tree = BoxTree(np.asarray(mesh.triangles))
    points = rng.uniform(-1.3, 1.3, (20, 3)) * [1, 1, 1.6]
    _, distance, _ = trimesh.proximity.closest_point(mesh, points)
    counted_one = interpreted(penetration)
    for point, away in zip(points, distance, strict=True):
        deep, nodes, triangles = counted_one(tree.low, tree.high, tree.corners, tree.first_leaf, *point, 0.4)
        assert nodes > triangles or nodes == 1
        assert deep == pytest.approx(0.4 - away) if away < 0.4 else deep == -math.inf
    compiled = tree.penetrations(points, np.full(len(points), 0.4))
    assert compiled == pytest.approx(np.where(distance < 0.4, 0.4 - distance, -np.inf))


def test_box_tree_has_the_same_penetrations_as_coal():
    from fctd import load_case
    from references.contact.tube_mesh import TubeOptions, build_tube
    from validation.cases import FOLDER

    case = load_case(FOLDER / "scaled_section.toml")
    coal = build("coal", case, query="collide", facets=16)
    tree = BoxTree(np.asarray(build_tube(case, TubeOptions(facets=16)).mesh.triangles))
    points = np.array([[0.0, 0.024, 12.0], [0.02, -0.015, 20.3], [0.0, 0.0, 5.0]])
    hits = coal.query(points, np.full(3, 0.03))
    deep = tree.penetrations(points, np.full(3, 0.03))
    assert (hits.penetration[:2] > 0).all()
    assert deep == pytest.approx(hits.penetration)


def test_a_sphere_meets_the_corner_of_a_box_when_it_reaches_it():
    low, high, near = np.zeros((1, 3)), np.ones((1, 3)), interpreted(_near)
    assert near(low, high, 0, 1.5, -0.5, 1.5, 0.751)
    assert not near(low, high, 0, 1.5, -0.5, 1.5, 0.749)
    assert near(low, high, 0, 0.5, 0.5, 0.5, 1e-9)
