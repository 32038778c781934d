"""The pictures of the tutorial, written by the commands that it shows."""

import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[1]


def commands() -> list[str]:
    """The commands of the tutorial, one line each."""
    text = (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```sh\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    return "".join(blocks).replace("\\\n", " ").splitlines()


def pictures(command: str) -> list[str]:
    """The pictures that a command writes."""
    return re.findall(r"--(?:plot|png) (\S+\.png)", command)


def draw(command: str, folder: Path) -> list[Path]:
    """Run a command, and copy its pictures into a folder as ``tutorial_NAME``; returns them.

    Raises CalledProcessError where the command fails.
    """
    program, *arguments = shlex.split(command)
    if program != ".venv/bin/fctd":
        raise ValueError(f"a command of the tutorial that is not fctd: {command}")
    with tempfile.TemporaryDirectory() as scratch:
        (Path(scratch) / "examples").symlink_to(ROOT / "examples")
        subprocess.run([sys.executable, "-m", "fctd", *arguments], cwd=scratch, check=True, capture_output=True)
        return [Path(shutil.copy(Path(scratch) / name, folder / f"tutorial_{name}")) for name in pictures(command)]
