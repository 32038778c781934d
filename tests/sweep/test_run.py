"""Whole sweeps on local workers: rows, resumption, failures, and sweeps that are refused before any work."""

import math
from collections.abc import Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest.mock import Mock

import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.sweep import run
from fctd.sweep.cluster import ClusterChoice
from fctd.sweep.dataset import open_dataset
from fctd.sweep.design import sample_of
from fctd.sweep.run import prepare, sweep
from fctd.sweep.spec import read_sweep
from validation.parts.clusters import failing
from validation.parts.small_sweep import PARAMETERS, WORK, about, sweep_file

ONE = ClusterChoice(workers=1)


@pytest.mark.slow
def test_a_sweep_has_the_rows_of_its_samples_and_a_second_call_computes_nothing(tmp_path: Path) -> None:
    spec = read_sweep(sweep_file(tmp_path))
    out, seen = tmp_path / "out", list[int]()
    found = sweep(spec, out, ONE, progress=lambda done, total, lacking: seen.append(done))
    table = open_dataset(out).rows()
    runner, samples = prepare(spec)
    wanted = pd.DataFrame([row for k in range(12) for row in runner.rows_of(sample_of(samples, k))])
    pd.testing.assert_frame_equal(table[wanted.columns], wanted, check_exact=True, check_dtype=False)
    assert table["mud.density"].tolist() == samples["mud.density"].repeat(4).tolist()
    assert (found.samples, found.rows, found.without_answer) == (12, 48, {})
    assert sorted(seen) == seen
    assert seen[-1] == 12
    assert about(out)["runs"][0]["rows"] == 48
    again = sweep(spec, out, ONE)
    assert (again.done_before, again.rows) == (12, 0)


@pytest.mark.slow
def test_hanging_and_crashing_samples_are_rows_and_the_others_have_answers(tmp_path: Path) -> None:
    import dask

    spec = read_sweep(sweep_file(tmp_path, 'method = "sobol"\nsamples = 12\ntime_limit = "5 s"\n'))
    with dask.config.set({"distributed.worker.preload": [str(failing(tmp_path, hang=(3,), crash=(8,)))]}):
        found = sweep(spec, tmp_path / "out", ONE)
    table = open_dataset(tmp_path / "out").rows().set_index("sample")
    assert found.without_answer == {"timed_out": 1, "crashed": 1}
    assert table.loc[3, "status"] == "timed_out"
    assert table.loc[8, "status"] == "crashed"
    assert table.loc[3, "mud.density"] == prepare(spec)[1]["mud.density"].iloc[3]
    assert (table.drop([3, 8])["status"] == "converged").all()
    assert len(table) == 42


def test_samples_that_no_case_can_have_are_refused_or_rows(tmp_path: Path) -> None:
    bad = PARAMETERS.replace("low = 0.1\n", "low = -0.1\n").replace("sd = 0.05", "sd = 0.3")
    spec = read_sweep(sweep_file(tmp_path, body=bad + WORK))
    with pytest.raises(
        InputError,
        match=r"density = 1\.\d+ sg.*values that a case can have.*sample \d+ has none.*a friction factor at least 0",
    ):
        sweep(spec, tmp_path / "out", ONE)
    assert not (tmp_path / "out").exists()
    rows = read_sweep(
        sweep_file(tmp_path, head='method = "random"\nsamples = 12\nbad_samples = "rows"', body=bad + WORK)
    )
    runner, samples = prepare(rows)
    below = int(samples["friction.open"].idxmin())
    (row,) = runner.rows_of(sample_of(samples, below))
    assert row["status"] == "failed"
    assert "at least 0" in row["reason"]


