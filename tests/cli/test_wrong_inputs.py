"""Wrong inputs from end to end: none is silent, and each message names file, key, value and what was expected."""

import json
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
import typer

import fctd
from fctd.case.errors import InputError
from fctd.case.raw_case import apply_override
from fctd.cli import main
from fctd.cli.options import BAD_INPUT, FAILED
from tests.cli.doubted_inputs import DOUBTED, DOUBTED_TOGETHER
from tests.cli.wrong_inputs import CASE, OPTIONS, REFUSED, REFUSED_TOGETHER
from tests.strategies import write_case

COMMANDS = typer.main.get_command(main.app)  # making it takes as long as a refusal


def present(value: Any) -> Any:
    """A case without the keys that are None."""
    if isinstance(value, Mapping):
        return {key: present(item) for key, item in value.items() if item is not None}
    return [present(item) for item in value] if isinstance(value, list) else value


def chart(
    monkeypatch: pytest.MonkeyPatch, folder: Path, changes: Mapping[str, Any], options: Mapping[str, Any], *flags: str
) -> int:
    """Exit code of ``fctd chart`` in a folder with the changed case."""
    raw = tomllib.loads(CASE)
    for key, value in changes.items():
        apply_override(raw, key, value)
    (folder / "well.toml").write_text(write_case(present(raw)), encoding="utf-8")
    monkeypatch.chdir(folder)
    given = [part for pair in (OPTIONS | dict(options)).items() for part in pair]
    monkeypatch.setattr("sys.argv", ["fctd", "chart", "well.toml", *given, "--quiet", *flags])
    with pytest.raises(SystemExit) as stopped:
        main.run(COMMANDS)
    return int(stopped.value.code or 0)


def split(key: str, value: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    """A change as one of the case or of the options."""
    return ({}, {key: value}) if key.startswith("--") else ({key: value}, {})


def test_there_are_at_least_sixty() -> None:
    rows = [*REFUSED, *REFUSED_TOGETHER, *DOUBTED, *DOUBTED_TOGETHER]
    assert len({repr(row[:2]) for row in rows}) == len(rows) >= 60


def test_the_case_itself_is_right(tmp_path: Path) -> None:
    (tmp_path / "well.toml").write_text(CASE, encoding="utf-8")
    assert fctd.load_case(tmp_path / "well.toml").warnings == ()


@pytest.mark.parametrize(("key", "value", "expected"), REFUSED)
def test_a_wrong_value_is_refused(
    key: str, value: Any, expected: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    assert chart(monkeypatch, tmp_path, *split(key, value)) == BAD_INPUT
    file = "" if key.startswith("--") else "well.toml: "
    shown = "is missing" if value is None else f"= {json.dumps(value, ensure_ascii=False)}"
    assert capsys.readouterr().err == f"{file}{key} {shown}: expected {expected}\n"


@pytest.mark.parametrize(("changes", "options", "message"), REFUSED_TOGETHER)
def test_values_that_do_not_go_together_are_refused(
    changes: dict[str, Any], options: dict[str, str], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    assert chart(monkeypatch, tmp_path, changes, options) == BAD_INPUT
    assert capsys.readouterr().err == f"{message}\n"


@pytest.mark.parametrize(("key", "value", "expected"), DOUBTED)
def test_a_probable_mistake_is_told(
    key: str, value: Any, expected: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    assert chart(monkeypatch, tmp_path, *split(key, value), "--strict") == FAILED
    first, *_, last = capsys.readouterr().err.splitlines()
    assert first == f"warning: well.toml: {key}: {expected}"
    assert last.startswith("strict: ")


@pytest.mark.parametrize(("changes", "options", "message"), DOUBTED_TOGETHER)
def test_a_probable_mistake_of_several_values_is_told(
    changes: dict[str, Any], options: dict[str, str], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    assert chart(monkeypatch, tmp_path, changes, options, "--strict") == FAILED
    assert capsys.readouterr().err.splitlines()[0] == f"warning: well.toml: {message}"


@pytest.mark.parametrize(
    "call",
    [
        lambda path: fctd.equilibrium(path, "trip_in", 500.0),
        lambda path: fctd.torque_drag(path, "trip_in", [500.0]),
        lambda path: fctd.refine(path),
        lambda path: fctd.simulate(path),
        lambda path: fctd.build_wellbore(path),
    ],
)
def test_a_path_is_no_case(call: Any) -> None:
    with pytest.raises(InputError, match=r'case = "well\.toml": expected a case'):
        call("well.toml")


def test_stations_that_no_arc_joins_name_their_survey(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    survey = tmp_path / "survey.csv"
    survey.write_text("md_m,inc_deg,azi_deg\n0,0,0\n300,0,0\n800,0,0\n1000,10,0\n1500,170,180\n", encoding="utf-8")
    changes = {"wellbore.stations": None, "wellbore.survey": "survey.csv"}
    assert chart(monkeypatch, tmp_path, changes, {}) == BAD_INPUT
    assert capsys.readouterr().err.splitlines()[-1] == (
        f'{survey}: station 5 = "1500 m, 170 deg, 180 deg": expected a direction that an arc can join with that of the '
        "station before, which is the opposite"
    )
