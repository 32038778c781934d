"""Refinement: the estimated error, the string found, and the messages where none is found."""

import math
import sys
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd
import pytest

import fctd
from fctd import Case, Equilibrium, InputError
from fctd.model.drillstring import lay_out
from fctd.model.layouts import uniform, with_components
from fctd.model.operations import SteadyRates, steady_rates
from fctd.results.status import RefineStatus, SteadyStatus
from fctd.steady.balance import IN_THE_OPEN
from fctd.steady.equilibrium import Solver
from fctd.steady.levels import Level, Task, relative_difference
from fctd.steady.refine import Refinement, _better
from tests.cases import level_case, make_case, pipe, rotation, trip
from validation.parts.refinement import finer

BUILD = [[0, 0, 0], [400, 0, 0], [800, 60, 0], [1300, 60, 0]]


def build_case(**more: Any) -> Case:
    return make_case(BUILD, [pipe(None, None, segment_length=10.0)], mud={"density": 1200.0}, **more)


@pytest.mark.parametrize("graded", [False, True])
def test_the_string_found_is_within_the_tolerance_of_a_finer_one(graded: bool) -> None:
    case = build_case()
    kinds = ["rotate_off_bottom", "trip_out"]
    found = fctd.refine(case, 0.01, kinds, 1300.0, graded)
    assert found.status == "within_tolerance"
    assert found.error <= 0.01
    assert found.operations == tuple(kinds)
    for kind in kinds:
        point = fctd.equilibrium(found.case, kind, 1300.0)
        assert len(point.profile) - 1 == found.segments
        spin = steady_rates(case, kind).spin
        off = relative_difference(point, fctd.equilibrium(finer(found.case), kind, 1300.0), spin)
        assert max(off) <= 0.01
    steps = found.steps[(found.steps["stage"] == "string") & (found.steps["layout"] == found.layout)]
    assert steps["segments"].iloc[-1] == found.segments
    assert steps["torque_error"].isna().tolist() == [True, True] + [False] * (len(steps) - 2)
    assert (found.steps["time_s"] > 0).all()


def test_grading_takes_fewer_segments() -> None:
    """A build between two straights."""
    even, cut = (fctd.refine(build_case(), 0.003, "rotate_off_bottom", 1300.0, graded) for graded in (False, True))
    assert cut.segments < 0.8 * even.segments
    assert (even.layout, cut.layout) == ("uniform", "graded")
    assert cut.steps["layout"].unique().tolist() == ["uniform", "graded"]
    assert lay_out(cut.case, 1300.0).segments == cut.segments
    assert lay_out(cut.case, 1300.0).length.min() == pytest.approx(cut.shortest)
    tried = cut.steps[(cut.steps["stage"] == "string") & (cut.steps["layout"] == "uniform")]
    assert tried["segments"].iloc[-1] == even.segments


def test_a_hole_that_bends_alike_everywhere_is_cut_alike() -> None:
    """Grading would save no segments there."""
    case = make_case([[0, 0, 0], [1300, 80, 0]], [pipe(None, None, segment_length=10.0)])
    even, cut = (fctd.refine(case, 0.01, "rotate_off_bottom", 1300.0, graded) for graded in (False, True))
    assert cut.layout == "uniform"
    assert cut.case == even.case
    assert (cut.segments, cut.error) == (even.segments, even.error)
    tried = cut.steps[cut.steps["layout"] == "graded"]["segments"]
    assert 0 < tried.max() <= 0.9 * even.segments


@pytest.mark.parametrize(
    ("uniform", "graded", "better"),
    [
        (("within_tolerance", 0.009, 100), ("within_tolerance", 0.0099, 80), "graded"),
        (("within_tolerance", 0.009, 100), ("within_tolerance", 0.001, 100), "uniform"),
        (("within_tolerance", 0.009, 100), ("not_reached", 0.02, 80), "uniform"),
        (("not_reached", 0.011, 900), ("within_tolerance", 0.009, 990), "graded"),
        (("not_reached", 0.03, 500), ("not_reached", 0.02, 600), "graded"),
        (("not_reached", 0.02, 600), ("not_reached", 0.03, 500), "uniform"),
        (("no_answer", math.inf, 0), ("not_reached", 0.5, 80), "graded"),
        (("no_answer", math.inf, 0), ("no_answer", math.inf, 0), "uniform"),
    ],
)
def test_the_better_string_is_the_one_that_is_enough_with_fewer(
    uniform: tuple[str, float, int], graded: tuple[str, float, int], better: str
) -> None:
    def found(layout: str, status: str, error: float, segments: int) -> Refinement:
        steps = pd.DataFrame({"stage": ["hole", "string"], "layout": ["uniform", layout]})
        ended = RefineStatus(status)
        return Refinement(ended, "", build_case(), ("trip_in",), 1300.0, 0.01, error, layout, segments, 1.0, steps)

    chosen = _better(found("uniform", *uniform), found("graded", *graded))
    assert chosen.layout == better
    assert chosen.steps["layout"].tolist() == ["uniform", "uniform", "graded"]


