"""Verdicts follow from stored numbers and recorded bounds, and a ledger that says something else is refused."""

import io
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
import pytest
from rich.console import Console

from fctd import build_wellbore
from fctd.case.errors import InputError
from validation.cases import load
from validation.claims import judgement
from validation.claims.ledger import Finding, read_ledger
from validation.harness.study import Check, Outcome

ROOT = Path(__file__).parents[3]

CLAIM = """
pending = ["later"]
[[claim]]
id = "a-claim"
section = "5.2"
says = "Forces are right."
verdict = "holds"
because = "target"
[claim.number]
study = "toy"
check = "error"
at_most = 1.0
"""
ONE_ROUTE = CLAIM.replace('because = "target"', 'because = "target"\none_route = "one number is printed"')
LIMITED = '[claim.limited]\nlimit = "in vertical hole"\nstudy = "toy"\ncheck = "error"\nat_most = {}\n'
SECOND = '[claim.second_route]\nstudy = "second"\ncheck = "error"\nat_most = 1.0\n'
CELL = """
[claim.number]
study = "toy"
table = "forces"
column = "force_N"
called = "force"
unit = "N"
at_most = 1.5
"""


def outcome(value, unit="mm"):
    if isinstance(value, Outcome):
        return value
    table = pd.DataFrame({"place": ["low", "low", "high"], "depth_m": [0.0, 10.0, 10.0], "force_N": [1.0, -2.0, 3.0]})
    return Outcome({"forces": table}, [Check("error", value, 1.0, "at_most", unit, "closed form")])


class Answer(NamedTuple):
    """Exit code, what was printed, and the first claim's finding; None where the claims could not be judged."""

    code: int
    printed: str
    finding: Finding | None


@pytest.fixture
def judged(register, run, tmp_path):
    """Write claims.toml, run toy and second studies that find ``values``, then judge the claims."""

    def call(text, *, quick=False, timed=(), **values):
        path, results = tmp_path / "claims.toml", tmp_path / "results"
        path.write_text(text)
        for name in ("toy", "second"):
            register(name, lambda context, name=name: outcome(values[name]))
        for name in values:
            run(name, quick=quick)
        printed = io.StringIO()
        code = judgement.run(results, Console(file=printed), path, timed)
        try:
            (finding,) = judgement.judge_all(results, path).findings
        except InputError:
            finding = None
        return Answer(code, printed.getvalue(), finding)

    return call


def verdict(answer):
    return answer.finding.verdict


@pytest.mark.slow
@pytest.mark.parametrize(
    ("value", "more", "found"),
    [
        (0.5, "", "holds"),
        (1.5, "", "does not hold"),
        (1.5, LIMITED.format(2.0), "holds with limits"),
        (2.0, LIMITED.format(2.0), "holds with limits"),
        (2.5, LIMITED.format(2.0), "does not hold"),
        (0.5, LIMITED.format(0.1), "holds"),
        (float("nan"), LIMITED.format(2.0), "does not hold"),
    ],
)
def test_verdict_follows_from_the_number(judged, value, more, found):
    answer = judged(CLAIM + more, toy=value)
    assert verdict(answer) == found
    assert answer[0] == (0 if found == "holds" else 1)
    if found != "holds":
        assert f"a-claim: {found}, recorded is holds" in answer[1]


def test_a_number_that_contradicts_the_paper_has_a_second_route_that_does_too(judged):
    text = CLAIM.replace('"holds"', '"does not hold"')
    assert judged(text + SECOND, toy=2.0, second=3.0)[0] == 0
    answer = judged(text + SECOND, toy=2.0, second=0.5)
    assert (answer[0], verdict(answer)) == (1, "routes disagree")
    assert answer.finding.second_route.check.value == 0.5
    answer = judged(CLAIM + SECOND, toy=0.5, second=3.0)
    assert (answer[0], verdict(answer)) == (1, "routes disagree")
    assert answer.finding.why == "the first route meets the bound and the second does not"
    told = "claim a-claim.second_route is missing: expected a second route"
    assert told in judged(text, toy=2.0)[1]
    answer = judged(ONE_ROUTE.replace('"holds"', '"does not hold"'), toy=2.0)
    assert (answer[0], told in answer[1]) == (1, True)


