"""A run one record at a time: what simulate() keeps, results at any time, windows, other steppers, interrupts."""

from typing import Any

import numpy as np
import pandas as pd
import pytest

from fctd import Case, InputError, Simulation, simulate
from fctd.arrays import Contacts
from fctd.mechanics import state
from fctd.mechanics.dynamics import advance
from fctd.mechanics.energy import Energy
from fctd.mechanics.faults import UnstableError
from fctd.mechanics.moving_string import HoleWall, MovingString
from fctd.mechanics.state import Laws
from fctd.mechanics.topdrive import Motion
from fctd.simulation.features import OWN
from fctd.simulation.run import Run
from tests.cases import make_case, pipe, rotation, trip

BUILD = [[0, 0, 0], [400, 0, 0], [850, 90, 0], [1200, 90, 0]]
STRING = [pipe(None, None, outer=0.102, segment_length=25.0)]


def build_case(*operations: dict[str, Any], **sections: Any) -> Case:
    return make_case(BUILD, STRING, list(operations) or [rotation(1000, 6, ramp=2)], top_md=300.0, **sections)


def test_its_records_are_the_rows_of_simulate() -> None:
    case = build_case(trip(1000, 1001), rotation(1001, 2.5, ramp=1), record={"profile_at": [1000.5]})
    simulation = Simulation(case)
    records = list(simulation)
    whole, parts = simulate(case), simulation.result()
    pd.testing.assert_frame_equal(pd.DataFrame(records), whole.history, check_exact=True)
    for name in ("history", "profile", "energy"):
        pd.testing.assert_frame_equal(getattr(parts, name), getattr(whole, name), check_exact=True)
    assert (parts.status, parts.message) == (whole.status, whole.message)
    assert whole.status == "completed"
    assert {n: parts.run[n] for n in ("steps", "contact")} == {n: whole.run[n] for n in ("steps", "contact")}
    assert next(simulation, None) is None


def test_a_result_may_be_had_at_any_time_and_changes_nothing() -> None:
    case = build_case()
    simulation = Simulation(case)
    assert not simulation.started
    before = simulation.result()
    assert (before.status, before.message, len(before.history)) == ("interrupted", "before the start", 0)
    for k, record in enumerate(simulation, start=1):
        early = simulation.result()
        assert len(early.history) == k
        assert len(early.profile) == simulation.run.segments + 1
        if k < 6:
            assert (early.status, early.message) == ("interrupted", f"at {record['time_s']:.4g} s")
    pd.testing.assert_frame_equal(simulation.result().profile, simulate(case).profile, check_exact=True)


class Watched(HoleWall):
    """The hole's own wall, which counts the steps of every call and is interrupted in the second phase."""

    def __init__(self, run: Run) -> None:
        super().__init__(run.hole.pieces, run.wall.name)
        self.calls: list[int] = []
        self.interrupts = True

    def advance(self, string: MovingString, motion: Motion, laws: Laws, dt: float, steps: int) -> None:
        super().advance(string, motion, laws, dt, steps)
        self.calls.append(steps)
        if self.interrupts and motion.duration == 3590.0:  # what follows the ramp
            raise KeyboardInterrupt


def test_ctrl_c_leaves_a_long_record_whose_part_is_kept() -> None:
    """An hour between records: Ctrl-C stops between two compiled calls, and the elapsed part becomes the last row."""
    simulation = Simulation(build_case(rotation(1000, 3600, ramp=10), record={"interval": 3600}))
    run = simulation.run
    run.at_once = 20_000
    run.wall = wall = Watched(run)
    with pytest.raises(KeyboardInterrupt):
        list(simulation)
    assert max(wall.calls) <= 20_000 / run.segments
    simulation.record_part()
    simulation.record_part()  # no time has passed since
    result = simulation.result()
    assert result.status == "interrupted"
    times = result.history["time_s"]
    assert times.iloc[0] == pytest.approx(10.0)
    assert 10.0 < times.iloc[-1] < 20.0
    assert result.profile["bit_depth_m"].unique().tolist() == [1000.0]
    assert len(result.energy) == len(result.history) == 2


def test_iterating_again_goes_on_with_the_rest_of_an_interval() -> None:
    simulation = Simulation(build_case(rotation(1000, 3, ramp=1), record={"interval": 3}))
    simulation.start()
    simulation.run.advance(simulation.intervals[0].motion, 0.5)
    simulation.record_part()
    assert [record["time_s"] for record in simulation] == pytest.approx([1.0, 3.0])
    assert simulation.result().history["time_s"].tolist() == pytest.approx([0.5, 1.0, 3.0])
    assert simulation.status == "completed"


