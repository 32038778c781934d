"""Mud that flows past a moving string: loads of the steady string, the ledger, and what a case turns on."""

from typing import Any

import numpy as np
import pytest

from fctd import Case, equilibrium, simulate
from fctd.mechanics import state
from fctd.model.drillstring import lay_out
from fctd.simulation.flowing_mud import is_driven, lie_of, pumps
from fctd.simulation.preparation import prepare
from tests.cases import make_case, pipe, rotation, trip

STATIONS = [[0, 0, 0], [400, 0, 0], [850, 60, 0], [1200, 60, 0]]
CLOSED = {"end": "closed"}


def case(
    mud: dict[str, Any], operation: dict[str, Any], stations: Any = ((0, 0, 0), (1200, 0, 0)), **more: Any
) -> Case:
    parts = [pipe(None, None, outer=0.2, inner=0.18, segment_length=50.0)]
    return make_case(
        list(stations), more.pop("components", parts), [operation], mud={"density": 1200.0} | mud,
        wellbore={"intervals": [{"to_md": 1200, "diameter": 0.3, "friction": 0.2}]}, **more,
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("feed", ["long_segment", "stands"])
@pytest.mark.parametrize("viscosity", [0.02, 0.1])
def test_a_trip_with_a_closed_end_has_the_loads_of_the_steady_string(feed: str, viscosity: float) -> None:
    """Hook load and surge at constant speed; with viscous mud too the steps are stable and the energy closes."""
    well = case({"viscosity": viscosity}, trip(1000, 1012, 0.5, 4.0), bit=CLOSED, rig={"feed": feed})
    result = simulate(well)
    last = result.history.iloc[-1]
    steady = equilibrium(well, "trip_in", float(last["bit_depth_m"]))
    assert steady.lift > 0.01 * steady.hookload
    drag = 10.0  # of a string that no mud holds back, which would not come to rest otherwise
    dragged = simulate(case({"viscosity": 0.0, "axial_damping": drag}, trip(1000, 1012, 0.5, 4.0), rig={"feed": feed}))
    fallen = (dragged.history["hookload_N"] - result.history["hookload_N"]).tail(6).mean()
    assert fallen + drag * 0.5 * 1010.5 == pytest.approx(steady.lift, rel=0.01)
    assert result.run["energy_error"] < 1e-3
    run, phases = prepare(well)
    for motion, _ in phases:  # to the phase of constant speed
        run.let_mud_flow(motion, motion.start + motion.duration)
    assert run.flow_pressures[2, -1] == pytest.approx(surge(well), rel=0.01)


def surge(well: Case) -> float:
    """Friction pressure at the bit at 1000 m [Pa], of the steady string."""
    profile = equilibrium(well, "trip_in", 1000.0).profile
    still = equilibrium(
        well.model_copy(update={"mud": well.mud.model_copy(update={"viscosity": 0.0})}), "trip_in", 1000.0
    )
    steel = np.pi * (0.1**2 - 0.09**2)
    # What pressures on both sides add to the tension of the steel at the bit; a closed bore has no friction of its own.
    change = (profile["effective_tension_N"] - profile["true_tension_N"]).iloc[-1]
    rest = (still.profile["effective_tension_N"] - still.profile["true_tension_N"]).iloc[-1]
    return float(change - rest) / steel


def test_pumps_take_the_lift_off_the_hook_load_of_a_run() -> None:
    """In a bend, where less tension is less friction; the flow's work on a string that moves is in the ledger."""
    bit = {"nozzles": [0.01, 0.01, 0.01]}
    for operation in (rotation(1000, 12, ramp=4.0), trip(1010, 1005, 0.3, 4.0)):
        well = case({"viscosity": 0.03}, operation | {"flow": 0.04}, STATIONS, bit=bit)
        result = simulate(well)
        steady = equilibrium(well, operation["kind"], float(result.history["bit_depth_m"].iloc[-1]))
        late = result.history[result.history["time_s"] > result.history["time_s"].max() - 4]
        assert late["hookload_N"].mean() == pytest.approx(steady.hookload, rel=2e-3)
        assert result.run["energy_error"] < 1e-3
        assert (abs(result.energy["flow_work_J"].iloc[-1]) > 1e3) == (operation["kind"] == "trip_out")


def test_what_a_case_turns_on() -> None:
    still, pumped = rotation(1000, 1), rotation(1000, 1) | {"flow": 0.02}
    assert not is_driven(case({}, still))
    assert pumps(case({}, pumped))
    assert is_driven(case({}, pumped))
    assert is_driven(case({"viscosity": 0.02}, still))
    assert not pumps(case({"viscosity": 0.02}, still))
    assert not is_driven(case({"viscosity": 0.02, "axial_damping": 3.0}, still))


def test_a_damping_that_the_case_gives_stays() -> None:
    run, phases = prepare(case({"viscosity": 0.02, "axial_damping": 3.0}, trip(1000, 1005) | {"flow": 0.02}))
    run.let_mud_flow(phases[-1].motion, phases[-1].motion.start + 1.0)
    assert state.row(run.S, state.MUD_AXIAL, run.segments)[1:] == pytest.approx(3.0 * run.string.length[1:])
    assert (state.row(run.S, state.GIVEN_FORCE, run.segments) < 0).all()


def test_eccentricity_is_where_the_string_lies() -> None:
    well = case({"viscosity": 0.03, "eccentricity": "string"}, rotation(1000, 1) | {"flow": 0.04}, STATIONS)
    run, _ = prepare(well)
    string = lay_out(well, 1000.0)
    for row, value in ((state.PX, 0.03), (state.PY, 0.04), (state.HOLE, 0.15)):
        state.row(run.S, row, run.segments)[:] = value
    assert lie_of(run.S, string) == pytest.approx(1.0)
    state.row(run.S, state.PX, run.segments)[:] = state.row(run.S, state.PY, run.segments)[:] = 0.0
    assert not lie_of(run.S, string).any()
    lifts = [equilibrium(case({"viscosity": 0.03, "eccentricity": e}, rotation(1000, 1) | {"flow": 0.04}, STATIONS),
                         "rotate_off_bottom", 1000.0).lift for e in (0.0, "string", 1.0)]  # fmt: skip
    assert lifts[0] > lifts[1] > lifts[2] > 0
