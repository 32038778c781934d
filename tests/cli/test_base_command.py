"""What all commands have in common: help, version, quiet, options left out or repeated."""

from importlib.metadata import version
from pathlib import Path

import pytest
import typer

from fctd.cli.main import COMMANDS, app
from fctd.mechanics.compile_cache import hash_of_sources
from fctd.store.origin import versions
from tests.cli.tiny import SMALL
from tests.commands import Command


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    Path("small.toml").write_text(SMALL)


def test_the_version(cli: Command) -> None:
    printed = cli("--version")
    """The version has stood for many commits: commit and sources say which program this is."""
    commit = f"commit {known['commit']}, " if "commit" in (known := versions()) else ""
    assert printed.out == f"fctd {version('fctd')} ({commit}sources {hash_of_sources()})\n"


@pytest.mark.parametrize("command", COMMANDS)
def test_short_options(command: str, cli: Command) -> None:
    text = cli(command, "-h").out
    assert "-q " in text
    assert "--quiet" in text
    assert ("--out" in text) == ("-o " in text)


@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        (["chart", "small.toml", "--depths", "1:2:1"], ["'--operation'", "trip_in, trip_out", "or all"]),
        (["chart", "small.toml", "--operation", "all"], ["'--depths'", "1750:2450:10"]),
        (["equilibrium", "small.toml", "--operation", "trip_in"], ["'--bit-depth'", "'2450 m'"]),
        (["equilibrium", "small.toml", "--bit-depth", "700"], ["'--operation'", "rotate_off_bottom"]),
    ],
)
def test_a_missing_option_says_what_it_accepts(arguments: list[str], parts: list[str], cli: Command) -> None:
    error = cli(*arguments, code=2).err
    assert "Missing option" in error
    assert all(part in error for part in parts)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--speed", "0.1", "--speed", "0.2"], "--speed is given twice."),
        (["--bit-depth", "1", "--bit-depth=2", "--bit-depth", "3"], "--bit-depth is given 3 times."),
        (["-o", "a.csv", "--out", "b.csv"], "--out is given twice."),
        (["--resolve-buckling", "--no-resolve-buckling"], "--resolve-buckling is given twice."),
    ],
)
def test_a_single_option_is_given_once(options: list[str], message: str, cli: Command) -> None:
    needed = ["--operation", "trip_in"] + ["--bit-depth", "700"] * ("--bit-depth" not in options)
    error = cli("equilibrium", "small.toml", *needed, *options, code=2).err
    assert message.replace("--resolve-buckling is", "resolve-buckling is") in error


def test_a_second_value_of_an_option_is_explained(cli: Command) -> None:
    error = cli(
        "chart", "small.toml", "--operation", "all", "--depths", "1:2:1", "--friction", "0.1", "0.2", code=2
    ).err
    assert "unexpected extra argument(s) (0.2): an option takes one value" in error


def test_options_that_may_be_repeated(cli: Command) -> None:
    changes = ["--set", "wellbore.overlap=0.1 m", "--set", "wellbore.intervals[0].friction=0.4"]
    assert "0.4" in cli("check", "small.toml", *changes).out


def test_help_needs_no_options(cli: Command) -> None:
    assert "Usage" in cli("chart", "--help", "--speed", "1").out
    assert isinstance(app, typer.Typer)
