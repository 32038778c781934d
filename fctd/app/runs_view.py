"""What the page shows of a run in time: the records that it has kept so far, or its result.

This runs in the process of its own that worker.py is.
"""

import tomllib
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

import pandas as pd

from fctd.app.charts import packed
from fctd.case.errors import InputError
from fctd.case.text import printable
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
        "last": ", ".join(filter(None, [_name(Path(target)), _last(history, shown_units)])) if len(history) else "",
    }  # fmt: skip


def _history(target: Path) -> tuple[pd.DataFrame, str]:
    """Records of a run's result, and how it ended; while it lasts, those that it has kept.

    A run that was stopped has both: what it kept, to go on with, and its result, which is later.
    """
    with suppress(InputError):
        result = open_result(target, pause=0.0)
        message = f": {result.message}" if result.message else ""
        return result.history, f"{result.status}{message}"
    parts = []
    for name in numbered(run_path(target), "history.parquet").values():
        try:
            content = (run_path(target) / name).read_bytes()
            parts.append(read_chunk({"history": content})["history"].to_pandas())
        except (OSError, ValueError):  # removed, as the run has just ended
            parts = []
            break
    return pd.concat(parts, ignore_index=True) if parts else pd.DataFrame(columns=["time_s", *COLUMNS]), ""


def _name(target: Path) -> str:
    """The name of the case that runs, which need not be the page's: another may have come since."""
    try:
        name = tomllib.loads((target.parent / "case.toml").read_text(encoding="utf-8")).get("name", "")
    except (OSError, ValueError):
        return ""
    return printable(str(name))


def _last(history: pd.DataFrame, units: System) -> str:
    row, words = history.iloc[-1], []
    for name, label in zip(COLUMNS, ("hook load", "torque", "bit at"), strict=True):
        factor, unit = shown(name, units)
        words.append(f"{label} {row[name] * factor:z.1f} {unit}")
    return f"{row['time_s']:.0f} s: {', '.join(words)}"