def test_a_window_is_reached_without_a_record_and_has_its_own_ledger() -> None:
    case = build_case(record={"interval": 0.5})
    whole, part = simulate(case).history, Simulation(case, window=(4.0, 2.0))
    records = pd.DataFrame(list(part))
    assert records["time_s"].tolist() == pytest.approx([4.5, 5.0, 5.5, 6.0])
    late = whole[whole["time_s"] > 4.1]
    for load in ("hookload_N", "surface_torque_N_m", "total_contact_force_N"):
        np.testing.assert_allclose(records[load], late[load], rtol=1e-3)  # other steps on the way
    result = part.result()
    assert (result.status, result.message) == ("completed", "")
    assert result.energy["top_drive_work_J"].iloc[-1] == pytest.approx(
        sum(record * 0.5 * np.pi * 2 for record in records["surface_torque_N_m"]), rel=1e-3
    )
    assert result.run["energy_error"] < 1e-2


def test_a_fed_string_has_its_depth_at_the_start_of_a_window() -> None:
    case = build_case(trip(1000, 1003, speed=0.5))
    records = list(Simulation(case, window=(4.0, Simulation(case).end - 4.0)))
    assert records[-1]["bit_depth_m"] == pytest.approx(1003.0, abs=1e-4)
    assert records[-1]["bit_md_m"] == pytest.approx(1003.0, abs=0.5)


def test_a_window_outside_the_schedule_names_the_file_and_the_key() -> None:
    with pytest.raises(InputError) as error:
        Simulation(build_case(), window=(5.0, 4.0))
    assert error.value.key == "window"


class Another:
    """The run's own stepper, but with made-up energies, and on request with a NaN in the state."""

    def __init__(self, run: Run, spoil: bool = False) -> None:
        self.run, self.spoil, self.calls = run, spoil, 0

    def advance(self, motion: Motion, duration: float) -> None:
        steps = max(int(np.ceil(duration / self.run.step - 1e-9)), 1)
        run = self.run
        advance(
            run.S, run.top, run.owner, run.segments, run.hole.pieces, run.laws, motion, run.pipe, duration / steps,
            steps,
        )  # fmt: skip
        if self.spoil and run.time > 2.5:
            state.row(run.S, state.X, run.segments)[3] = np.nan

    def refresh(self) -> None:
        self.run.refresh()

    def energy(self) -> Energy:
        self.calls += 1
        return self.run.energy()._replace(strain=1000.0 * self.calls)


def test_another_stepper_takes_the_place_of_the_own_one() -> None:
    case = build_case()
    begun: list[Another] = []

    class Engine:
        name, honours = "another", OWN

        def begin(self, run: Run) -> Another:
            assert run.time == 0
            begun.append(Another(run))
            return begun[-1]

    simulation = Simulation(case, engine=Engine())
    records = pd.DataFrame(list(simulation))
    pd.testing.assert_frame_equal(records, simulate(case).history, check_exact=True)
    assert simulation.stepper is begun[0]
    assert simulation.result().energy["strain_J"].tolist() == [1000.0 * k for k in range(1, 7)]


def test_what_becomes_unstable_ends_the_iteration_and_keeps_its_records() -> None:
    class Spoiled:
        name, honours = "spoiled", OWN

        def begin(self, run: Run) -> Another:
            return Another(run, spoil=True)

    simulation = Simulation(build_case(), engine=Spoiled())
    assert len(list(simulation)) == 2
    result = simulation.result()
    assert (result.status, result.message) == ("unstable", "at 3 s: a position or velocity is not finite")
    assert len(result.history) == 2
    assert list(simulation) == []
    assert result.profile.empty  # of a state that is not finite there is none


class Nowhere:
    """A contact method that returns NaN normals."""

    name = "nowhere"

    def query(self, points: Any, radii: Any) -> Contacts:
        n = len(points)
        return Contacts(np.full(n, 0.01), np.full((n, 3), np.nan), np.full(n, 500.0))


def test_a_string_that_does_not_settle_has_no_record() -> None:
    case = build_case()
    simulation = Simulation(case, Nowhere())
    with pytest.raises(UnstableError):
        simulation.start()
    assert list(simulation) == []
    result = simulate(case, contact=Nowhere())
    for each in (simulation.result(), result):
        assert each.status == "unsettled"
        assert each.message.startswith("before the start: contact method 'nowhere' returns a contact whose normal is")
        assert each.run["contact"] == "nowhere"
        assert len(each.history) == 0
