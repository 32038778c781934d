"""The string in other engines: loads as FCTD's, friction, and the choice of a step."""

import re
from collections.abc import Callable
from functools import cache

import numpy as np
import pandas as pd
import pytest

from fctd.mechanics import state
from fctd.mechanics.energy import energy_of
from fctd.results import ledger
from references import engines
from references.engines import EngineRun, Window
from references.engines.best_step import best_step, ladder
from references.engines.friction_law import lean_of_two_directions, sliding
from tests.cases import make_case, pipe
from tests.references.engines.turning import BULLET, STATIONS, WINDOW, begun, mean, turning
from validation.cases import load

# PyElastica compiles its own functions for half a minute in a new environment.
ELASTICA = pytest.param("elastica", marks=pytest.mark.slow)
CONTACT = ("bullet", "mujoco", ELASTICA)


@pytest.fixture(scope="module")
def own() -> EngineRun:
    return engines.build("fctd").run(turning(), WINDOW)


@pytest.mark.slow
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


@pytest.mark.slow
def test_weight_of_pipe_that_is_being_fed_in_an_engine_without_feed() -> None:
    """PyElastica's string is as long as FCTD's at the start of the window, and its upper end moves down."""
    trip = {"kind": "trip_in", "from_md": 480, "to_md": 500, "speed": 1.0, "ramp_time": 4.0}
    case = make_case(STATIONS, [pipe(None, None, segment_length=40.0)], [trip], record={"interval": 0.1})
    reference, run = (engines.build(name).run(case, Window(16.0, 1.0)) for name in ("fctd", "elastica"))
    assert run.status == "valid", run.message
    assert mean(run, "hookload_N") == pytest.approx(mean(reference, "hookload_N"), rel=2e-3)
    assert ledger.error(run.energy, motion=True) < 0.001


ENDS = ((1, state.ARM_BOTTOM), (-1, state.ARM_TOP))


@pytest.mark.slow
def test_a_rod_begins_pressed_into_the_wall_as_deep_as_the_segments_were() -> None:
    """Its nodes stand in the middle of the open joints, the last one at the bit."""
    run = begun(turning(), WINDOW)
    S, n = run.S, run.segments
    centre, axis = (
        np.stack([state.row(S, row, n) for row in rows], axis=1)
        for rows in ((state.X, state.Y, state.Z), (state.AX, state.AY, state.AZ))
    )
    lower, upper = (centre + sign * state.row(S, row, n)[:, None] * axis for sign, row in ENDS)
    pressed = []
    for places in (lower, np.vstack([0.5 * (lower[:-1] + upper[1:]), lower[-1:]])):
        walls = run.hole.walls(places, run.owner[1 : n + 1])
        depth = np.maximum(np.linalg.norm(walls.offset, axis=1) - walls.radius + state.row(S, state.RADIUS, n), 0.0)
        pressed.append(0.5 * float((walls.stiffness * state.row(S, state.TRIBUTARY, n) * depth**2).sum()))
    assert energy_of(S, n).contact == pytest.approx(pressed[0])
    assert pressed[0] > 1
    assert engines.build("elastica").begin(run).energy().contact == pytest.approx(pressed[1])


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


@pytest.mark.parametrize("name", ["bullet", "mujoco", "mujoco_chain", ELASTICA])
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
