"""``python -m references`` from the command line: the list, a run, messages, exit codes."""

import os
import subprocess
import sys
from pathlib import Path
from unittest.mock import Mock

import pandas as pd
import pyarrow.parquet as pq
import pytest

from fctd.cli.main import run
from references import commands as command
from references import contact, engines

CASE = Path(__file__).parents[2] / "validation" / "cases" / "curved_chain.toml"
SHORT = ("--set", "operations[0].duration=1 s", "--set", "operations[0].ramp_time=1 s", "--quiet")


def call(monkeypatch: pytest.MonkeyPatch, *arguments: object) -> int:
    """Exit code of ``python -m references ARGUMENTS``."""
    monkeypatch.setattr("sys.argv", ["references", *map(str, arguments)])
    with pytest.raises(SystemExit) as stopped:
        run(command.app)
    return int(stopped.value.code or 0)


def test_the_list_names_every_method(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    assert call(monkeypatch, "list") == 0
    printed = capsys.readouterr().out
    for name in [*contact.METHODS, *engines.ENGINES]:
        assert name in printed


def test_simulate_writes_the_same_files_as_fctd(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ("--contact", "cylinders", "--option", "cylinder_length=1 m", "--friction", "0.3", "--csv")
    assert call(monkeypatch, "simulate", CASE, *arguments, *SHORT, "--out", tmp_path) == 0
    assert "60 segments" in capsys.readouterr().out
    assert len(pd.read_csv(tmp_path / "history.csv")) == 1
    metadata = pq.read_schema(tmp_path / "history.parquet").metadata
    assert b'"contact": "cylinders"' in metadata[b"run"]
    assert b'"friction": 0.3' in metadata[b"case"]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("--contact", "fcll"), "fcl"),
        (("--contact", "cylinders", "--option", "facets=4"), "facets"),
        (("--contact", "cylinders", "--option", "cylinder_length"), "KEY=VALUE"),
        (("--contact", "arcs", "--set", "wellbore.survey_method=average_angle"), "geometry"),
        (("--contact", "cylinders", "--set", "contact.enabled=false"), "contact.enabled"),
        (("--contact", "cylinders", "--set", "wellbore.overlap=5 m"), "overlap"),
        ((), "--contact"),
    ],
)
def test_bad_input_is_one_message_and_exit_code_2(
    arguments: tuple[str, ...],
    expected: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert call(monkeypatch, "simulate", CASE, *arguments, *SHORT, "--out", tmp_path) == 2
    message = capsys.readouterr().err
    assert expected in message
    assert "Traceback" not in message


def test_a_missing_package_is_exit_code_2_and_is_listed(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    method = contact.method_class("fcl")
    monkeypatch.setattr(method, "distribution", "no-such-package")
    assert call(monkeypatch, "list") == 0
    assert "not installed" in capsys.readouterr().out
    monkeypatch.setitem(__import__("sys").modules, "fcl", None)
    assert call(monkeypatch, "simulate", CASE, "--contact", "fcl", *SHORT, "--out", tmp_path) == 2
    assert "no-such-package, which is not installed" in capsys.readouterr().err


def test_interrupted_is_exit_code_130(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(command, "simulate_file", Mock(side_effect=KeyboardInterrupt))
    assert call(monkeypatch, "simulate", CASE, "--contact", "cylinders", "--out", tmp_path) == 130


def test_an_engine_runs_a_window_and_prints_its_checks(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    window = ("--start", "6", "--duration", "1", "--set", "record.interval=0.1 s")
    assert call(monkeypatch, "engine", CASE, "--engine", "fctd", *window) == 0
    printed = capsys.readouterr().out
    assert "fctd: valid" in printed
    assert "passed  settled hook load" in printed
    assert call(monkeypatch, "engine", CASE, "--engine", "bulet", *window) == 2
    assert "bullet" in capsys.readouterr().err
    monkeypatch.setitem(__import__("sys").modules, "mujoco", None)
    assert call(monkeypatch, "engine", CASE, "--engine", "mujoco", *window) == 2
    assert "package mujoco, which is not installed" in capsys.readouterr().err


def test_ctrl_c_while_packages_are_imported_leaves_no_traceback(tmp_path: Path) -> None:
    (tmp_path / "pandas.py").write_text("raise KeyboardInterrupt")
    paths = os.pathsep.join([str(tmp_path), str(Path(__file__).parents[2])])
    done = subprocess.run(
        [sys.executable, "-m", "references", "list"],
        env=os.environ | {"PYTHONPATH": paths}, cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (130, "")