@pytest.mark.parametrize(("size", "first"), [({"chord_tolerance": 0.2}, 0.2), ({"cylinder_length": 12.0}, None)])
def test_cylinders_that_are_too_long_are_cut_as_well(size: dict[str, Any], first: float | None) -> None:
    case = build_case(wellbore=size)
    found = fctd.refine(case, 0.01, "rotate_off_bottom", 1300.0)
    assert found.status == "within_tolerance"
    hole = found.steps[found.steps["stage"] == "hole"]
    radius = 400 / math.radians(60)
    assert hole["chord_m"].iloc[0] == pytest.approx(first or 12.0**2 / (8 * radius))
    chords = hole["chord_m"].to_numpy()
    assert len(chords) > 1
    assert 4 * chords[1:] == pytest.approx(chords[:-1])
    (key,) = size
    assert getattr(found.case.wellbore, key) < size[key]
    exact = case.wellbore.model_copy(update={"geometry": "arcs"})
    point = fctd.equilibrium(found.case, "rotate_off_bottom", 1300.0)
    true = fctd.equilibrium(found.case.model_copy(update={"wellbore": exact}), "rotate_off_bottom", 1300.0)
    assert max(relative_difference(point, true, spin=6.0)) < 0.01


def test_the_string_is_allowed_what_the_cylinders_leave(monkeypatch: pytest.MonkeyPatch) -> None:
    module, asked = sys.modules["fctd.steady.refine"], []
    refine_string = module._refine_string

    def with_ease(case: Case, task: Any, layout: str, allowed: float) -> Any:
        asked.append(allowed)
        return refine_string(case, task, layout, 0.5)

    monkeypatch.setattr(module, "_refine_string", with_ease)
    found = fctd.refine(build_case(wellbore={"chord_tolerance": 0.2}), 0.01, "rotate_off_bottom", 1300.0)
    hole = found.steps[found.steps["stage"] == "hole"]
    left = hole[["hookload_error", "torque_error"]].iloc[-1].max()
    assert 0 < left < 0.0025
    assert asked == [pytest.approx(0.01 - left)]


def test_cylinders_never_get_shorter_than_their_overlap() -> None:
    found = fctd.refine(build_case(wellbore={"cylinder_length": 0.4}), 0.01, "trip_out", 1300.0)
    assert found.case.wellbore.cylinder_length is not None
    assert found.case.wellbore.overlap <= 0.5 * found.case.wellbore.cylinder_length


def test_arcs_are_left_alone() -> None:
    found = fctd.refine(build_case(wellbore={"geometry": "arcs"}), 0.02, "trip_out", 1300.0)
    assert set(found.steps["stage"]) == {"string"}


def test_operation_and_depth_are_the_cases_own() -> None:
    case = build_case(operations=[trip(1000, 1200), rotation(1200, 10.0)])
    found = fctd.refine(case, 0.05)
    assert (found.operations, found.bit_depth) == (("trip_in",), 1200.0)
    case = build_case(operations=[trip(1000, 1200), trip(1200, 1100)])
    assert fctd.refine(case, 0.05, "trip_out").bit_depth == 1100.0
    assert fctd.refine(case, 0.05, "rotate_off_bottom").bit_depth == 1200.0


def test_a_tolerance_that_is_not_reached_has_a_message() -> None:
    found = fctd.refine(build_case(), 1e-7, "rotate_off_bottom", 1300.0, most=100)
    assert found.status == "not_reached"
    assert found.error > 1e-7
    assert found.segments == 64
    assert "at 64 segments" in found.message
    assert fctd.equilibrium(found.case, "rotate_off_bottom", 1300.0).status == "converged"


