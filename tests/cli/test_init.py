"""``fctd init``: a case that the other commands take, of a template or of a survey; refusals."""

import re
import shlex
import tomllib
from pathlib import Path

import numpy as np
import pytest

import fctd
from fctd.model.templates import TEMPLATES
from tests.case.witsml_files import DAMAGED, PIPE, geometry, objects, section
from tests.commands import Command

SURVEY = "md_ft,inc_deg,azi_deg\n" + "".join(f"{100 * k},{min(max(k - 10, 0), 60)},{40 + k % 3}\n" for k in range(101))
METRIC = SURVEY.replace("md_ft", "md_m")
EXAMPLES = Path(__file__).parents[2] / "examples"
WITSML = [EXAMPLES / "my_survey.csv", "--string", EXAMPLES / "my_string.xml", "--hole", EXAMPLES / "my_hole.xml"]


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def advised(printed: str) -> list[list[str]]:
    """The commands that ``init`` names."""
    return [shlex.split(command) for command in re.findall(r"^(?:Next:)? +fctd (.*)$", printed, re.MULTILINE)]


@pytest.mark.parametrize("name", TEMPLATES)
def test_every_template_is_written(name: str, here: Path, cli: Command) -> None:
    cli("init", "--template", name, "--units", "field", "-o", "my.toml")
    case = fctd.load_case("my.toml")
    assert case.name == "my"
    assert all(part.cut_by_default for part in case.string.components)


@pytest.mark.parametrize("units", ["metric", "field"])
def test_the_commands_that_it_names_run(units: str, here: Path, cli: Command) -> None:
    """All but ``simulate``, which takes too long for a fast test."""
    commands = advised(cli("init", "--units", units).out)
    assert [command[0] for command in commands] == ["check", "chart", "equilibrium", "simulate"]
    assert "shoe:td:" in " ".join(commands[1])
    assert "segments of" in "".join(cli(*command).out for command in commands[:3])
    assert (here / "chart.csv").exists()


def test_the_case_of_a_survey(here: Path, cli: Command) -> None:
    (here / "surveys").mkdir()
    (here / "surveys" / "well ü.csv").write_text(SURVEY)
    cli("init", here / "surveys" / "well ü.csv", "--units", "field", "-o", "case/ü.toml")
    raw = tomllib.loads((here / "case" / "ü.toml").read_text(encoding="utf-8"))
    assert raw["wellbore"]["survey"] == "../surveys/well ü.csv"
    case = fctd.load_case("case/ü.toml")
    assert case.wellbore.trajectory[-1, 0] == pytest.approx(10_000 * 0.3048)
    # The build ends at 7000 ft; 95 % of 60° are reached at 6700 ft.
    assert raw["wellbore"]["intervals"][0]["to_md"] == "6700 ft"
    assert "assumed casing" in (here / "case" / "ü.toml").read_text(encoding="utf-8")
    point = fctd.equilibrium(case, "trip_out", "9000 ft")
    assert point.status == "converged"
    walls = point._shape.walls
    clearance = walls.radius - point._shape.radius
    deep = (np.linalg.norm(walls.offset, axis=1) - clearance) / clearance
    assert deep[:-1].max() < 0.01
    assert deep[-1] < 0.05  # the end, on which the assembly leans


@pytest.mark.parametrize(("units", "unit", "metre"), [("metric", "m", 1.0), ("field", "ft", 0.3048)])
def test_a_survey_without_a_unit_of_depth(
    units: str,
    unit: str,
    metre: float,
    here: Path,
    cli: Command,
) -> None:
    (here / "s.csv").write_text("DEPTH,DEVI,AZIM\n0,0,0\n500,0,0\n1000,40,10\n1500,40,10\n")
    cli("init", "s.csv", "--units", units)
    assert f'{{unit = "{unit}"}}' in (here / "my_well.toml").read_text(encoding="utf-8")
    assert fctd.load_case("my_well.toml").depths[1] == pytest.approx(1500 * metre, abs=0.01)


def test_a_unit_that_the_case_would_not_have(here: Path, cli: Command) -> None:
    """A survey whose headers and units disagree is refused, and not read in the units of the case."""
    rows = "".join(f"{k};{500 * k};{10 * k};45\n" for k in range(6))
    (here / "s.csv").write_text("Sta.;M.Depth;Inclin;Azim. Grid\n#;(ft);(deg);(deg)\n" + rows)
    cli("init", "s.csv", "--units", "metric")
    assert fctd.load_case("my_well.toml").depths[1] == pytest.approx(2500 * 0.3048, abs=0.01)
    (here / "s.csv").write_text("Sta.;MD (m);Inclin;Azim. Grid\n#;(ft);(deg);(deg)\n" + rows)
    cli("init", "s.csv", "--units", "field", "-o", "b.toml", code=2)


def test_columns_that_are_told(here: Path, cli: Command) -> None:
    rows = "".join(f"{k},{500 * k},{10 * k},45,90\n" for k in range(6))
    (here / "s.csv").write_text("Sta,Tiefe (m),Inc,Azi Grid,Azi True\n" + rows)
    assert "(for init: --columns 'azi=Azi Grid')" in cli("init", "s.csv", "--columns", "md=Tiefe (m)", code=2).err
    slip = cli("init", "s.csv", "--columns", "md=Tiefe", "--columns", "azi=Azi Gird", code=2).err
    assert 'columns.azi = "Azi Gird": expected the header "Azi Grid"' in slip
    told = ["--columns", "azi=azi grid", "--columns", "md=Tiefe", "--columns", "md.unit=feet"]
    cli("init", "s.csv", *told)
    hole = fctd.load_case("my_well.toml").wellbore
    assert hole.trajectory[-1] == pytest.approx([2500 * 0.3048, np.radians(50), np.radians(45)])


