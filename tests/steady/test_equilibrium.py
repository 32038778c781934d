"""The steady solver: balances, statuses, convergence with segment count, bad input."""

import math
from functools import partial
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import simpson, solve_bvp

import fctd
from fctd import Case, InputError, equilibrium
from fctd.case.operations import KINDS
from fctd.mechanics import state
from fctd.mechanics.law_names import CODES
from fctd.model.frames import hole_frame
from fctd.model.operations import steady_rates
from fctd.model.section import section_of
from fctd.model.wellbore import build_wellbore
from fctd.steady.balance import IN_THE_OPEN
from fctd.steady.block_thomas import solve_with_pivoting
from fctd.steady.continuation import add_pseudo_mass, take_step
from fctd.steady.equilibrium import Solver
from fctd.steady.first_guess import MD, guess
from fctd.steady.pose import PLACE
from fctd.steady.tangent import Steady, assemble
from tests.cases import make_case, pipe
from validation.harness.study import Context
from validation.studies import beam_in_hole

BUILD = [[0, 0, 0], [400, 0, 0], [800, 60, 0], [1300, 60, 0]]


def build_case(segments: int = 52, **more: Any) -> Case:
    hole = {"geometry": "arcs", "stiffness": None, "stiffness_per_length": 1e6} | more.pop("wellbore", {})
    return make_case(BUILD, [pipe(1300, segments)], mud={"density": 1200.0}, wellbore=hole, **more)


@st.composite
def wells(draw: st.DrawFn) -> list[list[float]]:
    """Five to eight stations, vertical at first, up to 2.4 deg/10 m in inclination, any azimuth through north."""
    stations = [[0.0, 0.0, 350.0], [200.0, 0.0, 350.0]]
    for _ in range(draw(st.integers(3, 6))):
        md, inclination, azimuth = stations[-1]
        step = draw(st.floats(60, 200))
        turn = draw(st.floats(-0.12, 0.24)) * step
        aside = draw(st.floats(-0.15, 0.15)) * step
        stations.append([md + step, float(np.clip(inclination + turn, 0, 115)), (azimuth + aside) % 360])
    return stations


@given(stations=wells(), kind=st.sampled_from(list(KINDS)), law=st.sampled_from(["coulomb", "paper"]),
       geometry=st.sampled_from(["cylinders", "arcs"]), friction=st.floats(0, 0.5))  # fmt: skip
@settings(max_examples=60)
def test_any_well_is_in_balance(
    stations: list[list[float]], kind: str, law: str, geometry: str, friction: float
) -> None:
    """Torque at the top equals that of wall, mud and bit.  The ends of the profile have the loads of top and bit."""
    depth = stations[-1][0]
    case = make_case(
        stations,
        [pipe(100, 10, outer=0.165), pipe(None, None, segment_length=20.0, contact_diameter=0.16)],
        wellbore={"geometry": geometry, "intervals": [{"to_md": depth, "diameter": 0.2159, "friction": friction}]},
        contact={"friction_law": law},
        mud={"density": 1100.0, "rotational_damping": 0.2},
        bit={"weight_on_bit": 1e4, "torque": 1e3},
    )
    point = equilibrium(case, kind, depth)
    assert point.answered, (point.status, point.message)
    profile = point.profile
    assert np.isfinite(profile.select_dtypes("number").drop(columns=["sinusoidal_limit_N", "helical_limit_N"])).all(
        axis=None
    )
    drilling = kind.startswith("drill")
    rates = steady_rates(case, kind)
    mud = 0.2 * rates.spin * depth
    taken = point.sum_r_ft + mud + (1e3 if drilling else 0.0)
    # A bent string passes its torque on with the cosine of a half bend at every joint.
    assert point.surface_torque == pytest.approx(taken, rel=0.02, abs=30.0)
    if law == "paper" and rates.spin:
        assert point.sum_r_ft == pytest.approx(point.sum_r_mu_fn, rel=1e-9, abs=1e-6)
    assert profile["effective_tension_N"].iloc[-1] == (-1e4 if drilling else 0.0)
    assert profile["effective_tension_N"].iloc[0] == pytest.approx(point.hookload, rel=0.02, abs=3e3)
    touching = profile["contact_force_N"] > 0
    offset = np.hypot(profile["offset_high_m"], profile["offset_right_m"])
    assert (offset[touching] >= profile["clearance_m"][touching] - 1e-9).all()
    assert (offset[~touching] <= profile["clearance_m"][~touching] + 1e-9).all()


