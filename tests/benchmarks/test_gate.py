"""The comparison that the gate makes, and the output and exit codes of its commands."""

from datetime import UTC, datetime
from pathlib import Path

import pytest
from typer.testing import CliRunner

from benchmarks import __main__ as commands
from benchmarks import checkout, history, measure
from benchmarks.gate import MOST, PROCESSES, SUM, Outcome, against, against_baseline, sampled
from benchmarks.history import Change
from benchmarks.measure import Costs
from benchmarks.verdict import Verdict, decide
from fctd.case.errors import InputError
from tests.benchmarks.test_history import a_record

COSTS = {measure.REFERENCE: [1.0] * 4, measure.FREE: [5.0] * 4, measure.CYLINDERS: [8.0] * 4, measure.ARCS: [9.0] * 4}


@pytest.fixture
def raced(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[Costs]:
    """Costs before and now, in place of processes."""
    sides = [COSTS, COSTS]
    monkeypatch.setattr(checkout, "resolved", lambda commit, root=None: "c0ffee")
    monkeypatch.setattr(checkout, "check_out", lambda commit: tmp_path)
    monkeypatch.setattr(checkout, "date_of", lambda commit: datetime(2026, 1, 1, tzinfo=UTC))
    monkeypatch.setattr(checkout, "brought", lambda kernel: kernel == "fresh")
    monkeypatch.setattr(measure, "side_by_side", lambda before, now, pairs: tuple(sides))
    return sides


def fails(outcome: Outcome) -> set[str]:
    return {verdict.kernel for verdict in outcome.verdicts if verdict.fails}


def test_the_same_sources_are_not_raced() -> None:
    outcome = against_baseline(a_record(sources=checkout.sources_of(measure.ROOT)), Path(), str)
    assert outcome.passed
    assert "nothing to race" in outcome.how


def test_a_slower_kernel_fails_against_the_baseline(raced: list[Costs]) -> None:
    assert against_baseline(a_record(), Path(), str).passed
    raced[1] = COSTS | {measure.FREE: [5.6] * 4}
    outcome = against_baseline(a_record(), Path(), str)
    assert fails(outcome) == {measure.FREE}
    assert "raced against the baseline abc12345 of 2026-01-02, 8 pairs" in outcome.how


def test_a_kernel_without_a_baseline_fails_except_in_the_change_that_brings_it(raced: list[Costs]) -> None:
    raced[1] = COSTS | {"fresh": [1.0] * 4, "late": [1.0] * 4}
    assert fails(against_baseline(a_record(), Path(), str)) == {"late"}
    raced[:] = raced[::-1]
    assert fails(against_baseline(a_record(), Path(), str)) == {"fresh", "late"}


def test_an_anchor_is_raced_on_what_both_have_and_fails_by_the_sum(raced: list[Costs]) -> None:
    raced[0] = COSTS | {"gone": [1.0] * 4}
    raced[1] = COSTS | {"late": [1.0] * 4}
    outcome = against("c0ffee", [], str)
    assert outcome.passed
    assert {verdict.kernel: verdict.status for verdict in outcome.verdicts}["late"] == "new"
    raced[1] = {name: [1.12 * cost for cost in taken] for name, taken in COSTS.items()}
    assert SUM in fails(against("c0ffee", [], str))


def test_what_was_accepted_since_the_anchor_counts_for_its_kernel_and_never_in_the_sum(raced: list[Costs]) -> None:
    names = [*measure.judged(COSTS)]
    raced[1] = {name: taken if name == measure.REFERENCE else [1.3 * cost for cost in taken]
                for name, taken in COSTS.items()}  # fmt: skip
    entries = dict.fromkeys(names, Change(ratio=1.25, low=1.2, high=1.3))
    accepting = a_record(changes=entries, accepted=dict.fromkeys(names, "two springs"))
    assert fails(against("c0ffee", [(Path(), accepting)], str)) == {SUM}
    older = accepting.model_copy(update={"date": datetime(2025, 1, 1, tzinfo=UTC)})
    assert fails(against("c0ffee", [(Path(), older)], str)) == {SUM, *names}


@pytest.mark.parametrize(
    ("factors", "used", "passes"),
    [
        ([1.0, 1.0], 1, True),
        ([1.5, 1.0, 1.0], 3, True),  # an outlier in the first batch
        ([1.5, 1.5, 1.5], 2, False),  # confirmed by the second
        ([1.0, 1.5, 1.5], 1, True),
    ],
)
def test_the_gate_measures_again_only_while_a_kernel_looks_slower(
    factors: list[float], used: int, passes: bool
) -> None:
    base = {name: [cost[0]] * PROCESSES for name, cost in COSTS.items()}
    batches = iter([(base, base | {measure.CYLINDERS: [factor * 8.0] * PROCESSES}) for factor in factors])
    reported: list[str] = []
    outcome = sampled("raced", lambda: next(batches), reported.append, decide)
    assert outcome.passed == passes
    assert len(outcome.now[measure.CYLINDERS]) == used * PROCESSES <= MOST
    assert len(reported) == used - 1
    assert all("step, cylinders" in line for line in reported)


def invoke(*arguments: str) -> tuple[int, str]:
    done = CliRunner().invoke(commands.app, list(arguments))
    if isinstance(done.exception, InputError):
        raise done.exception
    return done.exit_code, done.output


def test_the_command_fails_and_names_the_kernel(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    with monkeypatch.context() as patched:
        patched.setattr(commands, "MOST_MEMORY", 100e3)
        code, text = invoke("gate", "--history", str(tmp_path))
        assert (code, text) == (1, "arrays of a string of 60 segments: 154 kB, at most 100\n")
    history.write(a_record(accepted={"joint loads": "two springs"}), tmp_path)

    def saying(*verdicts: Verdict, anchor: tuple[Verdict, ...] = ()) -> tuple[int, str]:
        monkeypatch.setattr(commands, "against_baseline", lambda *_: Outcome("raced", list(verdicts), COSTS, COSTS))
        monkeypatch.setattr(commands, "against", lambda *_: Outcome("anchored", list(anchor), COSTS, COSTS))
        return invoke("gate", "--history", str(tmp_path), *(["--against", "HEAD"] if anchor else []))

    fine, slower = Verdict("a", "as before", 1.0, 0.9, 1.05), Verdict("a", "slower", 1.3, 1.2, 1.4)
    code, text = saying(fine)
    assert (code, "slower" in text) == (0, False)
    assert "accepts joint loads 1.20 times (1.15 to 1.25): two springs" in " ".join(text.split())
    assert saying(fine, anchor=(fine,))[0] == 0
    for code, text in (saying(slower), saying(fine, anchor=(slower,))):
        assert code == 1
        assert "slower: a takes 1.30 times what it took (80 % interval 1.20 to 1.40)" in " ".join(text.split())
    code, text = saying(fine, Verdict("x", "missing"))
    assert (code, "missing: x is no longer measured" in text) == (1, True)
    code, text = saying(fine, Verdict("x", "no baseline"))
    assert (code, "no baseline: x came with an earlier change" in text) == (1, True)


def test_a_gate_without_a_baseline_is_an_error(tmp_path: Path) -> None:
    """One that judges nothing must not look like one that passes."""
    with pytest.raises(InputError, match="python -m benchmarks record makes one"):
        invoke("gate", "--history", str(tmp_path))
    history.write(a_record(commit="0123abc"), tmp_path)
    with pytest.raises(InputError, match="a commit of this clone"):
        invoke("gate", "--history", str(tmp_path))


def test_a_record_needs_committed_sources_and_reasons(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(checkout, "uncommitted", lambda: " M fctd/joints.py")
    with pytest.raises(InputError, match="everything committed"):
        invoke("record", "--history", str(tmp_path))
    monkeypatch.setattr(checkout, "uncommitted", lambda: "")
    for entry in ("a", "a=", "=b", ""):
        with pytest.raises(InputError, match="KERNEL=REASON"):
            invoke("record", "--history", str(tmp_path), "--accept", entry)
    assert invoke("record", "--history", str(tmp_path / "new"))[0] == 0  # the first has no baseline before it
    slower = Outcome("raced", [Verdict("a, b", "slower", 1.3, 1.2, 1.4)], COSTS, COSTS)
    monkeypatch.setattr(commands, "against_baseline", lambda *_: slower)
    code, _ = invoke("record", "--history", str(tmp_path / "new"), "--accept", "a, b=x = y is solved twice")
    assert code == 0
    (_, last) = history.read(tmp_path / "new")[-1]
    assert last.accepted == {"a, b": "x = y is solved twice"}
    assert last.changes["a, b"].ratio == 1.3
