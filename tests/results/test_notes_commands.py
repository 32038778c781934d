"""Notes of the commands: the same words on the screen, in rows and in files, and exit codes."""

import json
import re
from pathlib import Path

import pandas as pd
import pyarrow.parquet as pq
import pytest

from fctd import open_result
from fctd.results import notes
from tests.commands import run

CASE = """
name = "turn"
[wellbore]
stations = [[0, 0, 0], [600, 0, 0], [937.5, 90, 0], [1275, 90, 90], [1612.5, 90, 180], [1900, 90, 180]]
[[wellbore.intervals]]
to_md = "1900 m"
diameter = "12.25 in"
friction = 0.5
[[string.components]]
name = "casing"
outer_diameter = "9.625 in"
inner_diameter = "8.755 in"
segment_length = "12 m"
yield_strength = "130 MPa"
[mud]
density = 0
[[operations]]
kind = "rotate_off_bottom"
at_md = "1700 m"
duration = "2 ms"
rpm = 60
"""


def test_the_screen_has_a_line_for_every_note_and_stretch_of_depths(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    case, out = tmp_path / "turn.toml", tmp_path / "chart.csv"
    case.write_text(CASE)
    asked = ("--operation", "trip_out", "--depths", "500:1800:100", "--quiet")
    assert run(monkeypatch, "chart", case, *asked, "--out", out) == 0
    errors = capsys.readouterr().err
    table = pd.read_csv(out)
    with_yield = table["notes"].str.contains("yield")
    first = table["bit_depth_m"][with_yield].min()
    assert first > 600
    (line,) = [line for line in errors.splitlines() if "note yield" in line]
    headline, remedy = notes.MEANINGS["yield"]
    where = f"{first:g} to 1800 m ({with_yield.sum()} of 14)"
    assert line == f"trip_out: note yield at {where}: {headline}: {remedy}"
    assert json.loads((tmp_path / "chart.csv.json").read_text())["notes"]["yield"]["headline"] == headline

    assert run(monkeypatch, "chart", case, *asked, "--out", out, "--strict") == 1
    assert "strict: notes are errors (tensile_capacity, yield)" in capsys.readouterr().err
    assert pd.read_csv(out).equals(table)

    asked = ("--operation", "trip_out", "--bit-depth", "1800")
    assert run(monkeypatch, "equilibrium", case, *asked, "--strict", "--out", tmp_path / "strict.csv") == 1
    assert capsys.readouterr().err.splitlines()[-1].startswith("strict: notes are errors")
    assert (tmp_path / "strict.csv").exists()
    assert run(monkeypatch, "refine", case, *asked, "--tolerance", "20 %", "--quiet") == 0
    assert "note: " in capsys.readouterr().err
    assert run(monkeypatch, "refine", case, *asked, "--tolerance", "20 %", "--quiet", "--strict") == 1
    assert "strict: notes are errors" in capsys.readouterr().err
    # A string without a note is as before.
    light = ("--operation", "rotate_off_bottom", "--bit-depth", "500", "--friction", "0.1")
    assert run(monkeypatch, "equilibrium", case, *light, "--strict") == 0
    capsys.readouterr()

    assert run(monkeypatch, "equilibrium", case, *asked, "--out", tmp_path / "p.parquet") == 0
    lines = [line for line in capsys.readouterr().err.splitlines() if line.startswith("note: ")]
    kept = json.loads(pq.read_schema(tmp_path / "p.parquet").metadata[b"notes"])
    assert lines == [f"note: {note['text']}: {note['remedy']}" for note in kept]
    assert len(lines) == 2

    assert run(monkeypatch, "simulate", case, "--out", tmp_path / "run", "--quiet") == 1
    errors = capsys.readouterr().err
    assert errors.count("energy ledger") == 1
    assert errors.startswith("inaccurate: the energy ledger is off by")
    assert "\nnote: the stress at" in errors
    assert pq.read_schema(tmp_path / "run" / "history.parquet").metadata[b"status"] == b"inaccurate"
    kept = open_result(tmp_path / "run").notes
    assert {note.code for note in kept} >= {"ledger", "yield"}
    assert f"\nnote: {next(note for note in kept if note.code == 'yield')}" in errors

    assert run(monkeypatch, "simulate", case, "--out", tmp_path / "run", "--quiet", "--strict") == 1
    assert re.search(r"strict: notes are errors \(.*ledger.*\)", capsys.readouterr().err)