def test_a_string_without_a_balance_has_a_message(monkeypatch: pytest.MonkeyPatch) -> None:
    """Hanging sideways without walls, which five iterations do not find at any count."""
    monkeypatch.setattr("fctd.steady.attempts.IN_THE_OPEN", ((5, *IN_THE_OPEN[0][1:]),))
    case = make_case([[0, 60, 0], [300, 60, 0]], [pipe(None, None, segment_length=10.0)], contact={"enabled": False})
    found = fctd.refine(case, 0.01, "trip_in", 300.0, most=64)
    assert found.status == "no_answer"
    assert found.case == case
    assert "trip_in (max_iterations:" in found.message
    assert found.steps["hookload_N"].isna().all()


def test_a_turning_string_without_friction_has_no_torque_error() -> None:
    hole = {"intervals": [{"to_md": 1300, "diameter": 0.2159, "friction": 0.0}]}
    assert fctd.refine(build_case(wellbore=hole), 0.01, "rotate_off_bottom", 1300.0).status == "within_tolerance"


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ({"tolerance": 0.0}, "tolerance = 0.0: expected a share above 0"),
        ({"tolerance": -0.01}, "tolerance = -0.01"),
        ({"tolerance": 1.0}, "tolerance = 1.0"),
        ({"tolerance": math.nan}, "tolerance = NaN"),
        ({"most": 10}, "most = 10: expected 16 to 10000 segments"),
        ({"most": 20_000}, "most = 20000"),
        ({"operation": "trip_up"}, "expected the kind trip_"),
        ({"operation": []}, "expected at least one kind"),
        ({"operation": None}, "operation is missing: expected a kind of operation, as the case has none"),
        ({"bit_depth": None}, "bit_depth is missing: expected a bit depth, as the case has no operation"),
        ({"bit_depth": 1301.0}, 'bit_depth = "1301 m": expected a depth below'),
        ({"speed": -1.0}, "speed = -1.0"),
        ({"bit_depth": "1300 kg"}, 'bit_depth = "1300 kg": expected a length such as'),
        ({"tolerance": "1%"}, 'tolerance = "1%": expected a share above 0 and below 1, such as 0.01'),
        ({"most": "many"}, 'most = "many": expected a number of segments'),
    ],
)
def test_bad_input_is_refused(call: dict[str, Any], expected: str) -> None:
    with pytest.raises(InputError) as error:
        fctd.refine(build_case(), **({"operation": "trip_out", "bit_depth": 1300.0} | call))
    assert expected.lower() in str(error.value).lower()


def test_resolved_joints_are_refused() -> None:
    joint = {"length": 10.0, "tool_joint_length": 0.5, "tool_joint_diameter": 0.165}
    case = make_case(components=[pipe(20, 4), pipe(None, None, joint=joint, joint_segments=4)])
    with pytest.raises(InputError, match=r"string.components\[1\].joint_segments = 4: expected none in a refinement"):
        fctd.refine(case, 0.01, "trip_in", 300.0)


def test_a_long_segment_alone_cannot_be_cut() -> None:
    case = make_case([[0, 0, 0], [300, 0, 0]], [pipe(None, 1)])
    with pytest.raises(InputError, match=r"string.components .*: expected a component that can be cut"):
        fctd.refine(case, 0.01, "trip_in", 300.0)


def test_one_agreement_is_not_enough() -> None:
    """A string that hangs straight down is exact at once; three strings are solved all the same."""
    case = make_case([[0, 0, 0], [500, 0, 0]], [pipe(None, None, segment_length=10.0)], wellbore={"geometry": "arcs"})
    assert fctd.refine(case, 0.1, "trip_in", 500.0).steps["segments"].tolist() == [16, 32, 64]


def test_finer_strings_without_an_answer_end_the_search(monkeypatch: pytest.MonkeyPatch) -> None:
    """As for a string that buckles only with short segments."""
    solve = Solver.solve

    def short_of_breath(self: Solver, operation: str, rates: SteadyRates, bit_depth: float) -> Equilibrium:
        point = solve(self, operation, rates, bit_depth)
        return replace(point, status=SteadyStatus.MAX_ITERATIONS) if len(point.profile) > 70 else point

    monkeypatch.setattr(Solver, "solve", short_of_breath)
    found = fctd.refine(build_case(wellbore={"geometry": "arcs"}), 1e-6, "rotate_off_bottom", 1300.0)
    assert found.status == "not_reached"
    assert found.message.startswith("strings of more than 64 segments have no solution (rotate_off_bottom: max_iter")
    assert found.segments == 64
    assert found.steps["segments"].tolist() == [16, 32, 64, 128, 256]
    assert found.steps["hookload_N"].isna().tolist() == [False] * 3 + [True] * 2


