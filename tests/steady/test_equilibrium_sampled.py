"""Steady strings in holes that are no circle, against closed forms."""

import numpy as np
import pytest
from scipy.optimize import fsolve

import fctd
from fctd.arrays import Array
from fctd.case.load import Case
from fctd.model.drillstring import lay_out
from fctd.steady.steady_string import Equilibrium
from tests.cases import make_case, pipe

BORE, RADIUS, LENGTH = 0.2159, 0.0635, 120.0


def level_case(
    rows: Array, segment: float, friction: float = 0.0, cell: float = 0.1, around: float | None = None
) -> Case:
    """Pipe in a level hole with a caliper of radii [m]; around : friction factor around the string."""
    pair = {} if around is None else {"rotational_friction": around}
    hole = {
        "stations": [[0, 90, 0], [LENGTH + 10, 90, 0]], "geometry": "sampled", "cell": cell,
        "stiffness_per_length": 1e9,
        "intervals": [{"to_md": LENGTH + 10, "diameter": BORE, "friction": friction} | pair],
        "caliper": {"rows": rows.tolist(), "values": "radius"},
    }  # fmt: skip
    parts = [pipe(None, None, segment_length=segment)]
    return make_case(components=parts, wellbore=hole, rig={"block_weight": 1e6})


def solved(case: Case, operation: str) -> Equilibrium:
    point = fctd.equilibrium(case, operation, LENGTH)
    assert point.status in ("converged", "locked_up")
    return point


def half_angle(a: float, b: float) -> float:
    """Angle [rad] from the lower end of an oval with the half axes a (upright) and b to the normals of both places.

    The disc touches both as far aside as its radius reaches: closed form of an ellipse.  0 where it touches the end.
    """
    c = np.sqrt(a * a - b * b)
    x = c * np.sqrt(1 - (RADIUS / b) ** 2)
    cosine = min(a * x / (c * c), 1.0)
    return float(np.arctan2(b * np.sqrt(1 - cosine**2), a * cosine - x))


def of_groove(beta: float, along: float, around: float, speed: float, turning: float) -> tuple[float, float, float]:
    """Drag, torque over radius, and force that holds a disc, all over its weight, between two walls.

    beta : of the normals from the bisector, which the weight is on.  Both places slide with the same velocities along
    and around the string, so each has the same share of its own normal force as friction: two equations for both.
    One wall alone where the other would have to pull.
    """
    size = np.hypot(along * speed, around * turning)
    f, g = along**2 * speed / size, around**2 * turning / size
    if beta == 0 or np.tan(beta) < g:
        return f / np.sqrt(1 + g * g), g / np.sqrt(1 + g * g), 1 / np.sqrt(1 + g * g)
    normals = np.array([[np.sin(k * beta), np.cos(beta)] for k in (-1, 1)])
    tangents = np.column_stack([normals[:, 1], -normals[:, 0]])
    forces = np.linalg.solve((normals - g * tangents).T, [0.0, 1.0])
    assert forces.min() >= 0
    return f * forces.sum(), g * forces.sum(), float(np.linalg.norm(forces @ normals))


SPEED, RPM = 0.2, 30.0
MOTIONS = {"trip_out": {"speed": SPEED}, "rotate_off_bottom": {"rpm": RPM}, "back_ream": {"speed": SPEED, "rpm": RPM}}


@pytest.mark.parametrize("operation", MOTIONS)
@pytest.mark.parametrize(
    ("long_axis", "short_axis", "along", "around", "places"),
    [
        (0.125, 0.108, 0.2, None, 1), (0.25, 0.108, 0.3, None, 2), (0.2, 0.07, 0.3, None, 2),
        (0.2, 0.08, 0.35, 0.15, 2), (0.19, 0.108, 0.4, None, 2),
    ],
)  # fmt: skip
def test_pipe_in_an_oval_rubs_on_one_place_or_two(
    long_axis: float, short_axis: float, along: float, around: float | None, places: int, operation: str
) -> None:
    """In pure rotation M = μ r W/((1 + μ²) cos β) while tan β ≥ μ, else it climbs one side: M = μ r W/√(1 + μ²)."""
    md = np.arange(1.0, LENGTH + 9, 5.0)
    rows = np.column_stack([md, np.full(len(md), long_axis), np.full(len(md), short_axis)])
    case = level_case(rows, 5.0, along, around=around)
    point = fctd.equilibrium(case, operation, LENGTH, **MOTIONS[operation])
    assert point.answered
    beta, mu = half_angle(long_axis, short_axis), around or along
    assert (beta > 0) == (places == 2)
    rates = MOTIONS[operation]
    drag, torque, held = of_groove(
        beta, along, mu, rates.get("speed", 0.0), RADIUS * rates.get("rpm", 0.0) * np.pi / 30
    )
    if operation == "rotate_off_bottom":
        more = np.sqrt(1 + mu * mu)
        assert torque == pytest.approx(mu / (more * more * np.cos(beta) if np.tan(beta) >= mu else more))
    # The drive holds pipe on the axis, metres of which do not lie down.
    weight = float(point.profile["contact_force_N"].sum()) / held
    string = lay_out(case, LENGTH)
    assert weight == pytest.approx(float((string.weight * string.length).sum()), rel=0.1)
    assert point.surface_torque == pytest.approx(torque * RADIUS * weight, rel=0.01, abs=1e-4 * weight)
    assert point.hookload == pytest.approx(drag * weight, rel=0.01, abs=1e-3 * weight)


