"""The string in other engines: loads as FCTD's, checks that detect wrong results, and refusals."""

import re
import sys
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pandas as pd
import pytest

from fctd import Case, InputError, Simulation
from fctd.mechanics import state, topdrive
from fctd.mechanics.energy import Energy, energy_of
from fctd.results import ledger
from fctd.simulation.run import Run, prepare
from references import engines, registry
from references.engines import EngineRun, Window
from references.engines.best_step import best_step, ladder
from references.engines.checks import axial_period, drift
from references.engines.friction_law import lean_of_two_directions, sliding
from references.engines.own import Fctd
from references.engines.run import check_supported, run_window
from references.registry import absent
from tests.cases import make_case, pipe, rotation
from validation.cases import load
from validation.harness.study import left_out

STATIONS = [[0, 0, 0], [100, 0, 0], [400, 60, 30], [600, 60, 30]]
WINDOW = Window(5.0, 1.0)
CONTACT = ("bullet", "mujoco", "elastica")


def needs(name: str) -> None:
    """Skip the test of an engine whose package is missing, and name the package."""
    if engines.installed_version(name) is None:
        pytest.skip(f"package {absent(engines.engine_class(name).distribution)}")


@pytest.fixture(autouse=True)
def installed(request: pytest.FixtureRequest) -> None:
    """Skip a test whose parameter ``name`` is an engine that is not installed."""
    callspec = getattr(request.node, "callspec", None)
    if callspec is not None and "name" in callspec.params:
        needs(callspec.params["name"])


BULLET = pytest.mark.usefixtures("bullet")


@pytest.fixture
def bullet() -> None:
    needs("bullet")


def turning(stations: Any = STATIONS, **sections: Any) -> Case:
    sections = {"record": {"interval": 0.1}} | sections
    return make_case(stations, **{"components": [pipe(500, 16)], "operations": [rotation(500, 8, ramp=1)]} | sections)


def begun(case: Case, window: Window) -> Run:
    """The string of a case at the start of a window."""
    simulation = Simulation(case, window=window)
    simulation.start()
    return simulation.run


def mean(run: EngineRun, column: str) -> float:
    return float(run.history[column].mean())


@pytest.fixture(scope="module")
def own() -> EngineRun:
    return engines.build("fctd").run(turning(), WINDOW)


@pytest.mark.parametrize("name", CONTACT)
def test_the_same_string_gives_the_same_loads(name: str, own: EngineRun) -> None:
    """Hook load within 0.5 %, torque within 2 %: Bullet's friction, of two fixed directions, is 1.1 % low."""
    run = engines.build(name).run(turning(), WINDOW)
    assert run.status == "valid", run.message
    assert mean(own, "sum_r_ft_N_m") > 100
    assert mean(run, "hookload_N") == pytest.approx(mean(own, "hookload_N"), rel=0.005)
    assert mean(run, "surface_torque_N_m") == pytest.approx(mean(own, "surface_torque_N_m"), rel=0.02)
    assert mean(run, "total_contact_force_N") == pytest.approx(mean(own, "total_contact_force_N"), rel=0.005)
    assert run.history["time_s"].iloc[-1] == pytest.approx(6.0)
    assert len(run.profile) == 17


S_WINDOW = Window(4.0, 1.2)  # three axial periods
GEOMETRIES = ("cylinders", "arcs")


@pytest.fixture(scope="module")
def s_shape() -> Callable[[str, str], EngineRun]:
    """A run by engine and geometry, each made once, in a well for which no engine's settings were chosen."""

    @cache
    def run(name: str, geometry: str) -> EngineRun:
        case = load("s_shape", wellbore__geometry=geometry, record__interval=0.05)
        return engines.build(name).run(case, S_WINDOW)

    return run


@pytest.mark.slow
@pytest.mark.parametrize("geometry", GEOMETRIES)
@pytest.mark.parametrize("name", ["mujoco", "elastica"])
def test_a_well_that_turns_below_an_inclined_top(
    name: str, geometry: str, s_shape: Callable[[str, str], EngineRun]
) -> None:
    """In arcs the tube once cut through its bends, and PyElastica once accepted vertical tops only."""
    own, run = s_shape("fctd", geometry), s_shape(name, geometry)
    assert run.status == "valid", run.message
    assert run.note == ""
    assert mean(own, "sum_r_ft_N_m") > 2500
    for column, bound in (("hookload_N", 0.01), ("surface_torque_N_m", 0.05), ("sum_r_ft_N_m", 0.05)):
        assert mean(run, column) == pytest.approx(mean(own, column), rel=bound)


