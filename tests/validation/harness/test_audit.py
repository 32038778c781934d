"""What a study reads and imports is seen, and what it declares is digested."""

import subprocess
import sys
from pathlib import Path

import pytest

from references import contact
from validation.cases import load
from validation.harness.audit import watched
from validation.harness.files import ABSENT, declare, declared, digest
from validation.harness.fingerprint import Sources

ROOT = Path(__file__).parents[3]

IMPORTS = """
from validation.harness import audit, runner, study
from validation.harness.registry import STUDIES

with audit.watched(study.ROOT) as seen:
    for name in STUDIES:
        runner.load(name)
print(*seen.files)
"""


def test_files_that_are_read_in_the_folders_are_seen(tmp_path: Path) -> None:
    inside, outside = tmp_path / "inside", tmp_path / "outside"
    for folder in (inside, outside):
        folder.mkdir()
        for name in ("case.toml", "module.py"):
            (folder / name).write_text("x")
    with watched(inside) as seen:
        (inside / "module.py").read_text()
        (outside / "case.toml").read_text()
        (inside / "written.toml").write_text("x")
        assert seen.files == set()
        (inside / "case.toml").read_text()
    (inside / "written.toml").read_text()
    assert seen.files == {inside / "case.toml"}


def test_a_registry_entry_is_seen_whenever_it_is_asked_for() -> None:
    contact.method_class("arcs")
    with watched() as seen:
        contact.method_class("arcs")
    sources = Sources()
    assert seen.undeclared({}, {}, sources) == ["references.contact.own"]
    assert seen.undeclared({}, sources.used_by(contact.METHODS["arcs"]), sources) == []


def test_a_case_declares_its_file_and_its_survey() -> None:
    with declared() as files:
        load("paper_well")
    assert {path.name for path in files} == {"paper_well.toml", "paper_well.csv"}
    assert all(found == digest(path) != ABSENT for path, found in files.items())
    with declared() as files:
        load("paper_well", wellbore__survey=None, wellbore__stations=[[0, 0, 0], [4300, 0, 0]])
    assert {path.name for path in files} == {"paper_well.toml"}


def test_the_first_digest_of_a_file_counts(tmp_path: Path) -> None:
    path = tmp_path / "case.toml"
    with declared() as files:
        declare(path)
        path.write_text("x")
        declare(path)
    assert files == {path: ABSENT}
    assert declare(path) == path  # also where no study is being run


@pytest.mark.slow
def test_importing_the_studies_reads_no_file() -> None:
    """It would be read once for all of them, and count for none."""
    pytest.importorskip("skfem")
    done = subprocess.run([sys.executable, "-c", IMPORTS], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""
