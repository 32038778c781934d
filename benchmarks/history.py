"""What releases cost: one readable file each in benchmarks/history/, and the question whether two may be compared."""

import statistics
import subprocess
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated, Any

import llvmlite.binding
from pydantic import AwareDatetime, BaseModel, ConfigDict, Field, ValidationError, computed_field

from benchmarks.measure import ROOT, Costs, ratios
from benchmarks.subjects import REFERENCE
from benchmarks.worker import reference_digest, sources_digest
from fctd.case.errors import MISSING, InputError
from references.timing.stopwatch import cpu_name, machine

# What turns the sources into machine code.
COMPILER = ("python", "numba", "llvmlite")
HISTORY = Path(__file__).parent / "history"

Cost = Annotated[float, Field(gt=0, allow_inf_nan=False)]


class Kernel(BaseModel):
    """One subject of a record: cost of a unit, absolute and over the reference kernel's in the same process.

    samples : the ratio in each process; ratio, spread : their median and range.
    """

    model_config = ConfigDict(frozen=True)

    unit: str
    size: str
    ns: float
    samples: Annotated[tuple[Cost, ...], Field(min_length=1)]

    @computed_field  # type: ignore[prop-decorator]
    @property
    def ratio(self) -> float:
        """Median of the samples."""
        return _round(statistics.median(self.samples))

    @computed_field  # type: ignore[prop-decorator]
    @property
    def spread(self) -> tuple[float, float]:
        """Least and largest sample."""
        return min(self.samples), max(self.samples)


class Record(BaseModel):
    """A release's costs, and what they depend on.

    sources, reference : hashes of the engine's sources and of the reference kernel.  reference_ns : cost of the
    reference kernel's column [ns].
    """

    model_config = ConfigDict(frozen=True)

    release: str
    date: AwareDatetime
    commit: Annotated[str, Field(pattern="^[0-9a-f]*$")]
    sources: str
    reference: str
    processor: str
    versions: dict[str, str]
    reference_ns: float
    kernels: Annotated[dict[str, Kernel], Field(min_length=1)]

    @property
    def ratios(self) -> Costs:
        """Ratio of every kernel to the reference kernel in each process; the reference's own is 1."""
        found = {name: list(kernel.samples) for name, kernel in self.kernels.items()}
        processes = max(len(taken) for taken in found.values())
        return {REFERENCE: [1.0] * processes} | found

    def not_here(self, reference: str, processor: str, versions: Mapping[str, str]) -> str:
        """Why ratios measured here do not compare with these; empty where they do."""
        if self.reference != reference:
            return "another reference kernel"
        if self.processor != processor:
            return f"another processor, {self.processor}"
        other = [name for name in COMPILER if self.versions.get(name) != versions.get(name)]
        return f"another {' and '.join(f'{name} {self.versions.get(name)}' for name in other)}" if other else ""


def processor() -> str:
    """The processor's name and, since clouds hide it, the architecture for which code is compiled."""
    return f"{cpu_name()}, {llvmlite.binding.get_host_cpu_name()}"


def machine_versions() -> dict[str, str]:
    """Versions of everything timed, of the compiler, and the commit."""
    found = machine() | {"llvmlite": llvmlite.__version__}
    found.pop("processor")
    return found


def sources_of(root: Path) -> str:
    """Hash of the engine's sources in a checkout."""
    return sources_digest(root)


def record_of(costs: Costs, subjects: dict[str, Any], release: str) -> Record:
    """The record of a measurement of these sources, now."""
    kernels = {
        name: Kernel(
            **subjects[name],
            ns=_round(statistics.median(costs[name])),
            samples=tuple(map(_round, samples)),
        )
        for name, samples in ratios(costs).items()
    }
    found = machine_versions()
    return Record(
        release=release, date=datetime.now(UTC).replace(microsecond=0), commit=found.pop("commit", ""),
        sources=sources_of(ROOT), reference=reference_digest(), processor=processor(),
        versions=found, reference_ns=_round(statistics.median(costs[REFERENCE])),
        kernels=kernels,
    )  # fmt: skip


def _round(value: float) -> float:
    """Five digits, which a reader can take in."""
    return float(f"{value:.5g}")


def write(record: Record, folder: Path = HISTORY) -> Path:
    """Keep a record; returns its file."""
    path = folder / f"{record.date:%Y-%m-%d}-{record.release}-{record.commit or 'unknown'}.json"
    folder.mkdir(parents=True, exist_ok=True)
    path.write_text(record.model_dump_json(indent=1) + "\n", encoding="utf-8")
    return path


def read(folder: Path = HISTORY) -> list[tuple[Path, Record]]:
    """All records with their files, the oldest first; InputError for a file that is none, or no folder."""
    if not folder.is_dir():  # a gate that compares with nothing passes
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


def last_release(folder: Path = HISTORY) -> tuple[Path, Record] | None:
    """The newest record by its own date: what this run is compared with."""
    records = read(folder)
    return records[-1] if records else None


def uncommitted() -> str:
    """What differs from the commit in the folders that a record speaks of; InputError without git."""
    try:
        done = subprocess.run(
            ["git", "-C", str(ROOT), "status", "--porcelain", "--", "fctd", "references", "benchmarks/*.py"],
            capture_output=True, text=True, check=True,
        )  # fmt: skip
    except (OSError, subprocess.SubprocessError):
        raise InputError("a checkout with its history: a record names its commit", key="git") from None
    return done.stdout.strip()
