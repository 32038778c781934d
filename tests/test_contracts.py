"""Every room has its place in the contracts of imports, which ``make lint`` checks; no room names a higher one in a
text, which import-linter does not read; and no file is too long."""

import ast
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = ("fctd", "references", "validation", "benchmarks", "reports", "docs")
CONTRACTS = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]["contracts"]
LAYERS = next(contract["layers"] for contract in CONTRACTS if contract["name"].startswith("rooms of the engine"))
# The layer of each room, of which 0 is the uppermost.
LAYER = {room.strip(): at for at, layer in enumerate(LAYERS) for room in layer.split("|")}
LONGEST = 400  # lines of a file


def texts(source: str) -> Iterator[str]:
    """The texts of a source and of its formatted texts; docstrings are for readers."""
    tree = ast.parse(source)
    docstrings = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings:
            yield node.value


def named_above(room: str, source: str) -> set[str]:
    """The rooms above one, or beside it, that texts of its source name; "fctd." where they name any room."""
    named = {found[0] for text in texts(source) for found in re.finditer(r"\bfctd\.\w*", text)} - {room}
    return {found for found in named if found == "fctd." or LAYER.get(found, len(LAYERS)) <= LAYER[room]}


@pytest.mark.parametrize("room", [room for room in LAYER if LAYER[room]])
def test_no_room_names_a_higher_one_in_a_text(room: str) -> None:
    """Who imports a module by its name depends on it as much as who imports it in a statement."""
    folder = ROOT.joinpath(*room.split("."))
    files = [*folder.rglob("*.py")] or [folder.with_suffix(".py")]
    found = {path.name: named_above(room, path.read_text(encoding="utf-8")) for path in files}
    assert {name: above for name, above in found.items() if above} == {}


@pytest.mark.parametrize(
    ("source", "named"),
    [
        ('import_module("fctd.plots")', {"fctd.plots"}),
        ("HOMES = {'Chart': 'fctd.steady.chart'}", {"fctd.steady"}),
        ('import_module(f"fctd.{room}")', {"fctd."}),
        ('"""As ``fctd.plots`` draws it."""\nload("fctd.case.load", "fctd.results.notes", "fctd.chart")', set()),
    ],
)
def test_a_text_that_names_a_higher_room_is_found(source: str, named: set[str]) -> None:
    assert named_above("fctd.results", source) == named


def test_every_room_of_the_engine_has_its_place_in_the_layers() -> None:
    """A room that no contract names could import anything."""
    rooms = {f"fctd.{path.parent.name}" for path in (ROOT / "fctd").glob("*/__init__.py")}
    modules = {f"fctd.{path.stem}" for path in (ROOT / "fctd").glob("*.py")} - {"fctd.__init__", "fctd.__main__"}
    assert LAYER.keys() == rooms | modules


@pytest.mark.parametrize("package", PACKAGES)
def test_no_file_is_too_long(package: str) -> None:
    lengths = {path: len(path.read_text().splitlines()) for path in (ROOT / package).rglob("*.py")}
    assert {path.name: lines for path, lines in lengths.items() if lines > LONGEST} == {}
