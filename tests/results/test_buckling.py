"""Buckling limits against closed forms, over many sizes; where a string is buckled; which segments can follow."""

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray

from fctd import Equilibrium, Wellbore, equilibrium, torque_drag
from fctd.results.buckling import (
    GROWN,
    HELICAL_LIMIT,
    MODE,
    NEEDED,
    NEITHER,
    SINUSOIDAL,
    SINUSOIDAL_LIMIT,
    UNKNOWN,
    Buckling,
    Pipe,
    buckling_along,
    rounded_down,
)
from fctd.steady.balance import IN_THE_OPEN
from tests.cases import hole_of, make_case, pipe

STIFFNESS = st.floats(1e5, 2e7)  # EI of 3½ in pipe to 11 in collars [N m²]
WEIGHT = st.floats(60.0, 3000.0)  # [N/m]
CLEARANCE = st.floats(0.005, 0.2)  # [m]
STEEP = st.floats(10.0, 90.0)  # inclination [°]
AZIMUTH = st.floats(0.0, 360.0)
HELIX = math.sqrt(2)


def judge(
    hole: Wellbore, md: list[float], compression: Any, EI: float = 2e6, weight: float = 250.0, clearance: float = 0.04
) -> tuple[NDArray[np.float64], Buckling]:
    """Rows and stretch of a uniform string with a top at ``md[0]`` and contact points below, with this compression."""
    n = len(md) - 1
    radius = 0.1 - clearance
    of = Pipe(*(np.full(n, value) for value in (EI, weight, radius)), np.diff(md), np.zeros(n, bool))
    load = np.broadcast_to(np.asarray(compression, float), n + 1)
    return buckling_along(hole, of, md[0], np.array(md[1:]), np.full(n, 0.1), -load[:n], -float(load[n]))


def at(hole: Wellbore, md: float, compression: float, **sizes: float) -> NDArray[np.float64]:
    """The row at one depth."""
    return judge(hole, [md - 1, md, md + 1], compression, **sizes)[0][1]


def straight(inclination: float, azimuth: float = 30.0, **wellbore: Any) -> Wellbore:
    return hole_of([[0, inclination, azimuth], [500, inclination, azimuth]], **wellbore)


def bend(start: float, end: float, length: float, geometry: str) -> Wellbore:
    """A planar bend of even curvature."""
    stations = [[k * length / 20, start + k * (end - start) / 20, 40.0] for k in range(21)]
    return hole_of(stations, geometry=geometry)


@given(STEEP, AZIMUTH, STIFFNESS, WEIGHT, CLEARANCE, st.sampled_from(["arcs", "cylinders"]))
def test_straight_inclined_hole(
    inclination: float, azimuth: float, EI: float, weight: float, clearance: float, geometry: str
) -> None:
    """2√(EI w sin α/r) (Dawson & Paslay), √2 times that for the helix, whatever the compression."""
    lying = 2 * math.sqrt(EI * weight * math.sin(math.radians(inclination)) / clearance)
    assume(lying > 5.55 * (EI * weight**2) ** (1 / 3))
    hole = straight(inclination, azimuth, geometry=geometry)
    for share, mode in ((0.0, 0), (0.999, 0), (1.001, 1), (HELIX * 0.999, 1), (HELIX * 1.001, 2)):
        row = at(hole, 250, share * lying, EI=EI, weight=weight, clearance=clearance)
        assert row[SINUSOIDAL_LIMIT] == pytest.approx(lying, rel=1e-9)
        assert row[HELICAL_LIMIT] == pytest.approx(HELIX * lying, rel=1e-9)
        assert row[MODE] == mode


@given(st.tuples(st.floats(0.0, 90.0), st.floats(0.0, 90.0)).map(sorted), STIFFNESS, WEIGHT, CLEARANCE)
def test_limits_grow_with_inclination(angles: list[float], EI: float, weight: float, clearance: float) -> None:
    """And they are never below those of hanging pipe."""
    less, more = (at(straight(angle), 250, 0.0, EI=EI, weight=weight, clearance=clearance) for angle in angles)
    hanging = (EI * weight**2) ** (1 / 3)
    for limit, factor in ((SINUSOIDAL_LIMIT, 1.94), (HELICAL_LIMIT, 5.55)):
        assert more[limit] >= less[limit] * (1 - 1e-12)
        assert less[limit] >= factor * hanging * (1 - 1e-12)


