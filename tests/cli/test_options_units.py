"""The system of units that a case names, of every command that takes --units."""

from importlib import import_module
from inspect import signature
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

import fctd
from fctd.case.errors import InputError
from fctd.case.load import load_case, read_raw
from fctd.cli.main import COMMANDS, app
from fctd.model.new_case import from_template
from fctd.model.templates import TEMPLATES
from fctd.results.differences import differences
from fctd.sweep.dataset import identity_of
from fctd.sweep.spec import read_sweep
from fctd.sweep.template import Template
from tests.cli.test_quantities import BESIDE, NEEDED
from tests.cli.tiny import CASE

FIELD = f'units = "field"\n{CASE}'
SWEEP = """
name = "sweep"
case = "well.toml"
method = "latin_hypercube"
samples = 2
[[parameters]]
key = "friction"
distribution = "uniform"
low = 0.1
high = 0.2
[work]
kind = "chart"
operations = ["trip_in"]
depths = "td"
"""
# Of what these show no case is the source.
WITHOUT_CASE = ("init", "pipes")
TAKING = [
    name
    for name in COMMANDS
    if name not in WITHOUT_CASE
    and "units" in signature(getattr(import_module(f"fctd.cli.{name}"), f"{name}_command")).parameters
]
MORE = {
    "calibrate": ["rows.csv"], "predict": ["rows.csv"], "compare": ["well.toml"], "uncertainty": [],
    "monitor": [BESIDE["monitor"]],
}  # fmt: skip


@pytest.fixture
def well(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A case that names field units, in the current folder, beside a sweep of it."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sweep.toml").write_text(SWEEP)
    path = tmp_path / "well.toml"
    path.write_text(FIELD)
    return path


def units_of(name: str, *more: str, monkeypatch: pytest.MonkeyPatch) -> Any:
    """The units in which a command is run, which itself does nothing."""
    found: dict[str, Any] = {}
    command = app_command(name)
    monkeypatch.setattr(command, "callback", lambda **options: found.update(options))
    first = "sweep.toml" if name == "uncertainty" else "well.toml"
    needed = [text for pair in NEEDED.get(name, {}).items() for text in pair]
    command.main([first, *MORE.get(name, []), *needed, *more], standalone_mode=False)
    return found["units"]


def app_command(name: str) -> Any:
    return import_module("fctd.cli.main")._command(name)


@pytest.mark.parametrize("name", TAKING)
def test_a_command_has_the_units_of_its_case(name: str, well: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """--units wins, --set changes them where a command has it, and without any they are SI."""
    assert units_of(name, monkeypatch=monkeypatch) == "field"
    assert units_of(name, "--units", "si", monkeypatch=monkeypatch) == "si"
    if any("--set" in option.opts for option in app_command(name).params):
        assert units_of(name, "--set", "units=si", monkeypatch=monkeypatch) == "si"
    well.write_text(CASE)
    assert units_of(name, monkeypatch=monkeypatch) == "si"
    assert units_of(name, "--units", "field", monkeypatch=monkeypatch) == "field"


@pytest.mark.parametrize(("word", "system"), [("metric", "si"), ("SI", "si"), (" Field ", "field")])
def test_the_key_takes_the_words_of_the_option(
    word: str, system: str, well: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert units_of("check", "--units", word, monkeypatch=monkeypatch) == system
    well.write_text(FIELD.replace('"field"', f'"{word}"'))
    assert units_of("check", monkeypatch=monkeypatch) == system
    assert load_case(well).system == system
    with pytest.raises(InputError, match='units = "imperial": expected "si" or "metric"'):
        load_case(well, {"units": "imperial"})


def test_units_below_a_table_are_sent_to_the_top(well: Path) -> None:
    well.write_text(CASE + '\nunits = "field"\n')
    with pytest.raises(InputError, match=r'units = "field": expected it above the first table of the case file$'):
        load_case(well)


def test_most_commands_take_units() -> None:
    assert len(TAKING) > 15


STEADY = ("--operation", "trip_in")


@pytest.mark.parametrize(
    "arguments",
    [
        ("check",), ("chart", *STEADY, "--depths", "100:td:100", "--out", "out.csv"),
        ("equilibrium", *STEADY, "--bit-depth", "td", "--out", "out.csv"),
        ("limits", *STEADY, "--depths", "td", "--out", "out.csv"),
        ("chart", *STEADY, "--depths", "9000"), ("equilibrium", *STEADY, "--bit-depth", "9000"),
    ],
)  # fmt: skip
def test_screen_files_and_refusals_are_those_of_the_option(arguments: tuple[str, ...], well: Path) -> None:
    command, *more = arguments
    said = []
    for text, units in ((FIELD, []), (CASE, ["--units", "field"])):
        well.write_text(text)
        done = CliRunner().invoke(app, [command, "well.toml", *more, *units])
        out = Path("out.csv")
        said.append((done.exit_code, done.output, str(done.exception), out.read_bytes() if out.exists() else b""))
    assert said[0] == said[1]
    assert " ft" in said[0][1] + said[0][2]


def test_an_invalid_case_is_refused_in_its_units(well: Path) -> None:
    well.write_text(FIELD + "[[wellbore.intervals]]\nto_md = 1\ndiameter = 0.2\nfriction = 0.2\n")
    one, other = (CliRunner().invoke(app, ["check", "well.toml", *more]) for more in ([], ["--units", "field"]))
    assert str(one.exception) == str(other.exception)
    assert " ft" in str(one.exception)


def test_units_of_display_do_not_count_in_a_case(well: Path) -> None:
    cases = [load_case(well, {"units": units}) for units in ("field", "si", None)]
    assert len({case.digest for case in cases}) == 1
    assert differences(cases) == []
    identities = set()
    for text in (CASE, FIELD):
        well.write_text(text)
        spec = read_sweep(Path("sweep.toml"))
        identities.add(identity_of(Template(spec, read_raw(well), load_case(well), {})))
    assert len(identities) == 1
    assert [case.system for case in cases] == ["field", "si", "si"]
    assert load_case(cases[0], {"name": "b"}).units == "field"
    assert "units" not in cases[2].model_dump()


def test_a_new_case_in_field_units_names_them() -> None:
    template = TEMPLATES["build-hold"]
    assert 'units = "field"' in from_template(template, "a", "field").text()
    assert "units =" not in from_template(template, "a", "si").text()


def test_python_shows_a_case_in_its_units(well: Path) -> None:
    case = load_case(well)
    made = fctd.chart(case, "trip_in", "td")
    assert made.units == fctd.compare([made, made]).units == "field"
    assert fctd.chart(case, "trip_in", "td", units="si").table.columns.tolist() == made.rows.columns.tolist()
    assert fctd.check_case(case).facts["departure"].endswith(" ft")
    assert "klbf" in fctd.equilibrium(case, "trip_in", "td")._repr_html_()
