"""``--resume``, ``--restart`` and limits of ``fctd simulate`` and ``fctd chart``: refusals, and what goes on."""

import json
import re
import shlex
from collections.abc import Callable
from itertools import count
from pathlib import Path
from types import SimpleNamespace

import pytest

from fctd import open_result
from fctd.cli import chart, main, simulate
from fctd.cli.keeping import read_bytes
from fctd.store import limits, save_interval
from fctd.store.lock import FolderLock
from fctd.store.run_folder import RunFolder, run_path
from tests.cli.tiny import SMALL
from tests.commands import run
from tests.simulation.kept import same

RUN = ("simulate", "small.toml", "--out", "out", "--quiet", "--csv", "--checkpoint-every", "0 s")
CHART = ("chart", "small.toml", "--operation", "trip_in,trip_out", "--depths", "700:800:10", "--out", "chart.csv")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder with a case and its survey; every record is kept, whatever that costs."""
    monkeypatch.chdir(tmp_path)
    Path("survey.csv").write_text("md_m,inc_deg,azi_deg\n0,0,0\n300,0,0\n750,90,0\n900,90,0\n")
    stations = "stations = [[0, 0, 0], [300, 0, 0], [750, 90, 0], [900, 90, 0]]"
    Path("small.toml").write_text(SMALL.replace(stations, 'survey = "survey.csv"'))
    monkeypatch.setattr(save_interval, "SHARE", 1e9)


class Killed(BaseException):
    """The process is gone, and nothing after it is run."""


def killed(
    monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...], after: int = 3, module: object = simulate
) -> None:
    """A command whose process is killed at its third record or row."""
    name = "simulate" if module is simulate else "chart_rows"
    real: Callable[..., object] = getattr(module, name)
    calls: list[object] = []

    def dying(*given: object, progress: Callable[..., object], **more: object) -> object:
        def report(*values: object) -> None:
            progress(*values)
            calls.append(values)
            if len(calls) == after:
                raise Killed

        return real(*given, progress=report, **more)

    with monkeypatch.context() as patched:
        patched.setattr(module, name, dying)
        patched.setattr(RunFolder, "leave", lambda self, remove: self._lock.release())
        patched.setattr("sys.argv", ["fctd", *arguments])
        with pytest.raises(Killed):
            main.main()


def test_a_killed_run_is_refused_with_both_ways_out_and_goes_on(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """What goes on has the options with which the run began, from another folder too."""
    assert run(monkeypatch, *RUN[:2], "--out", "whole", "--quiet") == 0
    killed(monkeypatch, RUN)
    assert not Path("out").exists()
    assert run(monkeypatch, *RUN) == 2
    Path("elsewhere").mkdir()
    monkeypatch.chdir("elsewhere")
    assert run(monkeypatch, "simulate", "--resume", "../out", "--quiet") == 0
    same(open_result("../out"), open_result("../whole"))
    assert Path("../out/history.csv").exists()
    assert not run_path(Path("../out")).exists()
    assert run(monkeypatch, "simulate", "--resume", "../out") == 2


def test_the_way_on_can_be_typed_as_it_stands(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    name = "the run's ü"
    asked = tuple(name if word == "out" else word for word in RUN)
    killed(monkeypatch, asked)
    capsys.readouterr()
    assert run(monkeypatch, *asked) == 2
    (way,) = re.findall("`(.*?)`", capsys.readouterr().err)
    assert run(monkeypatch, *shlex.split(way)[1:], "--quiet") == 0
    assert open_result(name).status == "completed"


def test_a_run_that_lasts_is_named_and_not_offered(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Another process computes: neither --resume nor --restart is a way out."""
    killed(monkeypatch, RUN)
    lock = FolderLock.take(run_path(Path("out")))
    (run_path(Path("out")) / "lock").write_text("[4242, 1e9]")
    for asked in (RUN, (*RUN, "--restart"), ("simulate", "--resume", "out")):
        capsys.readouterr()
        assert run(monkeypatch, *asked) == 2
        message = capsys.readouterr().err
        assert "(process 4242 does, since" in message
        assert "goes on" not in message
    lock.release()
    assert run(monkeypatch, "simulate", "--resume", "out", "--quiet") == 0