@given(STIFFNESS, WEIGHT, CLEARANCE, st.floats(200.0, 2000.0), st.sampled_from(["arcs", "cylinders"]))
def test_a_build_holds_the_string(EI: float, weight: float, clearance: float, radius: float, geometry: str) -> None:
    """F = (2EIκ/r)(1 + √(1 + r w sin α/(EIκ²))), which solves F = 2√(EI(w sin α + Fκ)/r); the helix has twice EI."""
    hole = bend(20.0, 80.0, math.radians(60) * radius, geometry)
    middle, curvature = 0.5 * hole.total_depth, 1 / radius
    for mode, stiffness in ((1, EI), (2, 2 * EI)):
        slope = 2 * stiffness * curvature / clearance
        own = clearance * weight * math.sin(math.radians(50)) / (stiffness * curvature**2)
        limit = slope * (1 + math.sqrt(1 + own))
        sizes = {"EI": EI, "weight": weight, "clearance": clearance}
        # The cylinders' bend is that of neighbouring chords.
        assert at(hole, middle, 0.99 * limit, **sizes)[MODE] == mode - 1
        assert at(hole, middle, 1.01 * limit, **sizes)[MODE] == mode


@given(STIFFNESS, WEIGHT, CLEARANCE, st.floats(200.0, 2000.0), st.sampled_from(["arcs", "cylinders"]))
def test_a_drop_takes_wall_force_away(EI: float, weight: float, clearance: float, radius: float, geometry: str) -> None:
    """At F = w R sin α nothing presses the string to the wall, and the limit is 0; short of that it is smaller."""
    hole = bend(80.0, 20.0, math.radians(60) * radius, geometry)
    free = weight * radius * math.sin(math.radians(50))
    lying = 2 * math.sqrt(EI * weight * math.sin(math.radians(50)) / clearance)
    assume(lying > 5.55 * (EI * weight**2) ** (1 / 3))
    limits = [
        at(hole, 0.5 * hole.total_depth, share * free, EI=EI, weight=weight, clearance=clearance)[SINUSOIDAL_LIMIT]
        for share in (0.0, 0.5, 1.0, 1.5, 2.0)
    ]
    # Squares, since 1 % of the load is 10 % of a limit near 0.
    np.testing.assert_allclose(np.divide(limits, lying) ** 2, [1.0, 0.5, 0.0, 0.5, 1.0], atol=0.02)


def test_a_turn_through_north_holds_the_string() -> None:
    """q = √((w sin α)² + (F sin α dφ/ds)²) at constant inclination; the azimuth passes from 359° to 1°."""
    stations = [[10 * k, 60.0, (340 + 2 * k) % 360] for k in range(21)]
    turn, w, F, EI, r = math.radians(2) / 10, 250.0, 2e5, 2e6, 0.04
    across = math.hypot(w * math.sin(math.radians(60)), F * math.sin(math.radians(60)) * turn)
    for geometry in ("arcs", "cylinders"):
        for md in (95.0, 98.0, 105.0):
            row = at(hole_of(stations, geometry=geometry), md, F, EI=EI, weight=w, clearance=r)
            assert row[SINUSOIDAL_LIMIT] == pytest.approx(2 * math.sqrt(EI * across / r), rel=2e-3)


def test_a_long_arc_between_two_stations_is_not_its_chord() -> None:
    """60° in one course: the bend at its start is that of the arc, to which its chord stands at 30°."""
    hole = hole_of([[0, 30, 0], [600, 90, 0]], geometry="arcs")
    F, EI, w, r = 2e5, 2e6, 250.0, 0.04
    q = w * math.sin(math.radians(30)) + F * math.radians(60) / 600
    assert at(hole, 1.0 + 1e-9, F)[SINUSOIDAL_LIMIT] == pytest.approx(2 * math.sqrt(EI * q / r), rel=5e-3)


