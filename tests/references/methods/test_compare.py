"""Contact methods and engines on one well: planted faults are seen, failures are rows, an interruption keeps rows."""

import signal
import time
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import fctd
from fctd.arena.frames import frame
from fctd.arena.result import Comparison, Row
from fctd.case.errors import InputError
from references.contact.reference_hole import hole_of
from references.engines import StringEngine, checks
from references.methods import asked, compare, compare_methods, in_hole, loop, window
from references.methods.compare import Comparing
from references.methods.in_hole import POINTS
from references.methods.loop import timed_run
from references.methods.window import Plan, plan_of
from tests.references.engines.faulty import FACTOR
from tests.references.methods.planted import OFF, Slow, plant, well

OWN = "engine fctd"


def rows(comparison: Comparison) -> dict[str, Row]:
    """The rows by their labels."""
    return {row.label: row for row in comparison.rows}


@pytest.fixture(scope="module")
def compared() -> Comparison:
    """Own methods, those with planted faults, and an engine with a fault, on the well."""
    with pytest.MonkeyPatch.context() as patch:
        plant(patch, absent="no_such_module:Absent", arcs="no_such_module:Arcs")
        wanted = ["arcs", "cylinders,cylinder_length=1 m", "leaning", "lost", "raising", "absent"]
        return compare_methods(well(), wanted, ["slippery"], quick=True)


def test_a_method_with_normals_off_is_seen(compared: Comparison) -> None:
    row = rows(compared)["leaning"]
    assert row.errors is not None
    assert row.errors.largest_angle_deg == pytest.approx(OFF, abs=1e-6)  # exact: it is turned by that
    assert row.struck
    assert row.verdict == "BROKEN"
    assert "the normal in" in " ".join(row.broken or [])


def test_an_engine_with_less_friction_is_seen(compared: Comparison) -> None:
    row, own = rows(compared)["engine slippery"], rows(compared)[OWN]
    assert row.loads is not None
    assert own.loads is not None
    # Torque is Σ r μ N but for the little that N depends on friction.
    assert row.loads.surface_torque_N_m / own.loads.surface_torque_N_m == pytest.approx(FACTOR, rel=0.01)
    assert not compared.sound


def test_exact_methods_have_no_error_and_the_loads_of_the_engine(compared: Comparison) -> None:
    row, own = rows(compared)["arcs"], rows(compared)[OWN]
    assert row.verdict == "kept"
    assert row.errors is not None
    assert row.errors.largest_penetration_m < 1e-9
    assert (row.errors.missed, row.errors.false_contacts) == (0, 0)
    assert 0.4 * row.errors.points < row.errors.touching < 0.6 * row.errors.points
    assert row.loads is not None
    assert own.loads is not None
    assert row.loads.hookload_N == pytest.approx(own.loads.hookload_N, rel=1e-6)
    assert row.loads.force_off_N < 1.0
    assert row.loads.energy_error < 1e-3


