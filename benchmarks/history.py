"""Records of releases: one readable file each in benchmarks/history/, and whether a record is comparable here."""

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
from fctd.store.origin import environment_of_git
from references.timing.stopwatch import cpu_name, machine

# Packages that compile the sources to machine code.
COMPILER = ("python", "numba", "llvmlite")
HISTORY = Path(__file__).parent / "history"

Cost = Annotated[float, Field(gt=0, allow_inf_nan=False)]


class Kernel(BaseModel):
    """One subject of a record: cost per unit, absolute and relative to the reference kernel in the same process.

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
    """Costs of a release, with machine, versions and sources.

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
    accepted: str = ""  # what became slower since the record before, and why this is the baseline all the same

    @property
    def ratios(self) -> Costs:
        """Ratio of every kernel to the reference kernel in each process; the reference's own is 1."""
        found = {name: list(kernel.samples) for name, kernel in self.kernels.items()}
        processes = max(len(taken) for taken in found.values())
        return {REFERENCE: [1.0] * processes} | found

    def not_here(self, reference: str, processor: str, versions: Mapping[str, str]) -> str:
        """Why ratios measured here are not comparable with this record; empty if they are."""
        if self.reference != reference:
            return "another reference kernel"
        if self.processor != processor:
            return f"another processor, {self.processor}"
        other = [name for name in COMPILER if self.versions.get(name) != versions.get(name)]
        return f"another {' and '.join(f'{name} {self.versions.get(name)}' for name in other)}" if other else ""


def processor() -> str:
    """Name of the processor and, since virtual machines hide it, the architecture for which code is compiled."""
    return f"{cpu_name()}, {llvmlite.binding.get_host_cpu_name()}"


def machine_versions() -> dict[str, str]:
    """Versions of everything timed, of the compiler, and the commit."""
    found = machine() | {"llvmlite": llvmlite.__version__}
    found.pop("processor")
    return found


def sources_of(root: Path) -> str:
    """Hash of the engine's sources in a checkout."""
    return sources_digest(root)


def record_of(costs: Costs, subjects: dict[str, Any], release: str, accepted: str = "") -> Record:
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
        kernels=kernels, accepted=accepted,
    )  # fmt: skip


def _round(value: float) -> float:
    """Rounded to five digits, for readable files."""
    return float(f"{value:.5g}")


def write(record: Record, folder: Path = HISTORY) -> Path:
    """Store a record; returns its file."""
    path = folder / f"{record.date:%Y-%m-%d}-{record.release}-{record.commit or 'unknown'}.json"
    folder.mkdir(parents=True, exist_ok=True)
    path.write_text(record.model_dump_json(indent=1) + "\n", encoding="utf-8")
    return path


def read(folder: Path = HISTORY) -> list[tuple[Path, Record]]:
    """All records with their files, oldest first; InputError for an invalid file or a missing folder."""
    if not folder.is_dir():  # without this check the gate would pass for want of a record
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
    """The newest record by the date inside, with which this run is compared; None without records."""
    records = read(folder)
    return records[-1] if records else None


def uncommitted() -> str:
    """Uncommitted changes in the folders that a record depends on, as git reports them; InputError without git."""
    try:
        done = subprocess.run(
            ["git", "-C", str(ROOT), "status", "--porcelain", "--", "fctd", "references", "benchmarks/*.py"],
            capture_output=True, text=True, check=True, env=environment_of_git(),
        )  # fmt: skip
    except (OSError, subprocess.SubprocessError):
        raise InputError("a checkout with its history: a record names its commit", key="git") from None
    return done.stdout.strip()
