"""Preparation of a run: its laws, step and start, and what is refused."""

from typing import Any

import numpy as np
import pytest

from fctd import InputError
from fctd.mechanics import state
from fctd.mechanics.energy import penetration
from fctd.mechanics.law_names import CODES
from fctd.mechanics.moving_string import STILL
from fctd.mechanics.stability import SHARES, stable_step, stiffest_mode
from fctd.simulation import preparation
from fctd.simulation.preparation import contact_points, prepare
from fctd.simulation.run import Run
from fctd.simulation.settling import relaxing, settle, start_from_rest
from tests.cases import make_case, pipe, rotation, trip

BUILD = [[0, 0, 0], [600, 0, 0], [900, 60, 0], [1400, 60, 0]]
MUD = {"density": 1200.0}


def test_profiles_may_be_wanted_at_both_ends_of_a_trip() -> None:
    prepare(make_case(operations=[trip(990, 1000)], record={"profile_at": [990.0, 1000.0]}))
    for depth in (989.9, 1000.1):
        with pytest.raises(InputError, match=rf"record\.profile_at\[1\].*{depth:g} m.*990 to 1000 m"):
            prepare(make_case(operations=[trip(990, 1000)], record={"profile_at": [995.0, depth]}))


@pytest.mark.parametrize(("law", "number"), [("coulomb", CODES["coulomb"]), ("paper", CODES["paper"])])
@pytest.mark.parametrize(("enabled", "geometry"), [(True, state.ARCS), (False, state.OPEN)])
def test_the_laws_of_a_run_are_those_of_its_case(law: str, number: int, enabled: bool, geometry: int) -> None:
    contact = {"friction_law": law, "damping": 123.0, "enabled": enabled}
    case = make_case(
        operations=[rotation(1000, 1)], wellbore={"geometry": "arcs"}, contact=contact, solver={"joint_damping": 2e-5}
    )
    assert prepare(case)[0].laws == state.Laws(geometry, number, 1.0, 123.0, 2e-5, 0.0, shape_damping=3e-3)


def test_the_step_holds_for_the_shortest_top_segment() -> None:
    """The step does not depend on the direction of a trip, but on its shallowest depth."""
    components = [pipe(300, 12), pipe(None, 1)]

    def step(moves: list[dict[str, Any]], **solver: Any) -> float:
        return prepare(make_case(components=components, operations=moves, solver=solver))[0].step

    down, up = step([trip(312, 400)]), step([trip(400, 312)])
    assert down == pytest.approx(up, rel=1e-12)
    assert step([trip(400, 350)]) > 1.01 * up
    largest = step([trip(400, 312)], step="largest")
    assert up == pytest.approx(0.8 * largest)
    assert step([trip(400, 312)], step=largest) == largest
    with pytest.raises(InputError, match=r"solver\.step.*at most the stable step"):
        step([trip(400, 312)], step=1.001 * largest)


def test_a_run_starts_with_the_pieces_its_points_lie_in() -> None:
    run, _ = prepare(make_case(BUILD, [pipe(None, None, segment_length=20.0)], [rotation(1400, 1)]))
    points = contact_points(run.S, run.segments)
    np.testing.assert_array_equal(run.owner[1:-1], run.hole.owners(points))
    # Laid unstretched on the axis: ends of segments on it, each a segment's length from the one above.
    np.testing.assert_allclose(np.linalg.norm(np.diff(points, axis=0), axis=1), run.string.length[1:], atol=1e-9)
    # The last one is the bit: fifteen chords of 20 m in the bend are 61 mm shorter than their arcs, L³/24R² each.
    np.testing.assert_allclose(points[-1], run.hole.at(np.array([1400.0]))[0][0], atol=0.07)
    walls = run.hole.walls(points)
    np.testing.assert_allclose(np.linalg.norm(walls.offset, axis=1), 0.0, atol=5e-3)


def test_a_string_settles_against_its_own_weight_and_length() -> None:
    run, _ = prepare(make_case(components=[pipe(100, 10, outer=0.15), pipe(None, 18)], operations=[rotation(1000, 1)]))
    laws, weight = relaxing(run)
    by_hand = 9.80665 * 7850 * np.pi / 4 * (100 * (0.15**2 - 0.07**2) + 900 * (0.127**2 - 0.07**2))
    assert weight == pytest.approx(by_hand)
    assert laws == run.laws._replace(friction_scale=0.0, settling=pytest.approx(12 * np.sqrt(9.80665 / 1000)))


