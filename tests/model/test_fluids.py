"""Fluids along a string against independent sums: weights, pressures, true and effective tension, stretch."""

from typing import Any

import numpy as np
import pytest

from fctd import equilibrium
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.drillstring import lay_out
from fctd.model.fluids import fluids_of
from fctd.model.string_in_hole import check_end, excess_pressure, squeeze_of
from fctd.model.wellbore import build_wellbore
from fctd.results.limits import LIMITS, SHARE
from fctd.steady.equilibrium import Solver
from tests.cases import make_case, pipe

# A tapered string of body alone, from the bit up [m], and three fluids that meet inside segments.
PARTS = [
    pipe(203.0, 7, outer=0.165, inner=0.0714), pipe(611.0, 20, outer=0.127, inner=0.1086),
    pipe(None, 40, outer=0.1397, inner=0.1214),
]  # fmt: skip
INSIDE = [{"to_md": 333.0, "density": 1450.0}, {"to_md": 1234.5, "density": 1100.0}, {"density": 1320.0}]
THREE = {
    "inside": INSIDE, "outside": [{"to_md": 777.0, "density": 1050.0}, {"density": 1380.0}],
    "inside_pressure": 30e5, "outside_pressure": 4e5, "float": True,
}  # fmt: skip
BIT = 2000.0
WELL = [[0.0, 0.0, 0.0], [BIT + 10, 0.0, 0.0]]


def tapered(mud: dict[str, Any], **more: Any) -> Case:
    hole = {"intervals": [{"to_md": BIT + 10, "diameter": 0.3, "friction": 0.0}]}
    return make_case(WELL, PARTS, wellbore=hole, mud=mud, **more)


def areas(part: dict[str, Any]) -> tuple[float, float]:
    """Bore, and all that the outside encloses [m²]."""
    return 0.25 * np.pi * part["inner_diameter"] ** 2, 0.25 * np.pi * part["outer_diameter"] ** 2


def pressure_at(depth: float, rows: list[dict[str, float]], surface: float) -> float:
    """Pressure of fluids one on the other [Pa], summed from the surface down to a depth [m]."""
    found, above = surface, 0.0
    for row in rows:
        end = min(row.get("to_md", np.inf), depth)
        found += row["density"] * GRAVITY * max(end - above, 0.0)
        above = max(end, above)
    return found


def steel_below(depth: float) -> tuple[float, float, float]:
    """Weight of the steel below a depth [N], and the true and effective tension there [N] by the forces on the steel.

    A free body: its weight, the pressures on its lower end, which a float closes, and on the shoulders of the taper.
    """
    weight, pushed, bottom = 0.0, 0.0, BIT
    bore, outside = areas(PARTS[0])
    inner, outer = (pressure_at(BIT, rows, top) for rows, top in sides())
    pushed += inner * bore - outer * outside
    for k, part in enumerate(PARTS):
        top = max(bottom - (part.get("length") or np.inf), 0.0)
        bore, outside = areas(part)
        weight += 7850.0 * (outside - bore) * GRAVITY * (bottom - max(top, depth))
        bottom = top
        if top <= depth:
            break
        above_bore, above_outside = areas(PARTS[k + 1])
        inner, outer = (pressure_at(top, rows, surface) for rows, surface in sides())
        pushed += inner * (above_bore - bore) - outer * (above_outside - outside)
    inner, outer = (pressure_at(depth, rows, surface) for rows, surface in sides())
    true = weight + pushed
    return weight, true, true - inner * bore + outer * outside


def sides() -> list[tuple[list[dict[str, float]], float]]:
    return [(THREE["inside"], THREE["inside_pressure"]), (THREE["outside"], THREE["outside_pressure"])]  # type: ignore[list-item]


