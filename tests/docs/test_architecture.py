"""The map and the walks of docs/architecture.md name what is there."""

import importlib
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
NAME = re.compile(r"`((?:fctd|references|validation|reports)(?:\.\w+)+)`")
WALKS = {part.split("\n")[0]: NAME.findall(part) for part in TEXT.split("\n## ")[1:] if part.startswith("From ")}


def found(name: str) -> object:
    """What a dotted name stands for: its longest part that is a module, and the attributes after it."""
    parts = name.split(".")
    for count in range(len(parts), 0, -1):
        try:
            here: object = importlib.import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for part in parts[count:]:
            here = getattr(here, part)
        return here
    raise ModuleNotFoundError(name)


def is_there(name: str) -> bool:
    try:
        return found(name) is not None
    except (AttributeError, ModuleNotFoundError):
        return False


def test_every_name_is_there() -> None:
    names = set(NAME.findall(TEXT))
    assert len(names) > 100
    assert {name for name in names if not is_there(name)} == set()


def test_a_wrong_name_is_found() -> None:
    for name in ("fctd.mechanics.dynamics.leap", "fctd.mechanics.leaps.step"):
        assert not is_there(name)


def test_the_walks_begin_where_their_number_comes_in() -> None:
    """A station, a key of a case, a penetration, a sample of a sweep, and a study's number."""
    assert [names[0] for names in WALKS.values()] == [
        "fctd.case.load.load_case", "fctd.cli.options.changes_of", "fctd.simulation.simulate.Simulation",
        "fctd.sweep.spec.read_sweep", "validation.__main__.main",
    ]  # fmt: skip
    assert min(map(len, WALKS.values())) >= 10


@pytest.mark.parametrize("package", ["fctd", "references", "validation"])
def test_every_room_is_in_the_map(package: str) -> None:
    rooms = {path.parent.name for path in (ROOT / package).glob("*/__init__.py")}
    assert set(re.findall(rf"^\| `{package}/(\w+)/` \|", TEXT, re.MULTILINE)) == rooms


IMPORTS = dict(re.findall(r"^\| `fctd/(\w+)/` \|[^|]*\| ([^|]+) \|$", TEXT, re.MULTILINE))


@pytest.mark.parametrize("room", IMPORTS)
def test_a_room_imports_what_the_map_says(room: str) -> None:
    below = list(IMPORTS)[list(IMPORTS).index(room) + 1 :]
    named = [name for name in below if re.search(rf"\b{name}\b", IMPORTS[room])]
    every = "every room" in IMPORTS[room]
    allowed = below if every else named
    if every and named:  # a room, and every one below it
        allowed = below[below.index(named[0]) :]
    sources = "\n".join(path.read_text("utf-8") for path in (ROOT / "fctd" / room).rglob("*.py"))
    used = set(re.findall(r"^\s*(?:from|import) fctd\.(\w+)", sources, re.MULTILINE)) & set(IMPORTS) - {room}
    assert used <= set(allowed)
    assert every or used == set(named)
