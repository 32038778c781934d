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


def level_case(rows: Array, segment: float, friction: float = 0.0, cell: float = 0.1) -> Case:
    """Pipe in a level hole with a caliper of radii [m]."""
    hole = {
        "stations": [[0, 90, 0], [LENGTH + 10, 90, 0]], "geometry": "sampled", "cell": cell,
        "stiffness_per_length": 1e9,
        "intervals": [{"to_md": LENGTH + 10, "diameter": BORE, "friction": friction}],
        "caliper": {"rows": rows.tolist(), "values": "radius"},
    }  # fmt: skip
    parts = [pipe(None, None, segment_length=segment)]
    return make_case(components=parts, wellbore=hole, rig={"block_weight": 1e6})


def solved(case: Case, operation: str) -> Equilibrium:
    point = fctd.equilibrium(case, operation, LENGTH)
    assert point.status in ("converged", "locked_up")
    return point


@pytest.mark.parametrize(("long_axis", "grips"), [(0.125, False), (0.20, True), (0.25, True)])
def test_pipe_at_rest_in_an_oval_rubs_on_two_places(long_axis: float, grips: bool) -> None:
    """It is pressed onto both by w/2 cos β: the drag is that of a floor over cos β, closed form of an ellipse."""
    b, a, friction = 0.5 * BORE, long_axis, 0.2
    md = np.arange(1.0, LENGTH + 9, 5.0)
    case = level_case(np.column_stack([md, np.full(len(md), a), np.full(len(md), b)]), 5.0, friction)
    string = lay_out(case, LENGTH)
    weight = float((string.weight * string.length).sum())
    c = np.sqrt(a * a - b * b)
    factor = 1.0
    if grips:
        x = c * np.sqrt(1 - (RADIUS / b) ** 2)
        cosine = a * x / (c * c)
        factor = 1 / np.cos(np.arctan2(b * np.sqrt(1 - cosine**2), a * cosine - x))
        assert factor > 1.1
    point = solved(case, "trip_out")
    pressed = float(point.profile["contact_force_N"].sum())
    assert pressed == pytest.approx(
        weight, rel=0.1
    )  # the drive holds pipe on the axis, metres of which do not lie down
    assert point.hookload == pytest.approx(friction * pressed * factor, rel=0.01)


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