@pytest.mark.parametrize(
    ("body", "words"),
    [
        (PARAMETERS.replace("mud.density", "mud.densty") + WORK, ["mud.densty", "density"]),
        (PARAMETERS.replace("1.3 sg", "1.3 kN").replace("1.0 sg", "1 kN") + WORK, ["mud.density", "a density"]),
        (PARAMETERS + WORK.replace("600:900:100", "600:900"), ["work.depths"]),
        (PARAMETERS + WORK.replace("600:900:100", "1600:1900:100"), ["work.depths", "string and hole", "900 m"]),
    ],
)
def test_a_bad_sweep_is_answered_before_any_work(body: str, words: list[str], tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        sweep(read_sweep(sweep_file(tmp_path, body=body)), tmp_path / "out", ONE)
    assert str(caught.value).startswith(f"{tmp_path / 'sweep.toml'}: ")
    for word in words:
        assert word in str(caught.value)
    assert not (tmp_path / "out").exists()


def test_chunks_are_larger_for_more_workers_and_smaller_at_the_end(tmp_path: Path) -> None:
    """A chunk takes at least LEAST; one of the many of a long sweep takes USUAL."""
    runner, samples = prepare(read_sweep(sweep_file(tmp_path, 'method = "random"\nsamples = 5000')))
    dataset = run.begin_dataset(tmp_path / "out", runner.template, samples)
    running = run._Running(None, runner, dataset, None)  # type: ignore[arg-type]
    running.workers, running.each = 2, 0.01
    assert running._size() == round(run.USUAL / 0.01)
    running.workers = 200
    assert running._size() == 13  # an even share of 5,000 for 400 chunks, where 1 s of work would be 100
    running.workers = 2
    for left, size in ((100, 25), (21, 6), (2, 5)):
        while len(running.waiting) > left:
            running.waiting.pop()
        assert running._size() == size


def test_a_chunk_whose_worker_died_is_halved_and_a_sample_is_given_up_after_three_deaths(tmp_path: Path) -> None:
    """While samples are suspected no chunk waits at a worker, which another one's sample would take with it."""
    runner, samples = prepare(read_sweep(sweep_file(tmp_path)))
    dataset = run.begin_dataset(tmp_path / "out", runner.template, samples)
    running = run._Running(None, runner, dataset, None)  # type: ignore[arg-type]
    running.workers = 2
    assert running._room == 4
    running._halve((3, 4, 5))
    assert list(running.again) == [(3,), (4, 5)]
    assert running._room == 2
    running.again.clear()
    future: Any = object()
    running.flying[future] = (5, 6)
    assert running._room == 2
    running.flying[future] = (6, 7)
    assert running._room == 4
    for death in range(2):
        running._halve((4,))
        assert list(running.again) == [(4,)] * (death + 1)
    assert running.taken == set()
    running._halve((4,))
    (row,) = running.tables[0].to_pylist()
    assert (row["sample"], row["status"]) == (4, "crashed")
    assert "ended its worker 3 times" in row["reason"]
    assert running.taken == {4}


def test_a_scheduler_that_ends_while_rows_are_fetched_is_lost_before_the_client_knows_it(tmp_path: Path) -> None:
    from distributed.comm.core import CommClosedError

    runner, samples = prepare(read_sweep(sweep_file(tmp_path)))
    dataset = run.begin_dataset(tmp_path / "out", runner.template, samples)
    client, future = Mock(status="running"), Mock()
    future.result.side_effect = CommClosedError("in <TCP (closed)>: Stream is closed")
    running = run._Running(client, runner, dataset, None)
    running.flying[future] = (1,)
    with pytest.raises(run.SchedulerLostError):
        running._take(future)


@pytest.mark.parametrize("extreme", ["idxmin", "idxmax"])
def test_the_extremes_of_each_parameter_are_tried_before_the_work(extreme: str, tmp_path: Path) -> None:
    """Of a thousand samples some 64 are tried, and these."""
    runner, samples = prepare(read_sweep(sweep_file(tmp_path, 'method = "random"\nsamples = 1000')))
    for key in runner.template.units:
        bad = int(getattr(samples[key], extreme)())
        assert bad % (1000 // run.TRIED)

        def case(number: int, values: Mapping[str, object], bad: int = bad) -> Case:
            if number == bad:
                raise InputError("another value")
            return runner.template.base

        template: Any = SimpleNamespace(spec=runner.template.spec, units=runner.template.units, case=case)
        with pytest.raises(InputError, match=f"sample {bad} has none"):
            run.check_samples(template, samples, runner.task)


def test_a_sweep_that_ends_before_its_workers_are_there_has_no_share() -> None:
    assert math.isnan(run.Summary(10, 0, wall=1.0).share)
    assert run.Summary(10, 0, wall=2.0, workers=2, solving=3.0, writing=0.5).share == 0.875


def test_a_key_that_no_case_has_is_refused_also_where_bad_samples_are_rows(tmp_path: Path) -> None:
    head = 'method = "random"\nsamples = 12\nbad_samples = "rows"'
    unknown = sweep_file(tmp_path, head, PARAMETERS.replace("mud.density", "mud.densty") + WORK)
    with pytest.raises(InputError, match=r"mud\.densty"):
        prepare(read_sweep(unknown))
