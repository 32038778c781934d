"""Studies side by side: what runs beside what, failures, and the same numbers as one after the other."""

import operator
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from unittest.mock import Mock

import pandas as pd
import pytest
from rich.console import Console

from fctd.store import limits
from references.timing.stopwatch import machine
from reports import chapters
from reports.figures import leading
from tests.commands import HANG, until
from tests.validation.conftest import outcome
from validation.claims.ledger import CLAIMS
from validation.harness import runner, side_by_side, store
from validation.harness.fingerprint import surroundings
from validation.harness.registry import STUDIES
from validation.studies import engines_agree

pytestmark = pytest.mark.skipif(side_by_side.workers() < 2, reason="one processor, or no copies of a process")


def spans(folder: Path) -> dict[str, tuple[float, float, int]]:
    """Start, end and process of each study that has left them."""
    return {path.stem: tuple(map(float, path.read_text().split())) for path in folder.glob("*.span")}


def lasting(folder: Path, name: str, beside: Sequence[str]):
    """A study that waits for others to begin, and says when it ran and where."""

    def run(context):
        began = time.monotonic()
        (folder / f"{name}.began").touch()
        until(lambda: all((folder / f"{other}.began").exists() for other in beside))
        (folder / f"{name}.span").write_text(f"{began} {time.monotonic()} {os.getpid()}")
        return outcome()

    return run


def test_what_times_nothing_runs_side_by_side_and_the_rest_alone_afterwards(register, run, tmp_path):
    register("first", lasting(tmp_path, "first", ["second"]))
    register("second", lasting(tmp_path, "second", ["first"]))
    register("clock", lasting(tmp_path, "clock", []), timed=True)
    code, text = run("clock", "first", "second", processes=2)
    assert code == 0
    assert "studies run: 3" in text
    found = spans(tmp_path)
    assert max(found["first"][0], found["second"][0]) < min(found["first"][1], found["second"][1])
    assert found["clock"][0] > max(found["first"][1], found["second"][1])
    assert found["clock"][2] == os.getpid()
    assert len({process for _, _, process in found.values()}) == 3


def test_processors_are_those_that_this_process_may_use(monkeypatch):
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {1, 2, 3}, raising=False)
    monkeypatch.setattr(os, "cpu_count", lambda: 99)
    monkeypatch.setattr(limits, "CPU_QUOTA", Path("none"))
    assert side_by_side.workers() == store.provenance().cores == 3
    assert surroundings(quick=True)["cores"] == machine()["cores"] == "3"


def test_a_failure_beside_others_is_a_result(register, run, tmp_path, capfd):
    register("broken", Mock(side_effect=ArithmeticError("lost in the bend")))
    register("toy")
    code, text = run("broken", "toy", processes=2)
    assert code == 1
    assert "lost in the bend" in text
    assert store.read(tmp_path / "results" / "toy").status == "finished"
    assert "Traceback" in capfd.readouterr().err


def test_ctrl_c_ends_all_and_keeps_what_is_finished(register, run, tmp_path, monkeypatch):
    register("quick")
    ended = tmp_path / "ended"
    register("endless", lambda context: (time.sleep(HANG), ended.touch()))
    told = runner.tell

    def interrupted(*arguments):
        told(*arguments)
        raise KeyboardInterrupt

    monkeypatch.setattr(runner, "tell", interrupted)
    code, text = run("endless", "quick", processes=2)
    assert code == runner.INTERRUPTED
    assert "kept: quick" in text
    assert not ended.exists()


@pytest.mark.slow
def test_parts_keep_their_order_in_other_processes():
    assert side_by_side.apart(operator.neg, [3.0, 1.0, 2.0]) == [-3.0, -1.0, -2.0]


def test_parts_of_the_engines_join_as_one_table():
    def part(engine: str) -> dict[str, pd.DataFrame]:
        rows = [(hole, name) for hole in ("planar", "turning") for name in ("FCTD", engine)]
        return {"chain": pd.DataFrame(rows, columns=["hole", "engine"])}

    table = engines_agree.joined([part("MuJoCo"), part("Bullet")])["chain"]
    assert table.to_numpy().tolist() == [
        [hole, name] for hole in ("planar", "turning") for name in ("FCTD", "Bullet", "MuJoCo")
    ]


@pytest.mark.slow
def test_two_runs_differ_in_times_only(tmp_path, sources):
    """Real studies, one after the other and side by side."""
    names, tables = ("overlap", "ownership"), []
    for processes in (1, 2):
        results = tmp_path / str(processes)
        code = runner.run_all(
            names, quick=True, processes=processes, data=None, expected=runner.read_expected(runner.EXPECTED),
            results=results, sources=sources, console=Console(quiet=True),
        )  # fmt: skip
        assert code == 0
        records = {name: store.read(results / name) for name in names}
        tables.append({name: (records[name], store.read_tables(results / name, records[name])) for name in names})
    for name in names:
        (first, its), (second, others) = tables[0][name], tables[1][name]
        assert first.checks == second.checks
        assert its.keys() == others.keys()
        for key, table in its.items():
            pd.testing.assert_frame_equal(table, others[key], check_exact=True)


def test_what_is_reproduced_is_what_claims_and_the_first_page_rest_on():
    """Studies of public data are left out: make reproduce needs none."""
    asked = set(re.findall(r'study = "(\w+)"', CLAIMS.read_text(encoding="utf-8")))
    contents = chapters.contents()
    for chapter in contents.chapter:
        asked |= {name for sentence in chapter.sentence for name, _ in sentence.numbers}
        asked.add(chapter.picture.partition("/")[0])
    asked |= {each.ours.partition("/")[0] for each in contents.paper if each.ours}
    asked |= {each.study for each in leading.LEADING}
    public = {name for name in STUDIES if "data" in runner.load(name).needs}
    assert {name for name in STUDIES if runner.load(name).reproduce} == asked - public


SLEEPERS = """
import os, time
from fctd.cli.interrupts import as_interrupts
from validation.harness import side_by_side

def sleep(seconds):
    os.write(1, f"{os.getpid()}\\n".encode())  # in one piece
    time.sleep(seconds)

with as_interrupts():
    list(side_by_side.each(sleep, [3600] * 4, 2))
"""


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="no /proc")
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_no_process_outlives_the_first_one(number):
    command = [sys.executable, "-c", SLEEPERS]
    first = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    assert first.stdout is not None
    others = [int(first.stdout.readline()) for _ in range(2)]
    first.send_signal(number)
    try:
        first.wait(HANG)
        until(lambda: not any(map(runs, others)))
    finally:
        first.stdout.close()
        for process in (first.pid, *others):
            with suppress(ProcessLookupError):
                os.kill(process, signal.SIGKILL)


def runs(process: int) -> bool:
    """Whether a process is there; one that has ended and whose parent has not asked for it is not."""
    try:
        return "\nState:\tZ" not in Path(f"/proc/{process}/status").read_text()
    except OSError:
        return False