@given(STIFFNESS, WEIGHT, CLEARANCE, st.floats(0.01, 3.0), st.floats(10.0, 60.0))
def test_vertical_pipe_is_judged_at_its_lower_end(
    EI: float, weight: float, clearance: float, share: float, segment: float
) -> None:
    """1.94 and 5.55 (EI w²)^⅓ at the bit; beyond them all compressed pipe is buckled, and none in tension."""
    hole = hole_of([[0, 0, 0], [3000, 0, 0]])
    md = list(np.arange(0.0, 3001.0, segment))
    for factor, below, beyond in ((1.94, "none", "sinusoidal"), (5.55, "sinusoidal", "helical")):
        for scale, mode in ((0.99, below), (1.01, beyond)):
            at_bit = scale * factor * (EI * weight**2) ** (1 / 3)
            compression = at_bit - share * weight * (md[-1] - np.array(md))
            rows, found = judge(hole, md, compression, EI=EI, weight=weight, clearance=clearance)
            assert found.mode == mode
            pushed = compression > 0
            if mode == "none":
                assert (rows[:, MODE] == NEITHER).all()
            else:
                assert ((rows[:, MODE] != NEITHER) == pushed).all()
                assert (found.from_md, found.to_md) == (np.array(md)[pushed][0], md[-1])


def test_each_compressed_stretch_of_vertical_hole_has_its_own_lower_end() -> None:
    """A stretch at 4 (EI w²)^⅓ over one in tension, and one at 7 below it."""
    unit = (2e6 * 250.0**2) ** (1 / 3)
    hole, md = hole_of([[0, 0, 0], [700, 0, 0]]), list(np.arange(0.0, 701.0, 100.0))
    rows, found = judge(hole, md, unit * np.array([-1, 2, 4, -1, -2, 0.5, 3, 7]))
    assert rows[:, MODE].tolist() == [0, 1, 1, 0, 0, 2, 2, 2]
    assert (found.mode, found.from_md, found.to_md) == ("helical", 100.0, 700.0)


def test_nearly_vertical_hole_has_the_limits_of_hanging_pipe() -> None:
    """At 0.05° the pipe's weight on the wall is nothing; a bend of 3°/30 m is."""
    unit = (2e6 * 250.0**2) ** (1 / 3)
    assert at(straight(0.05), 250, 0.0)[SINUSOIDAL_LIMIT] == pytest.approx(1.94 * unit)
    built = at(bend(0.0, 6.0, 60.0, "arcs"), 1.0, 10 * unit)
    assert built[SINUSOIDAL_LIMIT] > 2 * math.sqrt(2e6 * 10 * unit * math.radians(3) / 30 / 0.04)
    assert built[MODE] == NEITHER


@given(STEEP, st.floats(0.0, 1e7))
def test_without_clearance_nothing_buckles(inclination: float, compression: float) -> None:
    for clearance in (0.0, -0.01):
        rows, found = judge(straight(inclination), [0.0, 10.0, 20.0], compression, clearance=clearance)
        assert np.isinf(rows[:, [SINUSOIDAL_LIMIT, HELICAL_LIMIT, NEEDED]]).all()
        assert found.mode == "none"