def test_restart_drops_what_is_kept(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    killed(monkeypatch, RUN)
    capsys.readouterr()
    assert run(monkeypatch, *RUN, "--restart", "--friction", "0.3") == 0
    assert open_result("out").case.wellbore.intervals[0].friction == 0.3
    assert "goes on" not in capsys.readouterr().err
    assert not run_path(Path("out")).exists()


def test_a_run_that_has_kept_nothing_is_in_nobodys_way(monkeypatch: pytest.MonkeyPatch) -> None:
    killed(monkeypatch, (*RUN[:-1], "1 h"))
    assert run_path(Path("out")).exists()
    assert run(monkeypatch, *RUN) == 0


def test_the_earlier_result_stays_until_the_run_has_ended(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, *RUN) == 0
    first = open_result("out").identity
    killed(monkeypatch, (*RUN, "--friction", "0.3"))
    assert open_result("out").identity == first
    capsys.readouterr()
    assert run(monkeypatch, "simulate", "--resume", "out", "--quiet", "--time-limit", "1e-9 s") == 1
    told = capsys.readouterr()
    assert "stopped: at 4 s: the time limit of 1e-09 s is reached" in told.err
    assert "the earlier result in out stays as it was" in told.err
    assert "kept: 4 of 4 s are kept; `fctd simulate --resume out` goes on" in told.err
    assert open_result("out").identity == first
    assert run(monkeypatch, "simulate", "--resume", "out", "--quiet") == 0
    assert open_result("out").case.wellbore.intervals[0].friction == 0.3


def test_a_limit_keeps_the_result_and_the_run(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    sizes = count(10**9, 10**6)  # the process grows with every look
    monkeypatch.setattr(limits, "resident_memory", lambda: next(sizes))
    assert run(monkeypatch, *RUN[:4], "--quiet", "--memory-limit", "1 MB") == 1
    assert "the run has taken 1 MB of memory, the limit is 1 MB" in capsys.readouterr().err
    assert not run_path(Path("out")).exists()  # it was still settling
    assert not Path("out").exists()
    # Once the first record has been kept, the memory is beyond any limit.
    monkeypatch.setattr(
        limits, "resident_memory", lambda: 1e9 if (run_path(Path("out")) / "progress.json").exists() else 0
    )
    assert run(monkeypatch, *RUN, "--memory-limit", "1 MB") == 1
    result = open_result("out")
    assert result.status == "stopped"
    assert 0 < len(result.history) < 5
    assert run(monkeypatch, "simulate", "--resume", "out", "--quiet") == 0
    assert open_result("out").status == "completed"


@pytest.mark.parametrize("changed", ["small.toml", "survey.csv"])
def test_changed_files_are_named_and_refused(
    changed: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Accepted, the run goes on with the files as they were; put back, it goes on too."""
    assert run(monkeypatch, *RUN[:2], "--out", "whole", "--quiet") == 0
    killed(monkeypatch, RUN)
    with Path(changed).open("a") as file:
        file.write("# a word\n" if changed == "small.toml" else "950,90,0\n")
    capsys.readouterr()
    assert run(monkeypatch, "simulate", "--resume", "out", "--quiet") == 2
    message = capsys.readouterr().err
    assert re.search(rf"the (case file|survey) \S*{changed} has changed", message)
    assert "--accept-changes" in message
    assert "--restart" in message
    if changed == "survey.csv":
        Path(changed).unlink()
    assert run(monkeypatch, "simulate", "--resume", "out", "--accept-changes", "--quiet") == 0
    same(open_result("out"), open_result("whole"))


def test_a_run_of_the_release_before_is_refused_by_name(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its description has no form, its files have other names; nothing is dropped before --restart says so."""
    killed(monkeypatch, RUN)
    folder = run_path(Path("out"))
    about = folder / "run.json"
    about.write_text(about.read_text().replace('"form": 2, ', ""))
    for path in folder.glob("*.zip"):
        path.rename(path.with_suffix(".npz"))
    before = sorted(folder.iterdir())
    for asked in (RUN, ("simulate", "--resume", "out"), ("status", "out"), ("view", "out")):
        assert run(monkeypatch, *asked) == 2
        assert "an unfinished run of this version of fctd, form 2 (this one has form 1)" in capsys.readouterr().err
        assert sorted(folder.iterdir()) == before
    assert run(monkeypatch, *RUN, "--restart") == 0


def test_sizes_of_memory() -> None:
    assert read_bytes("4 GB", "") == 4e9
    assert read_bytes("512MiB", "") == 512 * 2**20


def test_a_killed_chart_goes_on_with_the_same_rows(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, *CHART[:-1], "whole.csv", "--quiet") == 0
    printed = capsys.readouterr().out
    asked = (*CHART, "--checkpoint-every", "0 s", "--quiet")
    killed(monkeypatch, asked, after=9, module=chart)
    assert run(monkeypatch, *asked) == 2
    assert run(monkeypatch, "chart", "--resume", "chart.csv", "--quiet") == 0
    assert Path("chart.csv").read_bytes() == Path("whole.csv").read_bytes()
    assert json.loads(Path("chart.csv.json").read_text()) == json.loads(Path("whole.csv.json").read_text())
    assert capsys.readouterr().out.partition("Written")[0] == printed.partition("Written")[0]
    assert not run_path(Path("chart.csv")).exists()


def test_a_chart_in_field_units_goes_on_in_them_or_is_shown_in_si(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its bare depths and speed are feet and feet a minute also where the rest is shown in metres."""
    chart_in = ("chart", "small.toml", "--operation", "trip_in", "--depths", "2000:2600:100", "--speed", "90")
    field = (*chart_in, "--units", "field", "--quiet")
    assert run(monkeypatch, *field, "--out", "field.csv") == 0
    in_si = ("chart", "small.toml", "--operation", "trip_in", "--depths", "2000 ft:2600 ft:100 ft", "--speed")
    assert run(monkeypatch, *in_si, "90 ft/min", "--out", "si.csv", "--quiet") == 0
    for units, whole in (((), "field.csv"), (("--units", "si"), "si.csv")):
        killed(monkeypatch, (*field, "--out", "chart.csv", "--checkpoint-every", "0 s"), after=4, module=chart)
        assert run(monkeypatch, "chart", "--resume", "chart.csv", "--quiet", *units) == 0, capsys.readouterr().err
        assert Path("chart.csv").read_bytes() == Path(whole).read_bytes()


def test_a_chart_that_reaches_its_limit(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(monkeypatch, *CHART, "--quiet", "--time-limit", "1e-9 s") == 1
    assert not run_path(Path("chart.csv")).exists()


def test_an_estimate_beyond_the_disk_is_refused_before(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("shutil.disk_usage", lambda _: SimpleNamespace(free=1e3))
    assert run(monkeypatch, *RUN) == 2
    assert re.search(r"--out = .*a disk with \d+ MB free \(this one has 0 MB\)", capsys.readouterr().err)
    assert not run_path(Path("out")).exists()
