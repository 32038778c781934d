"""The paper's claims one by one: verdicts computed from the stored results of the other studies."""

from typing import Any

import pandas as pd

from validation.claims.ledger import Finding, Found, Missing, Results, judge, read_ledger
from validation.harness.registry import STUDIES
from validation.harness.study import Check, Context, Outcome, Study

ROLES = ("number", "limited", "second_route")


def run(context: Context) -> Outcome:
    """Judge every claim of ``claims.toml`` by what is in ``validation/results``."""
    ledger, results = read_ledger(), Results(context.results)
    findings = [judge(claim, results) for claim in ledger.claim]
    waiting = [f"{found.claim.id} ({found.why})" for found in findings if found.verdict == "not yet run"]
    return Outcome(
        tables={
            "ledger": pd.DataFrame([row(found) for found in findings]),
            "misprints": pd.DataFrame([misprint.model_dump() for misprint in ledger.misprint]),
        },
        checks=[as_recorded(found) for found in findings if found.verdict != "not yet run"],
        notes=[f"Not yet run: {'; '.join(waiting)}."] if waiting else [],
    )


def as_recorded(found: Finding) -> Check:
    """Whether a verdict is the one that ``claims.toml`` records."""
    claim = found.claim
    agrees = found.verdict == claim.verdict
    name = f"{claim.id}: {found.verdict}" + ("" if agrees else f", recorded is {claim.verdict or 'nothing'}")
    return Check(name, float(agrees), 1.0, "at_least", "", "the verdict recorded in claims.toml")


def row(found: Finding) -> dict[str, Any]:
    """A claim, its verdict and its numbers in columns."""
    claim = found.claim
    studies = [name for name in dict.fromkeys(number.study for number in claim.numbers) if name in STUDIES]
    cells: dict[str, Any] = {
        "claim": claim.id,
        "section": claim.section,
        "says": claim.says,
        "verdict": found.verdict,
        "recorded": claim.verdict or "",
        "because": claim.because or "",
        "why": found.why,
        "limit": claim.limited.limit if claim.limited else "",
        "one_route": claim.one_route or "",
        "remark": claim.remark,
        "command": " ".join(["python -m validation", *studies]) if studies else "",
    }
    for role in ROLES:
        cells |= {f"{role}_{column}": value for column, value in _columns(getattr(found, role)).items()}
    return cells


def _columns(found: Found | Missing | None) -> dict[str, Any]:
    if isinstance(found, Found):
        check = found.check
        return {
            "study": found.study, "name": check.name, "value": check.value, "of_unit": check.unit,
            "bound": check.requirement(), "met": found.met, "quick": found.quick,
        }  # fmt: skip
    blank = {"name": "", "value": float("nan"), "of_unit": "", "bound": "", "met": False, "quick": False}
    return {"study": found.study if found else "", **blank}


STUDY = Study("claims", "What of the paper holds, by how much, and where does it end?", run, reproduce=True)