@given(STEEP, STIFFNESS, WEIGHT, CLEARANCE, st.floats(1.001, 3.0))
def test_segments_resolve_the_wave_or_not(
    inclination: float, EI: float, weight: float, clearance: float, share: float
) -> None:
    """An eighth of the half wave π(EI r/q)^¼ at the onset, a twelfth of the turn 2π√(2EI/F) of the helix."""
    q = weight * math.sin(math.radians(inclination))
    lying = 2 * math.sqrt(EI * q / clearance)
    assume(lying > 5.55 * (EI * weight**2) ** (1 / 3))
    F = share * lying
    length = math.pi * (EI * clearance / q) ** 0.25 / math.sqrt(share) / 8
    if share > HELIX:
        length = 2 * math.pi * math.sqrt(2 * EI / F) / 12
    for factor, resolved in ((0.999, True), (1.001, False)):
        md = list(100.0 + factor * length * np.arange(4))
        rows, found = judge(straight(inclination), md, F, EI=EI, weight=weight, clearance=clearance)
        assert found.resolved == resolved
        np.testing.assert_allclose(rows[:, NEEDED], length, rtol=1e-9)
        advised = length / math.sqrt(GROWN)
        assert 0.9 * advised < found.segment_length <= advised * (1 + 1e-12)
        assert found.excess == pytest.approx(share)
    assert f"segments of {found.longest:.3g} m" in found.shortfall()
    assert f"at most {found.segment_length:g} m" in found.shortfall()
    assert "resolve" in found.shortfall()
    assert "resolve" not in found.shortfall("resolve")


def test_a_segment_beside_a_buckled_point_counts() -> None:
    """Only the lowest points are beyond the limit: the segment above has to be short, the one above that need not."""
    hole, limit = straight(90.0), 2 * math.sqrt(2e6 * 250 / 0.04)
    for lengths, longest in (([20.0, 1.0, 1.0], 0.0), ([1.0, 20.0, 1.0], 20.0)):
        md = [100.0, *(100.0 + np.cumsum(lengths))]
        _, found = judge(hole, md, [0.9 * limit, 0.95 * limit, 1.05 * limit, 1.05 * limit])
        assert (found.mode, found.from_md, found.to_md, found.longest) == ("sinusoidal", md[2], md[3], longest)


def test_a_single_point_is_no_stretch_where_it_is_shorter_than_a_half_wave() -> None:
    """A third of 12 or of 60 m beside it is beyond the limit, by a line; a half wave is 13 m."""
    hole, limit = straight(90.0), 2 * math.sqrt(2e6 * 250 / 0.04)
    for length, mode in ((12.0, "none"), (60.0, "sinusoidal")):
        _, found = judge(hole, [100.0, 100.0 + length], [0.9 * limit, 1.05 * limit])
        assert found.mode == mode
        _, found = judge(hole, [100.0, 100.0 + length, 100.0 + 2 * length], [0.9 * limit, 1.05 * limit, 0.9 * limit])
        assert found.mode == mode


@given(st.floats(1e-6, 1e6))
def test_lengths_are_rounded_down_to_two_digits(length: float) -> None:
    rounded = rounded_down(length)
    assert 0.9 * length < rounded <= length * (1 + 1e-12)
    assert float(f"{rounded:.2g}") == rounded


def sliding(segment: float, share: float = 1.3) -> Equilibrium:
    """100 m of level string, slid with ``share`` of the sinusoidal limit on its bit; no half wave is held."""
    area, second = math.pi / 4 * (0.127**2 - 0.07**2), math.pi / 64 * (0.127**4 - 0.07**4)
    limit = 2 * math.sqrt(206.8e9 * second * 7850 * 9.80665 * area / ((0.2159 - 0.127) / 2))
    hole = {"geometry": "arcs", "intervals": [{"to_md": 110, "diameter": 0.2159, "friction": 0.1}]}
    case = make_case(
        [[0, 90, 0], [110, 90, 0]], [pipe(None, None, segment_length=segment)], wellbore=hole,
        bit={"weight_on_bit": share * limit}, rig={"block_weight": 1e7},
    )  # fmt: skip
    return equilibrium(case, "drill_sliding", 100.0)