@pytest.mark.slow
@BULLET
@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_bullet_notes_why_its_torque_is_low_where_the_hole_turns(
    geometry: str, s_shape: Callable[[str, str], EngineRun]
) -> None:
    """The friction share in its note, from its contacts alone, equals the share of its torque in FCTD's."""
    own, run = s_shape("fctd", geometry), s_shape("bullet", geometry)
    assert run.status == "valid", run.message
    assert mean(run, "hookload_N") == pytest.approx(mean(own, "hookload_N"), rel=0.01)
    assert mean(run, "total_contact_force_N") == pytest.approx(mean(own, "total_contact_force_N"), rel=0.05)
    noted = re.match(r"friction opposite to sliding is (.*)% of μN.*two fixed directions", run.note)
    assert noted is not None
    share = float(noted[1]) / 100
    assert share < 0.95
    own_share = mean(own, "sum_r_ft_N_m") / mean(own, "sum_r_mu_fn_N_m")
    assert own_share == pytest.approx(1, abs=0.01)
    assert mean(run, "sum_r_ft_N_m") / mean(run, "sum_r_mu_fn_N_m") == pytest.approx(share * own_share, rel=0.02)


@pytest.mark.parametrize("name", ["bullet", "mujoco"])
@pytest.mark.parametrize("options", [{"chord_tolerance": "20 mm"}, {"facets": 4}])
def test_triangles_with_errors_beyond_half_the_clearance_are_refused(name: str, options: dict[str, Any]) -> None:
    with pytest.raises(InputError, match=r"miss the wall by at most 0\.5 of the clearance of 23\.8 mm"):
        engines.build(name, **options).run(load("s_shape"), Window(0.0, 0.1))


@BULLET
def test_more_triangles_than_bullet_accepts_are_refused() -> None:
    with pytest.raises(InputError, match="174762 triangles"):
        engines.build("bullet", facets=600).run(load("s_shape", wellbore__geometry="cylinders"), Window(0.0, 0.1))


def test_weight_of_pipe_that_is_being_fed_in_an_engine_without_feed() -> None:
    """PyElastica's string is as long as FCTD's at the start of the window, and its upper end moves down."""
    trip = {"kind": "trip_in", "from_md": 480, "to_md": 500, "speed": 1.0, "ramp_time": 4.0}
    case = make_case(STATIONS, [pipe(None, None, segment_length=40.0)], [trip], record={"interval": 0.1})
    reference, run = (engines.build(name).run(case, Window(16.0, 1.0)) for name in ("fctd", "elastica"))
    assert run.status == "valid", run.message
    assert mean(run, "hookload_N") == pytest.approx(mean(reference, "hookload_N"), rel=2e-3)
    assert ledger.error(run.energy, motion=True) < 0.001


def test_a_rod_begins_pressed_into_the_wall_as_deep_as_the_segments_were() -> None:
    """Within what standing in the middle of open joints moves them by."""
    run = begun(turning(), WINDOW)
    pressed = energy_of(run.S, run.segments).contact
    assert pressed > 1
    assert engines.build("elastica").begin(run).energy().contact == pytest.approx(pressed, rel=0.5)


@pytest.mark.parametrize(("name", "least"), [("fctd", 0.9999), ("bullet", 0.98), ("mujoco", 0.995)])
def test_friction_obeys_coulomb_at_an_oblique_azimuth(name: str, least: float) -> None:
    """Exact, without FCTD's loads: μN opposite to sliding, which is across a straight hole."""
    found = sliding(name, 30.0, 1.0)
    assert found.status == "valid", found.failed
    assert least < found.share < 1.005
    assert abs(np.degrees(found.lean)) < 0.1


