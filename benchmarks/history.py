"""The baselines of the gate: one readable file each in benchmarks/history/, of which the newest is raced.

No time in a file is compared with a time measured elsewhere: a record keeps how each kernel changed against the
baseline before, raced on one machine, and a curve of the history is the product of these changes.
"""

import math
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated

from pydantic import AwareDatetime, BaseModel, ConfigDict, Field, ValidationError

from benchmarks import checkout
from benchmarks.measure import ROOT
from benchmarks.verdict import Verdict
from fctd.case.errors import MISSING, InputError
from references.timing.stopwatch import machine

HISTORY = Path(__file__).parent / "history"

Ratio = Annotated[float, Field(gt=0, allow_inf_nan=False)]


class Change(BaseModel):
    """Cost of a kernel over that in the baseline before, with its 80 % interval."""

    model_config = ConfigDict(frozen=True)

    ratio: Ratio
    low: Ratio
    high: Ratio


class Record(BaseModel):
    """A baseline: the commit, where and when it was raced against the baseline before, and what came out.

    sources : hash of the engine's sources.  machine : all that times depend on.  changes : of the kernels that both
    baselines have, empty in the first record.  accepted : kernels that became slower or are gone, and why.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    date: AwareDatetime
    commit: Annotated[str, Field(pattern="^[0-9a-f]+$")]
    sources: str
    machine: dict[str, str]
    changes: dict[str, Change]
    accepted: dict[str, str] = {}

    @property
    def name(self) -> str:
        """Commit and date as text."""
        return f"{self.commit[:8]} of {self.date:%Y-%m-%d}"

    def entry(self, kernel: str) -> str:
        """What the record accepts of a kernel, for the screen."""
        change = self.changes.get(kernel)
        by = "" if change is None else f" {change.ratio:.2f} times ({change.low:.2f} to {change.high:.2f})"
        return f"{kernel}{by}: {self.accepted[kernel]}"


def record_of(verdicts: list[Verdict], accepted: Mapping[str, str], last: Record | None) -> Record:
    """The record of the last commit after a race against the last baseline.

    InputError where the baseline may not move: a kernel fails without a reason, a reason names a kernel that does not
    fail, or nothing became faster and nothing is accepted.
    """
    failing = {verdict.kernel for verdict in verdicts if verdict.fails}
    for kernel in accepted.keys() - failing:
        raise InputError(
            f"a kernel that the gate fails ({', '.join(sorted(failing)) or 'none'})", key="--accept", value=kernel
        )
    for kernel in sorted(failing - accepted.keys()):
        raise InputError(f"a reason, as in --accept '{kernel}=REASON', or no slowdown", key="--accept", value=kernel)
    if last is not None and not accepted and not any(verdict.status in ("faster", "new") for verdict in verdicts):
        raise InputError("a gain, a new kernel or an accepted entry: the baseline stays", key="record", value=last.name)
    return Record(
        date=datetime.now(UTC).replace(microsecond=0), commit=checkout.resolved("HEAD"),
        sources=checkout.sources_of(ROOT), machine=machine(), accepted=dict(accepted),
        changes={each.kernel: change_in(each) for each in verdicts if not math.isnan(each.change)},
    )  # fmt: skip


def change_in(verdict: Verdict) -> Change:
    """The change of a verdict, rounded for a readable file."""
    return Change(ratio=round(verdict.change, 4), low=round(verdict.low, 4), high=round(verdict.high, 4))


def accepted_since(date: datetime, records: list[tuple[Path, Record]]) -> dict[str, float]:
    """By how much kernels became slower with a reason in the records after a date."""
    since: dict[str, float] = {}
    for _, record in records:
        for kernel in record.accepted if record.date > date else ():
            if kernel in record.changes:
                since[kernel] = since.get(kernel, 1.0) * record.changes[kernel].ratio
    return since


def curves(records: list[tuple[Path, Record]]) -> dict[str, list[float]]:
    """Cost of each kernel over its cost in the first record that has it; NaN before that one."""
    found: dict[str, list[float]] = {}
    for k, (_, record) in enumerate(records):
        for kernel, change in record.changes.items():
            curve = found.setdefault(kernel, [math.nan] * (k - 1) + [1.0])
            curve.extend([math.nan] * (k - len(curve)))
            curve.append((1.0 if math.isnan(curve[-1]) else curve[-1]) * change.ratio)
    return found


def commit_of(record: Record, file: Path) -> str:
    """The commit of a record; if it was rewritten, the one that added the record's file has the same sources.

    InputError where the clone holds neither.
    """
    try:
        return checkout.resolved(record.commit)
    except InputError:
        added = checkout.commit_of(file) if file.resolve().is_relative_to(ROOT) else ""
        if not added or checkout.sources_of(checkout.check_out(added)) != record.sources:
            raise
        return added


def write(record: Record, folder: Path = HISTORY) -> Path:
    """Store a record; returns its file."""
    path = folder / f"{record.date:%Y-%m-%d}-{record.commit[:8]}.json"
    folder.mkdir(parents=True, exist_ok=True)
    path.write_text(record.model_dump_json(indent=1) + "\n", encoding="utf-8")
    return path


def read(folder: Path = HISTORY) -> list[tuple[Path, Record]]:
    """All records with their files, oldest first; InputError for an invalid file or a missing folder."""
    if not folder.is_dir():
        raise InputError("a folder of records", key="--history", value=folder)
    found = []
    for path in folder.glob("*.json"):
        try:
            found.append((path, Record.model_validate_json(path.read_bytes())))
        except ValidationError as failure:
            first = failure.errors()[0]
            key = ".".join(str(part) for part in first["loc"])
            value = MISSING if first["type"] == "missing" else first["input"]
            raise InputError(f"a record ({first['msg']})", key=key, value=value, file=path) from None
    return sorted(found, key=lambda one: one[1].date)
