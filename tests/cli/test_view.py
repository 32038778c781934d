"""``fctd view``: pages of cases and of runs, refusals."""

from pathlib import Path

import pytest

from fctd.cli import chart as chart_of
from fctd.store import save_interval
from fctd.store.run_folder import run_path
from tests.cli.test_keeping import CHART, RUN, killed
from tests.commands import Command


def test_a_case_and_its_run_become_pages(
    small_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    monkeypatch.chdir(tmp_path)
    given = ("--operation", "trip_in", "--depths", "600:800:100", "--set", "string.components[0].length=850 m")
    assert "Written: small-view.html" in cli("view", small_file, *given, "--units", "si", "--quiet").out
    assert "at 700.0 m" in Path("small-view.html").read_text(encoding="utf-8")
    cli("simulate", small_file, "--out", "run", "--quiet")
    cli("view", "run", "--out", "run.html", "--colour", "stress")
    assert "rotating off bottom, bit at 800.0 m" in Path("run.html").read_text(encoding="utf-8")


def test_depths_without_a_string_are_named(
    small_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    """On the screen and on the page; as a chart with such rows, it is exit code 1."""
    monkeypatch.chdir(tmp_path)
    given = ("--operation", "trip_in", "--depths", "700:2700:1000", "--quiet")
    printed = cli("view", small_file, *given, code=1)
    told = "no string with the bit at 1700, 2700 m"
    assert told in printed.err
    assert told in Path("small-view.html").read_text(encoding="utf-8")


def test_a_run_that_has_not_ended(
    small_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    """What it has kept is shown, and a whole result before it; the run goes on afterwards as if nobody had looked."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(save_interval, "SHARE", 1e9)
    killed(monkeypatch, RUN)
    before = {path.name: path.read_bytes() for path in run_path(Path("out")).iterdir()}
    cli("view", "out", "--out", "out.html")
    assert "at 800.0 m" in Path("out.html").read_text(encoding="utf-8")
    assert {path.name: path.read_bytes() for path in run_path(Path("out")).iterdir()} == before
    cli("simulate", "--resume", "out", "--quiet")
    killed(monkeypatch, RUN)
    assert "this is the result before; there is a run that has not ended" in cli("view", "out", "--out", "out.html").err
    chart = (*CHART, "--checkpoint-every", "0 s", "--quiet")
    killed(monkeypatch, chart, after=9, module=chart_of)
    assert "fctd chart" in cli("view", "chart.csv", code=2).err


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        (("--sideways", "inf"), ["--sideways", "100000"]),
    ],
)
def test_wrong_options_are_refused(
    given: tuple[str, str], expected: list[str], small_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    cli: Command,
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    message = cli("view", small_file, *given, "--quiet", code=2).err
    for text in expected:
        assert text in message
    assert [path.name for path in tmp_path.iterdir()] == ["small.toml"]


def test_options_of_a_case_are_refused_for_a_run(small_file: Path, tmp_path: Path, cli: Command) -> None:
    assert "already computed" in cli("view", tmp_path, "--depths", "1:2:1", code=2).err
    assert "fctd simulate" in cli("view", tmp_path, code=2).err
