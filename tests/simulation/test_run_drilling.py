"""Runs that drill: what the ledger, the driller and the drive must keep."""

from typing import Any

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.mechanics import state, topdrive
from fctd.results.tables import SimulationResult
from fctd.simulation.preparation import prepare
from fctd.simulation.simulate import Simulation
from tests.cases import make_case, pipe

ROTATING = {"kind": "drill_rotating", "from_md": 900.0, "to_md": 900.3, "speed": 0.01, "rpm": 120, "ramp_time": 5.0}
SLIDING = {"kind": "drill_sliding", "from_md": 900.0, "to_md": 900.3, "speed": 0.01, "ramp_time": 5.0}


def drilling(operation: dict[str, Any] = ROTATING, bit: dict[str, Any] | None = None, **rig: Any) -> Case:
    """A vertical string of few segments that is fed by its long segment."""
    given = {"weight_on_bit": 4e4, "torque": 1500.0, "rock": {}} | (bit or {})
    mud = {"density": 1200.0, "axial_damping": 2.0, "rotational_damping": 0.3}
    components = [pipe(100, 4, outer=0.165), pipe(None, 1)]
    return make_case(None, components, [operation], mud=mud, bit=given, rig=rig)


def run_of(case: Case) -> tuple[Simulation, SimulationResult]:
    simulation = Simulation(case)
    for _ in simulation:
        pass
    result = simulation.result()
    assert result.status == "completed"
    return simulation, result


@pytest.mark.parametrize("drive", ["stiff", "speed_control", "impedance"])
def test_the_ledger_holds_with_every_drive(drive: str) -> None:
    _, result = run_of(drilling(drive=drive))
    assert result.run["energy_error"] < 1e-3
    spent = result.energy.iloc[-1]["lost_bit_J"]
    history = result.history
    power = history["bit_torque_N_m"] * history["bit_rpm"] * np.pi / 30
    assert spent == pytest.approx(float((power * np.diff(history["time_s"], prepend=0.0)).sum()), rel=0.02)


@pytest.mark.parametrize("drive", ["stiff", "speed_control", "impedance"])
def test_the_ledger_holds_where_the_string_sticks_and_slips(drive: str) -> None:
    """A drive that hides its inertia follows the jolts: with its work by the rotation after a step, off by 6.6 %."""
    turning = {"kind": "rotate_off_bottom", "at_md": 1480, "duration": 30, "rpm": 20, "ramp_time": 2}
    interval = {"to_md": 1500, "diameter": 0.2159, "friction": 0.2, "static_friction": 0.4}
    stations = [[0.0, 0, 0], [300, 0, 0], [750, 60, 0], [1500, 60, 0]]
    case = make_case(
        stations, [pipe(None, 40)], [turning], wellbore={"intervals": [interval]}, rig={"drive": drive},
        contact={"friction_law": "karnopp"},
    )  # fmt: skip
    _, result = run_of(case)
    assert result.history["bit_still_s"].sum() > 2.0
    assert result.run["energy_error"] < 1e-3


def test_the_hole_grows_by_what_is_fed_and_stretches() -> None:
    """Exact: the bit's travel is the hole made and what the bit is pressed into the rock."""
    simulation = Simulation(drilling())
    simulation.start()
    run = simulation.run
    before = float(run.S[state.Z + run.segments])
    for _ in simulation:
        pass
    travel = float(run.S[state.Z + run.segments]) - before
    made = run.top[topdrive.HOLE_MADE] + run.top[topdrive.PRESSED]
    assert made == pytest.approx(travel, abs=1e-6)
    assert run.top[topdrive.FED] == pytest.approx(0.3, abs=1e-6)


def test_an_autodriller_holds_the_weight() -> None:
    _, result = run_of(drilling(ROTATING | {"to_md": 900.4}, autodriller=True))
    assert result.history["weight_on_bit_N"].iloc[-1] == pytest.approx(4e4, rel=1e-3)


def test_a_motor_drills_while_the_string_slides() -> None:
    _, result = run_of(drilling(SLIDING, {"motor": {"flow": "2000 L/min", "revolutions_per_liter": 0.06}}))
    last = result.history.iloc[-1]
    assert last["bit_rpm"] == pytest.approx(120.0, rel=1e-4)
    assert last["top_rpm"] == 0.0
    # Reactive: the string takes the torque of the bit, and only the mud holds it.
    assert last["surface_torque_N_m"] == pytest.approx(last["bit_torque_N_m"], rel=1e-4)
    assert last["hole_made_m"] > 0.05


def test_given_loads_are_on_the_bit() -> None:
    _, result = run_of(drilling(bit={"rock": {"law": "given"}}))
    last = result.history.iloc[-1]
    assert (last["weight_on_bit_N"], last["bit_torque_N_m"]) == pytest.approx((4e4, 1500.0))


