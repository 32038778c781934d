"""What a simulation returns, and its files: Parquet tables that carry the case, versions and commit."""

import json
import platform
import subprocess
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

TABLES = ("history", "profile", "energy")


@dataclass(frozen=True)
class SimulationResult:
    """Outcome of ``fctd.simulate``.

    status : ``completed``, ``unstable``, ``unsettled`` or ``interrupted``; message says more when there is
    more to say.  history : a row per record interval; loads are means over the interval, depths and energies
    values at its end.  profile : a row per contact point from the top to the bit, for every recorded bit
    depth.  energy : the ledger, a row per record interval.  run : segments, step, counts and timing.
    """

    case: Case
    status: str
    message: str
    history: pd.DataFrame
    profile: pd.DataFrame
    energy: pd.DataFrame
    run: dict[str, Any]

    def save(self, folder: Path, csv: bool = False) -> list[Path]:
        """Write history, profile and energy tables into ``folder``; returns the files written."""
        folder.mkdir(parents=True, exist_ok=True)
        metadata = {
            "case": self.case.model_dump_json(),
            "status": self.status,
            "message": self.message,
            "run": json.dumps(self.run),
            "versions": json.dumps(versions()),
        }
        written = []
        for name in TABLES:
            frame: pd.DataFrame = getattr(self, name)
            table = pa.Table.from_pandas(frame, preserve_index=False)
            kept = {**(table.schema.metadata or {}), **{k.encode(): v.encode() for k, v in metadata.items()}}
            path = folder / f"{name}.parquet"
            pq.write_table(table.replace_schema_metadata(kept), path)
            written.append(path)
            if csv:
                path = folder / f"{name}.csv"
                frame.to_csv(path, index=False)
                written.append(path)
        return written


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
