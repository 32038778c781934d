"""A small well and sweeps of it, written as their files."""

import json
import textwrap
from pathlib import Path
from typing import Any

CASE = """
name = "small"
[wellbore]
stations = [[0, 0, 0], [200, 0, 0], [500, 45, 30], [900, 45, 30]]
[[wellbore.intervals]]
to_md = "400 m"
diameter = "9.625 in"
friction = 0.2
kind = "cased"
[[wellbore.intervals]]
to_md = "900 m"
diameter = "8.5 in"
friction = 0.3
kind = "open"
[[string.components]]
name = "collars"
length = "100 m"
outer_diameter = "6.5 in"
inner_diameter = "2.8 in"
segment_length = "25 m"
[[string.components]]
name = "pipe"
outer_diameter = "5 in"
inner_diameter = "4.276 in"
segment_length = "50 m"
[mud]
density = "1100 kg/m^3"
"""
PARAMETERS = """
[[parameters]]
key = "friction.open"
distribution = "normal"
mean = 0.3
sd = 0.05
low = 0.1
high = 0.5
[[parameters]]
key = "mud.density"
distribution = "uniform"
low = "1.0 sg"
high = "1.3 sg"
"""
WORK = """
[work]
operations = ["trip_out"]
depths = "600:900:100"
"""


def case_file(folder: Path, more: str = "") -> Path:
    """The well's file."""
    path = folder / "well.toml"
    path.write_text(CASE + textwrap.dedent(more), encoding="utf-8")
    return path


def sweep_file(
    folder: Path,
    head: str = 'method = "latin_hypercube"\nsamples = 12\n',
    body: str = PARAMETERS + WORK,
    case: str = "",
) -> Path:
    """A sweep of the small well, and its case; head, body : before and after its own lines."""
    case_file(folder, case)
    path = folder / "sweep.toml"
    path.write_text(f'name = "swept"\ncase = "well.toml"\nseed = 7\n{head}\n{body}', encoding="utf-8")
    return path


def about(folder: Path) -> dict[str, Any]:
    """What the dataset's folder says of itself."""
    found: dict[str, Any] = json.loads((folder / "sweep.json").read_text(encoding="utf-8"))
    return found