@given(stations=wells(), geometry=st.sampled_from(["cylinders", "arcs"]))
@settings(max_examples=20)
def test_hook_and_wall_carry_the_weight(stations: list[list[float]], geometry: str) -> None:
    """Turning by law ``paper`` the wall's forces are its normals alone; the top is vertical."""
    depth = stations[-1][0]
    case = make_case(
        stations, [pipe(None, None, segment_length=20.0)], wellbore={"geometry": geometry},
        contact={"friction_law": "paper"}, mud={"density": 1100.0},
    )  # fmt: skip
    point = equilibrium(case, "rotate_off_bottom", depth)
    assert point.answered
    profile = point.profile
    high, right = hole_frame(build_wellbore(case).at(profile["md_m"].to_numpy())[1])
    angle = np.radians(profile["contact_angle_deg"].to_numpy())
    down = np.cos(angle) * high[:, 2] + np.sin(angle) * right[:, 2]
    weight = 9.80665 * math.pi / 4 * (0.127**2 - 0.07**2) * (7850 - 1100) * depth
    carried = point.hookload + float(profile["contact_force_N"] @ down)
    assert carried == pytest.approx(weight, rel=1e-3)


def test_picking_up_pulls_more_than_turning_and_that_more_than_slacking_off() -> None:
    loads = [equilibrium(build_case(), kind, 1300.0).hookload for kind in ("trip_in", "rotate_off_bottom", "trip_out")]
    assert loads == sorted(loads)
    assert loads[2] - loads[0] > 5e4


def test_a_turning_string_hangs_with_its_vertical_weight() -> None:
    """No friction along the hole: the hook carries w times the vertical depth."""
    point = equilibrium(build_case(260), "rotate_off_bottom", 1300.0)
    radius = 400 / math.radians(60)
    vertical = 400 + radius * math.sin(math.radians(60)) + 500 * 0.5
    weight = 9.80665 * (math.pi / 4) * (0.127**2 - 0.07**2) * (7850 - 1200)
    assert point.hookload == pytest.approx(weight * vertical, rel=2e-3)


def test_torque_and_bending_moment_converge_with_the_segments() -> None:
    """Moment in the build: order 2.  Torque: order 1 at least, since the ends of contact move by whole segments."""
    counts = [20, 40, 65, 80, 130, 160, 260]
    numbers = []
    for count in [*counts, 2600]:
        point = equilibrium(build_case(count), "rotate_off_bottom", 1300.0)
        moment = np.interp(600.0, point.profile["md_m"], point.profile["bending_moment_N_m"])
        numbers.append((point.surface_torque, moment))
    errors = np.abs(np.array(numbers[:-1]) / numbers[-1] - 1)
    torque, moment = (-np.polyfit(np.log(counts), np.log(errors[:, k]), 1)[0] for k in (0, 1))
    assert moment == pytest.approx(2.0, abs=0.2)
    assert torque > 1.0
    assert errors[-1, 0] < 1e-4


def test_bending_moment_of_the_build_is_that_of_its_curvature() -> None:
    """EI/R where the string lies along the wall all the way."""
    point = equilibrium(build_case(520), "trip_out", 1300.0)
    EI = 206.8e9 * math.pi / 64 * (0.127**4 - 0.07**4)
    moment = np.interp(600.0, point.profile["md_m"], point.profile["bending_moment_N_m"])
    assert moment == pytest.approx(EI * math.radians(60) / 400, rel=1e-3)


def test_short_beams_are_those_of_beam_theory() -> None:
    """The study's cantilever, supports, pendulum and bent housing, each within 1 % (sources beside them)."""
    outcome = beam_in_hole.run(Context(quick=True))
    assert [(check.name, check.value) for check in outcome.checks if check.verdict != "met"] == []


