"""Options as the fields of a dataclass: what typer reads, and what an unfinished result keeps."""

import json
from dataclasses import dataclass, field, fields
from inspect import signature
from pathlib import Path
from typing import Annotated

import pytest
import typer
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.systems import SPEED
from fctd.cli.chart import ChartOptions, chart_command
from fctd.cli.keeping import SaveOptions
from fctd.cli.option_classes import beside, given_options, to_keep, with_options
from fctd.cli.quantities import Given, QuantityOption, quantity
from tests.commands import Command

SPEED_OPTION = QuantityOption("--speed", SPEED)


@dataclass(frozen=True)
class Inner:
    far: Annotated[bool, typer.Option("--far/--near")] = False


@dataclass(frozen=True, kw_only=True)
class Outer:
    case: Annotated[Path | None, typer.Argument(metavar="CASE")] = None
    names: Annotated[list[str], typer.Option("--name")] = field(default_factory=list)
    inner: Inner
    speed: Annotated[Given | None, quantity(SPEED_OPTION, "V", "Speed.")] = None
    quiet: Annotated[bool, typer.Option("--quiet")] = False


def test_fields_are_arguments_in_their_order() -> None:
    called = []

    @with_options
    def command(first: int, *, options: Outer, last: str = "x") -> None:
        called.append((first, options, last))

    found = signature(command).parameters
    assert list(found) == ["first", "case", "names", "far", "speed", "quiet", "last"]
    assert found["first"].default is found["first"].empty
    assert found["names"].default == []
    command(first=1, case=None, names=["a"], far=True, speed=None, quiet=True, last="y")
    assert called == [(1, Outer(names=["a"], inner=Inner(True), quiet=True), "y")]


@given(
    st.none() | st.sampled_from([Path("/a/b.toml"), Path("c")]), st.lists(st.text(max_size=3), max_size=2),
    st.none() | st.sampled_from(["1 m/s", "98.4 ft/min", "25"]),
)  # fmt: skip
def test_what_is_kept_comes_back_as_it_was_typed(case: Path | None, names: list[str], speed: str | None) -> None:
    """But a bare number has the unit that it had."""
    asked = None if speed is None else SPEED_OPTION.parse(speed)
    begun = Outer(case=case, names=names, inner=Inner(True), speed=asked, quiet=True)
    kept = json.loads(json.dumps(to_keep(begun, "field")))
    assert set(kept) == {"case", "names", "speed"}
    again = SPEED_OPTION.parse("25 ft/min") if speed == "25" else asked
    resumed = beside(Outer(inner=Inner()), kept)
    assert resumed == Outer(case=None if case is None else case.absolute(), names=names, inner=Inner(), speed=again)
    assert beside(Outer(names=["later"], inner=Inner()), kept).names == ["later"]
    assert {option for option, value in given_options(begun).items() if value is not None} == {
        option for option, value in (("CASE", case), ("--name", names), ("--speed", speed)) if value
    }


def test_a_chart_keeps_all_but_what_each_process_has() -> None:
    kept = set(to_keep(ChartOptions(keeping=SaveOptions()), "si"))
    assert kept == {of.name for of in fields(ChartOptions)} - {"keeping", "quiet"}
    assert kept | {of.name for of in fields(SaveOptions)} | {"quiet"} == set(signature(chart_command).parameters)


@pytest.mark.parametrize("option", [("--load", "string"), ("--strict",), ("--limits",)])
def test_a_resumed_chart_refuses_what_it_has_already(option: tuple[str, ...], cli: Command) -> None:
    assert f"{option[0]} = " in cli("chart", "--resume", "chart.csv", *option, code=2).err