def test_pipe_over_a_ledge_lifts_off_on_both_sides() -> None:
    """A floor that rises by h: contact with its edge, and pipe that lies down a before it and b behind it.

    Euler–Bernoulli: w = V (x + a)³/6EI − q (x + a)⁴/24EI, from x = 0 on with R x³/6EI for the force R of the edge. It
    is h at 0, and at b again, with neither slope nor moment there.
    """
    rise, edge = 0.02, 60.0
    md = np.concatenate([np.arange(1.0, edge, 2.0), [edge - 0.025, edge + 0.025], np.arange(edge + 1, LENGTH + 9, 2.0)])
    floor = 0.5 * BORE - np.where(md > edge, rise, 0.0)
    case = level_case(np.column_stack([md, floor]), 0.25, cell=0.05)
    string = lay_out(case, LENGTH)
    q, EI = float(string.weight[0]), float(string.of("EI")[0])

    def off(unknown: Array) -> Array:
        shear, a, edge_force, b = unknown
        x = a + b
        return np.array([
            shear * a**3 / 6 - q * a**4 / 24 - EI * rise,
            shear * x**3 / 6 - q * x**4 / 24 + edge_force * b**3 / 6 - EI * rise,
            shear * x**2 / 2 - q * x**3 / 6 + edge_force * b**2 / 2,
            shear * x - q * x**2 / 2 + edge_force * b,
        ])  # fmt: skip

    length = (24 * EI * rise / q) ** 0.25
    start = np.array([0.44 * q * length, 1.2 * length, 1.4 * q * length, 0.9 * length])
    scale = np.array([1.0, 1.0, q, q * length]) * np.array([EI * rise, EI * rise, length**2, length])
    _, _, edge_force, _ = start * fsolve(lambda share: off(start * share) / scale, np.ones(4))
    profile = solved(case, "rotate_off_bottom").profile
    near = profile[(profile["md_m"] - edge).abs() < 1.0]
    assert near["contact_force_N"].sum() == pytest.approx(edge_force, rel=0.005)


def test_a_round_caliper_has_the_rows_of_arcs() -> None:
    """In an S-shaped well with a shoe."""
    stations = [[0, 0, 0], [300, 0, 0], [600, 60, 40], [900, 20, 130], [1000, 20, 130]]
    sizes = [
        {"to_md": 500, "diameter": 0.3, "friction": 0.2, "kind": "cased"},
        {"to_md": 1000, "diameter": BORE, "friction": 0.3, "kind": "open"},
    ]
    round_hole = {"rows": [[450, BORE], [995, BORE]]}
    for operation in ("trip_in", "trip_out", "rotate_off_bottom"):
        arcs, sampled = (
            fctd.equilibrium(
                make_case(stations, [pipe(1000, 80)], wellbore={"geometry": geometry, "intervals": sizes, **more}),
                operation, 980.0,
            )
            for geometry, more in (("arcs", {}), ("sampled", {"caliper": round_hole}))
        )  # fmt: skip
        assert sampled.status == arcs.status == "converged"
        assert sampled.hookload == pytest.approx(arcs.hookload, rel=1e-6)
        assert sampled.surface_torque == pytest.approx(arcs.surface_torque, rel=1e-6, abs=1e-3)


def washed_out(seed: int, every: float, washed: float, deep: float, build: float) -> Case:
    """Pipe in a bend whose wall is washed out between ridges, at random: a share of the arms by a depth [m].

    every : rows [m]; build : of the bend [°/m].
    """
    draw = np.random.default_rng(seed)
    md = np.arange(1.0, 609.0, every)
    shape = len(md), 6
    arms = 0.1255 + draw.exponential(0.0015, shape) + deep * (draw.random(shape) < washed)
    hole = {
        "stations": [[0, 0, 0], [100, 0, 0], [100 + 60 / build, 60, 0], [610, 60, 0]], "geometry": "sampled",
        "cell": 0.5, "stiffness_per_length": 5e7,
        "intervals": [{"to_md": 610, "diameter": 0.2508, "friction": 0.35}],
        "caliper": {"rows": np.column_stack([md, arms]).tolist(), "values": "radius"},
    }  # fmt: skip
    part = pipe(None, None, 0.0889, 0.0702, segment_length=12.5, contact_diameter=0.12065)
    return make_case(components=[part], wellbore=hole, rig={"block_weight": 3e5})


@pytest.mark.parametrize("operation", ["trip_out", "rotate_off_bottom"])
@pytest.mark.parametrize("rough", [(20.0, 0.06, 0.04, 0.2), (10.0, 0.2, 0.05, 0.4)])
def test_a_string_leaves_the_ridges_of_a_rough_hole(rough: tuple[float, float, float, float], operation: str) -> None:
    """Walls of one roughness hold a string with nearly the same loads, whichever ridges it rolls off on the way."""
    points = [fctd.equilibrium(washed_out(seed, *rough), operation, 600.0) for seed in range(3)]
    assert [point.status for point in points] == ["converged"] * 3
    loads, torques = np.array([(point.hookload, point.surface_torque) for point in points]).T
    assert loads == pytest.approx(loads.mean(), rel=1e-3)
    assert torques == pytest.approx(torques.mean(), rel=5e-3, abs=1.0)
