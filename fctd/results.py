"""What a simulation returns, and the files of all results: tables that carry the case, versions and commit."""

import json
import platform
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numba
import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq

from fctd.case import Case
from fctd.notes import Note, as_metadata
from fctd.whole_file import whole_file

TABLES = ("history", "profile", "energy")


@dataclass(frozen=True)
class SimulationResult:
    """Outcome of ``fctd.simulate``.

    status : ``completed``, ``inaccurate`` (the energy ledger is off by more than a tenth of the work), ``unstable``,
    ``unsettled`` or ``interrupted``; message says more when there is more to say.  history : a row per record
    interval; loads are means over the interval, depths and energies values at its end.  profile : a row per contact
    point from the top to the bit, for every recorded bit depth.  energy : the ledger, a row per record interval.  run :
    segments, step, counts and timing.  notes : what to know before using the numbers, each code once, where it was
    worst.
    """

    case: Case
    status: str
    message: str
    history: pd.DataFrame
    profile: pd.DataFrame
    energy: pd.DataFrame
    run: dict[str, Any]
    notes: tuple[Note, ...] = ()

    def save(self, folder: Path, csv: bool = False) -> list[Path]:
        """Write history, profile and energy tables into ``folder``; returns the files written.

        Raises InputError where a file cannot be written.
        """
        metadata = {
            "case": self.case.model_dump_json(),
            "status": self.status,
            "message": self.message,
            "notes": as_metadata(self.notes),
            "run": self.run,
            "versions": versions(),
        }
        written = []
        for name in TABLES:
            frame: pd.DataFrame = getattr(self, name)
            path = folder / f"{name}.parquet"
            write_parquet(frame, path, metadata)
            written.append(path)
            if csv:
                path = folder / f"{name}.csv"
                write_csv(frame, path)
                written.append(path)
        return written


def write_table(frame: pd.DataFrame, path: Path, metadata: Mapping[str, Any]) -> list[Path]:
    """Write a table as CSV or Parquet, whichever the suffix says; returns the files written.

    Parquet carries the metadata itself; beside a CSV, which any reader must find a plain table, it goes into
    a JSON file of its own: ``chart.csv.json``.  Raises InputError where a file cannot be written.
    """
    if path.suffix.lower() == ".csv":
        beside = path.with_name(path.name + ".json")
        write_csv(frame, path)
        with whole_file(beside) as scratch:
            scratch.write_text(json.dumps(metadata, indent=1), encoding="utf-8")
        return [path, beside]
    write_parquet(frame, path, metadata)
    return [path]


def write_csv(frame: pd.DataFrame, path: Path) -> None:
    """Write a table as CSV, one row of headers."""
    with whole_file(path) as scratch:
        frame.to_csv(scratch, index=False)


def write_parquet(frame: pd.DataFrame, path: Path, metadata: Mapping[str, Any]) -> None:
    """Write a table, the metadata beside pandas' own: texts as they are, all else as JSON."""
    table = pa.Table.from_pandas(frame, preserve_index=False)
    kept = dict(table.schema.metadata or {})
    for key, value in metadata.items():
        kept[key.encode()] = (value if isinstance(value, str) else json.dumps(value)).encode()
    with whole_file(path) as scratch:
        pq.write_table(table.replace_schema_metadata(kept), scratch)


def versions() -> dict[str, str]:
    """Versions of the engine and of what its numbers depend on, and the commit of the checkout if any."""
    found = {"fctd": version("fctd"), "python": platform.python_version()}
    found |= {"numpy": np.__version__, "numba": numba.__version__}
    try:
        git = subprocess.run(
            ["git", "-C", str(Path(__file__).parent), "rev-parse", "--short", "HEAD"],
            capture_output=True, text=True, timeout=5, check=True,
        )  # fmt: skip
        found["commit"] = git.stdout.strip()
    except (OSError, subprocess.SubprocessError):
        pass  # an installed wheel has no checkout: the version stands alone
    return found
