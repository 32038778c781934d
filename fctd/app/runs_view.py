"""What the page shows of a run in time: the records that it has kept so far, or its result.

This runs in the process of its own that worker.py is.
"""

import tomllib
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Any, Final

import numpy as np
import pandas as pd

from fctd.app import scenes
from fctd.app.charts import packed
from fctd.case.errors import InputError
from fctd.case.load import Case, load_case
from fctd.case.operations import KINDS
from fctd.case.text import printable
from fctd.model.wellbore import Wellbore, build_wellbore
from fctd.results.tables import open_result
from fctd.results.unit_systems import System, shown
from fctd.simulation.chunks import HISTORY, NUMBER, SEGMENTS, read_chunk
from fctd.simulation.series import KEPT, SegmentSeries
from fctd.store import log
from fctd.store.run_folder import chunks_of, run_path
from fctd.view.quantities import quantity_of
from fctd.view.strings import of_records

COLUMNS: Final = ("hookload_N", "surface_torque_N_m", "bit_depth_m")
MOST_POINTS: Final = 4_000  # of a curve


def records(folder: Path, target: str, shown_units: System, colour: str = "side_force") -> dict[str, Any]:
    """The curves of a run over time [s], how many records they are of, and its string at the last kept record.

    target : the folder of its result, beside its case; colour : quantity by which the string is coloured.
    """
    history, segments, status = _kept(Path(target))
    step = max(len(history) // MOST_POINTS, 1)
    found = history.iloc[::step]
    curves = {name: packed(found[name].to_numpy(float) * shown(name, shown_units).factor) for name in COLUMNS}
    return {
        "time": packed(found["time_s"].to_numpy(float)), "curves": curves, "records": len(history), "status": status,
        "last": _told(Path(target), history, shown_units),
        "string": _string(Path(target), history, segments, shown_units, colour),
    }  # fmt: skip


def _kept(target: Path) -> tuple[pd.DataFrame, pd.DataFrame, str]:
    """Records and segments of a run's result, and how it ended; while it lasts, records kept so far and last segments.

    A run that was stopped has both: what it kept, to go on with, and its result, which is later.
    """
    with suppress(InputError):
        result = open_result(target, pause=0.0)
        message = f": {result.message}" if result.message else ""
        return result.history, result.segments, f"{result.status}{message}"
    path, none = run_path(target), pd.DataFrame()
    with suppress(OSError, ValueError):  # removed, as the run has just ended
        files = list(chunks_of(path).files.values())
        parts = [read_chunk(log.read(file, HISTORY))[HISTORY].to_pandas() for file in files]
        if parts:
            last = next(filter(None, (log.read(file, SEGMENTS) for file in reversed(files))), None)
            segments = none if last is None else _segments(read_chunk(last)[SEGMENTS], _hole(target)[1])
            return pd.concat(parts, ignore_index=True), segments, ""
    return pd.DataFrame(columns=["time_s", *COLUMNS]), none, ""


def _segments(table: Any, hole: Wellbore) -> pd.DataFrame:
    """The last record of a chunk's segments, as a result has it."""
    numbers = table.column(NUMBER).to_numpy()
    series, last = SegmentSeries(), numbers == numbers.max(initial=0)
    series.put_back(0, np.stack([table.column(name).to_numpy()[last] for name in KEPT], axis=1))
    return series.table(hole)


def _hole(target: Path) -> tuple[Case, Wellbore]:
    file = target.parent / "case.toml"
    return _hole_of(file, file.stat().st_mtime_ns)


@lru_cache(maxsize=2)
def _hole_of(file: Path, changed: int) -> tuple[Case, Wellbore]:
    case = load_case(file)
    return case, build_wellbore(case)


def _string(
    target: Path, history: pd.DataFrame, segments: pd.DataFrame, units: System, colour: str
) -> dict[str, Any] | None:
    """The string in its hole at the last record of its segments: the scene, when it is, and what is said of it."""
    if not len(segments) or not len(history):
        return None
    segments = segments[segments["time_s"] == segments["time_s"].max()]
    strings, quantity = of_records(*_hole(target), segments, history), quantity_of(colour)
    figure, _, times = scenes.skeletons(strings, quantity, units)
    changes, _, words = scenes.changes_of(strings, quantity, units, times, hole=True)
    for (*way, last), value in changes:
        place: Any = figure
        for key in way:
            place = place[key]
        place[last] = value
    (one,) = strings.snapshots
    return {"figure": figure, "where": f"{one.at:.0f} s, {KINDS[one.operation].label}", "words": words}


def _name(target: Path) -> str:
    """The name of the case that runs, which need not be the page's: another may have come since."""
    try:
        name = tomllib.loads((target.parent / "case.toml").read_text(encoding="utf-8")).get("name", "")
    except (OSError, ValueError):
        return ""
    return printable(str(name))


def _told(target: Path, history: pd.DataFrame, units: System) -> str:
    """The name of the case that runs, and the last record."""
    if not len(history):
        return ""
    row, words = history.iloc[-1], []
    for name, label in zip(COLUMNS, ("hook load", "torque", "bit at"), strict=True):
        factor, unit = shown(name, units)
        words.append(f"{label} {row[name] * factor:z.1f} {unit}")
    return ", ".join(filter(None, [_name(target), f"{row['time_s']:.0f} s: {', '.join(words)}"]))
