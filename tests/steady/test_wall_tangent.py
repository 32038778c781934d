"""Loads of the wall on one body and their derivatives, by every law."""

import numpy as np
import pytest

from fctd.mechanics import state
from fctd.mechanics.contact import FACTOR, FACTOR_AROUND, STIFFNESS
from fctd.mechanics.jit import entry
from fctd.mechanics.law_names import CODES, NAMES
from fctd.mechanics.rotations import turned
from fctd.model.wellbore import Wellbore, build_wellbore
from fctd.steady.pose import POSE
from fctd.steady.tangent import Steady
from fctd.steady.wall_tangent import DIRECTIONS, UNKNOWNS, add_wall, read_wall
from tests.cases import make_case, pipe

Array = np.ndarray
RADIUS, ARM, TRIBUTARY = 0.08, 0.7, 9.0
# Read with ``orthotropic`` laws alone, the factor around the string is another one.
HOLE = build_wellbore(make_case(
    [[0, 30, 0], [300, 60, 40]], [pipe(100, 5)],
    wellbore={
        "geometry": "arcs",
        "intervals": [{"to_md": 300, "diameter": 0.2159, "friction": 0.2, "rotational_friction": 0.07}],
    },
))  # fmt: skip
OWNER = int(HOLE.owners(HOLE.at(np.array([150.0]))[0])[0])


# In its middle an oval whose ends hold a disc of this radius at two places.
GROOVED = build_wellbore(make_case(
    [[0, 30, 0], [300, 60, 40]], [pipe(100, 5, outer=2 * RADIUS)],
    wellbore={
        "geometry": "sampled",
        "intervals": [{"to_md": 300, "diameter": 0.2159, "friction": 0.2, "rotational_friction": 0.07}],
        "caliper": {"rows": [[140.0, 0.2, 0.1], [160.0, 0.2, 0.1]], "values": "radius"},
    },
))  # fmt: skip


@entry
def add(S, P, C, owner, laws, R, D):
    """``add_wall`` of body 1."""
    add_wall(S, 1, P, C, owner, laws, R, D, np.empty(12 * DIRECTIONS))


@entry
def read(S, P, C, owner, laws):
    """``read_wall`` of body 1."""
    return read_wall(S, 1, P, C, owner[1], laws)


def laws(law: str = "coulomb", speed: float = 0.3, spin: float = 6.0, **more: float | None) -> Steady:
    base = Steady(HOLE.geometry, CODES[law], 1.0, speed, spin, 0.0, 0.0, 0.0, 0.0)
    return base._replace(**more)


def body(penetration: float, hole: Wellbore = HOLE, angle: float = 1.0) -> tuple[Array, Array]:
    """A body beside the wall in the middle of a hole, tilted against it; its point is ``penetration`` deep."""
    S, P = state.new_state(1), np.zeros((2, POSE))
    S[state.ARM_CONTACT + 1], S[state.RADIUS + 1], S[state.TRIBUTARY + 1] = ARM, RADIUS, TRIBUTARY
    at, beside = np.array([150.0]), np.array([angle])
    radius = float(hole.walls(hole.off_axis(at, beside, np.array([0.01])), None, np.array([RADIUS])).radius[0])
    (point,) = hole.off_axis(at, beside, np.array([radius - RADIUS + penetration]))
    (axis,) = hole.at(at)[1]
    P[1, 3:7] = turned(*np.array([np.cos(0.39), -np.sin(0.39) * axis[1], np.sin(0.39) * axis[0], 0.0]), 0.02, -0.01, 0)
    P[1, 3:7] /= np.linalg.norm(P[1, 3:7])
    w, x, y, z = P[1, 3:7]
    P[1, :3] = point - ARM * np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
    return S, P


def found(S: Array, P: Array, of: Steady, hole: Wellbore = HOLE) -> tuple[Array, Array]:
    R, D = np.zeros((2, 6)), np.zeros((2, 6, 6))
    owner = int(hole.owners(hole.at(np.array([150.0]))[0])[0])
    add(S, P, hole.pieces, np.array([0, owner, 0]), of, R, D)
    return R[1], D[1]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(
    "more",
    [{}, {"at_axis": 1}, {"wall_exponent": 1.5}, {"orthotropic": True}, {"own": True}, {"corners": True}],
)
def test_derivatives_are_those_of_central_differences(name: str, more: dict[str, float | None]) -> None:
    """Beside round hole; with bow springs; and in a groove, in which a disc touches two places."""
    hole = GROOVED if "corners" in more else HOLE
    S, P = body(2e-3, hole, 0.03 if "corners" in more else 1.0)
    S[state.BOW_STIFFNESS + 1] = 3e6 if "own" in more else 0.0
    of = laws(name, **more)._replace(geometry=hole.geometry)
    R, D = found(S, P, of, hole)
    assert np.linalg.norm(R[:3]) > 100
    for k in range(UNKNOWNS):
        sides = []
        for h in (1e-8, -1e-8):
            Q = P.copy()
            if k < 3:
                Q[1, k] += h
            else:
                Q[1, 3:7] = turned(*Q[1, 3:7], *(h * np.eye(3)[k - 3]))
            sides.append(found(S, Q, of, hole)[0])
        np.testing.assert_allclose(D[:, k], -(sides[0] - sides[1]) / 2e-8, atol=1e-6 * np.abs(D).max())
    np.testing.assert_array_equal(D[:, UNKNOWNS:], 0.0)


def test_a_body_off_the_wall_has_no_loads() -> None:
    S, P = body(-1e-3)
    R, D = found(S, P, laws())
    assert not R.any()
    assert not D.any()
    assert read(S, P, HOLE.pieces, np.array([0, OWNER, 0]), laws()) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("scale", [1.0, 0.5])
@pytest.mark.parametrize("exponent", [1.0, 1.5])
def test_what_is_read_are_the_loads_that_were_added(scale: float, exponent: float) -> None:
    """Sliding alone: across the wall K d₀ (d/d₀)^p of the body's length, along it μ times as much."""
    S, P = body(2e-3)
    of = laws(spin=0.0, friction_scale=scale, wall_exponent=exponent, wall_reference=0.5e-3)
    normal, r_ft, r_mu_fn = read(S, P, HOLE.pieces, np.array([0, OWNER, 0]), of)
    stiffness, factor = float(HOLE.pieces[OWNER, STIFFNESS]), scale * float(HOLE.pieces[OWNER, FACTOR])
    assert normal == pytest.approx(stiffness * TRIBUTARY * 0.5e-3 * 4.0**exponent, rel=1e-9)
    assert r_mu_fn == pytest.approx(factor * normal * RADIUS)
    added, _ = found(S, P, of)
    assert np.linalg.norm(added[:3]) == pytest.approx(normal * np.hypot(1, factor), rel=1e-6)
    assert added[5] == pytest.approx(-r_ft)


def test_turning_has_the_factor_around_the_string() -> None:
    S, P = body(2e-3)
    owner, around = np.array([0, OWNER, 0]), float(HOLE.pieces[OWNER, FACTOR_AROUND])
    along = float(HOLE.pieces[OWNER, FACTOR])
    for of, factor in ((laws(speed=0.0, orthotropic=True), around), (laws(speed=0.0), along)):
        normal, r_ft, r_mu_fn = read(S, P, HOLE.pieces, owner, of)
        assert r_mu_fn == pytest.approx(factor * normal * RADIUS)
        assert r_ft == pytest.approx(r_mu_fn, rel=0.02)  # the body is tilted against the wall
        added, _ = found(S, P, of)
        assert added[5] == pytest.approx(-r_ft)