@pytest.mark.parametrize("toolface", [0.0, 90.0, 180.0, 270.0])
def test_a_bent_housing_points_to_its_toolface(toolface: float) -> None:
    """A cantilever bent by β, 2 m above its end: the end is off the straight one's by 2β sin, towards the toolface."""
    ends = []
    for bend in (0.0, 0.01):
        parts = [
            beam_in_hole.part(2.0, 0.5, bend=bend, toolface=math.radians(toolface)),
            beam_in_hole.part(6.0, 0.5),
        ]
        end = beam_in_hole.solve(parts, 8.0, contact={"enabled": False}).profile.iloc[-1]
        ends.append((end["offset_high_m"], end["offset_right_m"]))
    off = np.subtract(*reversed(ends))
    expected = 0.02 * np.array([math.cos(math.radians(toolface)), math.sin(math.radians(toolface))])
    np.testing.assert_allclose(off, expected, atol=2e-4)


def test_a_locked_up_string_has_loads() -> None:
    """3 km of horizontal hole at μ 0.4 under 200 m of weight cannot be slacked off into."""
    stations = [[0, 0, 0], [200, 0, 0], [500, 90, 0], [3500, 90, 0]]
    hole = {"geometry": "arcs", "intervals": [{"to_md": 3500, "diameter": 0.2159, "friction": 0.4}]}
    case = make_case(stations, [pipe(None, None, segment_length=25.0)], wellbore=hole)
    point = equilibrium(case, "trip_in", 3500.0)
    assert point.status == "locked_up"
    assert not point.buckling.resolved  # coarse segments miss friction, so a string that they lock is locked
    assert point.hookload < 0
    heavy = case.model_copy(update={"rig": case.rig.model_copy(update={"block_weight": 2e6})})
    # A block that pushes: the string goes, but its segments of 25 m are too long for the helix.
    assert equilibrium(heavy, "trip_in", 3500.0).status == "under_resolved"


def test_a_straight_string_beyond_its_buckling_load_leaves_it_for_a_helix() -> None:
    """100 kN on the bit of a string that weighs 680 N/m, in a vertical hole, with segments that follow a helix."""
    components = [pipe(None, None, segment_length=2.5)]
    case = make_case([[0, 0, 0], [300, 0, 0]], components, bit={"weight_on_bit": 1e5})
    point = equilibrium(case, "drill_sliding", 300.0)
    assert point.status == "converged"
    assert point.imbalance < 1e-6 * 1e5
    profile = point.profile
    buckled = profile[profile["buckling"] == "helical"]
    # Compressed are the lower 147 m: 1e5 N over 680 N/m.
    assert buckled["md_m"].min() == pytest.approx(300 - 1e5 / 680, abs=5.0)
    lower = profile[profile["md_m"].between(200, 285)]
    assert (np.hypot(lower["offset_high_m"], lower["offset_right_m"]) > 0.99 * lower["clearance_m"]).all()
    case = case.model_copy(update={"bit": case.bit.model_copy(update={"weight_on_bit": 1e3})})
    straight = equilibrium(case, "drill_sliding", 300.0)
    assert (straight.status, straight.buckling.mode) == ("converged", "none")


def test_a_string_without_a_balance_has_a_status(monkeypatch: pytest.MonkeyPatch) -> None:
    """A clamped string without walls in a slanting hole hangs down in a loop, which five iterations do not find."""
    monkeypatch.setattr("fctd.steady.attempts.IN_THE_OPEN", ((5, *IN_THE_OPEN[0][1:]),))
    case = make_case([[0, 60, 0], [300, 60, 0]], [pipe(None, None, segment_length=10.0)], contact={"enabled": False})
    point = equilibrium(case, "trip_in", 300.0)
    assert point.status == "max_iterations"
    assert not point.answered
    assert point.imbalance > 1.0
    chart = fctd.torque_drag(case, "trip_in", [300.0])
    assert chart["hookload_N"].isna().all()
    assert list(chart["status"]) == ["max_iterations"]