@pytest.mark.slow
@BULLET
@pytest.mark.parametrize("azimuth", [15.0, 60.0])
def test_bullet_friction_deviates_as_computed_from_two_fixed_directions(azimuth: float) -> None:
    """The reason why the ``fair`` settings turn the hole into Bullet's own plane."""
    lean = lean_of_two_directions(azimuth)
    assert abs(np.degrees(lean)) > 15
    assert sliding("bullet", azimuth, 1.0, axes="global").lean == pytest.approx(lean, abs=np.radians(2))


def test_the_lean_of_two_directions_is_that_of_a_uniform_pipe() -> None:
    outer, inner, length, azimuth = 0.051, 0.03, 25.0, np.radians(30)
    spin = (outer**2 + inner**2) / 2  # for a mass of 1
    tilt = length**2 / 12 + spin / 2
    yields = np.diag([1 + outer**2 / tilt, 1 + (length / 2) ** 2 / tilt + outer**2 / spin])
    turn = np.array([[np.cos(azimuth), -np.sin(azimuth)], [np.sin(azimuth), np.cos(azimuth)]])
    push = turn[:, 1] / np.diag(turn @ yields @ turn.T)
    lean = np.arctan2(push @ turn[:, 0], push @ turn[:, 1])
    assert lean_of_two_directions(30.0) == pytest.approx(lean, abs=1e-6)


@pytest.mark.parametrize("name", ["bullet", "mujoco", "mujoco_chain", "elastica"])
def test_a_freely_hanging_string_has_the_same_hook_load_and_torque(name: str) -> None:
    case = turning([[0, 0, 0], [600, 0, 0]], contact={"enabled": False})
    window = Window(0.0, 1.0)
    own, run = (engines.build(each).run(case, window) for each in ("fctd", name))
    assert run.status == "valid", run.message
    torque, reference = (each.history["surface_torque_N_m"].to_numpy() for each in (run, own))
    assert np.abs(reference).max() > 50
    # PyElastica's rod is clamped at its first element, so that it is half a segment shorter.
    np.testing.assert_allclose(torque, reference, atol=0.08 * np.abs(reference).max())
    assert mean(run, "hookload_N") == pytest.approx(mean(own, "hookload_N"), rel=2e-3)


@pytest.mark.parametrize(
    ("name", "options", "failed"),
    [
        ("bullet", {"step": "12 ms"}, "finite state"),
        pytest.param("mujoco", {"stiffness": "1e3 N/m"}, "end points inside the hole", marks=pytest.mark.slow),
        ("elastica", {"step": "8 ms"}, "energy"),
        ("elastica", {"step": "8 ms"}, "chain length"),
    ],
)
def test_a_bad_option_fails_the_check_for_its_error(name: str, options: dict[str, str], failed: str) -> None:
    run = engines.build(name, **options).run(turning(), Window(5.0, 0.5))
    assert run.status == "invalid"
    assert re.search(rf"{failed} \(.*, at most", run.message)
    assert not run.checks.set_index("check").loc[failed, "passed"]


class FaultyStepper:
    """FCTD's stepper, with a fault added to the run after every advance."""

    def __init__(self, run: Run, fault: Callable[[Run], None]) -> None:
        self._stepper, self._run, self._fault = Fctd(Fctd.Options()).begin(run), run, fault
        self.step = run.step

    def advance(self, motion: Any, duration: float) -> None:
        self._stepper.advance(motion, duration)
        self._fault(self._run)

    def sync(self) -> None:
        self._stepper.sync()

    def energy(self) -> Energy:
        return self._stepper.energy()

    def note(self) -> str:
        return self._stepper.note()

    def close(self) -> None:
        self._stepper.close()


def through_the_wall(run: Run) -> None:
    """Move the bit into the wall by half of its clearance."""
    n = run.segments
    walls = np.stack([state.row(run.S, row, n)[-1] for row in (state.PX, state.PY, state.PZ)])
    clearance = run.S[state.HOLE + n] - run.S[state.RADIUS + n]
    for row, part in zip((state.X, state.Y, state.Z), walls / np.linalg.norm(walls), strict=True):
        run.S[row + n] += 0.5 * clearance * part


def gained_energy(run: Run) -> None:
    for row in (state.VX, state.VY, state.VZ, state.WZ):
        state.row(run.S, row, run.segments)[:] *= 1.2


