"""``fctd refine``: the table, the refined case file, exit codes."""

from pathlib import Path
from unittest.mock import Mock, patch

import pytest

import fctd
from fctd import InputError
from fctd.steady.balance import IN_THE_OPEN
from tests.cli.tiny import LEVEL
from tests.commands import Command

CASE = """
name = "tiny"  # mine
[wellbore]
survey = "hole.csv"
chord_tolerance = "50 mm"  # coarse
overlap = "0.1 m"  # ours
[[wellbore.intervals]]
to_md = "900 m"
diameter = "8.5 in"
friction = 0.2
[string]
[[string.components]]
name = "collar"
length = "300 ft"
outer_diameter = "6.5 in"
inner_diameter = "2.8125 in"
segments = 3
bend = "1 deg"
[[string.components]]
name = "pipe"
outer_diameter = "5 in"  # as on the rack
inner_diameter = "4.276 in"
segment_length = "40 m"
[mud]
density = "1.2 sg"
[[operations]]
kind = "trip_out"
from_md = "880 m"
to_md = "850 m"
speed = "0.2 m/s"
"""
HOLE = "md_m,inc_deg,azi_deg\n0,0,0\n100,0,0\n550,90,0\n900,90,0\n"


@pytest.fixture
def case_file(tmp_path: Path) -> Path:
    (tmp_path / "hole.csv").write_text(HOLE)
    path = tmp_path / "tiny.toml"
    path.write_text(CASE)
    return path


@pytest.mark.parametrize("graded", [False, True])
def test_the_case_is_written_as_the_user_has_it(graded: bool, case_file: Path, tmp_path: Path, cli: Command) -> None:
    out = tmp_path / "new" / "fine.toml"
    options = ("--tolerance", "2 %", "--friction", "0.3", "--set", "string.components[0].bend=", "--out", out)
    printed = cli("refine", case_file, *options, *(["--graded"] if graded else []), "--quiet")
    case = fctd.load_case(case_file, {"friction": 0.3, "string.components[0].bend": None})
    found = fctd.refine(case, 0.02, graded=graded)
    screen = printed.out
    assert "850.0 m" in screen
    cut = f"{found.segments} {found.layout} segments" if graded else f"{found.segments} segments"
    assert f"{cut}, from {found.shortest:.3g} m up" in screen
    assert found.layout == ("graded" if graded else "uniform")
    assert "A graded layout would save" not in screen
    assert f"{found.steps['hookload_N'].iloc[-1] / 1e3:.2f}" in screen

    text = out.read_text()
    written = fctd.load_case(out)
    assert f"{found.segments} {found.layout} segments,\n# an estimated error" in text
    assert "bend" not in text
    assert written.wellbore.intervals[0].friction == 0.3
    point, same = (fctd.equilibrium(c, "trip_out", 850.0) for c in (written, found.case))
    assert len(point.profile) == len(same.profile)
    assert point.hookload == pytest.approx(same.hookload, rel=1e-6)