def test_a_number_that_needs_limits_has_a_second_route_or_says_why_not(judged):
    limited = CLAIM.replace('"holds"', '"holds with limits"') + LIMITED.format(2.0)
    assert verdict(judged(limited + SECOND, toy=1.5, second=0.5)) == "routes disagree"
    answer = judged(limited + SECOND, toy=1.5, second=1.6)
    assert (answer[0], verdict(answer)) == (0, "holds with limits")
    assert "one_route = why there is none" in judged(limited, toy=1.5)[1]
    answer = judged(ONE_ROUTE.replace('"holds"', '"holds with limits"') + LIMITED.format(2.0), toy=1.5)
    assert (answer[0], verdict(answer)) == (0, "holds with limits")
    assert answer.finding.claim.one_route == "one number is printed"
    assert "second_route or one_route, not both" in judged(ONE_ROUTE + LIMITED.format(2.0) + SECOND, toy=1.5)[1]


@pytest.mark.parametrize(
    "second",
    [
        '[claim.second_route]\nstudy = "toy"\ncheck = "error"\nat_most = 0.5\n',
        '[claim.second_route]\nstudy = "toy"\ncheck = "other"\nat_most = 0.5\n',
    ],
)
def test_a_second_route_is_another_number(judged, second):
    limited = LIMITED.format(2.0).replace('"error"', '"other"')
    assert "expected a number of its own" in judged(CLAIM + limited + second, toy=0.5)[1]


def test_the_same_table_holds_other_numbers(judged):
    text = CLAIM[: CLAIM.index("[claim.number]")] + CELL + 'where = {place = "high"}\n'
    other = CELL.replace("claim.number", "claim.second_route")
    for more in ('where = {place = "low", depth_m = 0}', 'where = {place = "high"}\ntake = "least"'):
        assert "a number of its own" not in judged(text + other + more, toy=0.5)[1]
    assert "a number of its own" in judged(text + other + 'where = {place = "high"}', toy=0.5)[1]


@pytest.mark.parametrize(
    ("text", "values", "why"),
    [
        (CLAIM, {}, "toy has not been run"),
        (CLAIM.replace('study = "toy"', 'study = "later"'), {"toy": 0.5}, "study later is not written yet"),
        (CLAIM + SECOND, {"toy": 2.0}, "second route: second has not been run"),
        (CLAIM + LIMITED.format(2.0) + SECOND, {"toy": 1.5}, "second route: second has not been run"),
        (CLAIM + LIMITED.format(1.0).replace("toy", "second"), {"toy": 2.0}, "second has not been run"),
    ],
)
def test_what_has_not_been_run_has_no_verdict(judged, text, values, why):
    answer = judged(text, **values)
    assert (answer.code, verdict(answer), answer.finding.why) == (0, "not yet run", why)
    assert f"a-claim: not yet run ({why})" in answer.printed


def test_a_result_that_cannot_be_read_gives_no_number(judged, tmp_path, register, run):
    judged(CLAIM, toy=0.5)
    (tmp_path / "results" / "toy" / "verdict.json").write_text("{")
    assert judged(CLAIM).finding.why == "the result of toy cannot be read"


def test_a_skipped_study_gives_no_number(judged, register, run, tmp_path):
    judged(CLAIM)
    register("toy", needs=("data",))
    run("toy")
    (finding,) = judgement.judge_all(tmp_path / "results", tmp_path / "claims.toml").findings
    assert finding.verdict == "not yet run"
    assert finding.why.startswith("toy: skipped, the public data folder is missing")


def test_a_verdict_that_nobody_recorded_asks_for_it(judged):
    code, printed, _ = judged(CLAIM.replace('verdict = "holds"\n', ""), toy=0.5)
    assert code == 1
    assert "a-claim: holds, recorded is nothing" in printed
    # With noise or other code, the times of a study say nothing of its claim.
    code, printed, _ = judged(CLAIM.replace('verdict = "holds"\n', ""), toy=0.5, timed=["toy"])
    assert code == 0
    assert "1 not judged by times of other code" in printed