def longer(run: Run) -> None:
    n = run.segments
    for place, axis in ((state.X, state.AX), (state.Y, state.AY), (state.Z, state.AZ)):
        run.S[place + n] += 0.2 * run.S[axis + n]


def not_finite(run: Run) -> None:
    run.top[topdrive.SUM_HOOKLOAD] = np.nan


def drifting(run: Run) -> None:
    run.top[topdrive.SUM_HOOKLOAD] *= 1 + 0.05 * (float(run.top[topdrive.TOP_TIME]) - WINDOW.start)


@pytest.mark.parametrize(
    ("fault", "failed"),
    [
        (through_the_wall, "end points inside the hole"),
        (gained_energy, "energy"),
        (longer, "chain length"),
        (not_finite, "finite state"),
        (drifting, "settled hook load"),
    ],
)
def test_a_fault_fails_the_check_for_it(fault: Callable[[Run], None], failed: str) -> None:
    run = run_window(turning(), WINDOW, lambda start: FaultyStepper(start, fault))
    assert run.status == "invalid"
    assert failed in run.message
    assert not run.checks.set_index("check").loc[failed, "passed"]


@pytest.mark.parametrize(
    ("key", "table"),
    [
        ("contact.law", {"contact": {"law": "power"}}),
        ("contact.friction_law", {"contact": {"friction_law": "karnopp"}}),
        ("rig.drive", {"rig": {"drive": "impedance"}}),
        ("mud.viscosity", {"mud": {"density": 1200.0}}),
    ],
)
def test_another_engine_refuses_what_it_would_leave_out(key: str, table: dict[str, Any]) -> None:
    case = turning(**table)
    with pytest.raises(InputError, match="in another engine") as caught:
        engines.build("bullet").run(case, WINDOW)
    assert caught.value.key == key
    check_supported(turning())


@pytest.mark.parametrize("key", ["bend", "eccentricity"])
def test_another_engine_refuses_a_component_that_only_fctd_turns(key: str) -> None:
    """A bent housing, and a mass beside its axis, in the lowest of two components."""
    case = make_case(STATIONS, [pipe(100, 5, **{key: 0.01}), pipe(None, None, segment_length=20.0)], [rotation(500, 2)])
    with pytest.raises(InputError, match="0 in another engine than FCTD's") as caught:
        check_supported(case)
    assert caught.value.key == f"string.components[0].{key}"


def test_an_engine_that_is_unstable_at_once_is_invalid_with_a_message() -> None:
    """With a step above the stability limit, before the first record."""
    case = turning(wellbore={"geometry": "arcs"})
    run = engines.build("fctd", step=3 * prepare(case)[0].step).run(case, Window(0.0, 1.0))
    assert run.status == "invalid"
    assert "a position or velocity is not finite" in run.message
    assert not run.checks.set_index("check").loc[["finite state", "energy"], "passed"].any()


def test_the_same_engine_without_a_fault_is_valid() -> None:
    run = run_window(turning(), WINDOW, lambda start: FaultyStepper(start, lambda run: None))
    assert run.status == "valid", run.message


def test_a_string_rings_with_the_period_of_its_stretch() -> None:
    """A uniform rod held at one end: four times the length over the speed of sound."""
    run = begun(turning([[0, 0, 0], [600, 0, 0]]), Window(0.0, 1.0))
    assert axial_period(run) == pytest.approx(4 * 500 / np.sqrt(206.8e9 / 7850), rel=1e-3)


@pytest.mark.parametrize(("duration", "expected"), [(4.0, 0.0), (6.1, 0.0), (2.5, 0.03054), (1.0, 0.06366)])
def test_vibration_is_no_drift_in_a_window_of_two_periods(duration: float, expected: float) -> None:
    """Exact row means of a sine about 1 with a period of 2 s; a window below two periods is compared in halves."""
    time = np.arange(1, round(duration / 0.05) + 1) * 0.05
    ring = (np.cos(np.pi * (time - 0.05)) - np.cos(np.pi * time)) / np.pi
    history = pd.DataFrame({"time_s": 7 + time, "hookload_N": 1 + ring, "total_contact_force_N": 0.0})
    if duration == 1.0:
        history["hookload_N"] = 1 + (np.sin(np.pi * time) - np.sin(np.pi * (time - 0.05))) / np.pi
    assert drift(7.0, history, 2.0) == pytest.approx(expected, abs=1e-4)
    rising = history.assign(hookload_N=1 + 0.02 * time)
    assert drift(7.0, rising, 2.0) > 0.009