def test_a_bit_that_never_turns_as_planned_has_the_window_of_the_last_try(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(window, "_turns", lambda run, rpm: False)
    plan = plan_of(well())
    times = plan.own.history["time_s"]
    assert plan.window.start < times.min() <= times.max() <= plan.window.start + plan.window.duration + 1e-6
    assert "does not turn as planned" in plan.notes[0]


def test_the_window_has_the_loads_of_the_steady_string(compared: Comparison) -> None:
    """The start leaves no swing that the mean over two periods would keep."""
    own = rows(compared)[OWN].loads
    assert own is not None
    steady = fctd.equilibrium(well(), operation="rotate_off_bottom", bit_depth=200)
    assert own.hookload_N == pytest.approx(steady.hookload, rel=1e-4)
    assert own.surface_torque_N_m == pytest.approx(steady.surface_torque, rel=5e-3)


def test_cylinders_are_off_by_the_sagitta_at_most(compared: Comparison) -> None:
    row = rows(compared)["cylinders, cylinder_length=1 m"]
    assert row.errors is not None
    curvature = np.radians(12) / 30  # of the sharpest bend
    assert 0 < row.errors.largest_penetration_m < 1.02 * curvature / 8 + 1e-6  # κℓ²/8 of a metre


def test_costs_have_quartiles_in_ns_and_in_units_of_the_reference_kernel(compared: Comparison) -> None:
    assert compared.kernel_ns is not None
    for name in ("arcs", "leaning"):
        cost = rows(compared)[name].cost
        assert cost is not None
        for value in (cost.point_ns, cost.kernels):
            assert 0 < value.low <= value.median <= value.high
    step = rows(compared)["arcs"].loads
    assert step is not None
    assert step.step_kernels is not None
    for value in (step.step_us, step.step_kernels):
        assert 0 < value.low <= value.median <= value.high


def test_failures_are_rows_with_their_reason(compared: Comparison) -> None:
    lost, raising, absent = (rows(compared)[name] for name in ("lost", "raising", "absent"))
    assert "is not a number" in " ".join(lost.broken or [])
    assert "contact method 'lost' returns a penetration that is not a number" in lost.loads_reason
    assert (raising.status, raising.reason) == ("failed", "ZeroDivisionError: of mine")
    assert raising.loads is None
    assert absent.status == "refused"
    assert "No module named 'no_such_module'" in absent.reason
    assert rows(compared)["arcs"].package == "fctd"  # no plugin takes its place


def test_all_methods_name_the_plugins_that_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    plant(monkeypatch, arcs="no_such_module:Arcs")
    found, _ = asked.rows_of("contact", ["all"])
    assert [row.reason for row in found if row.status == "refused"] == ["the name arcs is taken"]


def test_the_window_has_whole_periods_and_turns() -> None:
    plan = plan_of(well())
    window, run = plan.described, plan.own
    assert window.duration_s == pytest.approx(window.whole * window.period_s)
    assert run.status == "valid"
    assert run.history["bit_rpm"].mean() == pytest.approx(60, rel=0.05)
    # A uniform rod, fixed at the top: four times its length over the speed of shear waves, 0.25 s with 200 m.
    assert window.period_s == pytest.approx(0.25, rel=0.05)


def test_a_check_that_the_own_run_fails_is_told_of_the_string_and_not_of_a_method(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(checks, "DEEPEST", 1e-9)  # the string lies deeper in the wall than that
    found = compare_methods(well(), ["arcs"], quick=True)
    assert "end points inside the hole" in " ".join(found.notes)
    assert rows(found)["arcs"].verdict == "kept"


@pytest.mark.parametrize(("kind", "ends"), [("trip_in", (None, 190.0)), ("trip_out", (190.0, None))])
def test_a_trip_is_cut_to_its_deepest_end(kind: str, ends: tuple[float | None, float | None]) -> None:
    start, end = (150.0, 190.0) if kind == "trip_in" else (190.0, 150.0)
    case = well(operations=[{"kind": kind, "from_md": start, "to_md": end, "speed": 0.5, "ramp_time": 0.2}])
    window = plan_of(case).described
    assert window.vibration == "axial"
    for given, found in zip(ends, (window.from_md_m, window.to_md_m), strict=True):
        assert given is None or found == given
    assert abs(window.to_md_m - window.from_md_m) < 8.0


@pytest.mark.parametrize(
    "operation",
    [
        {"kind": "back_ream", "from_md": 190, "to_md": 150, "speed": 0.5, "rpm": 60},
        {"kind": "ream_in", "from_md": 150, "to_md": 190, "speed": 0.5, "rpm": 60},
        {"kind": "drill_rotating", "from_md": 150, "to_md": 190, "speed": 0.01, "rpm": 60},
    ],
    ids=lambda operation: operation["kind"],
)
def test_every_kind_of_operation_has_a_window(operation: dict[str, Any]) -> None:
    case = well(operations=[operation], bit={"weight_on_bit": 1e4, "rock": {}})
    found = compare_methods(case, ["arcs"], quick=True)
    own, arcs = rows(found)[OWN].loads, rows(found)["arcs"].loads
    assert own is not None
    assert arcs is not None
    assert own.hookload_N == pytest.approx(arcs.hookload_N, rel=1e-5)
    assert found.digest == case.digest


def test_a_case_without_operations_rotates_at_its_deepest() -> None:
    case = well(operations=[])
    assert plan_of(case).described.to_md_m == pytest.approx(case.deepest)


@pytest.mark.parametrize(
    ("what", "left", "expected"),
    [
        ("cost of a point", 1e-4, {"loads": "expected to take ", "kept": False, "errors": True}),
        ("arcs: errors", -1.0, {"loads": "the budget is spent", "kept": False, "errors": False}),
        ("cylinders: contract", 29.0, {"loads": "", "kept": True, "errors": True}),
    ],
)
def test_what_the_budget_leaves_out_says_so(
    what: str, left: float, expected: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a budget of a minute so much is left from a part of the work on; half of it waits for the loads."""

    def spend(doing: str, *_: float) -> None:
        if doing == what:
            monkeypatch.setattr(Comparing, "left", left)

    found = rows(compare_methods(well(), ["arcs", "cylinders"], quick=True, progress=spend))
    assert found["arcs"].loads_reason.startswith(expected["loads"])
    assert (found["arcs"].loads is None) == bool(expected["loads"])
    assert (found["arcs"].verdict == "kept") == expected["kept"]
    assert (found["arcs"].errors is not None) == expected["errors"]
    assert found["arcs"].sound
    if expected["kept"]:
        assert found["cylinders"].verdict == ""
        assert "half of the budget" in found["cylinders"].remarks[0]


def test_what_an_engine_compiles_at_first_is_not_expected_of_every_step(monkeypatch: pytest.MonkeyPatch) -> None:
    plant(monkeypatch)
    row = rows(compare_methods(well(), [], ["starting"], quick=True))["engine starting"]
    assert row.loads is not None
    assert row.predicted_s is not None
    assert row.predicted_s < 0.02 * row.loads.steps  # [s]: half a second in 20 steps is 0.025 s a step


def test_what_loads_take_is_expected_in_processor_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine on which the run waits for its core: the wait is counted once, in how busy the machine is."""

    def waiting(plan: Plan, engine: StringEngine) -> Any:
        time.sleep(2.0)
        return timed_run(plan, engine)

    monkeypatch.setattr(compare, "timed_run", waiting)
    own = rows(compare_methods(well(), [], quick=True))[OWN]
    assert own.predicted_s is not None
    assert own.predicted_s < 2.0


@pytest.mark.parametrize(("each", "points"), [(0.0, POINTS), (1e-3, 500)])
def test_a_slow_method_is_asked_for_fewer_points(each: float, points: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """What it does at first alone does not make it slow."""
    monkeypatch.setattr(in_hole, "MOST", 0.5)
    monkeypatch.setattr(Slow, "each", each)
    near = frame(hole_of(well())[0], POINTS)
    found, _ = in_hole.errors(Slow(well(), None), near)
    assert found.points == pytest.approx(points, rel=0.1)


def test_a_run_is_not_ended_for_the_time_in_which_its_step_is_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a clock of its own: the first record takes 9 s, those after it 0.4 s each, and 1 s was expected at most."""
    now, run = [0.0], SimpleNamespace(steps=0)

    def advance(motion: Any, duration: float) -> None:
        now[0] += 0.4 if run.steps else 9.0
        run.steps += 1

    monkeypatch.setattr(loop, "kernel", lambda: (lambda: None, 1))
    monkeypatch.setattr(loop.time, "process_time", lambda: now[0])
    timed: Any = loop.TimedStepper(SimpleNamespace(step=0.1, advance=advance), run, lambda _: None, 1.0)  # type: ignore[arg-type]
    for _ in range(3):
        timed.advance(None, 1.0)
    with pytest.raises(loop.OverrunError, match=r"1.2 s for 3 of"):
        timed.advance(None, 1.0)


def test_an_interruption_keeps_the_rows_that_are_there() -> None:
    def stop(what: str, done: float, _: float) -> None:
        if what.endswith(": loads") and done > 1.1:
            raise KeyboardInterrupt

    found = compare_methods(well(), ["arcs", "cylinders"], quick=True, progress=stop)
    by_name = rows(found)
    assert found.interrupted
    finished, stopped = (
        by_name["arcs"], by_name["cylinders"]
    ) if by_name["cylinders"].loads is None else (by_name["cylinders"], by_name["arcs"])  # fmt: skip
    assert finished.errors is not None
    assert stopped.loads_reason == "interrupted"
    assert stopped.errors is not None


def test_a_ctrl_c_that_a_library_catches_is_not_lost(monkeypatch: pytest.MonkeyPatch) -> None:
    plant(monkeypatch, deaf="tests.references.methods.planted:Deaf")
    handler = signal.getsignal(signal.SIGINT)
    found = compare_methods(well(), ["deaf", "arcs"], quick=True)
    assert found.interrupted
    assert signal.getsignal(signal.SIGINT) is handler


def test_meshes_have_frames_alone_in_a_quick_comparison() -> None:
    pytest.importorskip("igl")
    row = rows(compare_methods(well(), ["libigl"], quick=True))["libigl"]
    assert row.errors is not None
    assert row.loads is None
    assert "mesh" in row.loads_reason


def test_an_engine_says_what_it_cannot_honour() -> None:
    pytest.importorskip("mujoco")
    found = rows(compare_methods(well(mud={"density": 1200}), [], ["mujoco"], quick=True))["engine mujoco"]
    assert found.status == "refused"
    assert "mud" in found.reason
    assert not found.sound


def test_a_hole_with_a_caliper_is_judged_by_the_sampled_wall_of_the_engine() -> None:
    pytest.importorskip("igl")
    md = np.arange(5.0, 235.0, 0.5)
    radii = 0.108 * (1 + 0.1 * np.maximum(np.sin(2 * np.pi * md / 60), 0.0))  # washed out every 60 m
    rows_of_log = np.column_stack([md, *[radii] * 8]).tolist()
    caliper = {"geometry": "sampled", "caliper": {"rows": rows_of_log, "values": "radius"}}
    hole = well().wellbore.model_dump(include={"stations", "intervals"}, exclude_none=True)
    found = compare_methods(well(wellbore=hole | caliper), ["libigl", "arcs"], quick=True)
    assert "sampled wall" in found.reference
    mesh = rows(found)["libigl"].errors
    assert mesh is not None
    assert 0.3 * mesh.points < mesh.touching < 0.7 * mesh.points
    assert mesh.missed + mesh.false_contacts < 0.1 * mesh.points
    assert rows(found)["arcs"].status == "refused"


def test_a_survey_by_average_angle_is_judged_by_the_cylinders_of_the_engine() -> None:
    hole = well().wellbore.model_dump(include={"stations", "intervals"}, exclude_none=True)
    average = well(wellbore=hole | {"survey_method": "average_angle"})
    found = compare_methods(average, ["cylinders", "arcs"], quick=True)
    assert "average angle has no arcs" in found.reference
    own, chain = rows(found)[OWN].loads, rows(found)["cylinders"]
    assert own is not None
    assert chain.errors is not None
    assert chain.loads is not None
    assert chain.errors.largest_penetration_m < 1e-9
    # Where two cylinders overlap, either may hold a point.
    assert chain.loads.hookload_N == pytest.approx(own.hookload_N, rel=1e-3)
    assert "minimum_curvature" in rows(found)["arcs"].reason


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ({"methods": ["arx"]}, "arcs"),
        ({"methods": ["arcs,spacing=1 m"]}, "spacing"),
        ({"methods": ["cylinders,1 m"]}, "KEY=VALUE"),
        ({"engine": ["mujocco"]}, "mujoco"),
        ({"operation": "trip_in"}, "rotate_off_bottom"),
        ({"operation": "2"}, "from 1 to 1"),
    ],
)
def test_bad_usage_is_one_message(arguments: dict[str, Any], expected: str) -> None:
    with pytest.raises(InputError, match=expected):
        compare_methods(well(), **arguments)
