"""The result of a simulation, and its folder: tables with case, versions and commit as metadata."""

from __future__ import annotations

import json
import os
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any
from uuid import uuid4

from fctd.case.errors import InputError
from fctd.case.input_file import check_regular
from fctd.case.input_warnings import InputWarning
from fctd.case.load import Case
from fctd.results.notes import Note, as_metadata, from_metadata
from fctd.results.status import RunStatus
from fctd.results.unit_systems import System, in_field_units
from fctd.store.origin import versions
from fctd.store.parquet import read_table
from fctd.store.tables import to_csv, to_parquet
from fctd.store.whole_file import check_file
from fctd.store.whole_folder import PAUSE, check_folder, repair, whole_folder

if TYPE_CHECKING:
    import pandas as pd

TABLES = ("history", "profile", "energy", "operations", "segments")
ATTEMPTS = 20  # to read a folder that another process may be replacing


def _no_rows() -> pd.DataFrame:
    import pandas as pd

    return pd.DataFrame(columns=[])


@dataclass(frozen=True)
class SimulationResult:
    """Outcome of ``fctd.simulate``.

    status : how the run ended; message : details, or empty.  history : a row per record
    interval; loads are means over the interval, depths and energies values at its end.  profile : a row per contact
    point from the top to the bit, for every recorded bit depth.  energy : the ledger, a row per record interval.  run :
    segments, step, counts and timing.  notes : warnings about the numbers, each code once, where it was worst.
    warnings : probable mistakes of the case.  operations : a row for each operation, with mean and swing of hook load
    and torque over whole periods (``fctd.results.swings``).  segments : a row per contact point at the records, every
    record of a short run and evenly chosen ones of a long run.  identity : of the run, the same in all of its files.
    """

    case: Case
    status: RunStatus
    message: str
    history: pd.DataFrame
    profile: pd.DataFrame
    energy: pd.DataFrame
    run: dict[str, Any]
    notes: tuple[Note, ...] = ()
    warnings: tuple[InputWarning, ...] = ()
    operations: pd.DataFrame = field(default_factory=_no_rows)
    segments: pd.DataFrame = field(default_factory=_no_rows)
    identity: str = field(default_factory=lambda: uuid4().hex)

    def save(self, folder: str | os.PathLike[str], csv: bool = False, units: System | None = None) -> list[Path]:
        """Write the tables of ``TABLES`` as the results in ``folder``; returns the files written.

        They take the place of an earlier run's tables all at once; other files in the folder stay.  units : of the CSV
        files, by default those of the case; the Parquet files are SI, as ``open_result`` reads them.  Raises InputError
        where the folder cannot be written.
        """
        folder = Path(folder)
        metadata = {
            "case": self.case.model_dump(mode="json"),
            "status": self.status,
            "message": self.message,
            "notes": as_metadata(self.notes),
            "warnings": [warning.as_metadata() for warning in self.warnings],
            "run": self.run,
            "versions": versions(),
            "identity": self.identity,
            "csv": csv,
        }
        with whole_folder(folder, own_files) as new:
            for name in TABLES:
                frame: pd.DataFrame = getattr(self, name)
                to_parquet(frame, new / f"{name}.parquet", metadata)
                if csv:
                    field = (units or self.case.system) == "field"
                    to_csv(in_field_units(frame) if field else frame, new / f"{name}.csv")
        return [folder / name for name in result_files(csv)]


def check_result_folder(folder: Path, csv: bool, key: str = "") -> None:
    """Repair a folder that a killed run left; raise InputError where ``SimulationResult.save`` could not replace it."""
    repair(folder, own_files)
    check_folder(folder, key)
    for name in result_files(csv):
        check_file(folder / name, key)


def result_files(csv: bool) -> list[str]:
    """Names of the files that ``SimulationResult.save`` writes."""
    return [f"{name}.{suffix}" for name in TABLES for suffix in (("parquet", "csv") if csv else ("parquet",))]


def own_files(folder: Path) -> set[str]:
    """Names of the files of an earlier run in a folder, which the next result replaces.

    A CSV file is one of them where the metadata of the tables says that their run wrote it; else it is the user's.
    """
    tables = [folder / name for name in result_files(csv=False)]
    csv = any(_metadata(path).get(b"csv") == b"true" for path in tables if path.is_file())
    return {name for name in result_files(csv) if (folder / name).is_file()}


def open_result(folder: str | os.PathLike[str], pause: float = PAUSE) -> SimulationResult:
    """The result that ``SimulationResult.save`` wrote into a folder; first completes a replacement that was killed.

    pause : between two attempts to read a folder that another process may be replacing [s].
    Raises InputError for a folder without a whole result, and for one whose tables come from different runs.
    """
    folder = Path(folder)
    for attempt in range(ATTEMPTS):
        repair(folder, own_files)
        try:
            return _read(folder)
        except InputError:
            if attempt == ATTEMPTS - 1:
                raise
            time.sleep(pause)
    raise AssertionError("the last attempt returns or raises")


def _read(folder: Path) -> SimulationResult:
    if not folder.is_dir():
        reason = "this is a file" if folder.exists() else "there is none"
        raise InputError(f"a folder that fctd simulate wrote ({reason})", value=folder)
    tables, origins = {}, {}
    for name, file in zip(TABLES, result_files(csv=False), strict=True):
        try:
            check_regular(folder / file)
            with (folder / file).open("rb") as source:
                table = read_table(source)
            tables[name], origins[name] = table.to_pandas(use_threads=False), table.schema.metadata or {}
        except InputError as error:
            raise error.in_file(folder / file) from None
        except (OSError, ValueError) as error:
            expected = f"a table that fctd simulate wrote ({getattr(error, 'strerror', None) or error})"
            raise InputError(expected, value=folder / file) from error
    # Another process may have given the folder's name to a new one between two tables.
    runs = {name: origin.get(b"identity", b"").decode() for name, origin in origins.items()}
    if len(set(runs.values())) > 1:
        found = ", ".join(f"{name}: {identity[:8] or 'none'}" for name, identity in runs.items())
        expected = f"tables of one run, found those of several ({found}): simulate the case again into this folder"
        raise InputError(expected, value=folder)
    origin = origins["history"]
    try:
        case = Case.model_validate_json(origin[b"case"])
        status, message, run = (origin[key].decode() for key in (b"status", b"message", b"run"))
        return SimulationResult(
            case,
            RunStatus(status),
            message,
            **tables,
            run=json.loads(run),
            notes=from_metadata(json.loads(origin[b"notes"])),
            warnings=tuple(InputWarning(**kept) for kept in json.loads(origin.get(b"warnings", b"[]"))),
            identity=runs["history"],
        )
    except (KeyError, TypeError, ValueError) as error:
        expected = f"the metadata that fctd simulate writes ({type(error).__name__}: {error})"
        raise InputError(expected, value=folder / "history.parquet") from error


def identity_of(folder: Path) -> str:
    """Identity of the run whose result is in a folder; empty where there is none."""
    return _metadata(folder / "history.parquet").get(b"identity", b"").decode()


def _metadata(path: Path) -> dict[bytes, bytes]:
    """Metadata of a Parquet file; empty for another file."""
    import pyarrow.parquet as pq

    try:
        return dict(pq.read_schema(path).metadata or {})
    except (OSError, ValueError):
        return {}
