"""What the page shows of a run in time: the records that it has kept so far, or its result.

This runs in the process of its own that worker.py is.
"""

from pathlib import Path
from typing import Any, Final

import pandas as pd

from fctd.app.charts import packed
from fctd.case.errors import InputError
from fctd.results.run_folder import numbered, run_path
from fctd.results.tables import open_result
from fctd.results.unit_systems import System, shown
from fctd.simulation.chunks import read_chunk

COLUMNS: Final = ("hookload_N", "surface_torque_N_m", "bit_depth_m")
MOST_POINTS: Final = 4_000  # of a curve


def records(folder: Path, target: str, shown_units: System) -> dict[str, Any]:
    """The curves of a run over time [s], and how many records they are of; target : the folder of its result."""
    history, status = _history(Path(target))
    step = max(len(history) // MOST_POINTS, 1)
    found = history.iloc[::step]
    curves = {name: packed(found[name].to_numpy(float) * shown(name, shown_units).factor) for name in COLUMNS}
    return {
        "time": packed(found["time_s"].to_numpy(float)), "curves": curves, "records": len(history), "status": status,
        "last": _last(history, shown_units),
    }  # fmt: skip


def _history(target: Path) -> tuple[pd.DataFrame, str]:
    """Records kept while a run lasts, or those of its result, and how it ended."""
    parts = []
    for name in numbered(run_path(target), "history.parquet").values():
        try:
            content = (run_path(target) / name).read_bytes()
            parts.append(read_chunk({"history": content})["history"].to_pandas())
        except (OSError, ValueError):  # removed, as the run has just ended
            parts = []
            break
    if parts:
        return pd.concat(parts, ignore_index=True), ""
    try:
        result = open_result(target, pause=0.0)
    except InputError:
        return pd.DataFrame(columns=["time_s", *COLUMNS]), ""
    message = f": {result.message}" if result.message else ""
    return result.history, f"{result.status}{message}"


def _last(history: pd.DataFrame, units: System) -> str:
    if not len(history):
        return ""
    row, words = history.iloc[-1], []
    for name, label in zip(COLUMNS, ("hook load", "torque", "bit at"), strict=True):
        factor, unit = shown(name, units)
        words.append(f"{label} {row[name] * factor:.1f} {unit}")
    return f"{row['time_s']:.0f} s: {', '.join(words)}"
