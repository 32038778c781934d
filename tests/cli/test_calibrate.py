"""``fctd calibrate``: what it prints and writes, and how it refuses."""

import json
import re
from pathlib import Path

import pytest

from fctd.case.load import load_case
from tests.calibration.test_calibrate import CASE
from tests.commands import Command

HANG = 500 * 30 * 9.80665e-3  # [kN]
ROWS = (
    "id,bit_depth_m,operation,rpm,hookload_low_kN,hookload_high_kN,torque_kN_m\n"
    f"turn,500,rotate_off_bottom,60,{HANG + 195},{HANG + 205},\n"
    "slips,,in_slips,,190,201,\n,,tare,60,,,1.5\n"
)


@pytest.fixture
def files(tmp_path: Path) -> tuple[Path, Path]:
    case, rows = tmp_path / "small.toml", tmp_path / "rows.csv"
    case.write_text(CASE, encoding="utf-8")
    rows.write_text(ROWS, encoding="utf-8")
    return case, rows


@pytest.mark.slow
def test_a_calibration_and_its_files(files: tuple[Path, Path], tmp_path: Path, cli: Command) -> None:
    out, table, plot = tmp_path / "new.toml", tmp_path / "rows_fitted.csv", tmp_path / "fit.png"
    options = ("--fit", "rig.block_weight", "--fit", "rig.torque_offset", "--starts", "1", "--quiet")
    printed = cli("calibrate", *files, *options, "--out", out, "--table", table, "--plot", plot).out
    for part in (
        "small: 3 rows fitted",
        "rig.block_weight",
        "profile (ranges)",
        "rig.torque_offset",
        "1.5",
        "Written:",
    ):
        assert part in printed
    assert load_case(out).rig.torque_offset == pytest.approx(1500.0, rel=1e-4)
    assert len(table.read_text(encoding="utf-8").splitlines()) == 4
    assert plot.read_bytes().startswith(b"\x89PNG")
    assert "inside the band of 50 %" in cli("predict", out, files[1]).out
    field = cli("predict", out, files[1], "--units", "field").out
    assert "hookload, klbf" in field
    assert "torque, kft·lbf" in field
    assert "kN" not in field


@pytest.mark.parametrize(
    ("rows", "options", "expected"),
    [
        (ROWS.replace("rotate_off", "rotat_off"), ("--fit", "friction"), "rows.csv: row 2, operation"),
        (ROWS.replace(",500,", ",900,"), ("--fit", "friction"), "row 2, bit_depth_m"),
        (ROWS.replace(",190,201", ",201,190"), ("--fit", "friction"), "row 3, hookload"),
        (ROWS, (), "--fit is missing: expected at least one unknown"),
        (ROWS, ("--fit", "frictn"), '--fit = "frictn": expected the unknown friction'),
        (ROWS, ("--fit", "friction", "--prior", "friction"), "--prior"),
        (ROWS, ("--fit", "rig.torque_offset", "--fit", "rig.torque_per_rpm"), "--fit"),
        (ROWS, ("--fit", "friction", "--setup", "none.toml"), "none.toml"),
        (ROWS, ("--fit", "friction", "--starts", "0"), "--starts"),
        (ROWS, ("--fit", "friction", "--out", "new.json"), "--out"),
        (ROWS, ("--fit", "friction", "--plot", "new.html"), "--plot"),
    ],
)
def test_wrong_inputs_end_with_exit_code_2(
    rows: str, options: tuple[str, ...], expected: str, files: tuple[Path, Path], cli: Command,
) -> None:  # fmt: skip
    files[1].write_text(rows, encoding="utf-8")
    assert expected in cli("calibrate", *files, *options, code=2).err


def test_the_files_that_it_reads_are_not_replaced(files: tuple[Path, Path], tmp_path: Path, cli: Command) -> None:
    setup = tmp_path / "setup.toml"
    setup.write_text('[sources.""]\nhookload_noise = "20 kN"\n', encoding="utf-8")
    for option, path in (("--table", files[1]), ("--out", setup)):
        before = path.read_bytes()
        options = ("--fit", "rig.block_weight", "--setup", setup, option, path)
        assert f'{option} = "{path}"' in cli("calibrate", *files, *options, code=2).err
        assert path.read_bytes() == before


def test_days_pumps_and_doubts_are_printed(
    files: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    rows = (
        "id,day,bit_depth_m,operation,rpm,hookload_kN,torque_kN_m,pumps,flow_L_min\n"
        f"a,Mon,500,rotate_off_bottom,60,{HANG + 200},,on,1800\nb,Mon,500,trip_in,,{HANG + 260},,,\n"
        f"c,Tue,400,rotate_off_bottom,60,{0.8 * HANG + 180},,off,\nd,Wed,,in_slips,,210,,,\n"
    )
    files[1].write_text(rows, encoding="utf-8")
    out = tmp_path / "new.toml"
    options = ("--fit", "rig.block_weight", "--starts", "1", "--quiet", "--out", out)
    printed = cli("calibrate", *files, *options)
    for part in ("scatter.hookload", "scatter of days", "(pumps on", "1800", "(pumps off)", "rows of its day",
                 "score of the 3 days"):  # fmt: skip
        assert part in " ".join(printed.out.split())
    assert "with care: b: a slack-off weight of" in printed.err
    assert "did not settle" not in printed.err
    cli("predict", out, files[1])
    table = tmp_path / "table.csv"
    monkeypatch.setattr("fctd.cli.job.warnings_of", lambda case: [])  # they would end it before
    strict = cli("calibrate", *files, *options, "--table", table, "--units", "field", "--strict", code=1)
    assert "strict: notes are errors (doubt, flow_absorbed, misfit)" in strict.err
    assert re.search(r"a slack-off weight of [\d.]+ klbf above the rotating weight of [\d.]+ klbf", strict.err)
    metadata = json.loads((tmp_path / "table.csv.json").read_text())
    assert metadata["case"]["name"]
    assert any(note.startswith("with care: b: a slack-off weight") for note in metadata["notes"])
    monkeypatch.setattr("fctd.calibration.scatter._CLOSE", 0.0)
    assert "the fit with scatter did not settle" in cli("calibrate", *files, *options).err
    printed = cli("calibrate", *files, *options, "--no-scatter", "--units", "field").out
    assert "scatter" not in printed
    assert "475.5" in printed  # gal/min