@pytest.mark.parametrize("length", [10.0, 20.0, 30.0, 45.4])
def test_a_heavy_pipe_held_level_is_an_elastica(length: float) -> None:
    """EI θ″ = −q (L − s) cos θ, θ(0) = 0, θ′(L) = 0, integrated; q L³/EI from 0.2 to 20."""
    segments = 120
    part = pipe(None, None, inner=0.1086, segment_length=length / segments)
    case = make_case([[0, 90, 0], [length, 90, 0]], [part], contact={"enabled": False})
    point = equilibrium(case, "trip_in", length)
    assert point.status == "converged"
    s = section_of(case.string.components[0], 0.0)
    load = s.weight * length**3 / s.EI

    def slopes(at, y, share):
        return np.vstack([y[1], -share * load * (1 - at) * np.cos(y[0])])

    at, found = np.linspace(0, 1, 201), np.zeros((2, 201))
    for share in np.linspace(0.05, 1, 20):
        solved = solve_bvp(partial(slopes, share=share), lambda a, b: np.array([a[0], b[1]]), at, found, tol=1e-8)
        at, found = solved.x, solved.y
    fine = np.linspace(0, 1, 4001)
    drop = length * simpson(np.sin(solved.sol(fine)[0]), x=fine)
    reach = length * simpson(np.cos(solved.sol(fine)[0]), x=fine)
    places = point._shape.contacts[:, PLACE]
    assert places[-1, 2] - point._shape.top[2] == pytest.approx(drop, rel=1e-3)
    assert places[-1, 0] - point._shape.top[0] == pytest.approx(reach, rel=2e-3)
    moment = point.profile["bending_moment_N_m"].max()
    assert moment == pytest.approx(s.EI / length * solved.sol(0.0)[1], rel=1e-3)


@pytest.mark.parametrize("stations", [[[0, 0, 0], [300, 0, 0]], [[0, 0, 0], [300, 60, 40]]])
def test_no_clearance_at_all(stations: list[list[float]]) -> None:
    """The string lies on the axis, where |PT| = 0."""
    case = make_case(stations, [pipe(None, None, segment_length=10.0, contact_diameter=0.2159)])
    for kind in ("trip_out", "rotate_off_bottom"):
        point = equilibrium(case, kind, 300.0)
        assert point.status == "converged"
        assert np.hypot(point.profile["offset_high_m"], point.profile["offset_right_m"]).max() < 5e-3


def test_steps_by_the_other_solver_lead_to_the_same_balance() -> None:
    """The solver for near singular blocks, used for every step of a whole solution."""
    solver = Solver(build_case(40))
    rates = steady_rates(solver.case, "trip_out")
    point = solver.solve("trip_out", rates, 1300.0)
    w, n, pieces = solver.work, 40, solver.hole.pieces
    law = CODES[solver.case.contact.friction_law]
    laws = Steady(solver.geometry, law, 1.0, rates.speed, rates.spin, 0.0, 0.0, 0.0, 0.0)
    kinks = np.tile([1.0, 0.0, 0.0, 0.0], (n + 2, 1))
    radius = solver.lay_out(1300.0).string.contact_radius()
    guess(w.S, n, pieces, laws, 0.0, 0.0, radius, 1e-4, w.G, w.P)
    w.owner[1 : n + 1] = np.searchsorted(pieces[:, 10], w.G[1 : n + 1, MD], side="right") - 1
    tau = 0.2
    for _ in range(25):
        assemble(w.S, n, w.P, kinks, pieces, w.owner, laws, w.R, w.D, w.A, w.U)
        add_pseudo_mass(w.S, n, tau, w.D)
        w.R[1 : n + 1] = solve_with_pivoting(w.D, w.A, w.U, w.R, n)
        take_step(w.P, n, w.R, 1.0)
        tau *= 3
    assemble(w.S, n, w.P, kinks, pieces, w.owner, laws, w.R, w.D, w.A, w.U)
    assert w.R[0, :3] @ [0, 0, 1] == pytest.approx(point.hookload, rel=1e-7)


