"""Mud that a moving string takes along: what a key of the case turns on, and that energy is kept."""

from typing import Any

import numpy as np
import pytest

from fctd import Simulation, build_wellbore, equilibrium, simulate
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.mechanics.energy import energy_of
from fctd.mechanics.moving_string import STILL
from fctd.mechanics.topdrive import put_long_segment
from fctd.model.drillstring import String, lay_out
from fctd.model.mud import added_mass, lateral_damping
from fctd.model.operations import SteadyRates
from fctd.model.string_in_hole import damping_of
from fctd.model.torsion import axial_period_of
from fctd.simulation.carried_mud import layers, sideways, take_along
from fctd.simulation.preparation import prepare
from fctd.simulation.settling import start_from_rest
from fctd.steady.laid_string import LaidString
from tests.cases import make_case, pipe, rotation, trip

STATIONS = [[0, 0, 0], [400, 0, 0], [850, 60, 0], [1200, 60, 0]]
SIZES = {"intervals": [
    {"to_md": 500, "diameter": 0.311, "friction": 0.2}, {"to_md": 1200, "diameter": 0.2159, "friction": 0.2},
]}  # fmt: skip
PIPE = [pipe(None, None, inner=0.1086, segment_length=25.0)]


def well(mud: dict[str, Any], operation: dict[str, Any] | None = None) -> Case:

    return make_case(STATIONS, PIPE, [operation or rotation(1000, 12, rpm=120, ramp=4)], wellbore=SIZES, mud=mud)


def test_coefficients_follow_the_size_of_the_hole() -> None:
    case = well({"density": 1200.0})
    string = lay_out(case, 1000.0)
    found, above = sideways(case, string, build_wellbore(case), 120.0), np.arange(40) < 20
    for part, radius in ((above, 0.1555), (~above, 0.10795)):
        np.testing.assert_allclose(found.damping[part], lateral_damping(0.0635, radius, 1200.0, 0.02, 2.0))
        np.testing.assert_allclose(found.added_mass[part], added_mass(0.0635, 0.0543, radius, 1200.0))
    # At rest the string swings at about 1 Hz.
    np.testing.assert_allclose(
        sideways(case, string, build_wellbore(case), 0.0).damping,
        sideways(case, string, build_wellbore(case), 60.0).damping,
    )


def steady(case: Case, string: String) -> tuple[np.ndarray, np.ndarray]:
    """Damping along and around the hole: with the mud that is displaced at 0.5 m/s, and at 1 rad/s."""
    hole = build_wellbore(case)
    displaced = LaidString(case, hole, string).in_flow(SteadyRates(0.5, 0.0)).given / string.length
    damping = damping_of(case, string, hole)
    return damping[:, 0] - displaced / 0.5, damping[:, 2]


@pytest.mark.parametrize(
    ("mud", "lateral", "mass", "layer", "axial", "rotational"),
    [
        ({"density": 1200.0}, True, True, True, False, False),
        ({"density": 1200.0, "viscosity": "20 mPa*s"}, True, True, True, True, True),
        ({"density": 1200.0, "viscosity": 0}, False, False, False, False, False),
        ({}, False, False, False, False, False),
        ({"density": 1200.0, "lateral_damping": 0}, False, True, True, False, False),
        ({"density": 1200.0, "axial_damping": 1.0}, True, True, False, True, False),
        (
            {"density": 1200.0, "viscosity": 0.02, "axial_damping": 0, "rotational_damping": 0},
            True, True, False, False, False,
        ),
    ],
)  # fmt: skip
def test_what_a_case_turns_on(
    mud: dict[str, Any], lateral: bool, mass: bool, layer: bool, axial: bool, rotational: bool
) -> None:  # fmt: skip
    case = well(mud)
    string = lay_out(case, 1000.0)
    parts = *sideways(case, string, build_wellbore(case), 0.0), layers(case, string, 3.0), *steady(case, string)
    assert [part.any() for part in parts] == [lateral, mass, layer, axial, rotational]


def test_a_damping_that_is_given_wins() -> None:
    given = {"axial_damping": 3.0, "lateral_damping": 5.0, "rotational_damping": 0.7}
    case = well({"density": 1200.0, "viscosity": 0.05, **given})
    string = lay_out(case, 1000.0)
    along, around = steady(case, string)
    assert (set(along), set(around), set(sideways(case, string, build_wellbore(case), 60.0).damping)) == (
        {3.0},
        {0.7},
        {5.0},
    )


def test_steady_loads_depend_on_a_given_viscosity_alone() -> None:
    """What a given one adds is c Ω, and c v in laminar flow; without friction, which the added tension would raise.

    Nor with a joint in the shoe at 500 m, whose ledge bears a part of the tension.
    """
    depth = 1005.0
    frictionless = {"intervals": [{**interval, "friction": 0.0} for interval in SIZES["intervals"]]}

    def loads(**mud: Any) -> tuple[float, float]:
        case = make_case(STATIONS, PIPE, wellbore=frictionless, mud=mud)
        return (
            equilibrium(case, "rotate_off_bottom", depth, rpm=120).surface_torque,
            equilibrium(case, "trip_out", depth, speed=0.5).hookload,
        )

    still = loads(density=1200.0, viscosity=0)
    assert loads(density=1200.0) == still
    case = well({"density": 1200.0, "viscosity": 0.03})
    string = lay_out(case, depth)
    axial, rotational = steady(case, string)
    added = (rotational @ string.length) * 4 * np.pi, 0.5 * (axial @ string.length)
    assert np.subtract(loads(density=1200.0, viscosity=0.03), still) == pytest.approx(added, rel=1e-3)


