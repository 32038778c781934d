"""The statuses in tables, files and exit codes."""

import json
from dataclasses import replace
from functools import cache
from itertools import chain
from pathlib import Path
from types import ModuleType
from typing import Any

import pandas as pd
import pyarrow.parquet as pq
import pytest

import fctd
from fctd.cli import equilibrium, refine, simulate
from fctd.results.status import RefineStatus, RunStatus, SteadyStatus
from fctd.results.table_files import write_table
from tests.cases import make_case, rotation
from tests.cli.tiny import SMALL
from tests.commands import run

ALL = list(chain(SteadyStatus, RunStatus, RefineStatus))
# What a script relies on: the exit code of the command, and whether its loads are those of a string; with the reason.
OUTCOMES = [
    ("equilibrium", "converged", 0, True, "forces are in balance, as was asked"),
    ("equilibrium", "locked_up", 0, True, "so far and no farther is an answer, with the push that it takes"),
    ("equilibrium", "rolling", 0, True, "forces are in balance in a frame that goes round with the string"),
    ("equilibrium", "under_resolved", 1, True, "forces are in balance, without the wall force of the wave"),
    ("equilibrium", "unstable", 1, True, "forces are in balance, but no string stays there"),
    ("equilibrium", "max_iterations", 1, False, "the forces of the last iterate are not in balance"),
    ("equilibrium", "diverged", 1, False, "beyond the hole's radius the wall pushes to the wrong side"),
    ("equilibrium", "not_finite", 1, False, "there are no numbers"),
    ("equilibrium", "not_possible", 1, False, "nothing was computed"),
    ("simulate", "completed", 0, True, "the motion that was asked for"),
    ("simulate", "inaccurate", 1, True, "all of the motion, with a tenth of the work lost"),
    ("simulate", "unstable", 1, False, "the last rows are not those of a string"),
    ("simulate", "unsettled", 1, False, "the motion never began"),
    ("simulate", "interrupted", 130, True, "the shell's number for Ctrl-C; the rows so far are as in a whole run"),
    ("simulate", "stopped", 1, True, "the operations are not done; the rows so far are as in a whole run"),
    ("refine", "within_tolerance", 0, True, "the segments that were asked for"),
    ("refine", "not_reached", 1, True, "the finest string has loads, with a larger error than allowed"),
    ("refine", "no_answer", 1, False, "no string had loads"),
]


KINDS = {"equilibrium": SteadyStatus, "simulate": RunStatus, "refine": RefineStatus}
AT = ("--operation", "rotate_off_bottom", "--bit-depth", "800 m")
# By command: the module that computes, what else the command needs, and a file that it writes.
COMMANDS: dict[str, tuple[ModuleType, tuple[str, ...], str]] = {
    "equilibrium": (equilibrium, AT, "profile.csv"),
    "simulate": (simulate, ("--quiet",), "run/history.parquet"),
    "refine": (refine, (*AT, "--tolerance", "5 %", "--quiet"), "refined.toml"),
}


@cache
def result_of(command: str) -> Any:
    """A result of a small case."""
    case = make_case(operations=[rotation(1000, 1)])
    if command == "equilibrium":
        return fctd.equilibrium(case, "rotate_off_bottom", 1000.0)
    return fctd.simulate(case) if command == "simulate" else fctd.refine(case, 0.2)


def test_every_status_has_an_outcome() -> None:
    assert [KINDS[command](word) for command, word, *_ in OUTCOMES] == ALL


@pytest.mark.parametrize(("command", "word", "code", "loads", "reason"), OUTCOMES)
def test_exit_code_and_loads(
    command: str, word: str, code: int, loads: bool, reason: str,
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    """A command whose computation ends with the status writes the shape of a string only where it has loads.

    The rows of a run are written in any case, and what ended it is said unless it is completed.
    """
    status = KINDS[command](word)
    assert status.has_loads == loads, reason
    module, arguments, file = COMMANDS[command]
    result = replace(result_of(command), status=status, message="at 5 s")
    monkeypatch.setattr(module, command, lambda *_, **__: result)
    (tmp_path / "case.toml").write_text(SMALL)
    out = tmp_path / file.split("/")[0]
    assert run(monkeypatch, command, tmp_path / "case.toml", *arguments, "--out", out) == code, reason
    assert (tmp_path / file).exists() == (loads or command == "simulate"), reason
    if command == "simulate":
        assert (f"{word}: at 5 s" in capsys.readouterr().err) == (code != 0), reason


def test_what_is_not_acceptable_says_why() -> None:
    assert all(status.message for status in ALL if not status.acceptable)


@pytest.mark.parametrize("status", ALL)
def test_a_status_is_plain_text(status: SteadyStatus | RunStatus | RefineStatus) -> None:
    assert (status == status.value, f"{status}", json.dumps(status)) == (True, status.value, f'"{status.value}"')
    assert type(status)(status.value) is status


def test_files_keep_the_word(tmp_path: Path) -> None:
    write_table(pd.DataFrame({"status": ALL}), tmp_path / "t.parquet", {"status": RunStatus.COMPLETED})
    table = pq.read_table(tmp_path / "t.parquet")
    assert table["status"].to_pylist() == [status.value for status in ALL]
    assert (table.schema.metadata or {})[b"status"] == b"completed"
