"""What a study reads is seen, here and in other processes, and digested."""

import subprocess
import sys
from pathlib import Path

import pytest

from validation.cases import load
from validation.harness.files import ABSENT, digest, reading
from validation.harness.side_by_side import apart

ROOT = Path(__file__).parents[3]

IMPORTS = """
from validation.harness import files, runner, study
from validation.harness.registry import STUDIES

with files.reading(study.ROOT) as read:
    for name in STUDIES:
        runner.load(name)
print(*read.files)
"""


def test_files_that_are_read_in_the_folders_are_seen(tmp_path: Path) -> None:
    inside, outside = tmp_path / "inside", tmp_path / "outside"
    for folder in (inside, outside):
        folder.mkdir()
        for name in ("case.toml", "module.py"):
            (folder / name).write_text("x")
    with reading(inside) as read:
        (inside / "module.py").read_text()
        (outside / "case.toml").read_text()
        (inside / "written.toml").write_text("x")
        assert read.files == {}
        (inside / "case.toml").read_text()
    (inside / "written.toml").read_text()
    assert read.files.keys() == {inside / "case.toml"}


def test_a_case_is_read_with_its_survey() -> None:
    with reading(ROOT) as read:
        load("paper_well")
    assert {path.name for path in read.files} == {"paper_well.toml", "paper_well.csv"}
    assert all(found == digest(path) != ABSENT for path, found in read.files.items())
    with reading(ROOT) as read:
        load("paper_well", wellbore__survey=None, wellbore__stations=[[0, 0, 0], [4300, 0, 0]])
    assert {path.name for path in read.files} == {"paper_well.toml"}


@pytest.mark.slow
def test_what_another_process_reads_counts_too(tmp_path: Path) -> None:
    paths = [tmp_path / f"{k}.toml" for k in range(3)]
    for path in paths:
        path.write_text(path.name)
    with reading(tmp_path) as read:
        assert apart(Path.read_text, paths[:2]) == ["0.toml", "1.toml"]
    assert read.files == {path: digest(path) for path in paths[:2]}


def test_the_first_digest_of_a_file_counts(tmp_path: Path) -> None:
    path = tmp_path / "case.toml"
    path.write_text("before")
    before = digest(path)
    with reading(tmp_path) as read:
        path.read_text()
        path.write_text("after")
        path.read_text()
    assert read.files == {path: before}


@pytest.mark.slow
def test_importing_the_studies_reads_no_file() -> None:
    """It would be read once for all of them, and count for none."""
    done = subprocess.run([sys.executable, "-c", IMPORTS], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""
