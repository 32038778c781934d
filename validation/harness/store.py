"""What is kept of a run: ``verdict.json`` and one Parquet file per table, written whole or not at all."""

import json
import math
import subprocess
from collections import Counter
from collections.abc import Collection, Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

import pandas as pd
from pyarrow import parquet
from pydantic import TypeAdapter

from fctd.arena.result import Comparison
from fctd.store.limits import cores
from fctd.store.origin import environment_of_git, versions
from fctd.store.parquet import read_frame
from fctd.store.whole_file import whole_file
from fctd.store.whole_folder import whole_folder
from references.timing.stopwatch import cpu_name
from validation.harness.fingerprint import Inputs
from validation.harness.study import ROOT, Check

Status = Literal["finished", "skipped", "failed"]
Standing = Literal["met", "missed (recorded)", "finding about the paper", "better than recorded", "worse than recorded"]


@dataclass(frozen=True)
class Judged:
    """A check beside what ``expected.toml`` records of it: ``missed``, ``finding`` or ``varies: why``, or None."""

    check: Check
    recorded: str | None

    @property
    def varies(self) -> bool:
        """Whether it is recorded that this check is met on one machine and missed on another."""
        return self.recorded is not None and self.recorded.startswith("varies")

    @property
    def standing(self) -> Standing:
        """The verdict against the record."""
        if self.check.verdict == "met":
            return "met" if self.recorded is None or self.varies else "better than recorded"
        if self.recorded is None:
            return "worse than recorded"
        return "finding about the paper" if self.recorded.startswith("finding") else "missed (recorded)"

    @property
    def is_finding(self) -> bool:
        """Whether what is missed is the paper's, so that it says nothing against the engine."""
        return self.standing == "finding about the paper"


@dataclass(frozen=True)
class Provenance:
    """Where a result comes from."""

    commit: str
    versions: dict[str, str]
    cpu: str
    cores: int


@dataclass(frozen=True)
class Record:
    """The content of ``verdict.json``.

    message : why a study was skipped or failed.  variation : the noise or the target of a run that shows what hangs on
    rounding; empty for a plain one.
    """

    study: str
    question: str
    status: Status
    message: str
    checks: tuple[Judged, ...]
    notes: tuple[str, ...]
    display: dict[str, str]
    tables: tuple[str, ...]
    quick: bool
    date: str
    wall_s: float
    provenance: Provenance
    variation: str = ""

    @property
    def is_error(self) -> bool:
        """Whether this run is worse than what is recorded; of a variation, times are left aside."""
        judged = [judged for judged in self.checks if not (self.variation and judged.check.timed)]
        return self.status == "failed" or any(each.standing == "worse than recorded" for each in judged)

    def summary(self, left_out: Collection[str] = ()) -> str:
        """The run in a few words, e.g. ``4 met, 1 missed (recorded), 2 not checked``.

        left_out : see ``full_checks``.
        """
        if self.status != "finished":
            return self.status
        counts = Counter[str](judged.standing for judged in self.checks) + Counter({"not checked": len(left_out)})
        several = {"finding about the paper": "findings about the paper"}
        words = ((count, several.get(name, name) if count > 1 else name) for name, count in counts.items())
        return ", ".join(f"{count} {name}" for count, name in words) or "no checks"


def provenance() -> Provenance:
    """The code and the machine that this process runs on."""
    found = versions()
    commit = found.pop("commit", "unknown")  # outside a repository
    asked = ["git", "-C", str(ROOT), "diff", "--quiet", "HEAD"]
    if commit != "unknown" and subprocess.run(asked, env=environment_of_git()).returncode:
        commit += " with changes"
    return Provenance(commit, found, cpu_name(), cores())


def write(
    record: Record, tables: dict[str, pd.DataFrame], results: Path, inputs: Inputs | None = None,
    comparisons: Mapping[str, Comparison] = MappingProxyType({}),
) -> Path:  # fmt: skip
    """Store a run and its inputs as ``results/STUDY/``, replacing the one before; return the folder.

    A run that is interrupted leaves the earlier result or none, never half of one.  Raises InputError where the folder
    cannot be written.
    """
    folder = results / record.study
    with whole_folder(folder) as new:
        for name, table in tables.items():
            table.to_parquet(new / f"{name}.parquet", index=False)
        for name, comparison in comparisons.items():
            (new / f"{name}.json").write_text(comparison.model_dump_json(indent=1), encoding="utf-8")
        _write_verdict(record, new / "verdict.json")
        if inputs is not None:
            inputs.write(new)
    return folder


def judge_again(record: Record, recorded: Mapping[str, str], results: Path) -> Record:
    """The stored run compared with the present ``expected.toml``; stored again where that changes it."""
    checks = tuple(Judged(judged.check, recorded.get(judged.check.name)) for judged in record.checks)
    if checks == record.checks:
        return record
    judged_again = replace(record, checks=checks)
    with whole_file(results / record.study / "verdict.json") as scratch:
        _write_verdict(judged_again, scratch)
    return judged_again


_STORED: TypeAdapter[Record] = TypeAdapter(Record)


def read(folder: Path) -> Record:
    """The record stored in a result folder; OSError, ValueError, TypeError or LookupError where there is none."""
    stored = json.loads((folder / "verdict.json").read_text(encoding="utf-8"))
    # The stored verdicts are left aside, since they follow from value and bound.
    checks = [{"check": entry, "recorded": entry["recorded"]} for entry in stored["checks"]]
    found = _STORED.validate_python(stored | {"checks": checks})
    if lost := found.display.keys() - set(found.tables):
        raise ValueError(f"display names tables that are not there: {sorted(lost)}")
    return found


def unreadable(folder: Path, record: Record) -> str:
    """The first table of a record that is not there or whose file is cut short; empty where all can be read."""
    for name in record.tables:
        try:
            parquet.read_metadata(folder / f"{name}.parquet")
        except (OSError, ValueError):
            return name
    return ""


def read_tables(folder: Path, record: Record) -> dict[str, pd.DataFrame]:
    """The tables stored beside a record."""
    return {name: read_frame(folder / f"{name}.parquet") for name in record.tables}


def _write_verdict(record: Record, path: Path) -> None:
    text = json.dumps(_to_json(record), indent=2, ensure_ascii=False) + "\n"
    # A path in a message may hold bytes that are no UTF-8: their escape is JSON's as well.
    path.write_text(text, encoding="utf-8", errors="backslashreplace")


def _to_json(record: Record) -> dict[str, Any]:
    """The record as JSON can hold it: each check with its verdict, for readers of the file."""
    checks = [
        asdict(judged.check)
        | {
            "value": _number(judged.check.value),
            "bound": [_number(limit) for limit in judged.check.bound]
            if isinstance(judged.check.bound, tuple)
            else _number(judged.check.bound),
            "verdict": judged.check.verdict,
            "recorded": judged.recorded,
        }
        for judged in record.checks
    ]
    return asdict(record) | {"checks": checks}


def _number(value: float) -> float | str:
    """JSON has no word for nan and the infinities; ``float`` reads them back from text."""
    return float(value) if math.isfinite(value) else str(float(value))