def test_mud_that_moves_sideways_changes_no_steady_load_of_a_run_and_its_energy_is_in_the_ledger() -> None:
    """Means over the last torsional periods of the same rotation with and without it."""
    means = []
    for mud in ({"viscosity": 0}, {}):
        result = simulate(well({"density": 1200.0, **mud}, rotation(1000, 20, rpm=120, ramp=5)))
        assert result.run["energy_error"] < 1e-3
        (row,) = result.operations.to_dict("records")
        means.append((row["surface_torque_mean_N_m"], row["hookload_mean_N"]))
    assert means[0] == pytest.approx(means[1], rel=3e-3)


def test_a_trip_past_a_shoe_changes_the_coefficients() -> None:
    """The lower end leaves casing at 500 m: at the end its coefficients are those of the narrower hole."""
    string = make_case(components=[pipe(200, 10), pipe(None, 1)]).string
    case = well({"density": 1200.0}, trip(480, 540, speed=3.0, ramp=4)).model_copy(update={"string": string})
    simulation = Simulation(case)
    length, before = 20.0, state.row(simulation.run.S, state.ADDED_MASS, 11).copy()
    for _ in simulation:
        pass
    after = state.row(simulation.run.S, state.ADDED_MASS, 11)
    wide, narrow = (length * added_mass(0.0635, 0.035, radius, 1200.0) for radius in (0.1555, 0.10795))
    assert before[-1] == after[-3] == pytest.approx(wide)
    assert after[-1] == pytest.approx(narrow)
    # The long segment has half of its mud at its lower end, and the mass that its waves have along it.
    run = simulation.run
    waves = 0.5 * run.pipe.mass * 340.0 - run.S[state.MASS + 1]
    assert waves > 0
    assert after[0] == pytest.approx(0.5 * 340.0 * wide / length + waves, rel=1e-6)


def test_mud_that_joins_a_moving_body_keeps_the_sum_of_energy_and_loss() -> None:
    run, _ = prepare(well({"density": 1200.0}))
    start_from_rest(run)
    n = run.segments
    state.row(run.S, state.VX, n)[:], state.row(run.S, state.VZ, n)[:] = 0.3, -0.2
    state.row(run.S, state.WX, n)[:] = 0.01

    def total() -> float:
        return energy_of(run.S, n).kinetic + float(state.row(run.S, state.LOST_MUD, n).sum())

    before = total()
    heavier = well({"density": 2000.0})
    pipe_ = take_along(run.S, heavier, run.laid_out, run.hole, run.pipe, 0.0, 1.0)
    assert total() == pytest.approx(before, rel=1e-12)
    assert pipe_.added_mass > run.pipe.added_mass


def test_the_mud_adds_its_own_moment_of_inertia() -> None:
    """(m + a) L²/12 of a segment, (m + a) L³/6 of the half of a long segment that its lower end has; and once only."""
    string = make_case(components=[pipe(200, 10), pipe(None, 1)]).string
    run, _ = prepare(well({"density": 1200.0}, trip(480, 540)).model_copy(update={"string": string}))
    n, string = run.segments, run.string
    run.pipe = take_along(run.S, run.case, run.laid_out, run.hole, run.pipe, 60.0, 1.0)
    mass = state.row(run.S, state.MASS, n) + state.row(run.S, state.ADDED_MASS, n)
    inertia = state.row(run.S, state.J_TRANSVERSE, n)
    np.testing.assert_allclose(inertia[1:], (mass * string.length**2 / 12)[1:], rtol=1e-4)
    assert inertia[0] == pytest.approx(mass[0] * string.length[0] ** 2 / 3, rel=1e-12)
    np.testing.assert_allclose(inertia * state.row(run.S, state.INVERSE_JT, n), 1.0, rtol=1e-15)
    put_long_segment(run.S, float(string.length[0]), run.pipe)
    assert inertia[0] == pytest.approx(mass[0] * string.length[0] ** 2 / 3, rel=1e-12)


def test_the_boundary_layers_damp_the_slowest_axial_wave_as_stokes_says() -> None:
    """A hanging string swings along itself and loses c/4(m + c/2ω) of its swing in a second, c of both its walls."""
    length, density, viscosity = 2400.0, 1250.0, 0.02
    components = [pipe(None, None, inner=0.1086, segment_length=40.0)]
    case = make_case(
        [[0, 0, 0], [length, 0, 0]], components, [rotation(length, 1.0)], contact={"enabled": False},
        mud={"density": density}, solver={"joint_damping": 0.0},
    )  # fmt: skip
    (run, _), (still, _) = prepare(case), prepare(case)
    n, section = run.segments, run.string.sections[0]
    frequency = 2 * np.pi / axial_period_of(run.string)
    drag = 2 * np.pi * (0.0635 + 0.0543) * np.sqrt(2 * density * viscosity * frequency)
    rate = drag / (4 * (section.mass + drag / (2 * frequency)))
    middle = np.cumsum(run.string.length) - 0.5 * run.string.length
    state.row(run.S, state.VZ, n)[:] = 0.1 * np.sin(0.5 * np.pi * middle / length)
    swings = []
    for _ in range(2):  # over two periods each; both strings stretch by their weight alike, and only one was kicked
        apart = []
        for _ in range(100):
            for each in (run, still):
                each.advance(STILL, 4 * np.pi / frequency / 100)
            apart.append(abs(run.S[state.Z + n] - still.S[state.Z + n]))
        swings.append(max(apart))
    assert np.log(swings[0] / swings[1]) / (4 * np.pi / frequency) == pytest.approx(rate, rel=0.05)
    assert 0.08 < rate < 0.09  # the 8 % of the guide