def test_a_claim_that_cannot_be_tested_says_why(judged):
    text = CLAIM[: CLAIM.index("because")].replace('"holds"', '"cannot be tested"') + 'untestable = "not public"\n'
    answer = judged(text)
    assert (answer[0], verdict(answer), answer.finding.why) == (0, "cannot be tested", "not public")


@pytest.mark.parametrize(
    ("more", "value"),
    [
        ('where = {place = "high"}', 3.0),
        ('where = {place = "low", depth_m = 10}', -2.0),
        ('take = "first"', 1.0),
        ('take = "last"', 3.0),
        ('take = "least"', -2.0),
        ('take = "greatest"', 3.0),
        ('where = {place = "low"}\ntake = "largest"', 2.0),
        ('take = "mean"', 2.0 / 3),
    ],
)
def test_a_number_of_a_table(judged, more, value):
    finding = judged(CLAIM[: CLAIM.index("[claim.number]")] + CELL + more, toy=0.5).finding
    check = finding.number.check
    assert check.value == pytest.approx(value)
    assert finding.verdict == ("holds" if value <= 1.5 else "does not hold")
    assert (check.name, check.requirement()) == ("force", "at most 1.5 N")


def test_the_quartiles_of_a_number_decide_with_it(judged):
    """Those of a check, and those of a column in the columns beside it."""
    row = {"ratio": [1.4], "ratio_low": [1.3], "ratio_high": [1.6]}
    check = Check("error", 1.4, 9.0, "at_most", "", "test", timed=True, interval=(1.3, 1.6))
    timed = Outcome({"times": pd.DataFrame(row)}, [check])
    cell = 'study = "toy"\ntable = "times"\ncolumn = "ratio"\ncalled = "ratio"\nunit = ""\n'
    for number in ('study = "toy"\ncheck = "error"\n', cell):
        for bound, met in ((1.5, False), (1.7, True)):
            text = f"{CLAIM[: CLAIM.index('[claim.number]')]}[claim.number]\n{number}at_most = {bound}\n"
            found = judged(text, toy=timed).finding.number
            assert (found.check.interval, found.met) == ((1.3, 1.6), met)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('check = "error"', 'check = "eror"', ".check = \"eror\": expected one of the checks of toy: error"),
        (None, 'table = "force"', "one of the tables of toy: forces"),
        (None, 'column = "force"', "one of the columns of forces: place; depth_m; force_N"),
        (None, 'where = {place = "middle"}', "middle\": expected one of the values of place: low; high"),
        (None, 'take = "only"', "take = \"only\": expected a way to take one number of 3 rows"),
    ],
)  # fmt: skip
def test_a_number_that_is_not_there_is_told_with_those_that_are(judged, old, new, message, capsys):
    if old is None:
        key = new.partition(" ")[0]
        cell = re.sub(rf"^{key} = .*$", new, CELL, flags=re.MULTILINE)
        text = CLAIM[: CLAIM.index("[claim.number]")] + (cell if cell != CELL else CELL + new)
    else:
        text = CLAIM.replace(old, new)
    code, printed, _ = judged(text, toy=0.5)
    assert code == 1
    assert "claims: failed: claims.toml: claim a-claim.number" in printed
    assert message in printed
    assert "Traceback" not in capsys.readouterr().err


