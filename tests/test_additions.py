"""What is written once is added once: a result column by one line, in a copy of the package."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

from fctd.mechanics.compile_cache import STORE

ROOT = Path(__file__).parents[1]
WELL = """
name = "tiny"
[wellbore]
stations = [[0, 0, 0], [100, 0, 0], [550, 90, 0], [900, 90, 0]]
[[wellbore.intervals]]
to_md = 900
diameter = 0.2159
friction = 0.2
[string]
[[string.components]]
name = "pipe"
outer_diameter = 0.127
inner_diameter = 0.1086
segment_length = 40
"""


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """A folder with a copy of the package and a case."""
    shutil.copytree(ROOT / "fctd", tmp_path / "fctd", ignore=shutil.ignore_patterns("__pycache__"))
    (tmp_path / "well.toml").write_text(WELL)
    return tmp_path


def add_line(file: Path, after: str, line: str) -> None:
    """Add one line to a file below the one that reads so."""
    lines = file.read_text().splitlines()
    lines.insert(lines.index(after) + 1, line)
    file.write_text("\n".join(lines) + "\n")


def fctd(copy: Path, cache: Path, *arguments: str) -> str:
    """What the copy's command prints."""
    environment = os.environ | {"PYTHONPATH": str(copy), "NUMBA_CACHE_DIR": str(cache), "COLUMNS": "160"}
    done = subprocess.run(
        [sys.executable, "-m", "fctd", *arguments], cwd=copy, env=environment, capture_output=True, text=True
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_result_column_is_one_line(copy: Path) -> None:
    """It is in charts and their field units, on the screen and beside a profile."""
    add_line(
        copy / "fctd" / "results" / "columns.py",
        "LOADS: Final = (",
        '    Column("spare_N", "spare pull", 2, "spare", of=lambda point: 1e6 - point.hookload),',
    )
    assert STORE.folder is not None
    chart = ("chart", "well.toml", "--operation", "trip_out", "--depths", "500:800:300", "--units", "field")
    screen = fctd(copy, STORE.folder, *chart, "--out", "chart.csv")
    table = pd.read_csv(copy / "chart.csv")
    spare = 1e3 / 4.4482216152605 - table["hookload_klbf"]
    assert table["spare_klbf"].to_numpy() == pytest.approx(spare.to_numpy())
    assert "spare" in screen
    assert all(f"{value:.2f}" in screen for value in spare)
    assert "spare pull" in fctd(
        copy, STORE.folder, "equilibrium", "well.toml", "--operation", "trip_out", "--bit-depth", "800"
    )
