"""The contract as tests of pytest, for a method from anywhere."""

import subprocess
import sys
from pathlib import Path

METHODS = """
from tests.arena.test_contract import Exact


class Inwards(Exact):
    def spoil(self, hits):
        return hits._replace(normal=-hits.normal)
"""


def run(folder: Path, *methods: str) -> "subprocess.CompletedProcess[str]":
    (folder / "mine.py").write_text(METHODS, encoding="utf-8")
    named = [part for method in methods for part in ("--contact-method", method)]
    asked = [sys.executable, "-m", "pytest", "-q", "-p", "fctd.arena.pytest_plugin", "-p", "no:cacheprovider", *named]
    root = str(Path(__file__).parents[2])
    env = {"PYTHONPATH": f"{root}:{folder}", "PATH": "/usr/bin"}
    return subprocess.run(
        [*asked, "--rootdir", str(folder), str(folder)], cwd=folder, env=env, capture_output=True, text=True
    )


def test_each_demand_is_a_test(tmp_path: Path) -> None:
    done = run(tmp_path, "mine:Exact", "mine:Inwards")
    assert done.returncode == 1
    assert "mine:Inwards::directions" in done.stdout
    assert "point into the hole: expected from the axis to the wall" in done.stdout
    assert "mine:Exact" not in done.stdout


def test_what_is_no_class_is_told(tmp_path: Path) -> None:
    done = run(tmp_path, "mine:Nobody")
    assert done.returncode == 4
    assert "--contact-method mine:Nobody: expected MODULE:CLASS" in done.stderr