@pytest.mark.parametrize(
    ("loads", "segments"), [((math.nan,), [16, 32, 64]), ((1.0, 2.0), [16, 32, 64, 128, 256, 512])]
)
def test_a_buckled_string_ends_the_search_early(
    loads: tuple[float, ...], segments: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where no push moves it, and where its hook load goes on jumping between two shapes."""
    module = sys.modules["fctd.steady.refine"]
    case, point = build_case(), SimpleNamespace(shape="helix", profile=range(1001))
    cuts: list[int] = []

    def solve(stage: str, layout: str, cut: Case, task: Any) -> Level:
        cuts.append(lay_out(cut, task.bit_depth).segments)
        load = np.array([[loads[len(cuts) % len(loads)], 0.0]])
        return Level(stage, layout, cut, cuts[-1], 1.0, load, np.ones((1, 2)), [point], [0.0])  # type: ignore[list-item]

    monkeypatch.setattr(module, "solve_level", solve)
    levels = module._refine_string(case, Task({}, 1300.0, 5000, None), "uniform", 0.01)
    assert cuts == segments
    assert levels[-1].resolved == 1000


@pytest.mark.slow
def test_buckled_strings_are_resolved_unless_the_case_says_otherwise() -> None:
    """A level string in a hole of arcs at 2.6 times its sinusoidal limit."""
    given = level_case(wellbore={
        "intervals": [{"to_md": 170.0, "diameter": 0.2159, "friction": 0.5}], "stiffness_per_length": 1e6,
        "survey_method": "minimum_curvature", "geometry": "arcs",
    })  # fmt: skip
    case = given.model_copy(update={"solver": type(given.solver)()})
    found = fctd.refine(case, 0.05, "drill_sliding", 150.0, most=64)
    assert found.status == "within_tolerance"
    assert found.case.solver.buckling == "resolve"
    point = fctd.equilibrium(found.case, "drill_sliding", 150.0)
    assert found.resolved == len(point.profile) - 1 > 2 * found.segments
    detect = case.model_copy(update={"solver": type(given.solver)(buckling="detect")})
    assert fctd.refine(detect, 0.05, "drill_sliding", 150.0, most=64).resolved == 0


def motor_case() -> Case:
    """A bit, a bent motor of 27 ft at full gauge, collars and pipe in a build of 4.5°/30 m."""
    tool = pipe(None, None, outer=0.1715, inner=0.0714)
    parts = [
        pipe(0.3, 1, outer=0.2159, inner=0.05),
        tool | {"length": 8.23, "contact_diameter": 0.2127, "bend": math.radians(1.15), "segments": 1},
        tool | {"length": 80.0},
        pipe(None, None, contact_diameter=0.168),
    ]
    hole = {"geometry": "arcs", "intervals": [{"to_md": 1300.0, "diameter": 0.2159, "friction": 0.3}]}
    return make_case(
        BUILD, parts, mud={"density": 1200.0}, wellbore=hole | {"stiffness": None, "stiffness_per_length": 1e7}
    )


@pytest.mark.parametrize("graded", [False, True])
def test_a_short_bent_component_is_cut_before_a_string_is_judged(graded: bool) -> None:
    """In 69 segments, with 20 m of collar above the motor, three levels agreed within 1 % on a torque 11 % low."""
    case = motor_case()
    found = fctd.refine(case, 0.02, "rotate_off_bottom", 1300.0, graded, rpm=60.0)
    assert found.status == "within_tolerance"
    string = lay_out(found.case, 1300.0)
    assert string.length[string.length.cumsum() > 1300.0 - 30.0].max() <= 10.0
    fine = with_components(case, uniform(case, 1300.0, 1.5))
    points = (fctd.equilibrium(c, "rotate_off_bottom", 1300.0, rpm=60.0) for c in (found.case, fine))
    assert max(relative_difference(*points, 2 * math.pi)) <= 0.02


def test_too_few_segments_beside_a_short_component_are_said_so() -> None:
    found = fctd.refine(motor_case(), 0.02, "rotate_off_bottom", 1300.0, most=100, rpm=60.0)
    assert found.status == "not_reached"
    assert "bent and short components ask for segments of 10 m beside them" in found.message