def test_long_segments_cannot_snake() -> None:
    """At 1.3 times the onset segments of 10 m lie straight; segments of 1 m snake over half of the hole's width."""
    coarse, fine = sliding(10.0), sliding(1.0)
    assert (coarse.status, coarse.buckling.mode, coarse.buckling.resolved) == ("under_resolved", "sinusoidal", False)
    assert coarse.answered
    assert not coarse.status.acceptable
    assert "sinusoidal from 0 to 100 m, where segments of 10 m cannot bend that way" in coarse.message
    assert (fine.status, fine.buckling.mode, fine.buckling.resolved) == ("converged", "sinusoidal", True)
    assert (fine.buckling.from_md, fine.buckling.to_md) == pytest.approx((0.0, 100.0), abs=0.1)
    assert fine.profile["offset_right_m"].abs().max() > 0.02
    below = sliding(10.0, 0.9)
    assert (below.status, below.buckling.mode) == ("converged", "none")


def test_chart_rows_say_where_the_string_is_buckled(monkeypatch: pytest.MonkeyPatch) -> None:
    """A row of each kind: buckled, in tension, without a hole to buckle in, without an answer in five iterations."""
    monkeypatch.setattr("fctd.steady.attempts.IN_THE_OPEN", ((5, *IN_THE_OPEN[0][1:]),))
    stations, parts = [[0, 0, 0], [600, 0, 0]], [pipe(None, None, segment_length=10.0)]
    case = make_case(stations, parts, bit={"weight_on_bit": 1e5})
    down, up = torque_drag(case, ["drill_sliding", "trip_out"], [300.0]).to_dict("records")
    profile = equilibrium(case, "drill_sliding", 300.0).profile
    buckled = profile["md_m"][profile["buckling"] != "none"]
    assert (down["buckling"], down["status"]) == ("helical", "under_resolved")
    assert (down["buckled_from_md_m"], down["buckled_to_md_m"]) == (buckled.min(), buckled.max())
    assert "use segments of at most" in down["reason"]
    assert 'or solver.buckling = "resolve" (--resolve-buckling)' in down["reason"]
    assert up["buckling"] == "none"
    assert np.isnan([up["buckled_from_md_m"], up["buckled_to_md_m"]]).all()
    (free,) = torque_drag(
        make_case(stations, parts, contact={"enabled": False}, bit={"weight_on_bit": 1e3}), "drill_sliding", [300.0]
    ).to_dict("records")
    assert free["buckling"] == "none"
    lost = make_case([[0, 60, 0], [300, 60, 0]], parts, contact={"enabled": False})
    (lost_row,) = torque_drag(lost, "trip_in", [300.0]).to_dict("records")
    assert (lost_row["status"], lost_row["buckling"]) == ("max_iterations", UNKNOWN.mode)
    assert equilibrium(lost, "trip_in", 300.0).buckling == UNKNOWN


def test_the_middle_of_a_short_component_has_the_mean_of_both_its_joints() -> None:
    """Compression of 1, 3 and 5 MN at three joints and the bit; the second segment touches at its middle."""
    hole = straight(90.0)
    n = 3
    of = Pipe(*(np.full(n, value) for value in (2e6, 250.0, 0.06, 10.0)), np.array([False, True, False]))
    md = np.array([110.0, 115.0, 130.0])
    rows, _ = buckling_along(hole, of, 100.0, md, np.full(n, 0.1), -1e6 * np.array([1.0, 1.0, 3.0]), -5e6)
    turns = 2 * math.pi * np.sqrt(2 * 2e6 / (1e6 * np.array([1.0, 1.0, 2.0, 5.0])))
    assert (rows[:, MODE] > SINUSOIDAL).all()
    np.testing.assert_allclose(rows[:, NEEDED], turns / 12, rtol=1e-12)


def bends(*rows: tuple[float, float, float, float]) -> Any:
    """A hole given by tangents at depths alone, between which they change evenly."""
    return SimpleNamespace(bends=np.array(rows))


def test_the_lateral_load_within_an_even_bend() -> None:
    """q = |w (z − t_z t) − F dt/ds| where t is between two rows; in tension its bend does not count."""
    t, turn = np.array([0.48, 0.6, 0.64]), np.array([3e-4, -2e-4, -3.75e-5])  # of unit length, and across t
    hole = bends((100.0, *(t - 40 * turn)), (200.0, *(t + 60 * turn)), (300.0, *(t + 60 * turn)))
    across = 250.0 * (np.array([0.0, 0.0, 1.0]) - t[2] * t)
    for load in (-1e5, 0.0, 1e5):
        q = np.linalg.norm(across - max(load, 0.0) * turn)
        assert at(hole, 140.0, load)[SINUSOIDAL_LIMIT] == pytest.approx(2 * math.sqrt(2e6 * q / 0.04), rel=1e-12)