def test_three_fluids_against_a_balance_of_forces_on_the_steel() -> None:
    """Effective tension and hook load within 1e-9 of the weight, true tension too where its pressures are read."""
    point = equilibrium(tapered(THREE), "trip_out", BIT)
    assert point.status == "converged"
    string, profile = lay_out(point.case, BIT), point.profile
    weight = steel_below(0.0)[0]
    assert point.hookload == pytest.approx(steel_below(0.0)[2], abs=1e-9 * weight)
    ends = np.maximum(BIT - string.contacts_above, 0.0)
    bore, body = (np.append(values[0], values) ** 2 * np.pi for values in (string.of("inner"), string.of("outer")))
    for row, depth in enumerate(ends[:-1]):
        _, true, effective = steel_below(float(depth) + 1e-9 * (row > 0))
        found = profile.iloc[row]
        assert found["effective_tension_N"] == pytest.approx(effective, abs=1e-9 * weight)
        # The string stretches by metres, which its tally does not have: the pressures of the profile are those there.
        inner, outer = (pressure_at(depth, rows, surface) for rows, surface in sides())
        deeper = (found["inside_pressure_Pa"] - inner) * bore[row] - (found["outside_pressure_Pa"] - outer) * body[row]
        if not np.isclose(np.cumsum(string.length), depth).any() or np.ptp(string.component[row - 1 : row + 1]) == 0:
            assert found["true_tension_N"] - deeper == pytest.approx(true, abs=2e-9 * weight)


def test_the_weight_of_a_segment_is_that_of_its_mean_densities() -> None:
    string = lay_out(tapered(THREE), BIT)
    for k in range(string.segments):
        bottom = float(string.length[: k + 1].sum())
        above = steel_below(bottom - string.length[k])[2] - steel_below(min(bottom, BIT - 1e-9))[2]
        if string.component[k] == string.component[min(k + 1, string.segments - 1)]:
            assert string.weight[k] * string.length[k] == pytest.approx(above, rel=1e-7)


def test_equal_rows_are_one_mud_to_the_last_bit() -> None:
    rows = [{"to_md": 300.0, "density": 1234.0}, {"to_md": 1111.0, "density": 1234.0}, {"density": 1234.0}]
    one, several = tapered({"density": 1234.0}), tapered({"inside": rows, "outside": rows[1:]})
    hole, laid, filled = build_wellbore(one), lay_out(one, BIT), lay_out(several, BIT)
    assert laid.fluids is None
    assert filled.fluids is not None
    assert np.array_equal(laid.weight, filled.weight)
    assert np.array_equal(laid.body_weight, filled.body_weight)
    assert np.array_equal(squeeze_of(one, laid, hole), squeeze_of(several, filled, hole))
    assert not excess_pressure(filled, hole).any()


PLUGGED = {
    "inside": [{"to_md": 600.0, "density": 1200.0, "plug": True}, {"density": 0.0, "pressure": 1e5}],
    "outside": [{"density": 1200.0}], "float": True,
}  # fmt: skip


def test_true_tension_jumps_at_a_plug_and_effective_tension_does_not() -> None:
    """By the difference of pressures on the bore; the joint at 600 m is the plug's place, whose column is above it."""
    case = make_case(
        components=[pipe(1000, 50)], mud=PLUGGED,
        wellbore={"intervals": [{"to_md": 1000.0, "diameter": 0.3, "friction": 0.0}]},
    )  # fmt: skip
    point = equilibrium(case, "trip_out", 1000.0)
    profile = point.profile.set_index(np.round(point.profile["md_m"]))
    at, below = profile.iloc[30], profile.iloc[31]
    assert (at["md_m"], below["md_m"]) == pytest.approx((600, 620), abs=1)
    bore, steel = 0.25 * np.pi * 0.07**2, 0.25 * np.pi * (0.127**2 - 0.07**2)
    jump = (at["inside_pressure_Pa"] - 1e5) * bore
    weights = 20 * GRAVITY * 7850 * steel
    assert at["true_tension_N"] - below["true_tension_N"] - weights == pytest.approx(jump, rel=1e-3)
    displaced = GRAVITY * 1200 * 20 * (steel + bore)
    assert at["effective_tension_N"] - below["effective_tension_N"] == pytest.approx(weights - displaced, rel=1e-6)
    assert below["inside_pressure_Pa"] == 1e5


def test_a_segment_with_a_plug_inside_has_the_mean_of_both_pressures() -> None:
    """A plug in the middle of the only segment of 1000 m: half of it has the mud's mean pressure, half its own."""
    case = make_case(
        components=[pipe(1000, 1)],
        mud={**PLUGGED, "inside": [{**PLUGGED["inside"][0], "to_md": 500.0}, PLUGGED["inside"][1]]},  # type: ignore[index, dict-item]
    )
    string, hole = lay_out(case, 1000.0), build_wellbore(case)
    assert string.fluids is not None
    mean = string.fluids.inside.mean_pressure(
        np.array([1000.0]), np.array([0.0]), np.array([500.0]), hole, string.bit_depth
    )
    assert mean == pytest.approx([0.5 * (1200 * GRAVITY * 250 + 1e5)])
    inside, outside = string.densities or (None, None)
    assert (inside, outside) == (pytest.approx([600.0]), pytest.approx([1200.0]))


