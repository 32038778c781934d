"""``fctd check``: numbers of the case as understood, in both unit systems; what does not fit; warnings."""

from pathlib import Path

import pytest

from tests.commands import Command

# A quarter circle of 286.48 m radius after 300 m: 90° in 450 m, 6°/30 m; 150 m horizontal.
CASE = """
name = "quarter"
[wellbore]
stations = [[0, 0, 0], [300, 0, 0], [750, 90, 0], [900, 90, 0]]
geometry = "arcs"
[[wellbore.intervals]]
name = "casing"
kind = "cased"
to_md = "600 m"
diameter = "8.681 in"
friction = 0.2
[[wellbore.intervals]]
to_md = "900 m"
diameter = "8.5 in"
friction = 0.3
[[string.components]]
name = "collars"
length = "100 m"
outer_diameter = "6.5 in"
inner_diameter = "3 in"
[[string.components]]
name = "pipe"
outer_diameter = "5 in"
inner_diameter = "4.276 in"
linear_mass = "30 kg/m"
[mud]
density = "785 kg/m^3"
"""


@pytest.fixture
def case_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("COLUMNS", "120")
    path = tmp_path / "quarter.toml"
    path.write_text(CASE)
    return path


def printed(cli: Command, case_file: Path, *more: str) -> str:
    """What ``fctd check`` prints, every run of blanks as one."""
    return " ".join(cli("check", case_file, *more).out.split())


def test_the_numbers(case_file: Path, cli: Command) -> None:
    """By hand: 300 m + radius deep, radius + 150 m away; 24 t of pipe and 13 t of collars, mud of a tenth of steel."""
    text = printed(cli, case_file)
    for line in (
        "total depth, measured 900.0 m (4 stations)",
        "true vertical depth 586.5 m",
        "departure 436.5 m",
        "greatest inclination 90.0 ° at 750 m",
        "greatest dog-leg 6.00 °/30 m from 300 to 750 m",
        "1: casing cased 0.0 600.0 220.5 0.2",
        "2 – 600.0 900.0 215.9 0.3",
        "pipe 0.0 800.0 235.4 211.8 46.7 44.5",
        "collars 800.0 900.0 129.7 116.7 27.7 25.4",
        "buoyancy factor 0.900",
        "string in air 365.1 kN",
        "string in mud 328.6 kN",
        "m with the bit at 900.0 m, by default short in bends and near the bit",
    ):
        assert line in text


def test_field_units(case_file: Path, cli: Command) -> None:
    text = printed(cli, case_file, "--units", "field")
    for line in (
        "total depth, measured 2952.8 ft",
        "greatest dog-leg 6.10 °/100 ft from 984 to 2461 ft",  # 6°/30 m
        "1: casing cased 0.0 1968.5 8.681 0.2",
        "mud density 6.551 ppg",
        "string in air 82.1 klbf",
    ):
        assert line in text


def test_what_does_not_fit_is_refused_below_the_tables(case_file: Path, cli: Command) -> None:
    printed = cli("check", case_file, "--set", "string.components[0].contact_diameter=8.6 in", code=2)
    assert "-1.27" in printed.out


def test_a_string_that_fits_where_its_operations_end_is_checked_there(case_file: Path, cli: Command) -> None:
    """Pipe of one segment is straight: with the bit at 390 m it ends at 290 m, above the bend at 300 m."""
    text = CASE.replace('length = "100 m"', 'length = "100 m"\nsegments = 10')
    text = text.replace('linear_mass = "30 kg/m"', 'linear_mass = "30 kg/m"\nsegments = 1')
    case_file.write_text(text)
    cli("check", case_file, code=2)
    operation = 'kind = "trip_in"\nfrom_md = 350\nto_md = {}\nspeed = 0.3\n'
    case_file.write_text(f"{text}[[operations]]\n{operation.format(390)}")
    assert "bit at 390.0" in printed(cli, case_file)
    case_file.write_text(f"{text}[[operations]]\n{operation.format(700)}")
    cli("check", case_file, code=2)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        (
            'outer_diameter = "5 in"\ninner_diameter = "4.276 in"\n'
            'joint = {length = "31 ft", tool_joint_length = "21 in", tool_joint_diameter = "9 in"}',
            'joint.tool_joint_diameter = "9 in": expected at most the hole\'s',
        ),
        (
            'pipe = "9 5/8 in 47 N-80 casing"',
            "N-80 casing\": expected a diameter of at most the hole's 220.497 mm (wellbore.intervals[0].diameter = "
            '"8.681 in"), not 269.875 mm',
        ),
        (
            'pipe = "5 in 19.5 S-135 NC50"\njoint = {tool_joint_diameter = "9 in"}',
            'tool_joint_diameter = "9 in": expected',
        ),
    ],
)
def test_what_is_wider_than_the_hole_is_named_by_the_key_that_was_written(
    keys: str, message: str, cli: Command, case_file: Path
) -> None:
    text = case_file.read_text().replace('outer_diameter = "5 in"\ninner_diameter = "4.276 in"', keys)
    case_file.write_text(text)
    assert message in cli("check", case_file, code=2).err


def test_the_flow_curve_and_its_misfit(case_file: Path, cli: Command) -> None:
    """Readings 60, 40, 8, 6 by RP 13D: yield stress 4 degrees of 0.511 Pa, index log2(56/36), 6 rev/min read 6.97."""
    more = ["--set", "mud.fann={600 = 60, 300 = 40, 6 = 8, 3 = 6}"]
    text = printed(cli, case_file, *more)
    assert all(value in text for value in ("2.04 Pa", "0.345 Pa·sⁿ", "index 0.637", "-1.0 degrees"))
    field = printed(cli, case_file, *more, "--units", "field")
    assert "4.27 lbf" in field
    assert "flow curve" not in printed(cli, case_file)


def test_segments_that_are_too_long_for_a_bend_are_noted(cli: Command, case_file: Path) -> None:
    cut = ("--set", "string.components[1].segment_length=60 m")
    said = cli("check", case_file, *cut).err
    assert "note: segments of 6" in said
    assert "leave out segments and segment_length there, or use shorter segments" in said
    assert "strict: notes are errors (sagitta)" in cli("check", case_file, *cut, "--strict", "--quiet", code=1).err
