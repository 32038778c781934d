"""Every room has its place in the contracts of imports, which ``make lint`` checks, and no file is too long."""

import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = ("fctd", "references", "validation", "benchmarks", "reports", "docs")
CONTRACTS = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]["contracts"]
LONGEST = 400  # lines of a file


def test_every_room_of_the_engine_has_its_place_in_the_layers() -> None:
    """A room that no contract names could import anything."""
    layers = next(contract["layers"] for contract in CONTRACTS if contract["name"].startswith("rooms of the engine"))
    named = {room.strip() for layer in layers for room in layer.split("|")}
    rooms = {f"fctd.{path.parent.name}" for path in (ROOT / "fctd").glob("*/__init__.py")}
    modules = {f"fctd.{path.stem}" for path in (ROOT / "fctd").glob("*.py")} - {"fctd.__init__", "fctd.__main__"}
    assert named == rooms | modules


@pytest.mark.parametrize("package", PACKAGES)
def test_no_file_is_too_long(package: str) -> None:
    lengths = {path: len(path.read_text().splitlines()) for path in (ROOT / package).rglob("*.py")}
    assert {path.name: lines for path, lines in lengths.items() if lines > LONGEST} == {}