def test_pressures_follow_the_depth_of_a_hole_that_turns() -> None:
    """Past horizontal the pressure falls again; a plug in the bend is at the depth of its place."""
    stations = [[0.0, 0, 0], [300.0, 0, 0], [900.0, 100.0, 0], [1500.0, 100.0, 0]]
    mud = {"inside": [{"to_md": 700.0, "density": 1300.0, "plug": True}, {"density": 900.0, "pressure": 3e5}],
           "outside": [{"density": 1100.0}], "float": True}  # fmt: skip
    case = make_case(stations, [pipe(None, 75)], wellbore={"geometry": "arcs", "survey_method": "minimum_curvature"},
                     mud=mud)  # fmt: skip
    string, hole = lay_out(case, 1500.0), build_wellbore(case)
    assert string.fluids is not None
    md = np.array([650.0, 700.0, 700.01, 1000.0, 1500.0])
    depth = hole.at(md)[0][:, 2]
    inside, outside = string.fluids.pressures(1500.0 - md, depth, hole, 1500.0)
    plug = hole.at(np.array([700.0]))[0][0, 2]
    expected = [1300 * GRAVITY * z for z in depth[:2]] + [3e5 + 900 * GRAVITY * (z - plug) for z in depth[2:]]
    assert inside == pytest.approx(expected, rel=1e-12)
    assert outside == pytest.approx(1100 * GRAVITY * depth)
    assert inside[-1] < inside[-2]


def test_a_floated_string_sinks_or_floats() -> None:
    """9 5/8 in casing of 47 lb/ft in a level hole, 1000 m: 174.9 kN of drag with mud inside, 40.2 kN empty.

    Its steel is taken to displace what the body of the pipe does, without couplings, as these numbers do.
    """
    steel = 0.25 * np.pi * 0.0254**2 * (9.625**2 - 8.681**2)
    casing = pipe(None, 200, outer=9.625 * 0.0254, inner=8.681 * 0.0254, linear_mass="47 lb/ft")
    casing["density"] = 47 * 1.48816394 / steel
    for inside, expected in (([{"density": 1200}], 174.9e3), ([{"density": 0}], 40.2e3)):
        case = make_case(
            [[0, 90, 0], [1100, 90, 0]], [casing],
            wellbore={"intervals": [{"to_md": 1100.0, "diameter": 0.3111, "friction": 0.3}]},
            mud={"inside": inside, "outside": [{"density": 1200}], "float": True},
        )  # fmt: skip
        profile = equilibrium(case, "trip_out", 1100.0).profile
        # Of 1000 m away from the ends, as the upper one hangs in the middle of the hole.
        upper, lower = np.interp([50.0, 1050.0], profile["md_m"], profile["effective_tension_N"])
        assert upper - lower == pytest.approx(expected, rel=0.01)
    light = pipe(None, 220, outer=0.5, inner=0.48)
    case = make_case(
        [[0, 90, 0], [1100, 90, 0]], [light],
        wellbore={"intervals": [{"to_md": 1100.0, "diameter": 0.6, "friction": 0.3}]},
        mud={"inside": [{"density": 0}], "outside": [{"density": 1200}], "float": True},
    )  # fmt: skip
    profile = equilibrium(case, "trip_out", 1100.0).profile
    bore, body = 0.25 * np.pi * 0.48**2, 0.25 * np.pi * 0.5**2
    lift = GRAVITY * (1200 * body - 7850 * (body - bore)) * 1000
    assert lift > 0
    upper, lower = np.interp([50.0, 1050.0], profile["md_m"], profile["effective_tension_N"])
    assert upper - lower == pytest.approx(0.3 * lift, rel=1e-3)
    assert (profile["offset_high_m"].iloc[20:-1] > 0.049).all()