@pytest.mark.parametrize(
    ("sections", "message"),
    [
        (
            {"operations": [trip(900, 950), {"kind": "drill_sliding", "from_md": 950, "to_md": 960, "speed": 0.01}]},
            r"bit\.rock is missing: expected a table \[bit\.rock\], since operations\[1\] drills",
        ),
        (
            {"contact": {"helical_force": "analytic"}, "operations": [rotation(1000, 1)]},
            r'contact\.helical_force = "analytic": expected "none", since a simulation leaves out the force of a helix',
        ),
    ],
)
def test_input_that_only_the_steady_solver_supports_is_refused(sections: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        prepare(make_case(**sections))


def test_the_step_is_that_of_the_fastest_rotation_and_of_no_wall_without_contact() -> None:
    def built(*rpm: float) -> Run:
        moves = [rotation(1000, 10, rpm=each) for each in rpm]
        sections = {"contact": {"enabled": False}, "solver": {"joint_damping": 1e-3}}
        return prepare(make_case(operations=moves, **sections))[0]

    slow, mixed, fast = built(10.0), built(900.0, 10.0), built(900.0)
    assert mixed.step == fast.step < slow.step
    frequency = stiffest_mode(fast.S, fast.segments, 0.0)
    assert fast.step == SHARES["auto"] * stable_step(frequency, 1e-3, 900 * np.pi / 30)


def test_records_and_profiles_up_to_their_bounds(monkeypatch: pytest.MonkeyPatch) -> None:
    """A profile of 20 segments has a row for each of them and one for the top."""
    turn = [rotation(1000, 200)]
    prepare(make_case(operations=turn, record={"interval": 1e-3}))
    with pytest.raises(InputError, match="at most 200000 records"):
        prepare(make_case(operations=turn, record={"interval": 0.999e-3}))
    two = make_case(operations=turn, record={"profile_at": [1000.0] * 2})
    monkeypatch.setattr(preparation, "MOST_PROFILE_ROWS", 42)
    prepare(two)
    monkeypatch.setattr(preparation, "MOST_PROFILE_ROWS", 41)
    with pytest.raises(InputError, match="at most 1 profiles of 20 segments"):
        prepare(two)


def test_an_operation_that_takes_too_long_is_named() -> None:
    """Not the step, which is that of other runs; at 1 µs it is the step that is named."""
    turns = [rotation(1000, 200), rotation(1000, 1e9)]
    with pytest.raises(InputError, match=r'operations\[1\]\.duration = "2\.78e\+05 h": expected a run of at most'):
        prepare(make_case(operations=turns))
    with pytest.raises(InputError, match=r'operations\[0\]\.speed = "2\.78e\+05 h": expected a run of at most'):
        prepare(make_case(operations=[trip(990, 1000, speed=1e-8, ramp=1.0)]))
    with pytest.raises(InputError, match=r"solver\.step = .*at most .* steps of 20 segments"):
        prepare(make_case(operations=[rotation(1000, 1e6)], solver={"step": 1e-6}))


def test_an_operation_below_the_survey_is_named() -> None:
    with pytest.raises(InputError, match=r'operations\[1\]\.to_md = "1001 m": expected a depth below string\.top_md'):
        prepare(make_case(operations=[trip(990, 1000), trip(1000, 1001)]))


@pytest.mark.parametrize("more", [{"shear_stiffness": 1e308, "linear_mass": 1e-30}, {"torsional_stiffness": 1e308}])
def test_masses_and_stiffnesses_without_a_finite_frequency_are_refused(more: dict[str, float]) -> None:
    light = pipe(1000, 20, **{"linear_mass": 1e-10} | more)
    with pytest.raises(InputError, match=r"string\.components = \"a stiffest mode of inf rad/s\""):
        prepare(make_case(components=[light], operations=[rotation(1000, 1)]))


def test_the_step_holds_for_a_wall_of_another_power_at_its_largest_penetration() -> None:
    """The wall rules the step of short heavy segments; its tangent there is 1.5 √5 times the linear stiffness."""

    def step(contact: dict[str, Any], stiffness: float = 1e9) -> float:
        return prepare(
            make_case(wellbore={"stiffness": stiffness}, operations=[rotation(900, 1)], contact=contact)
        )[0].step  # fmt: skip

    power = step({"law": "power"})
    assert power == pytest.approx(step({}, stiffness=1e9 * 1.5 * 5**0.5), rel=1e-9)
    assert step({"law": "power", "largest_penetration": "2 mm"}) > power
    assert step({"law": "power", "exponent": 1.0}) == step({})


@pytest.mark.parametrize("inclination", [0.0, 2.0])
def test_mud_cake_is_as_old_as_the_string_has_rested_where_it_touches(inclination: float) -> None:
    """In an exactly vertical hole it hangs free, on the axis, and there is no cake below it."""
    intervals = [{"to_md": 1000, "diameter": 0.2159, "friction": 0.2, "overbalance": 5e6}]
    case = make_case(
        [[0, inclination, 0], [1000, inclination, 0]],
        wellbore={"intervals": intervals}, operations=[rotation(900, 1)], contact={"friction_law": "karnopp"},
        mud={"cake": {"friction": 0.1, "rested": "2 h"}},
    )  # fmt: skip
    run, _ = prepare(case)
    settle(run)
    start_from_rest(run)
    rests = penetration(run.S, run.segments) > 0
    assert rests.any() == (inclination > 0)
    np.testing.assert_array_equal(state.row(run.S, state.CAKE_AGE, run.segments), np.where(rests, 7200.0, 0.0))
    run.advance(STILL, 1.0)
    run.check()
    assert (run.laws.cake_thickness, run.laws.cake_friction) == (0.002, 0.1)
