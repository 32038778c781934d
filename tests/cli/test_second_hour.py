"""Inputs of new users who had not seen the program, odd, mistaken and right: each is answered as it was sorted."""

import re
import shlex
import tomllib
from pathlib import Path
from typing import Any, Final

import pytest

from tests.commands import Command

EXAMPLES: Final = Path(__file__).parents[2] / "examples"
INPUTS: Final = tomllib.loads((Path(__file__).parents[1] / "inputs" / "second_hour.toml").read_text(encoding="utf-8"))
FRAMES: Final = re.compile("[╭╮╰╯│─]")

pytestmark = pytest.mark.slow(seconds=20)


def words(*texts: str) -> str:
    """Texts without frames and breaks of lines."""
    return " ".join(FRAMES.sub(" ", " ".join(texts)).split())


def lay_out(given: dict[str, Any], folder: Path) -> None:
    """The files of an input in a folder."""
    if given["base"] == "well":
        text = (EXAMPLES / "my_well.toml").read_text(encoding="utf-8")
        for edit in given.get("set", []):
            assert edit["find"] in text
            text = text.replace(edit["find"], edit["replace"], 1)
        (folder / "well.toml").write_text(text, encoding="utf-8")
        (folder / "my_survey.csv").write_bytes((EXAMPLES / "my_survey.csv").read_bytes())
    for name, content in given.get("files", {}).items():
        (folder / name).write_text(content, encoding="utf-8")


@pytest.mark.parametrize("given", INPUTS["input"], ids=lambda given: str(given["id"]))
def test_an_input_is_answered_as_sorted(
    given: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    lay_out(given, tmp_path)
    monkeypatch.chdir(tmp_path)
    printed = cli(*shlex.split(given["command"])[1:], code=given["code"])
    written = tmp_path / "my.toml"
    case = written.read_text(encoding="utf-8") if written.exists() else ""
    assert given["says"] in words(printed.out, printed.err, case)
    assert not (given["class"] == "control" and printed.err.strip())
