"""``python -m references methods``: tables, files, exit codes."""

import json
import re
from pathlib import Path
from typing import Any

import pandas as pd
import pytest

import fctd
from fctd.arena.result import Comparison, Row
from fctd.cli import job
from fctd.cli.options import Terminal
from fctd.store.parquet import read_frame
from references.methods import command, tables
from references.methods.window import in_arcs
from tests.references.methods.planted import plant
from tests.references.test_command_line import call
from tests.references.wells import STATIONS
from tests.report.test_html_file import Cells

ARGUMENTS = ("--quick", "--quiet", "--contact", "arcs", "--contact", "leaning")


WELL = """
name = "a bent well"
[wellbore]
stations = {stations}
intervals = [{{ to_md = "240 m", diameter = "8.5 in", friction = 0.2 }}]
[string]
components = [{{ name = "pipe", outer_diameter = "5 in", inner_diameter = "4.276 in", segment_length = "20 m" }}]
[mud]
density = "1.2 sg"
viscosity = 0
[[operations]]
kind = "rotate_off_bottom"
at_md = "200 m"
duration = "5 s"
rpm = 60
"""


@pytest.fixture
def case(tmp_path: Path) -> Path:
    """A file of the well."""
    file = tmp_path / "well.toml"
    file.write_text(WELL.format(stations=STATIONS), encoding="utf-8")
    return file


def test_planted_faults_stand_in_the_tables(
    case: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    plant(monkeypatch)
    assert call(monkeypatch, "methods", case, *ARGUMENTS, "--engine", "slippery") == 1
    printed, told = capsys.readouterr()
    (wall,) = (line for line in printed.splitlines() if line.split()[:2] == ["leaning", "BROKEN"] and " 3 " in line)
    assert wall
    assert "leaning: breaks the contract of contact methods: Penetration and normal" in told
    # A tenth less friction, which presses the string the less up the wall: N grows by half a percent.
    assert re.search(r"engine slippery: torque 9\.\d % below that of engine fctd", told)
    assert "8 torsional periods of 0.25" in printed  # 2 s


@pytest.mark.parametrize("suffix", ["csv", "parquet", "json"])
def test_a_file_has_all_rows(suffix: str, case: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = tmp_path / f"compared.{suffix}"
    assert call(monkeypatch, "methods", case, "--quick", "--quiet", "--contact", "arcs", "--out", out) == 0
    if suffix == "json":
        found = Comparison.model_validate_json(out.read_text())
        assert [row.label for row in found.rows] == ["engine fctd", "arcs"]
        assert len(found.md_m) == 10
        return
    table: pd.DataFrame = pd.read_csv(out) if suffix == "csv" else read_frame(out)
    assert table["setting"].to_list() == ["engine fctd", "arcs"]
    assert table["hookload_N"].notna().all()
    if suffix == "csv":
        assert json.loads(out.with_name("compared.csv.json").read_text())["window"]["whole"] == 8


def test_pictures_and_a_range_of_counts(
    case: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    plot, out = tmp_path / "compared.png", tmp_path / "compared.json"
    arguments = ("--quick", "--quiet", "--contact", "arcs", "--contact", "cylinders", "--segments", "8:64")
    page = tmp_path / "compared.html"
    assert call(monkeypatch, "methods", case, *arguments, "--plot", plot, "--out", out, "--page", page) == 0
    assert min(path.stat().st_size for path in (plot, tmp_path / "compared_segments.png")) > 10_000
    found = Comparison.model_validate_json(out.read_text())
    assert found.counts is not None
    same = fctd.refine(in_arcs(fctd.load_case(case)), 0.01, "rotate_off_bottom", segments="8:64")
    told = [row["hookload_N"] for row in found.counts.steps]
    assert told == pytest.approx(same.steps.loc[same.steps["stage"] == "counts", "hookload_N"].tolist(), rel=1e-9)
    screen = capsys.readouterr().out
    assert f"The default layout has {found.counts.steps[-1]['segments']} segments" in screen
    assert "observed order" in screen
    shown = Cells(page.read_text(encoding="utf-8"))
    assert {f"{row['segments']} {row['layout']}" for row in found.counts.steps} <= {row[0] for row in shown.rows}
    assert sum(address.startswith("data:") for address in shown.addresses) == 2


def test_a_picture_and_a_page_are_written(case: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plot, page = tmp_path / "compared.png", tmp_path / "compared.html"
    arguments = ("--quick", "--quiet", "--contact", "arcs", "--contact", "cylinders")
    assert call(monkeypatch, "methods", case, *arguments, "--plot", plot, "--page", page) == 0
    assert plot.stat().st_size > 10_000
    assert "cylinders" in page.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("arguments", "code", "expected"),
    [
        (("--contact", "arx"), 2, "arcs"),
        (("--operation", "9"), 2, "from 1 to 1"),
        (("--out", "table.txt"), 2, ".csv or .parquet or .json"),
        (("--page", "page.pdf"), 2, ".html"),
        (("--budget", "0"), 2, "--budget"),
        (("--segments", "10:20"), 2, '--segments = "10:20": expected FROM:TO'),
        (("--contact", "absent", "--quick", "--quiet"), 1, "No module named 'no_such_module'"),
    ],
)
def test_exit_codes(
    arguments: tuple[str, ...], code: int, expected: str, case: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    plant(monkeypatch, absent="no_such_module:Absent")
    assert call(monkeypatch, "methods", case, *arguments) == code
    message = capsys.readouterr().err
    assert expected in message
    assert "Traceback" not in message


def test_an_interruption_prints_what_is_there(
    case: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    real = command.compare_methods

    def stopped(*arguments: Any, **options: Any) -> Comparison:
        def progress(what: str, done: float, total: float) -> None:
            if what == "cost of a point":
                raise KeyboardInterrupt

        return real(*arguments, **(options | {"progress": progress}))

    monkeypatch.setattr(command, "compare_methods", stopped)
    out = tmp_path / "compared.json"
    assert call(monkeypatch, "methods", case, "--quick", "--quiet", "--contact", "arcs", "--out", out) == 130
    printed = capsys.readouterr()
    assert "interrupted after" in printed.out
    assert "arcs: no loads: interrupted" in printed.err
    assert Comparison.model_validate_json(out.read_text()).interrupted


def test_what_is_broken_is_struck_through(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.delenv("NO_COLOR", raising=False)
    shown = Terminal()
    monkeypatch.setattr(job, "screen", shown)
    rows = [Row(kind="contact", name="sound", status="measured", broken=[]),
            Row(kind="contact", name="wrong", status="measured", broken=["it is wrong"])]  # fmt: skip
    with shown.capture() as printed:
        job.print_table(tables.verdicts(rows))
    lines = printed.get().splitlines()
    assert ["\x1b[9m" in line for line in lines if "sound" in line or "wrong" in line] == [False, True]
