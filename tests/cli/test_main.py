"""The command line: files written, messages, exit codes."""

import gc
import io
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from fctd.cli import simulate
from fctd.cli.interrupts import ends_program
from tests.commands import Command


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ("wellbore.overlap=5 m", ["wellbore.overlap", "5", "length of a cylinder"]),
        ("wellbore.ovrlap=1 m", ["wellbore.ovrlap", "overlap"]),
        ("wellbore.overlap=1 kg", ["wellbore.overlap", "1 kg", "length"]),
        ("wellbore.survey_method=spline", ["wellbore.survey_method", "spline", "minimum_curvature"]),
        ("wellbore.intervals[0].friction=-0.1", ["wellbore.intervals[0].friction", "-0.1"]),
        ("wellbore.intervals[0].diameter=0", ["wellbore.intervals[0].diameter", "0"]),
        ("wellbore.intervals[0].diameter=4 in", ["string.components[0].outer_diameter", "5 in", "101.6"]),
        ("string.components[0].inner_diameter=6 in", ["string.components[0].inner_diameter", "6 in"]),
        ("string.components[0].outer_diameter=-1 in", ["string.components[0].outer_diameter", "-1 in"]),
        ("string.components[0].segments=20000", ["string.components", "20000", "10000"]),
        ("string.components[0].segments=99999999999999999999", ["string.components[0].segments", "a whole number"]),
        (
            "string.components=[{name='p', length=800, outer_diameter=0.1, inner_diameter=0, segment_length=1e-9}]",
            ["string.components", "8e+11 segments", "10000"],
        ),
        ("string.components={name='p', segments=3}", ["string.components", "a list of tables", "[[name]]"]),
        ("string.components[0].length=200 m", ["string.components", "200", "800"]),
        ("solver.step=1 s", ["solver.step", "1", "stable"]),
        ("operations[0].at_md=1000 m", ["operations[0].at_md", "1000", "900"]),
        ("operations=[]", ["operations", "at least one"]),
        ("wellbore.stations=[[0, 0, 0], [300, 181, 0]]", ["stations", "181", "180"]),
        ("wellbore.stations=[[0, 0, 0], [300, 10, 0], [200, 10, 0]]", ["stations", "200"]),
    ],
)
def test_bad_input_is_one_message_and_exit_code_2(
    change: str,
    expected: list[str],
    small_file: Path,
    tmp_path: Path,
    cli: Command,
) -> None:
    out = tmp_path / "out"
    message = cli("simulate", small_file, "--set", change, "--out", out, "--quiet", code=2).err
    assert re.search(f"^{re.escape(str(small_file))}: ", message, re.M)  # below its warnings
    assert "Traceback" not in message
    assert "expected" in message
    for part in expected:
        assert part in message
    assert not list(out.glob("*"))


def test_a_missing_small_file(cli: Command) -> None:
    assert "nowhere.toml" in cli("simulate", "nowhere.toml", code=2).err


@pytest.mark.skipif(os.name == "nt", reason="a current folder cannot be removed there")
def test_a_current_folder_that_is_gone_is_named(
    small_file: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    gone = small_file.parent / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    assert "the current folder is no longer there" in cli("check", "../small.toml", code=2).err


def test_an_unknown_option_is_exit_code_2(small_file: Path, cli: Command) -> None:
    assert "--frction" in cli("simulate", small_file, "--frction", "0.2", code=2).err


def test_with_a_full_disk_the_answer_is_still_printed(
    small_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    write_table = pq.write_table

    def full(table: pa.Table, where: object, **options: Any) -> None:
        if not isinstance(where, io.BytesIO):  # chunks of records are packed in memory before they are written
            raise OSError(28, "No space left on device")
        write_table(table, where, **options)

    monkeypatch.setattr("pyarrow.parquet.write_table", full)
    out = tmp_path / "out"
    captured = cli("simulate", small_file, "--out", out, "--quiet", code=2)
    assert f'"{out}": expected a folder that can be written (No space left on device)' in captured.err
    assert [path.name for path in tmp_path.iterdir()] == ["small.toml"]
    assert "32 segments" in captured.out


def test_interrupted_is_exit_code_130(
    small_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    monkeypatch.setattr(simulate, "simulate", Mock(side_effect=KeyboardInterrupt))
    cli("simulate", small_file, "--out", tmp_path / "out", "--quiet", code=130)
    assert [path.name for path in tmp_path.iterdir()] == ["small.toml"]


@pytest.mark.parametrize("package", ["numba", pytest.param("typer", marks=pytest.mark.slow)])
def test_interrupted_while_it_is_imported(package: str, tmp_path: Path) -> None:
    (tmp_path / f"{package}.py").write_text("raise KeyboardInterrupt\n")
    environment = os.environ | {"PYTHONPATH": f"{tmp_path}{os.pathsep}{Path(__file__).parents[2]}"}
    done = subprocess.run([sys.executable, "-m", "fctd"], env=environment, capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


def test_an_interactive_session_is_not_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "ps1", ">>> ", raising=False)
    with pytest.raises(KeyboardInterrupt), ends_program():
        raise KeyboardInterrupt


def test_the_garbage_collector_rests_during_imports_alone() -> None:
    assert gc.isenabled()
    with ends_program():
        assert not gc.isenabled()
        with ends_program():  # as one module imports another
            assert not gc.isenabled()
        assert not gc.isenabled()
    assert gc.isenabled()
    with pytest.raises(SystemExit), ends_program():
        raise KeyboardInterrupt
    assert gc.isenabled()