def test_contact_points_need_not_follow_each_other_downwards() -> None:
    """Points in the first, the last and the middle one of three bends, each with the limit of its own."""
    first, last = np.array([0.6, 0.0, 0.8]), np.array([0.8, 0.0, 0.6])
    hole = bends((100.0, *first), (200.0, *last), (300.0, *last), (400.0, *first))
    turn, level, F = (last - first) / 100, 250.0 * np.array([-0.48, 0.0, 0.64]), 1e5
    steep = 250.0 * np.array([-0.48, 0.0, 0.36])
    by_depth = {100.0: steep - F * turn, 250.0: level, 400.0: steep + F * turn}
    md = [100.0, 400.0, 250.0, 100.0, 250.0, 400.0, 100.0]
    rows, _ = judge(hole, md, F)
    limits = [2 * math.sqrt(2e6 * np.linalg.norm(by_depth[depth]) / 0.04) for depth in md]
    np.testing.assert_allclose(rows[:, SINUSOIDAL_LIMIT], limits, rtol=1e-12)


def test_every_row_has_the_section_of_its_own_segment() -> None:
    """And the top that of the first one: EI, weight and clearance of three components by hand."""
    EI, weight, clearance = np.array([1e6, 2e6, 8e6]), np.array([200.0, 300.0, 900.0]), np.array([0.05, 0.03, 0.02])
    of = Pipe(EI, weight, 0.1 - clearance, np.full(3, 10.0), np.zeros(3, bool))
    F = 1e7
    rows, found = buckling_along(straight(90.0), of, 100.0, np.array([110.0, 120.0, 130.0]), np.full(3, 0.1),
                                 np.full(3, -F), -F)  # fmt: skip
    own = [0, 0, 1, 2]
    np.testing.assert_allclose(rows[:, SINUSOIDAL_LIMIT], (2 * np.sqrt(EI * weight / clearance))[own], rtol=1e-9)
    np.testing.assert_allclose(rows[:, NEEDED], (2 * math.pi * np.sqrt(2 * EI / F) / 12)[own], rtol=1e-12)
    assert (found.from_md, found.to_md, found.longest) == (100.0, 130.0, 10.0)


def test_a_point_without_clearance_ends_a_stretch_of_vertical_pipe() -> None:
    """Above it the pipe is compressed less than the limit, and not judged by the end of the pipe below it."""
    unit = (2e6 * 250.0**2) ** (1 / 3)
    clearance = np.array([0.04, 0.04, 0.0, 0.04, 0.04])
    of = Pipe(*(np.full(5, value) for value in (2e6, 250.0)), 0.1 - clearance, np.full(5, 100.0), np.zeros(5, bool))
    hole, md = hole_of([[0, 0, 0], [500, 0, 0]]), np.arange(100.0, 501.0, 100.0)
    rows, found = buckling_along(hole, of, 0.0, md, np.full(5, 0.1), np.full(5, -unit), -4 * unit)
    assert rows[:, MODE].tolist() == [0, 0, 0, 0, 1, 1]
    assert (found.from_md, found.to_md) == (400.0, 500.0)


def test_the_excess_over_no_limit_is_a_thousand() -> None:
    """A drop in which nothing presses the string to the wall, w sin α = F dt/ds."""
    hole = bends((0.0, 1.0, 0.0, -0.05), (100.0, 1.0, 0.0, 0.05), (200.0, 1.0, 0.0, 0.05))
    rows, found = judge(hole, [49.0, 50.0, 51.0], 250.0 / 1e-3)
    assert rows[1, SINUSOIDAL_LIMIT] < 10.0
    assert found.excess == pytest.approx(1e3)