def test_the_warnings_of_check_are_told(here: Path, cli: Command) -> None:
    (here / "s.csv").write_text(
        "md_m,inc_deg,azi_deg\n" + "".join(f"{95 * k + k % 3 / 10},{k},40\n" for k in range(1, 30))
    )
    told = cli("init", "s.csv", "-q").err
    checked = cli("check", "my_well.toml", "-q").err
    assert checked.count("warning: ") == 2
    assert told.startswith(checked)


@pytest.mark.parametrize(("steepest", "pipe"), [(60, "drill collars"), (89, "drill collars")])
def test_the_string_follows_the_survey(steepest: int, pipe: str, here: Path, cli: Command) -> None:
    (here / "s.csv").write_text(f"md_m,inc_deg,azi_deg\n0,0,0\n500,0,0\n1000,{steepest},0\n1500,{steepest},0\n")
    assert ("horizontal well" in cli("init", "s.csv").out) == (steepest > 70)
    assert pipe in fctd.load_case("my_well.toml").string.components[0].name


def test_string_and_hole_of_files(here: Path, cli: Command) -> None:
    """What they lack is named with its line, and the commands that it names run once it is filled in."""
    told = cli("init", *WITSML)
    missing = re.fullmatch(
        r"fill in: my_well\.toml: line (\d+), string\.components\[6\]\.linear_mass: its mass with tool joints, .*\n",
        told.err,
    )
    assert missing is not None
    text = (here / "my_well.toml").read_text(encoding="utf-8")
    assert text.splitlines()[int(missing[1]) - 1].startswith('linear_mass = ""')
    refused = cli("check", "my_well.toml", code=2).err
    assert refused.startswith('my_well.toml: string.components[6].linear_mass = ""')
    (here / "my_well.toml").write_text(text.replace('linear_mass = ""', 'linear_mass = "49.3 lb/ft"'), encoding="utf-8")
    commands = [shlex.split(line.partition("fctd ")[2]) for line in told.out.splitlines() if "  fctd" in line]
    assert [command[0] for command in commands] == ["chart", "equilibrium", "simulate"]
    assert "143 segments" in cli("check", "my_well.toml").out
    cli(*commands[1])


def test_the_units_of_a_case_of_files(here: Path, cli: Command) -> None:
    told = cli("init", *WITSML, "--units", "field", "--quiet", "-o", "field.toml")
    assert told.out == ""
    assert "492.125984 ft" in told.err
    assert 'diameter = "8.681 in"' in (here / "field.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize(("kind", "text", "message"), [row[1:] for row in DAMAGED], ids=[row[0] for row in DAMAGED])
def test_a_damaged_file_is_refused(kind: str, text: str, message: str, here: Path, cli: Command) -> None:
    """One message with file, element and value, exit code 2, and no case."""
    (here / "w.xml").write_text(text, encoding="utf-8")
    (here / "s.csv").write_text(METRIC)
    told = cli("init", "s.csv", f"--{kind}", "w.xml", code=2)
    assert told.err.startswith(f"w.xml: {message}")
    assert len(told.err.splitlines()) == 1
    assert not (here / "my_well.toml").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["s.csv", "--string", "s.xml"], "--string-name is missing: expected the name of one tubular of the 2"),
        (["s.csv", "--string", "s.xml", "--string-name", "C"], '--string-name = "C": expected the name or the uid'),
    ],
)
def test_files_are_refused(arguments: list[str], message: str, here: Path, cli: Command) -> None:
    string = [(name, "B", {"tubularComponent": PIPE}) for name in "AB"]
    (here / "s.xml").write_text(objects("tubular", string), encoding="utf-8")
    (here / "narrow.xml").write_text(geometry([section("casing", 0, 3000, 6.184)]), encoding="utf-8")
    (here / "s.csv").write_text(METRIC)
    assert message in cli("init", *arguments, code=2).err
    assert not (here / "my_well.toml").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--out", "there.toml/my.toml"], '--out = "there.toml/my.toml": expected '),
        (["--template", "j-well"], "'j-well' is not one of 'build-hold', 'horizontal'"),
        (["--units", "ft"], '\'ft\': expected "si" or "metric" (m, kN'),
    ],
)
def test_refused(
    arguments: list[str],
    message: str,
    here: Path,
    monkeypatch: pytest.MonkeyPatch,
    cli: Command,
) -> None:
    (here / "there.toml").write_text("mine")
    (here / "far.csv").write_text("md_m,inc_deg,azi_deg\n0,0,0\n1e9,0,0\n")
    (here / "bad.csv").write_text("md_m,inc_deg,azi_deg\n0,0,0\n100,x,0\n")
    monkeypatch.setenv("COLUMNS", "200")
    assert message in " ".join(cli("init", *arguments, code=2).err.split())
    assert (here / "there.toml").read_text() == "mine"
    assert not (here / "my_well.toml").exists()


def test_quiet(here: Path, cli: Command) -> None:
    assert cli("init", "--quiet").out == ""
    assert (here / "my_well.toml").exists()