def test_the_rates_of_a_call_are_those_of_the_loads() -> None:
    case = build_case(operations=[{"kind": "back_ream", "from_md": 900, "to_md": 800, "speed": 0.25, "rpm": 30}])
    fast = equilibrium(case, "back_ream", 900.0, speed=2.0).hookload
    assert fast > equilibrium(case, "back_ream", 900.0, speed=0.01).hookload


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ({"operation": "trip_up"}, 'operation = "trip_up": expected the kind trip_'),
        (
            {"operation": "dance"},
            "expected one of the kinds trip_in, trip_out, rotate_off_bottom, back_ream, ream_in",
        ),
        ({"bit_depth": 1301.0}, 'bit_depth = "1301 m": expected a depth below string.top_md, 0 m, within survey'),
        ({"bit_depth": 0.0}, 'bit_depth = "0 m": expected a depth below'),
        ({"bit_depth": math.nan}, "expected a depth below"),
        ({"speed": 0.0}, "speed = 0.0: expected a speed above 0 and at most 10 m/s for trip_out"),
        ({"speed": -1.0}, "speed = -1.0: expected a speed above 0"),
        ({"operation": "rotate_off_bottom", "speed": 0.1}, "expected a speed of 0 for rotate_off_bottom"),
        ({"operation": "rotate_off_bottom", "rpm": 0}, "rpm = 0: expected rev/min above 0"),
        ({"operation": "drill_sliding", "rpm": 60}, "rpm = 60: expected rev/min of 0"),
        ({"bit_depth": "1000 kg"}, 'bit_depth = "1000 kg": expected a length such as'),
        ({"bit_depth": None}, "bit_depth = null: expected a length such as"),
        ({"speed": "0.2 m"}, 'speed = "0.2 m": expected a speed such as'),
        ({"rpm": "60 kg"}, 'rpm = "60 kg": expected a rotation such as'),
        (
            {"operation": "ream_in", "rpm": 1e5},
            "rpm = 100000.0: expected rev/min above 0 and at most 10000 for ream_in",
        ),
        ({"operation": "trip_in", "speed": 1e5}, "speed = 100000.0: expected a speed above 0 and at most 10 m/s"),
    ],
)
def test_bad_input_is_refused(call: dict[str, Any], expected: str) -> None:
    arguments = {"operation": "trip_out", "bit_depth": 1000.0} | call
    with pytest.raises(InputError) as error:
        equilibrium(build_case(), **arguments)
    assert expected in str(error.value)


def test_string_and_hole_have_to_fit() -> None:
    case = make_case([[0, 0, 0], [300, 0, 0]], [pipe(None, 5, contact_diameter=0.3)])
    with pytest.raises(InputError, match=r"string.components\[0\].contact_diameter"):
        equilibrium(case, "trip_in", 300.0)


def test_arrays_for_deeper_strings_are_no_larger_than_the_buffer() -> None:
    """The first fit the string; those for a deeper one have room for half as many segments again."""
    case = make_case([[0, 0, 0], [800, 0, 0]], [pipe(None, None, segment_length=0.1)])
    solver = Solver(case)
    for depth, room in ((690.0, 6900), (700.0, state.MAX_SEGMENTS)):
        laid = solver.lay_out(depth)
        assert laid.string.segments == round(10 * depth)
        solver.problem("trip_in", steady_rates(case, "trip_in"), laid)
        assert solver.work.segments == room


def test_a_wall_of_another_power_presses_by_its_law() -> None:
    """F = K d₀ (d/d₀)^1.5 at every contact point; the loads are those of the linear wall within its penetration."""
    wells = [[0, 0, 0], [100, 0, 0], [400, 60, 0], [600, 60, 0]]
    points = [
        fctd.equilibrium(
            make_case(wells, [pipe(None, None, segment_length=20)], wellbore={"geometry": "arcs"}, contact=contact),
            operation="trip_out", bit_depth=550.0,
        )
        for contact in ({}, {"law": "power"})
    ]  # fmt: skip
    linear, power = points
    assert power.status == "converged"
    assert power.hookload == pytest.approx(linear.hookload, rel=1e-3)
    profile = power.profile[power.profile["contact_force_N"] > 0]
    depth = np.hypot(profile["offset_high_m"], profile["offset_right_m"]) - profile["clearance_m"]
    np.testing.assert_allclose(profile["contact_force_N"], 1e7 * 1e-3 * (depth / 1e-3) ** 1.5, rtol=1e-4)


def test_segments_that_cannot_follow_a_winding_hole_are_under_resolved() -> None:
    waves = {"amplitude": 0.01, "wavelength": 40.0}
    wells = [[0, 0, 0], [100, 0, 0], [400, 60, 0], [600, 60, 0]]
    status = [
        fctd.equilibrium(
            make_case(
                wells, [pipe(None, None, segment_length=length)],
                wellbore={"geometry": "arcs", "tortuosity": waves, "stiffness_per_length": 1e7},
            ),
            operation="rotate_off_bottom", bit_depth=550.0,
        )
        for length in (5.0, 10.0)
    ]  # fmt: skip
    assert [point.status for point in status] == ["converged", "under_resolved"]
    assert "use segments of at most 5 m" in status[1].message
