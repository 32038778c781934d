"""The comparison that the gate makes, and the output and exit codes of its commands."""

from pathlib import Path
from unittest.mock import Mock

import pytest
from typer.testing import CliRunner

from benchmarks import __main__ as commands
from benchmarks import gate as module
from benchmarks import history, measure
from benchmarks.gate import Outcome, gate
from benchmarks.history import Kernel, Record
from benchmarks.release import NoSourcesError
from benchmarks.verdict import decide
from fctd.case.errors import InputError
from tests.benchmarks.test_history import a_record

FILE = Path("record.json")
COSTS = {measure.REFERENCE: [1.0] * 4, measure.FREE: [5.0] * 4, measure.CYLINDERS: [8.0] * 4, measure.ARCS: [9.0] * 4}


def record_here(**changes: object) -> Record:
    """A record of this machine with other sources."""
    kernels = {
        name: Kernel(unit="segment-step", size="60 segments", ns=4 * taken[0], samples=tuple(taken))
        for name, taken in COSTS.items() if name != measure.REFERENCE
    }  # fmt: skip
    known = {"reference": history.reference_digest(), "processor": history.processor(), "kernels": kernels}
    return a_record(**(known | {"versions": history.machine_versions()} | changes))


@pytest.fixture
def no_sources(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        module, "check_out", Mock(side_effect=NoSourcesError("this shallow clone does not hold commit abc1234"))
    )


def measuring(monkeypatch: pytest.MonkeyPatch, costs: measure.Costs) -> None:
    monkeypatch.setattr(measure, "alone", lambda processes: ({k: [4 * c for c in v] for k, v in costs.items()}, {}))


def test_the_same_sources_are_not_raced() -> None:
    outcome = gate(a_record(sources=history.sources_of(measure.ROOT)), FILE, str)
    assert outcome.passed
    assert "nothing to compare" in outcome.how


def test_the_release_is_raced_where_the_checkout_has_it(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Independent of the machine of the record."""
    monkeypatch.setattr(module, "check_out", lambda *_: tmp_path)
    slower = COSTS | {measure.FREE: [6.5] * 4}
    monkeypatch.setattr(measure, "side_by_side", lambda release, pairs, root: (COSTS, slower))
    outcome = gate(a_record(processor="another"), FILE, str)
    assert "raced" in outcome.how
    assert [verdict.kernel for verdict in outcome.verdicts if verdict.fails] == [measure.FREE]


@pytest.mark.usefixtures("no_sources")
def test_without_sources_the_record_of_the_same_processor_is_used(monkeypatch: pytest.MonkeyPatch) -> None:
    measuring(monkeypatch, COSTS)
    outcome = gate(record_here(), FILE, str)
    assert outcome.passed
    assert len(outcome.verdicts) == 5
    assert "from the same kind of processor (this shallow clone" in outcome.how
    measuring(monkeypatch, COSTS | {measure.ARCS: [12.0] * 4})
    failed = {verdict.kernel for verdict in gate(record_here(), FILE, str).verdicts if verdict.fails}
    assert failed == {measure.ARCS, "contact's addition, arcs"}


@pytest.mark.usefixtures("no_sources")
def test_the_record_of_another_machine_is_not_compared_and_the_reason_is_reported() -> None:
    outcome = gate(record_here(processor="abacus"), FILE, str)
    assert outcome.passed
    assert not outcome.verdicts
    assert "not compared" in outcome.how
    assert "another processor, abacus" in outcome.how


def invoke(*arguments: str) -> tuple[int, str]:
    done = CliRunner().invoke(commands.app, list(arguments))
    if isinstance(done.exception, InputError):
        raise done.exception
    return done.exit_code, done.output


def test_the_command_fails_and_names_the_kernel(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    code, text = invoke("gate", "--history", str(tmp_path))
    assert (code, text.splitlines()[-1]) == (0, "no release is recorded: nothing to compare with")
    with monkeypatch.context() as patched:
        patched.setattr(commands, "MOST_MEMORY", 100e3)
        code, text = invoke("gate", "--history", str(tmp_path))
        assert (code, text) == (1, "arrays of a string of 60 segments: 154 kB, at most 100\n")
    history.write(record_here(), tmp_path)

    def with_costs(now: measure.Costs) -> tuple[int, str]:
        verdicts = decide(measure.judged(COSTS), measure.judged(now))
        monkeypatch.setattr(commands, "gate", lambda *_: Outcome("raced", verdicts, COSTS, now))
        return invoke("gate", "--history", str(tmp_path))

    code, text = with_costs(COSTS)
    assert (code, "slower" in text) == (0, False)
    code, text = with_costs(COSTS | {measure.FREE: [6.5] * 4})
    assert code == 1
    assert "slower: step, contact-free takes 1.30 times" in text
    code, text = with_costs(COSTS | {"steady depth": [1.0] * 4})
    assert code == 0
    monkeypatch.setattr(commands, "gate", lambda *_: Outcome("raced", decide({"x": [1.0]}, {}), COSTS, COSTS))
    code, text = invoke("gate", "--history", str(tmp_path))
    assert code == 1
    assert "missing: x is no longer measured" in text


def test_a_run_next_to_the_last_release(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(commands.screen, "_width", 80)
    monkeypatch.setattr(commands, "measured", lambda release="": record_here(release="now"))
    history.write(record_here(), tmp_path)
    code, text = invoke("compare", "--history", str(tmp_path))
    assert code == 0
    assert "this run and release 1.0" in text
    assert "+0.0%" in text
    assert "contact :" in text
    assert "…" not in text
    history.write(record_here(processor="abacus", release="2.0", date=record_here().date.replace(year=2027)), tmp_path)
    _, text = invoke("compare", "--history", str(tmp_path))
    assert "another processor, abacus" in text
    assert "+0.0%" not in text


def test_a_measurement_becomes_a_record(monkeypatch: pytest.MonkeyPatch) -> None:
    subject = {name: {"unit": "segment-step", "size": "60 segments"} for name in COSTS}
    monkeypatch.setattr(measure, "alone", lambda processes, report: (COSTS, subject))
    record = commands.measured("4.0")
    assert (record.release, record.ratios) == ("4.0", COSTS)
    assert record.not_here(history.reference_digest(), history.processor(), history.machine_versions()) == ""


def test_a_record_needs_committed_sources(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(commands, "measured", lambda release, accepted: record_here(release=release, accepted=accepted))
    monkeypatch.setattr(history, "uncommitted", lambda: " M fctd/joints.py")
    with pytest.raises(InputError, match="everything committed"):
        invoke("record", "--history", str(tmp_path))
    monkeypatch.setattr(history, "uncommitted", lambda: "")
    assert invoke("record", "--history", str(tmp_path), "--release", "3.0", "--accept", "a slower step")[0] == 0
    found = history.last_release(tmp_path)
    assert found is not None
    assert (found[1].release, found[1].accepted) == ("3.0", "a slower step")
    _, text = invoke("gate", "--history", str(tmp_path))
    assert "accepts: a slower step" in text
