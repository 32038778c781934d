"""``results.json``: every check and every claim's verdict for programs, and the schema of the file."""

import json
import math
from collections.abc import Iterable
from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from reports.claims import Claims
from reports.sections import Section, anchor
from validation.claims.ledger import Verdict
from validation.harness.store import Provenance, Standing


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid")


class CheckResult(_Table):
    """A number and its bound."""

    name: str
    value: float | None = Field(description="null where the number is not finite")
    interval: tuple[float, float] | None = Field(description="quartiles of the rounds of a time, or of a fit")
    unit: str
    kind: Literal["at_most", "at_least", "within"]
    bound: float | tuple[float, float]
    source: str = Field(description="where the bound comes from")
    verdict: Literal["met", "missed"]
    standing: Standing = Field(description="the verdict against what validation/expected.toml records")
    page: str


class StudyResult(_Table):
    """A study and its checks."""

    study: str
    question: str
    status: Literal["finished", "skipped", "failed", "not run", "unreadable"]
    message: str
    quick: bool
    date: str
    wall_s: float
    out_of_date: str = Field(description="the input that has changed since the result was stored, or empty")
    provenance: Provenance | None
    checks: list[CheckResult]
    notes: list[str]


class ClaimResult(_Table):
    """A claim of the paper and its verdict."""

    id: str
    section: str
    says: str
    verdict: Verdict
    as_recorded: bool
    studies: list[str]


class Results(_Table):
    """All that the pages judge."""

    schema_version: Literal[1] = 1
    claims: list[ClaimResult]
    studies: list[StudyResult]


def write(sections: Iterable[Section], claims: Claims, out: Path) -> None:
    """Write ``results.json`` and ``results.schema.json``."""
    found = Results(
        claims=[
            ClaimResult(
                id=each.claim.id, section=each.claim.section, says=each.claim.says, verdict=each.verdict,
                as_recorded=each.as_recorded, studies=each.studies,
            )
            for each in claims.judgement.findings
        ],
        studies=[_study(section) for section in sections],
    )  # fmt: skip
    text = json.dumps(found.model_dump(mode="json"), indent=1, ensure_ascii=False, allow_nan=False)
    (out / "results.json").write_text(text + "\n", encoding="utf-8", errors="backslashreplace")
    schema = json.dumps(Results.model_json_schema(), indent=1, ensure_ascii=False)
    (out / "results.schema.json").write_text(schema + "\n", encoding="utf-8")


def _study(section: Section) -> StudyResult:
    record = section.record
    if record is None:
        return StudyResult(
            study=section.study, question=section.asked, status="unreadable" if section.problems else "not run",
            message="; ".join(section.problems), quick=False, date="", wall_s=0.0, out_of_date=section.changed,
            provenance=None, checks=[], notes=[],
        )  # fmt: skip
    checks = [
        CheckResult(
            name=judged.check.name, value=judged.check.value if math.isfinite(judged.check.value) else None,
            interval=judged.check.interval, unit=judged.check.unit, kind=judged.check.kind, bound=judged.check.bound,
            source=judged.check.source,
            verdict=judged.check.verdict, standing=judged.standing,
            page=f"studies/{section.study}.html#{anchor(judged.check.name)}",
        )
        for judged in record.checks
    ]  # fmt: skip
    return StudyResult(
        study=section.study, question=record.question, status=record.status, message=record.message,
        quick=record.quick, date=record.date, wall_s=record.wall_s, out_of_date=section.changed,
        provenance=record.provenance, checks=checks, notes=list(record.notes),
    )  # fmt: skip
