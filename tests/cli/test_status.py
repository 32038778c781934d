"""``fctd status``: how far a run is, also while it lasts."""

import os
from pathlib import Path

import pytest

from fctd.cli import simulate
from fctd.store import save_interval
from fctd.store.run_folder import RunFolder
from fctd.sweep.chunk import as_table, without_answer
from fctd.sweep.dataset import alone, begin_dataset
from fctd.sweep.design import sample_of
from fctd.sweep.run import prepare
from fctd.sweep.spec import read_sweep
from tests.cli.test_keeping import CHART, RUN, killed
from tests.cli.tiny import SMALL
from tests.commands import run
from validation.parts.small_sweep import sweep_file


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(save_interval, "SHARE", 1e9)
    Path("small.toml").write_text(SMALL)


def test_of_a_run_that_has_ended_and_of_one_that_has_not(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, *RUN) == 0
    killed(monkeypatch, RUN)
    capsys.readouterr()
    assert run(monkeypatch, "status", "out") == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].endswith("to 3 s")
    assert lines[2] == "out: a result: completed, 4 records, rotate_off_bottom at 800.0 m"
    assert run(monkeypatch, "status", "out", "-q") == 0
    assert capsys.readouterr().out == ""


def test_while_it_lasts(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    real, seen = simulate.simulate, []

    def watched(*given: object, progress: object, **more: object) -> object:
        def report(*values: float) -> None:
            with monkeypatch.context() as patched:
                assert run(patched, "status", "out") == 0
            seen.append(capsys.readouterr().out)

        return real(*given, progress=report, **more)  # type: ignore[arg-type]

    monkeypatch.setattr(simulate, "simulate", watched)
    monkeypatch.setattr("sys.argv", ["fctd", *RUN])
    assert run(monkeypatch, *RUN) == 0
    assert len(seen) == 4
    assert "out: running since 20" in seen[2]
    assert "(75 %)" in seen[2]


def test_before_anything_is_computed(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    folder = RunFolder.take(Path("out"))
    assert run(monkeypatch, "status", "out") == 0
    assert "begun by process" in capsys.readouterr().out
    folder.leave(remove=True)


def test_of_a_chart(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(monkeypatch, *CHART, "--quiet") == 0
    capsys.readouterr()
    assert run(monkeypatch, "status", "chart.csv") == 0
    assert "chart.csv: a chart, written at 20" in capsys.readouterr().out


@pytest.mark.parametrize("place", ["small.toml", "/", ".", "nowhere/deep", "small.toml/out"])
def test_of_a_place_without_a_result(
    place: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A case is no chart, and the root has no name."""
    assert run(monkeypatch, "status", place) == 2
    assert "expected the" in capsys.readouterr().err
    assert run(monkeypatch, "simulate", "--resume", place) == 2
    assert "not ended" in capsys.readouterr().err


def test_of_a_damaged_result(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(monkeypatch, *RUN) == 0
    Path("out/segments.parquet").write_bytes(b"PAR1")
    capsys.readouterr()
    assert run(monkeypatch, "status", "out") == 2
    assert '"out/segments.parquet": expected a table that fctd simulate wrote' in capsys.readouterr().err


def test_of_a_sweep_while_it_runs_and_when_it_has_stopped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    runner, samples = prepare(read_sweep(sweep_file(tmp_path)))

    def rows_of(*numbers: int) -> None:
        sweep.write([as_table([row for k in numbers for row in runner.rows_of(sample_of(samples, k))])])

    def lines() -> list[str]:
        capsys.readouterr()
        assert run(monkeypatch, "status", "swept") == 0
        return capsys.readouterr().out.splitlines()

    with alone(Path("swept")):
        sweep = begin_dataset(Path("swept"), runner.template, samples)
        assert lines()[1] == "swept: a sweep: 0 of 12 samples done (0 %)"
        rows_of(0, 1)
        sweep.write([as_table([{"sample": 5, **without_answer("timed_out", "more than 1 s")}])])
        first, second = lines()
        assert first.startswith("swept: running since 20")
        assert first.endswith(f", process {os.getpid()}")
        assert second.startswith(
            "swept: a sweep: 3 of 12 samples done (25 %), 1 without an answer; last rows written at 20"
        )
    assert lines()[1:] == ["swept: stopped; the same `fctd sweep` command goes on"]
    rows_of(2, 3, 4, 6, 7, 8, 9, 10, 11)
    (only,) = lines()
    assert only.startswith(
        "swept: a sweep: 12 of 12 samples done (100 %), 1 without an answer; last rows written at 20"
    )