def test_the_file_is_written_also_when_the_terminal_is_closed(
    case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    case_file.write_text(CASE, encoding="utf-8-sig")  # as some editors write
    monkeypatch.setattr("fctd.cli.options.screen.print", Mock(side_effect=SystemExit(1)))
    out = tmp_path / "fine.toml"
    cli("refine", case_file, "--tolerance", "20%", "--out", out, "--quiet", code=1)
    assert fctd.load_case(out).name == "tiny"


def test_a_message_says_that_grading_saves_nothing(case_file: Path, cli: Command) -> None:
    """A hole of constant curvature."""
    (case_file.parent / "hole.csv").write_text("md_m,inc_deg,azi_deg\n0,0,0\n900,90,0\n")
    options = ("--set", "string.components[0].bend=", "--tolerance", "3%", "--graded", "--quiet")
    screen = cli("refine", case_file, *options).out
    assert "uniform segments, from" in screen
    assert "A graded layout would save less than a tenth of the segments." in screen
    assert " graded " in screen


def test_several_operations_and_field_units(case_file: Path, cli: Command) -> None:
    kinds = ("--operation", "trip_in", "--operation", "rotate_off_bottom")
    screen = cli("refine", case_file, *kinds, "--bit-depth", "880 m", "--tolerance", "0.03", "--rpm", "80",
               "--units", "field", "--quiet").out  # fmt: skip
    assert "klbf" in screen
    assert "2887.1 ft" in screen
    assert screen.count("trip_in") == screen.count("rotate_off_bottom") > 3


def test_a_message_says_that_the_string_is_locked_up(case_file: Path, cli: Command) -> None:
    more = ("--operation", "trip_in", "--friction", "0.6", "--tolerance", "20%", "--no-resolve-buckling")
    assert "trip_in (locked up)" in cli("refine", case_file, *more, "--quiet").out


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "resolved"),
    [((), True), (("--no-resolve-buckling",), False), (("--set", "solver.buckling=detect"), False)],
)
def test_a_buckled_string_is_resolved_unless_the_user_says_otherwise(
    options: tuple[str, ...], resolved: bool, tmp_path: Path, cli: Command,
) -> None:  # fmt: skip
    """The buckled stretch keeps its own segments, and the file says so."""
    case_file, out = tmp_path / "level.toml", tmp_path / "fine.toml"
    case_file.write_text(LEVEL)
    kinds = ("--operation", "drill_sliding", "--bit-depth", "150", "--tolerance", "5%", "--most", "64", "--out", out)
    assert (
        "Its buckled stretch has segments that can bend as it does"
        in cli("refine", case_file, *kinds, *options, "--quiet", code=0 if resolved else 1).out
    ) == resolved
    if resolved:
        written = fctd.load_case(out)
        assert written.solver.buckling == "resolve"
        assert fctd.equilibrium(written, "drill_sliding", 150.0).shape == "helix"
    else:
        assert not out.exists()


def test_a_tolerance_out_of_reach_is_exit_code_1(case_file: Path, tmp_path: Path, cli: Command) -> None:
    out = tmp_path / "fine.toml"
    captured = cli("refine", case_file, "--tolerance", "1e-9", "--most", "100", "--out", out, code=1)
    assert "not_reached: an error of" in captured.err
    assert "tolerance 1e-07 %" in out.read_text()


def test_a_string_without_an_answer_is_exit_code_1_and_no_file(
    case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    monkeypatch.setattr("fctd.steady.attempts.IN_THE_OPEN", ((2, *IN_THE_OPEN[0][1:]),))
    out = tmp_path / "fine.toml"
    options = ("--most", "40", "--out", out, "--set", "contact.enabled=false")
    captured = cli("refine", case_file, *options, code=1)
    assert "no_answer: no string of" in captured.err
    assert "max_iterations" in captured.err
    assert "no answer" in captured.out
    assert not out.exists()


def test_a_range_of_counts_is_printed_and_drawn(case_file: Path, tmp_path: Path, cli: Command) -> None:
    pytest.importorskip("matplotlib")
    picture = tmp_path / "counts.svg"
    asked = ("--operation", "rotate_off_bottom", "--set", "string.components[0].bend=", "--tolerance", "3%", "--quiet")
    screen = cli("refine", case_file, *asked, "--segments", "10:80", "--plot", picture).out
    found = fctd.refine(
        fctd.load_case(case_file, {"string.components[0].bend": None}), 0.03, "rotate_off_bottom", segments="10:80"
    )
    counts = found.steps[found.steps["stage"] == "counts"]
    for layout, segments in counts[["layout", "segments"]].to_numpy():
        assert f" {segments} {layout} " in screen
    assert "observed order  " in screen
    assert "segments" in screen
    assert f"The default layout has {counts['segments'].iloc[-1]} segments, and an error of " in screen
    assert picture.read_text().startswith("<?xml")


def test_a_picture_alone_has_the_usual_range(case_file: Path, tmp_path: Path, cli: Command) -> None:
    pytest.importorskip("matplotlib")
    with patch("fctd.cli.refine.refine", side_effect=InputError("nothing", key="segments")) as asked:
        cli("refine", case_file, "--plot", tmp_path / "a.png", "--quiet", code=2)
    assert asked.call_args.kwargs["segments"] == "10:1000"