def test_a_quick_run_may_leave_a_number_out(judged):
    answer = judged(CLAIM.replace('check = "error"', 'check = "of full runs"'), quick=True, toy=0.5)
    assert (answer[0], verdict(answer)) == (0, "not yet run")
    assert answer.finding.why == "the quick run of toy has no such number"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"toy"', '"tyo"', r'claim a-claim\.number\.study = "tyo": expected one of the studies .*toy'),
        ('"a-claim"', '"A claim"', r'claim A claim\.id = "A claim"'),
        ('"5.2"', '"five"', r'claim a-claim\.section = "five"'),
        ('verdict = "holds"', 'verdict = "true"', r'claim a-claim\.verdict = "true"'),
        ('verdict = "holds"', 'verdict = "holds with limits"', r"claim a-claim\.limited"),
        ('verdict = "holds"', 'verdict = "cannot be tested"', r"claim a-claim\.verdict"),
        ('because = "target"\n', "", r"claim a-claim\.because"),
        ("at_most = 1.0", "", "at_most"),
        ("at_most = 1.0", "at_most = 1.0\nat_least = 2.0", "one of at_most, at_least and within"),
        ("at_most = 1.0", 'at_most = "1"', r'number\.at_most = "1"'),
        ("at_most = 1.0", "at_most = nan", r"number\.at_most"),
        ("at_most = 1.0", "within = [1.0]", r"number\.within"),
        ("at_most = 1.0", "atmost = 1.0", "the key at_most"),
        ("at_most = 1.0", 'at_most = 1.0\nunit = "m"', "the check has its own"),
        ('check = "error"', 'check = "error"\ntable = "forces"', "check or table, not both"),
        ('check = "error"', 'table = "forces"', "a number of a table needs it"),
        ('check = "error"', "", "check or table"),
        ('pending = ["later"]', 'pending = ["toy"]', r'pending\[0\] = "toy": expected no study that there is'),
        ("pending", "pendings", "pendings"),
        ("[[claim]]", "[claim", "a TOML file"),
        ('because = "target"', 'because = "target"\nuntestable = "why"', "number or untestable, not both"),
        (
            'because = "target"',
            'because = "target"\none_route = "why"',
            "one_route = .* nothing, except for a claim that",
        ),
        ('verdict = "holds"', 'one_route = "why"', "one_route = .* nothing, except for a claim that"),
    ],
)
def test_a_ledger_that_cannot_be_meant_is_refused(register, tmp_path, old, new, message):
    register("toy")
    path = tmp_path / "claims.toml"
    assert old in CLAIM
    path.write_text(CLAIM.replace(old, new))
    with pytest.raises(InputError, match=message) as told:
        read_ledger(path)
    assert str(told.value).startswith("claims.toml: ")


def test_two_claims_of_one_name_are_refused(register, tmp_path):
    register("toy")
    path = tmp_path / "claims.toml"
    path.write_text(CLAIM + CLAIM[CLAIM.index("[[claim]]") :])
    with pytest.raises(InputError, match=r'claim\.id = "a-claim": expected an id of its own'):
        read_ledger(path)


def test_the_papers_ledger_is_complete_and_reads():
    found = read_ledger()
    assert len(found.claim) >= 16
    assert all(claim.numbers or claim.untestable for claim in found.claim)
    contradicted = [claim for claim in found.claim if claim.verdict in ("holds with limits", "does not hold")]
    assert len([claim for claim in contradicted if claim.second_route is None]) <= 1


def test_every_misprint_names_tests_that_there_are():
    for misprint in read_ledger().misprint:
        for test in misprint.tests:
            file, _, name = test.partition("::")
            assert f"\ndef {name}(" in (ROOT / file).read_text(), test


@pytest.mark.parametrize("name", ["paper_well", "paper_well_b"])
def test_the_papers_wells_bend_by_some_fifteen_degrees_in_a_hundred_metres(name):
    hole = build_wellbore(load(name))
    tangents = hole.at(np.arange(1750.0, 2451.0, 100.0))[1]
    bends = np.degrees(np.arccos(np.clip(np.sum(tangents[1:] * tangents[:-1], axis=1), -1, 1)))
    assert 15.0 < bends.max() < 17.0


def test_the_command_of_a_claim_names_its_studies(judged):
    assert judged(CLAIM + SECOND, toy=0.5, second=0.5).finding.studies == ["toy", "second"]
    later = CLAIM.replace('study = "toy"', 'study = "later"')
    assert judged(later).finding.studies == []
