"""Every option that takes a quantity, of every command, reads every spelling in one way."""

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any, get_type_hints

import numpy as np
import pytest
from typer.models import OptionInfo
from typer.testing import CliRunner

from fctd.case.errors import InputError
from fctd.case.units import FORCE, TORQUE
from fctd.cli.main import COMMANDS, app
from fctd.cli.quantities import QuantityOption, several
from fctd.results.unit_systems import System
from tests.cli.tiny import CASE

SYSTEMS: tuple[System, ...] = ("si", "field")
# Texts that are no quantities, by what the help calls them.
OTHERS = {
    "ADDRESS", "E", "ENDS", "FROM:TO", "KEY=HEADER", "KEY=VALUE", "KIND", "KINDS", "MD or NAME", "NAME",
    "NAME=MEAN+-SD", "NAME=VALUE", "NAME[=LOW:HIGH]", "QUANTITY", "QUANTITY=HEADER", "SHARE", "SIZE", "X",
    "X or LOW:HIGH", "X,Y[,COLUMN]",
}  # fmt: skip


def options() -> Iterator[tuple[str, OptionInfo, Any]]:
    """The options of all commands: the command's name, the option, and the type of its value."""
    for command in COMMANDS:
        function = getattr(import_module(f"fctd.cli.{command}"), f"{command}_command")
        for hint in get_type_hints(function, include_extras=True).values():
            for info in getattr(hint, "__metadata__", ()):
                if isinstance(info, OptionInfo):
                    yield command, info, hint.__origin__


def option_of(info: OptionInfo) -> QuantityOption | None:
    """The quantity that an option takes."""
    owner = getattr(info.parser, "__self__", None)
    return owner if isinstance(owner, QuantityOption) else None


QUANTITIES = [(command, found) for command, info, _ in options() if (found := option_of(info)) is not None]


def spellings(option: QuantityOption) -> Iterator[tuple[str, System, str | None]]:
    """Texts, the system of units in which they are typed, and the quantity that they are, None where it is refused."""
    for units in SYSTEMS:
        bare = option.kind.bare_unit(units)
        for text in ("25", "2.5e1", "+25", " 25 ", "25.0"):
            yield text, units, f"25 {bare}" if bare else None
        unit = bare or option.kind.dimension.units[0]
        for text in (f"25 {unit}", f"25{unit}", f"+25 {unit}", f"2.5e1 {unit}", f" 25  {unit} "):
            yield text, units, f"25 {unit}"
        grouped = (f"2,5 {unit}", f"1,500 {unit}", f"1 500 {unit}", f"1'500 {unit}", "1,500", "2,5", "1.500,5")
        for text in (*grouped, f"-25 {unit}", "-25"):
            yield text, units, None
        for text in ("", "nan", "inf", "25 apples", f"25 {unit} {unit} x", unit, "1e400", "2+3", "deep", "3 kg K"):
            yield text, units, None
    for unit in option.kind.dimension.units:
        small = f"0.001 {unit}"
        yield small, "si", small
        yield small, "field", small


@pytest.mark.parametrize(("command", "option"), QUANTITIES, ids=lambda value: getattr(value, "name", value))
def test_a_spelling_is_one_value_or_is_refused(command: str, option: QuantityOption) -> None:
    for text, units, wanted in spellings(option):
        given = option.parse(text)
        number, _, unit = (wanted or "").partition(" ")
        value = float(number) * option.kind.dimension.factor(unit) if wanted else np.nan
        if wanted is None or value > (option.at_most or np.inf):
            with pytest.raises(InputError) as refused:
                given.si(units)
            assert refused.value.key == option.name, text
            continue
        assert given.si(units) == pytest.approx(value, rel=1e-12), text
        assert several([given], units) == [given.si(units)]


def test_options_without_a_quantity_are_named() -> None:
    """A new option with a text is a quantity, or is called by what it is."""
    names = {option.name for _, option in QUANTITIES}
    texts = [
        (command, info) for command, info, of in options()
        if option_of(info) is None and info.parser is None and of in (str, str | None, list[str])
    ]  # fmt: skip
    assert {(command, info.metavar) for command, info in texts if info.metavar not in OTHERS} == set()
    assert not [command for command, info in texts if names & set(info.param_decls or ())]
    assert len(QUANTITIES) > 50


@pytest.mark.parametrize(("command", "default"), [("surge", "0.5 m/s"), ("hydraulics", "2.6 sg"), ("jar", "td")])
def test_help_has_the_default_as_it_may_be_typed(command: str, default: str) -> None:
    said = CliRunner().invoke(app, [command, "--help"], env={"COLUMNS": "200"}).output
    assert f"[default: {default}]" in said
    assert "QuantityOption" not in said


def test_loads_have_their_unit() -> None:
    loads = {option.name for _, option in QUANTITIES if option.kind.dimension in (FORCE, TORQUE)}
    assert {"--pull", "--torque", "--up", "--down", "--hookload", "--first-torque", "--first-hookload"} == loads


# What else a command needs.
NEEDED: dict[str, dict[str, str]] = {
    "chart": {"--operation": "trip_out", "--depths": "td"}, "compare": {"--depths": "td"}, "jar": {"--jar": "10 m"},
    "equilibrium": {"--operation": "trip_out", "--bit-depth": "td"},
    "hydraulics": {"--flow": "2000 L/min", "--penetration": "20"},
    "monitor": {"--chart": "a.png"},
}  # fmt: skip
BESIDE = {"compare": "well.toml", "monitor": str(Path(__file__).parents[2] / "examples" / "my_readings.csv")}


@pytest.mark.parametrize(
    ("command", "option"), [pair for pair in QUANTITIES if pair[0] not in {"uncertainty", "calibrate"}],
    ids=lambda value: getattr(value, "name", value),
)  # fmt: skip
def test_a_command_refuses_what_the_reader_refuses(
    command: str, option: QuantityOption, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Before anything is computed or written: a decimal comma, of an option that may be repeated too."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "well.toml").write_text(CASE)
    unit = option.kind.dimension.units[0]
    given = NEEDED.get(command, {}) | {option.name: f"1,5 {unit}"}
    texts = [text for pair in given.items() for text in pair]
    done = CliRunner().invoke(app, [command, "well.toml", *filter(None, [BESIDE.get(command)]), *texts])
    assert isinstance(done.exception, InputError), done.output
    assert done.exception.key == option.name
    assert f"'1.5 {unit}'" in str(done.exception)
    assert {path.name for path in tmp_path.iterdir()} == {"well.toml"}
