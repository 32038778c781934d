"""Statements of the table on some drawn cases; `python -m tests.equivalence --draws N --seed S` judges more."""

import pytest

from tests.equivalence.campaign import campaign, fast
from tests.equivalence.draws import draw
from tests.equivalence.table import STATEMENTS

SEED = 57


@pytest.mark.parametrize("start", [*range(8), *(pytest.param(k, marks=pytest.mark.slow) for k in range(8, 40, 4))])
def test_the_statements_hold(start: int) -> None:
    """Of a drawn case, or of four of the slow ones; a failure names its draw and its statement."""
    tally = campaign(SEED, range(start, start + (1 if start < 8 else 4)), fast())
    assert [f"--seed {SEED} --only {index}: {name}: {words}" for name, _, index, words in tally.failures] == []
    assert tally.refusals == []
    assert tally.held >= 15


@pytest.mark.slow(seconds=20)
@pytest.mark.parametrize("start", range(0, 12, 3))
def test_the_slow_statements_hold(start: int) -> None:
    """Those that run commands or take longer, of three drawn cases."""
    chosen = [of for of in STATEMENTS.values() if of.slow]
    tally = campaign(SEED, range(start, start + 3), chosen)
    assert [f"--seed {SEED} --only {index}: {name}: {words}" for name, _, index, words in tally.failures] == []
    assert tally.held >= 15


def test_a_wrong_answer_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """A rig whose drive reads the string's torque alone: its seed and its statement are told."""
    monkeypatch.setattr("fctd.steady.steady_string.drive_torque", lambda rig, spin, torque: torque)
    index = next(k for k in range(40) if draw(SEED, k).has("torque_offset"))
    told: list[str] = []
    tally = campaign(SEED, [index], [STATEMENTS["the rig's readings by their formulas"]], told.append)
    assert [(name, seed, k) for name, seed, k, _ in tally.failures] == [
        ("the rig's readings by their formulas", SEED, index)
    ]
    assert told[0].startswith(f"--seed {SEED} --only {index}: the rig's readings")


def test_what_a_program_does_not_expect_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    """An exception that is no refusal names its place."""
    monkeypatch.setattr("fctd.steady.steady_string.drive_torque", lambda *_: 1 / 0)
    (failure,) = campaign(SEED, [0], [STATEMENTS["names of components"]]).failures
    assert "ZeroDivisionError" in failure[3]
