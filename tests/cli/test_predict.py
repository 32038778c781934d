"""``fctd predict``: bands, tables, pictures, and a posterior that is not there."""

from pathlib import Path

import pandas as pd
import pytest

from tests.calibration.test_calibrate import CASE
from tests.cli.test_calibrate import ROWS
from tests.commands import Command


def test_rows_without_readings_have_bands_and_no_scores(tmp_path: Path, cli: Command) -> None:
    case, rows, plan = tmp_path / "small.toml", tmp_path / "rows.csv", tmp_path / "plan.csv"
    case.write_text(CASE, encoding="utf-8")
    rows.write_text(ROWS, encoding="utf-8")
    plan.write_text("id,bit_depth_m,operation\nlater,700,trip_out\n", encoding="utf-8")
    assert "small.fit.json" in cli("predict", case, plan, code=2).err
    new, out, plot = tmp_path / "new.toml", tmp_path / "bands.csv", tmp_path / "bands.png"
    cli("calibrate", case, rows, "--fit", "rig.block_weight", "--out", new, "--quiet")
    printed = cli("predict", new, plan, "--out", out, "--plot", plot).out
    assert "later" in printed
    assert "the band" not in printed
    table = pd.read_csv(out, keep_default_na=False)
    assert table["load"].tolist() == ["hookload", "torque"]
    assert table["inside95"].tolist() == ["", ""]
    hang = 700 * 30 * 9.80665  # [N]; the hole is vertical
    assert float(table["predicted"][0]) - hang == pytest.approx(200e3, rel=0.02)
    assert "rig.block_weight" in cli("predict", new, plan, "--set", "rig.block_weight=1 kN", code=2).err
    assert plot.read_bytes().startswith(b"\x89PNG")


def test_the_files_that_it_reads_are_not_replaced(tmp_path: Path, cli: Command) -> None:
    case, rows, kept = tmp_path / "small.toml", tmp_path / "rows.csv", tmp_path / "kept.csv"
    case.write_text(CASE, encoding="utf-8")
    for path in (rows, kept):
        path.write_text(ROWS, encoding="utf-8")
    for option in ([rows], [kept, "--posterior", rows]):
        assert f'--out = "{rows}"' in cli("predict", case, *option, "--out", rows, code=2).err
    assert rows.read_text(encoding="utf-8") == ROWS
