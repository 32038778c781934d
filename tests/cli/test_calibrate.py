"""``fctd calibrate``: what it prints and writes, and how it refuses."""

from pathlib import Path

import pytest

from fctd.case.load import load_case
from tests.calibration.test_calibrate import CASE
from tests.cli.test_main import run

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


def test_a_calibration_and_its_files(
    files: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    out, table, plot = tmp_path / "new.toml", tmp_path / "rows_fitted.csv", tmp_path / "fit.png"
    options = ("--fit", "rig.block_weight", "--fit", "rig.torque_offset", "--starts", "1", "--quiet")
    assert run(monkeypatch, "calibrate", *files, *options, "--out", out, "--table", table, "--plot", plot) == 0
    printed = capsys.readouterr().out
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
    assert run(monkeypatch, "predict", out, files[1]) == 0
    assert "inside the band of 50 %" in capsys.readouterr().out
    assert run(monkeypatch, "predict", out, files[1], "--units", "field") == 0
    field = capsys.readouterr().out
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
    rows: str, options: tuple[str, ...], expected: str, files: tuple[Path, Path], monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    files[1].write_text(rows, encoding="utf-8")
    assert run(monkeypatch, "calibrate", *files, *options) == 2
    assert expected in capsys.readouterr().err


def test_the_files_that_it_reads_are_not_replaced(
    files: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    setup = tmp_path / "setup.toml"
    setup.write_text('[sources.""]\nhookload_noise = "20 kN"\n', encoding="utf-8")
    for option, path in (("--table", files[1]), ("--out", setup)):
        before = path.read_bytes()
        options = ("--fit", "rig.block_weight", "--setup", setup, option, path)
        assert run(monkeypatch, "calibrate", *files, *options) == 2
        assert f'{option} = "{path}": expected another file than {path}, which' in capsys.readouterr().err
        assert path.read_bytes() == before


def test_days_pumps_and_doubts_are_printed(
    files: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    rows = (
        "id,day,bit_depth_m,operation,rpm,hookload_kN,torque_kN_m,pumps,flow_L_min\n"
        f"a,Mon,500,rotate_off_bottom,60,{HANG + 200},,on,1800\nb,Mon,500,trip_in,,{HANG + 260},,,\n"
        f"c,Tue,400,rotate_off_bottom,60,{0.8 * HANG + 180},,off,\nd,Wed,,in_slips,,210,,,\n"
    )
    files[1].write_text(rows, encoding="utf-8")
    out = tmp_path / "new.toml"
    options = ("--fit", "rig.block_weight", "--starts", "1", "--quiet", "--out", out)
    assert run(monkeypatch, "calibrate", *files, *options) == 0
    printed = capsys.readouterr()
    for part in ("scatter.hookload", "scatter of days", "(pumps on", "1800", "(pumps off)", "rows of its day",
                 "score of the 3 days"):  # fmt: skip
        assert part in " ".join(printed.out.split())
    assert "with care: b: a slack-off of" in printed.err
    assert run(monkeypatch, "predict", out, files[1]) == 0
    capsys.readouterr()
    assert run(monkeypatch, "calibrate", *files, *options, "--no-scatter", "--units", "field") == 0
    printed = capsys.readouterr()
    assert "scatter" not in printed.out
    assert "475.5" in printed.out  # gal/min
