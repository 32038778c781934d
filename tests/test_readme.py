"""What the README promises runs as it stands there."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def blocks(language: str) -> list[str]:
    """Code blocks of one language."""
    return re.findall(rf"```{language}\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)


@pytest.mark.parametrize(("number", "printed"), [(0, ["completed", "[0.04205]"]), (1, ["converged", "trip_out"])])
def test_the_python_examples_run(number: int, printed: list[str]) -> None:
    examples = blocks("python")
    assert len(examples) == 2
    assert len(examples[number].strip().splitlines()) <= 10
    command = [sys.executable, "-W", "error", "-c", examples[number]]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    for part in printed:
        assert part in done.stdout


def test_the_command_line_examples_run(tmp_path: Path) -> None:
    commands = re.findall(r"^\.venv/bin/fctd .*$", "\n".join(blocks("sh")).replace("\\\n", " "), re.MULTILINE)
    assert [shlex.split(command)[1] for command in commands] == ["simulate", "chart", "equilibrium"]
    here = {**os.environ, "PYTHONPATH": str(ROOT)}
    for command in commands:
        arguments = [str(ROOT / part) if part.startswith("validation/") else part for part in shlex.split(command)[1:]]
        done = subprocess.run(
            [sys.executable, "-m", "fctd", *arguments], cwd=tmp_path, env=here, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stderr
    written = {path.name for path in tmp_path.iterdir()}
    assert written == {
        "my-run",
        "chart.csv",
        "chart.csv.json",
        "chart.png",
        "profiles.png",
        "profile.parquet",
        "profile.svg",
    }


def test_every_folder_of_the_map_is_there() -> None:
    for folder in re.findall(r"^\| `(\w+)/` \|", (ROOT / "README.md").read_text(), re.MULTILINE):
        assert (ROOT / folder).is_dir()