def test_an_open_end_needs_equal_pressures() -> None:
    hole = build_wellbore(make_case())
    for mud, sentence in (
        (
            {"density": 1000.0, "inside": [{"density": 1400.0}]},
            "mud.float = false: expected true, or pressures that are equal within 0.5 bar at the open end: with 137.3 "
            "bar inside and 98.1 bar outside the level inside would fall by 286 m",
        ),
        (
            {"density": 1000.0, "inside": [{"density": 0.0}]},
            "mud.float = false: expected true, or pressures that are equal within 0.5 bar at the open end: with 0.0 "
            "bar inside and 98.1 bar outside fluid would flow in",
        ),
    ):
        case = make_case(mud=mud)
        with pytest.raises(InputError) as caught:
            check_end(lay_out(case, 1000.0), hole)
        assert str(caught.value) == sentence
        with pytest.raises(InputError, match=r"mud\.float"):
            equilibrium(case, "trip_in", 1000.0)
        check_end(lay_out(make_case(mud={**mud, "float": True}), 1000.0), hole)
    # A level that has fallen, within the half bar of measured densities.
    level = 1000.0 * (1 - 1000 / 1400)
    rows = [{"to_md": level, "density": 0.0}, {"density": 1400.0}]
    check_end(lay_out(make_case(mud={"density": 1000.0, "inside": rows}), 1000.0), hole)
    rows[0]["to_md"] = level + 3.0
    check_end(lay_out(make_case(mud={"density": 1000.0, "inside": rows}), 1000.0), hole)
    rows[0]["to_md"] = level + 4.0
    with pytest.raises(InputError, match=r"mud\.float"):
        check_end(lay_out(make_case(mud={"density": 1000.0, "inside": rows}), 1000.0), hole)


def test_rows_reach_the_bit_or_are_refused() -> None:
    case = make_case(mud={"inside": [{"to_md": 900.0, "density": 1000.0}], "density": 1000.0})
    assert fluids_of(case, 900.0) is not None
    with pytest.raises(InputError, match=r"mud.inside\[0\].to_md = 900 m: expected left out, or a depth down to"):
        fluids_of(case, 950.0)


def test_a_plug_at_the_bit_is_a_float() -> None:
    rows = [{"to_md": 800.0, "density": 0.0, "plug": True}]
    case = make_case(mud={"inside": rows, "density": 1000.0})
    check_end(lay_out(case, 800.0), build_wellbore(case))
    assert lay_out(case, 800.0).fluids is not None


def test_pressures_burst_and_collapse_pipe() -> None:
    """Shares of Barlow's and the API's capacities: 9 5/8 in 47 lb/ft N-80 collapses at 4750 psi, as tables have it."""
    psi, inch = 6894.757, 0.0254
    casing = pipe(None, 50, outer=9.625 * inch, inner=8.681 * inch, yield_strength="N-80", density=7850)
    hole = {"intervals": [{"to_md": 3000.0, "diameter": 0.3111, "friction": 0.0}]}
    for mud, code, capacity in (
        ({"density": 1200.0, "inside": [{"density": 0.0}], "float": True}, "collapse", 4754 * psi),
        ({"inside_pressure": 300e5, "float": True}, "burst", 0.875 * 2 * 80_000 * psi * 0.472 / 9.625),
    ):
        case = make_case([[0, 0, 0], [3000, 0, 0]], [casing], wellbore=hole, mud=mud)
        solver = Solver(case)
        point = equilibrium(case, "trip_in", 3000.0)
        k = [limit.code for limit in LIMITS].index(code)
        largest = np.abs(solver.lay_out(3000.0).excess).max()
        assert point.shares[k, SHARE] == pytest.approx(largest / capacity, rel=2e-3)
        assert (code in [note.code for note in point.notes]) == (largest > capacity)


def test_a_packer_pushes_with_the_difference_on_its_bore() -> None:
    """T = −A_p (p_i − p_o) at the lower end, whatever the pipe's own areas are."""
    mud = {"density": 1000.0, "inside_pressure": 100e5, "packer_bore": 0.1}
    hole = {"intervals": [{"to_md": 1000.0, "diameter": 0.2159, "friction": 0.0}]}
    case = make_case(components=[pipe(1000, 50)], mud=mud, wellbore=hole)
    point = equilibrium(case, "trip_out", 1000.0)
    push = 0.25 * np.pi * 0.1**2 * 100e5
    assert point.profile["effective_tension_N"].iloc[-1] == pytest.approx(-push)
    assert point.hookload == pytest.approx(lay_out(case, 1000.0).weight @ np.full(50, 20.0) - push, rel=1e-6)
