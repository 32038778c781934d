"""Allowed imports: every contract of pyproject.toml is kept, and fails for an import that it forbids."""

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = ("fctd", "references", "validation", "benchmarks", "reports", "docs")
CONTRACTS = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]["contracts"]
LONGEST = 400  # lines of a file

# Contract, file, and an import that it may not hold.
FORBIDDEN = [
    ("the engine stands alone; references, studies and reports build on it", "fctd/results/tables.py", "references"),
    ("the engine stands alone; references, studies and reports build on it", "references/registry.py", "validation"),
    ("the engine stands alone; references, studies and reports build on it", "validation/harness/study.py", "reports"),
    ("the engine stands alone; references, studies and reports build on it", "benchmarks/gate.py", "validation"),
    ("rooms of the engine: each imports only what stands below it", "fctd/model/survey.py", "fctd.results.tables"),
    ("rooms of the engine: each imports only what stands below it", "fctd/case/errors.py", "fctd.model.survey"),
    ("rooms of the engine: each imports only what stands below it", "fctd/mechanics/state.py", "fctd.case.errors"),
    ("rooms of the engine: each imports only what stands below it", "fctd/steady/tangent.py", "fctd.simulation.run"),
    ("rooms of the engine: each imports only what stands below it", "fctd/plots/page.py", "fctd.view.page"),
    ("mechanics needs numba and numpy alone", "fctd/mechanics/joints.py", "pandas"),
    ("rooms of the references", "references/contact/own.py", "references.engines.run"),
    ("rooms of the references", "references/soft_string/torsion.py", "references.beams.case"),
    ("rooms of the validation", "validation/cases/wells.py", "validation.parts.windows"),
    ("rooms of the validation", "validation/harness/store.py", "validation.cases"),
    ("rooms of the validation", "validation/studies/overlap.py", "validation.claims.ledger"),
    ("no arrow runs up in any room", "fctd/mechanics/rotations.py", "fctd.mechanics.dynamics"),
    ("no arrow runs up in any room", "validation/harness/study.py", "validation.harness.runner"),
    ("the guides need the engine and the figures alone", "docs/keys.py", "references.registry"),
    ("no study imports another", "validation/studies/overlap.py", "validation.studies.broomstick"),
]


def broken(root: Path) -> dict[str, str]:
    """The contracts that the sources under ``root`` break, by name: what is printed of each."""
    done = subprocess.run(
        [Path(sys.executable).with_name("lint-imports"), "--no-cache", "--no-logo"],
        cwd=root, capture_output=True, text=True,
    )  # fmt: skip
    found = dict(re.findall(r"^(.+) (KEPT|BROKEN)$", done.stdout, re.MULTILINE))
    assert found.keys() == {contract["name"] for contract in CONTRACTS}, done.stdout + done.stderr
    assert done.returncode == ("BROKEN" in found.values())
    _, _, told = done.stdout.partition("Broken contracts")
    named = [name for name, state in found.items() if state == "BROKEN"]
    parts = re.split(rf"^({'|'.join(map(re.escape, named))})\n-+$", told, flags=re.MULTILINE) if named else []
    return dict(zip(parts[1::2], parts[2::2], strict=True))


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sources and the contracts in a folder of their own."""
    root = tmp_path_factory.mktemp("copy")
    shutil.copy(ROOT / "pyproject.toml", root)
    for package in PACKAGES:
        for file in (ROOT / package).rglob("*.py"):
            target = root / file.relative_to(ROOT)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, target)
    return root


def test_every_contract_is_kept(copy: Path) -> None:
    assert broken(copy) == {}


def rank(index: int) -> int:
    """How many earlier imports the same contract forbids."""
    return [contract for contract, _, _ in FORBIDDEN[:index]].count(FORBIDDEN[index][0])


RANKS = [rank(index) for index in range(len(FORBIDDEN))]


@pytest.mark.parametrize("wanted", sorted(set(RANKS)))
def test_a_forbidden_import_breaks_its_contract(copy: Path, wanted: int) -> None:
    """One import for each contract at a time; the contract names it."""
    added = [entry for entry, found in zip(FORBIDDEN, RANKS, strict=True) if found == wanted]
    texts = {copy / file: (copy / file).read_text() for _, file, _ in added}
    try:
        for _, file, module in added:
            with (copy / file).open("a") as source:
                source.write(f"\nimport {module}\n")
        told = broken(copy)
    finally:
        for path, text in texts.items():
            path.write_text(text)
    for contract, file, module in added:
        importer = file.removesuffix(".py").replace("/", ".")
        within = f".{importer.rpartition('.')[2]} -> .{module.rpartition('.')[2]} ("  # how cycles in a room are told
        assert f"{importer} -> {module} (" in told[contract] or within in told[contract], told[contract]


def test_every_contract_has_an_import_that_it_forbids() -> None:
    assert {contract for contract, _, _ in FORBIDDEN} == {contract["name"] for contract in CONTRACTS}


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
