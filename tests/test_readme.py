"""What the README promises runs as it stands there."""

import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from fctd import cli
from references.__main__ import app

ROOT = Path(__file__).parents[1]


def blocks(language: str) -> list[str]:
    """Code blocks of one language."""
    return re.findall(rf"```{language}\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)


def test_the_python_example_runs() -> None:
    (example,) = blocks("python")
    assert len(example.strip().splitlines()) <= 10
    done = subprocess.run([sys.executable, "-W", "error", "-c", example], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "completed" in done.stdout
    assert "[0.04205]" in done.stdout


def test_the_command_line_example_runs(tmp_path: Path) -> None:
    command = next(b for b in blocks("sh") if "fctd simulate" in b).replace(".venv/bin/fctd", "-m fctd")
    command = command.replace("\\\n", " ").replace("my-run", str(tmp_path / "out"))
    arguments = shlex.split(command)
    done = subprocess.run([sys.executable, *arguments, "--quiet"], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "history.csv").exists()


def test_the_examples_of_another_contact_method_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In this process, where the loop is compiled already."""
    monkeypatch.chdir(ROOT)
    (example,) = blocks("py")
    names: dict[str, Any] = {}
    exec(example, names)
    assert names["result"].status == "completed"
    assert names["result"].run["contact"] == "for_loop"
    command = next(b for b in blocks("sh") if "references simulate" in b)
    command = command.replace("\\\n", " ").replace("fcl-run", str(tmp_path / "out"))
    command = command.replace("--contact fcl --option facets=96", "--contact for_loop")  # installed or not
    for line in command.strip().splitlines():
        monkeypatch.setattr("sys.argv", shlex.split(line.removeprefix(".venv/bin/python -m ")))
        with pytest.raises(SystemExit) as stopped:
            cli.run(app)
        assert not stopped.value.code
    assert (tmp_path / "out" / "history.parquet").exists()


def test_every_folder_of_the_map_is_there() -> None:
    for folder in re.findall(r"^\| `(\w+)/` \|", (ROOT / "README.md").read_text(), re.MULTILINE):
        assert (ROOT / folder).is_dir()