def test_more_weight_than_the_string_has_is_refused() -> None:
    with pytest.raises(InputError, match=r'bit\.weight_on_bit = "600000 N": expected less than the weight'):
        prepare(drilling(bit={"weight_on_bit": 6e5, "rock": {"law": "given"}}))


def over_a_connection(**rig: Any) -> Case:
    """Soft rock, drilled at 5 cm/s from 3 m above a connection to 2 m below it, at 45 deg."""
    connection = 31 * 28.5
    move = ROTATING | {"from_md": connection - 3.0, "to_md": connection + 2.0}
    return make_case(
        [[0, 0, 0], [300, 0, 0], [600, 45, 0], [1000, 45, 0]],
        [pipe(100, None, 0.165, segment_length=25.0), pipe(None, None, segment_length=28.5)],
        [move],
        wellbore={"geometry": "arcs"},
        mud={"density": 1200.0, "axial_damping": 2.0, "rotational_damping": 0.3},
        bit={"weight_on_bit": 4e4, "rock": {"specific_energy": "25 MPa", "wear_flat": 0}},
        rig={"autodriller": True, "feed": "stands", "connection_time": 5.0, **rig},
    )


def test_an_autodriller_drills_over_a_connection() -> None:
    """It picks up, hangs the string in the slips, adds a stand, takes the tare and resumes; to the end of the hole,
    however long that takes."""
    simulation = Simulation(over_a_connection())
    planned = simulation.end
    records = list(simulation)
    result = simulation.result()
    assert result.status == "completed"
    assert result.run["energy_error"] < 1e-3
    last = records[-1]
    assert abs(simulation.end - planned) > 0.5  # the block moves as the bit drills, not as planned
    assert last["bit_depth_m"] == pytest.approx(31 * 28.5 + 2.0, abs=0.1)
    (slips,) = [k for k in range(1, len(records)) if records[k]["in_slips"] > records[k - 1]["in_slips"]]
    (resumed,) = [k for k in range(1, len(records)) if records[k]["in_slips"] < records[k - 1]["in_slips"]]
    before = records[slips]
    assert before["weight_on_bit_N"] == 0.0
    lowest = min(record["block_position_m"] for record in records[:slips])  # it drills on while the weight comes off
    assert before["block_position_m"] - lowest == pytest.approx(0.5, abs=0.02)
    # What the driller sees at surface; drag along the string keeps some of it from the bit.
    tare = simulation.run.top[topdrive.TARE]
    assert tare - last["hookload_N"] == pytest.approx(4e4, rel=0.02)
    drilled = records[slips - 20]["weight_on_bit_N"]
    assert 0.88 * 4e4 < drilled < 4e4
    assert last["weight_on_bit_N"] == pytest.approx(drilled, rel=0.03)
    # The tare is the mean hook load while the string turned off bottom with the new stand.
    taring = [motion for motion, _ in simulation.phases if motion.driller.taring]
    assert len(taring) == 1
    window = taring[0].start, taring[0].start + taring[0].duration
    loads = [record["hookload_N"] for record in records[resumed:] if window[0] < record["time_s"] <= window[1]]
    assert tare == pytest.approx(np.mean(loads), rel=2e-3)
    assert last["hole_made_m"] > before["hole_made_m"]


@pytest.mark.slow
def test_a_bit_that_stands_still_ends_the_run_of_an_autodriller() -> None:
    simulation = Simulation(over_a_connection(drive="speed_control", control={"torque_limit": 10.0}))
    for _ in simulation:
        pass
    result = simulation.result()
    assert result.status == "unstable"
    assert "drills 10 times more slowly than its law says: raise bit.weight_on_bit" in result.message


def test_an_autodriller_needs_more_weight_than_the_wear_flats_carry() -> None:
    """σ a l = 100 MPa · 107.95 mm · 5 mm."""
    case = drilling(ROTATING | {"to_md": 940.0}, autodriller=True, feed="stands")
    with pytest.raises(InputError, match=r'bit\.weight_on_bit = "40000 N": expected above what .* 5\.398e\+04 N'):
        prepare(case)


def test_a_run_whose_bit_cuts_nothing_says_so() -> None:
    """Wear flats of 5 cm carry half a meganewton."""
    _, result = run_of(drilling(bit={"rock": {"wear_flat": 0.05}}, autodriller=True))
    assert result.history["hole_made_m"].iloc[-1] == 0
    assert [note.code for note in result.notes if note.code == "drilling"] == ["drilling"]
    _, drilled = run_of(drilling())
    assert drilled.history["hole_made_m"].iloc[-1] > 0
    assert "drilling" not in {note.code for note in drilled.notes}