def test_the_best_step_is_the_largest_valid_one_with_loads_near_the_next_finer() -> None:
    rungs = pd.DataFrame(
        {
            "step_s": [8.0, 4.0, 2.0, 1.0],
            "status": ["invalid", "valid", "valid", "valid"],
            "off": [0.001, 0.02, 0.004, np.nan],
        }
    )
    assert best_step(rungs) == 2.0
    assert np.isnan(best_step(rungs.tail(1)))


def test_a_ladder_halves_the_step_and_compares_each_rung_with_the_next() -> None:
    table = ladder("fctd", turning(), WINDOW, 8e-3, 2, 1.0)
    assert table["step_s"].tolist() == [8e-3, 4e-3]
    loads = table[["hookload_N", "surface_torque_N_m"]].to_numpy()
    assert table["off"][0] == pytest.approx(np.abs(loads[0] / loads[1] - 1).max())
    assert np.isnan(table["off"][1])


@pytest.mark.parametrize(
    ("name", "sections", "key"),
    [
        ("bullet", {"contact": {"friction_law": "paper"}}, "contact.friction_law"),
        ("mujoco", {"contact": {"friction_law": "paper"}}, "contact.friction_law"),
        ("elastica", {"mud": {"axial_damping": 1.0}}, "mud.axial_damping"),
        ("bullet", {"mud": {"lateral_damping": 1.0}}, "mud.lateral_damping"),
        ("bullet", {"mud": {"density": 1200.0}}, "mud.viscosity"),
        ("mujoco_chain", {}, "contact.enabled"),
        ("elastica", {"components": [pipe(450, 15), pipe(10, 1), pipe(40, 1)]}, "string.components[1].length"),
    ],
)
def test_a_case_that_an_engine_cannot_represent_is_an_input_error(
    name: str, sections: dict[str, Any], key: str
) -> None:
    with pytest.raises(InputError) as error:
        engines.build(name).run(turning(**sections), Window(0.0, 0.1))
    assert error.value.key == key


@BULLET
def test_two_friction_factors_are_refused_by_engines_with_one() -> None:
    intervals = [
        {"to_md": 300, "diameter": 0.2159, "friction": f} | ({"to_md": 600} if f > 0.2 else {}) for f in (0.2, 0.3)
    ]
    with pytest.raises(InputError, match="one friction factor"):
        engines.build("bullet").run(turning(wellbore={"intervals": intervals}), Window(0.0, 0.1))


@pytest.mark.parametrize("window", [Window(-1.0, 1.0), Window(0.0, 0.0), Window(5.0, 4.0)])
def test_a_window_outside_the_schedule_is_an_input_error(window: Window) -> None:
    with pytest.raises(InputError, match="window"):
        engines.build("fctd").run(turning(), window)


def test_an_unknown_engine_or_option_names_the_nearest() -> None:
    with pytest.raises(InputError, match="bullet"):
        engines.build("bulet")
    with pytest.raises(InputError, match="settings"):
        engines.build("bullet", setings="fair")


@pytest.mark.parametrize(("name", "module"), [("bullet", "pybullet"), ("mujoco", "mujoco"), ("elastica", "elastica")])
def test_a_missing_package_is_named(name: str, module: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(InputError, match="not installed") as error:
        engines.build(name)
    assert error.value.key == "engine"


def test_two_ways_to_install_pybullet_are_named_where_it_has_no_wheels(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pybullet", None)
    monkeypatch.setattr(registry, "NO_PYBULLET", sys.version_info[:2])
    with pytest.raises(InputError, match=r"run on Python 3\.11, or build it by 'make bullet'"):
        engines.build("bullet")
    (note,) = left_out(["Bullet"])
    assert "make bullet" in note
    assert "make bullet" not in left_out(["MuJoCo"])[0]
