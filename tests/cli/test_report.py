"""``fctd report``: files, refusals before anything is computed, exit codes."""

import io
import sys
from pathlib import Path
from unittest.mock import Mock

import pytest

from fctd.case.load import load_case
from fctd.cli.report import _default_depths
from fctd.report import answers
from fctd.report.parts import Picture
from tests.cli.tiny import settings
from tests.commands import Command

calamine = pytest.importorskip("python_calamine")
SHORT = ("--operation", "trip_out,rotate_off_bottom", "--depths", "600:900:100", "--no-limits")


@pytest.fixture
def blank_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """The pictures of a report are a grey dot each: another test looks at them."""
    dot = io.BytesIO()
    pytest.importorskip("PIL.Image").new("L", (1, 1)).save(dot, "png")
    monkeypatch.setattr(Picture, "drawn", lambda *_, **__: dot.getvalue())


def sheet(path: Path, name: str) -> list[list[object]]:
    return calamine.CalamineWorkbook.from_filelike(io.BytesIO(path.read_bytes())).get_sheet_by_name(name).to_python()


@pytest.mark.slow
def test_without_a_name_all_three_files_are_written(
    case_file: Path, cli: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With the logo on each page."""
    monkeypatch.chdir(tmp_path)
    pytest.importorskip("PIL.Image").new("RGBA", (300, 100), (200, 30, 30, 128)).save("logo.png")
    said = cli("report", case_file, *SHORT, "--company", "C\n", "--by", "me", "--logo", "logo.png")
    files = [f"tiny-report{suffix}" for suffix in (".html", ".pdf", ".xlsx")]
    assert said.out.splitlines()[-1] == f"Written: {', '.join(files)}"
    assert b"data:image/png;base64," in (tmp_path / files[0]).read_bytes()
    assert all(page.images for page in pytest.importorskip("pypdf").PdfReader(files[1]).pages)
    assert ["company", "C\\n"] in [row[:2] for row in sheet(tmp_path / files[2], "Well")]


@pytest.mark.usefixtures("blank_pictures")
def test_the_chart_is_that_of_fctd_chart(case_file: Path, cli: Command, tmp_path: Path) -> None:
    """As its workbook has it, cell by cell."""
    report, chart = tmp_path / "r.xlsx", tmp_path / "c.xlsx"
    cli("report", case_file, *SHORT, "--units", "field", "--friction", "0.2,0.3", "--out", report)
    cli("chart", case_file, *SHORT[:-1], "--units", "field", "--friction", "0.2,0.3", "--out", chart)
    heads, *rows = sheet(chart, "table")
    (line, *_), _, _, given, *found = sheet(report, "Torque and drag")
    assert line.startswith("mud none (air); picking up ")
    names = [name for name in given if str(name).endswith(("(ft)", "(klbf)", "(kft·lbf)"))]
    assert len(names) == 4
    for name in names:
        expected = [row[heads.index(name)] for row in rows]
        assert len(expected) == 16
        assert [row[given.index(name)] for row in found[:16]] == pytest.approx(expected, rel=1e-12)


@pytest.mark.usefixtures("blank_pictures")
def test_measured_rows_stand_beside_the_chart(case_file: Path, cli: Command, tmp_path: Path) -> None:
    measured, report = tmp_path / "m.csv", tmp_path / "r.xlsx"
    measured.write_text("bit_depth_m,operation,hookload_kN\n700,trip_out,200\n")
    cli("report", case_file, *SHORT, "--measured", measured, "--out", report)
    rows = sheet(report, "Torque and drag")
    assert ["Measured rows"] in [row[:1] for row in rows]
    assert ["picking up", 700.0, 200.0, 200.0] in [row[:4] for row in rows]
    assert ["Loads over bit depth with measured points"] in [row[:1] for row in rows]


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (("--out", "r.doc"), "--out = \"r.doc\": expected a file name that ends in .html or .pdf or .xlsx"),
        (("--out", "r.pdf", "--out", "./r.pdf"), "a file of its own for each report"),
        (("--out", "logo.pdf", "--logo", "logo.pdf"), "another file than"),
        (("--logo", "logo.pdf"), "expected a PNG or JPEG of at most 4 MiB"),
        (("--logo", "none.png"), "that can be read (No such file or directory)"),
        (("--depths", "2 km"), "--depths"),
        (("--operation", "pull"), "operation"),
        (("--operation", "trip_in", "--rpm", "60", "--speed", "-1 m/s"), "--speed"),
        (("--measured", "none.csv"), "none.csv"),
        (("--flow", "1e9"), "--flow"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_before_anything_is_computed(
    options: tuple[str, ...], told: str, case_file: Path, cli: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(case_file.parent)
    Path("logo.pdf").write_bytes(b"no picture")
    monkeypatch.setattr(answers, "answer", Mock(side_effect=AssertionError))
    message = cli("report", case_file, *options, code=2).err
    assert told in message.replace("\n", " ")
    assert Path("logo.pdf").read_bytes() == b"no picture"
    assert {path.name for path in Path().iterdir()} == {case_file.name, "logo.pdf"}


@pytest.mark.parametrize(
    ("package", "suffix"), [("jinja2", ".html"), ("reportlab", ".pdf"), ("xlsxwriter", ".xlsx"), ("matplotlib", ".pdf")]
)
def test_a_missing_package_is_named(
    package: str, suffix: str, case_file: Path, cli: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, package, None)
    message = cli("report", case_file, "--out", case_file.with_suffix(suffix), code=2).err
    assert f"expected the package {package} for {suffix} (pip install {package}, or the extra fctd[report])" in message


@pytest.mark.slow
@pytest.mark.usefixtures("blank_pictures")
def test_rows_without_an_answer_are_exit_code_1_and_notes_only_where_strict(
    case_file: Path, cli: Command, tmp_path: Path
) -> None:
    out = ("--out", tmp_path / "r.xlsx")
    loads = settings("bit.weight_on_bit=120 kN", "rig.block_weight=500 kN")
    said = cli("report", case_file, "--operation", "drill_sliding", "--depths", "900", *loads, *out, code=1)
    assert "1 of 1 rows of the chart are under_resolved: the section Notes says why" in said.err
    noted = (
        "--operation",
        "trip_out",
        "--depths",
        "900",
        "--no-limits",
        *out,
        "--set",
        "rig.hoist_capacity=100 kN",
        "--set",
        "mud.density=1200",
    )
    cli("report", case_file, *noted)
    assert "strict: notes are errors (hoist, sagitta)" in cli("report", case_file, *noted, "--strict", code=1).err


def test_depths_by_default_are_round_and_end_at_the_bottom(case_file: Path) -> None:
    """From the last shoe, else from three tenths of the hole; in feet where they are asked for."""
    assert _default_depths(load_case(case_file), "si")[:2] == [270.0, 320.0]
    field = _default_depths(load_case("examples/my_well.toml"), "field")
    assert field[0] == 1500.0
    assert field[1] - field[0] == pytest.approx(500 * 0.3048)
    assert field[-1] == 3000.0
