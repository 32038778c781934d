"""The shared cases, and functions to load them with changes."""

from pathlib import Path
from typing import Any

from fctd import Case, load_case

FOLDER = Path(__file__).parent


def load(name: str, **overrides: Any) -> Case:
    """A case of this folder by file name without suffix; ``__`` in a keyword stands for a dot."""
    changes = {key.replace("__", "."): value for key, value in overrides.items()}
    return load_case(FOLDER / f"{name}.toml", changes)


def rotation(at: float, duration: float, ramp: float, rpm: float = 60.0) -> list[dict[str, Any]]:
    """A schedule of one operation: rotate off bottom with the bit at ``at`` [m]."""
    kind = "rotate_off_bottom"
    return [{"kind": kind, "at_md": at, "duration": duration, "rpm": rpm, "ramp_time": ramp}]


def trip(start: float, end: float, speed: float, ramp: float) -> list[dict[str, Any]]:
    """A schedule of one operation: trip in or out from ``start`` to ``end`` [m]."""
    kind = "trip_in" if end > start else "trip_out"
    return [{"kind": kind, "from_md": start, "to_md": end, "speed": speed, "ramp_time": ramp}]
