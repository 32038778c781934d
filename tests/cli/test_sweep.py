"""``fctd sweep``: its dataset, its messages, and options that exclude each other."""

import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from fctd.case.errors import InputError
from fctd.cli import sweep as cli
from fctd.cli.main import app
from fctd.cli.sweep import cluster_choice
from fctd.store.limits import cores
from fctd.sweep.dataset import open_dataset
from fctd.sweep.run import Summary
from tests.commands import HANG, until
from validation.parts import clusters
from validation.parts.small_sweep import sweep_file

NOTHING = (None, None, None)


@pytest.mark.slow
def test_a_sweep_is_written_and_resumed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its segments of 25 and 50 m are too long for waves of 60 m: exit code 1, however often it is asked."""
    monkeypatch.chdir(tmp_path)
    waves = '[wellbore.tortuosity]\namplitude = "1 cm"\nwavelength = "60 m"\n'
    file = sweep_file(tmp_path, 'method = "random"\nsamples = 2', case=waves)
    command, doubts = ["sweep", str(file), "--workers", "1"], "8 of 8 rows under_resolved: see the column reason"
    done = CliRunner().invoke(app, command)
    assert done.exit_code == 1, done.output
    assert "dashboard: http://127.0.0.1:" in done.stderr
    assert doubts in done.stderr
    assert "2 samples; 8 rows in" in done.stdout
    assert "Written: swept-sweep" in done.stdout
    assert len(open_dataset(tmp_path / "swept-sweep").rows()) == 8
    part = tmp_path / "swept-sweep" / "rows" / "part-00000.parquet"
    part.unlink()
    assert CliRunner().invoke(app, [*command, "--quiet"]).exit_code == 1
    assert len(open_dataset(tmp_path / "swept-sweep").rows()) == 8
    done = CliRunner().invoke(app, command)
    assert done.exit_code == 1
    assert doubts in done.stderr
    assert "All 2 samples are there" in done.stdout


@pytest.mark.parametrize(
    ("found", "code", "said"),
    [
        (Summary(2, 0, 1, rows=2, statuses={"timed_out": 2}), 1, "2 samples timed_out: see the column reason"),
        (Summary(1, 0, 1, rows=1, statuses={"converged": 1}), 0, "1 sample; 1 row in 0.0 s on 1 worker "),
        (
            Summary(3, 1, 2, rows=2, statuses={"converged": 3}),
            0,
            "2 samples, 1 was there; 2 rows in 0.0 s on 2 workers ",
        ),
        (Summary(1, 1, statuses={"converged": 1}), 0, "The sample is there: "),
    ],
)
def test_what_a_sweep_found_is_said(
    found: Summary, code: int, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Samples without an answer are exit code 1; one sample is no plural."""
    monkeypatch.setattr(cli, "sweep", lambda *_, **__: found)
    done = CliRunner().invoke(app, ["sweep", str(sweep_file(tmp_path)), "--out", str(tmp_path / "out")])
    assert done.exit_code == code
    assert said in done.output


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ((None, "tcp://a:1", Path("b"), NOTHING), "not both"),
        ((2, "tcp://a:1", None, NOTHING), "no number of workers"),
        ((4 * cores() + 1, None, None, NOTHING), "for each core of this machine"),
        ((None, None, None, (Path("ca"), None, None)), "the scheduler of another machine"),
        ((None, "tls://a:1", None, (Path(__file__), None, None)), "--tls-cert is missing"),
        ((None, "tls://a:1", None, (Path("none.pem"), Path("b"), Path("c"))), "a file that is there"),
    ],
)
def test_options_that_do_not_go_together_are_refused(given: tuple[object, ...], words: str) -> None:
    with pytest.raises(InputError, match=words):
        cluster_choice(*given)  # type: ignore[arg-type]


def test_options_say_where_a_sweep_runs() -> None:
    here = Path(__file__)
    assert cluster_choice(3, None, None, NOTHING).local
    assert cluster_choice(None, "tls://a:1", None, (here, here, here)).tls == (here, here, here)


@pytest.mark.slow
def test_a_lost_scheduler_is_told_without_a_traceback(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "fctd", "sweep", str(sweep_file(tmp_path)), "--out", str(tmp_path / "out")]
    with clusters.cluster(tmp_path, preload=clusters.failing(tmp_path, pause=2.0)) as dask:
        dask.wait_for_workers(1)
        asked = [*command, "--scheduler-file", str(dask.file)]
        with subprocess.Popen(asked, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as sweeping:
            until(lambda: list(tmp_path.glob("out/rows/part-*.parquet")))  # of some samples
            dask.kill("scheduler")
            _, told = sweeping.communicate(timeout=HANG)
    assert sweeping.returncode == 1, told
    assert "The scheduler has ended; what was written stays in" in " ".join(told.split())
    assert "Traceback" not in told, told
