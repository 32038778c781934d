"""Entries of a benchmark's record besides its time, and the printed summary."""

from types import SimpleNamespace

import pytest

from benchmarks import conftest, records
from benchmarks.strings import chain, hanging, trip
from fctd.mechanics.faults import UnstableError
from references.timing.workloads import moving


def test_the_hook_load_of_a_turning_chain_is_its_vertical_weight():
    run, _ = moving(chain(20), 1.0)
    assert records.vertical_weight(run) == pytest.approx(426.5e3, rel=2e-3)
    run, _ = moving(hanging(20), 1.0)
    weight = float((run.string.weight * run.string.length).sum())
    assert records.vertical_weight(run) == pytest.approx(weight, rel=1e-3)


def test_a_record_names_machine_versions_and_commit():
    benchmark = SimpleNamespace(extra_info={}, group=None)
    records.describe(benchmark, "a group", segments=3)
    assert benchmark.group == "a group"
    assert {"processor", "load average", "fctd", "numba", "pyelastica", "segments"} <= benchmark.extra_info.keys()
    assert benchmark.extra_info["extrapolated"] is False


def test_steps_are_counted_and_the_hook_load_is_compared_with_the_weight(benchmark):
    run, motion = moving(chain(20), 6.0)
    records.time_steps(benchmark, lambda span: run.advance(motion, span), run, run.step, 50)
    noted = benchmark.extra_info
    assert noted["segments"] == 20
    assert noted["steps_per_round"] == 50
    assert noted["simulated_s"] >= 50 * run.step * 0.999
    assert abs(noted["hookload_off_percent"]) < 5


def test_an_unstable_run_has_no_record(benchmark):
    run, motion = moving(chain(20), 1.0)
    run.step *= 3  # above the stability limit of symplectic Euler
    with pytest.raises(UnstableError, match="take a shorter step"):
        records.time_steps(benchmark, lambda span: run.advance(motion, span), run, run.step, 2000)


def test_the_trips_of_the_paper_have_its_segments():
    case = trip(1750.0, 2250.0)
    assert [component.segments for component in case.string.components] == [20, 40, 1]
    assert case.operations[0].speed == 0.5


def test_a_summary_line_is_printed_for_each_record_with_shown_entries():
    shown = SimpleNamespace(name="a", has_error=False, extra_info={"real_time_factor": 1234.5, "extrapolated": True})
    silent = SimpleNamespace(name="b", has_error=False, extra_info={"segments": 60})
    broken = SimpleNamespace(name="c", has_error=True, extra_info={"real_time_factor": 1.0})
    assert list(conftest.summary_lines([shown, silent, broken])) == ["a: × real time 1.23e+03  (extrapolated)"]


def test_the_processors_share_is_that_of_the_rounds(monkeypatch):
    """Time between rounds counts on neither clock."""
    wall, processor = iter([0.0, 2.0, 10.0, 12.0]), iter([0.0, 1.0, 8.0, 8.5])
    monkeypatch.setattr(conftest, "processor_time", lambda: next(processor))
    clocks = conftest.TwoClocks(lambda: next(wall))
    assert not clocks.processor_percent > 0
    assert [clocks() for _ in range(4)] == [0.0, 2.0, 10.0, 12.0]
    assert clocks.processor_percent == 37.5
