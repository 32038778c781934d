"""What the README promises runs as it stands there."""

import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from fctd.cli import main
from references.__main__ import app

ROOT = Path(__file__).parents[1]


def blocks(language: str) -> list[str]:
    """Code blocks of one language."""
    return re.findall(rf"```{language}\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)


@pytest.mark.parametrize(("number", "printed"), [(0, ["completed", "[0.04205]"]), (1, ["converged", "trip_out"])])
def test_the_python_examples_run(number: int, printed: list[str]) -> None:
    pytest.importorskip("matplotlib")
    examples = blocks("python")
    assert len(examples) == 2
    assert len(examples[number].strip().splitlines()) <= 10
    command = [sys.executable, "-W", "error", "-c", examples[number]]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    for part in printed:
        assert part in done.stdout


def test_the_command_line_examples_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("matplotlib")
    commands = re.findall(r"^\.venv/bin/(fctd .*)$", "\n".join(blocks("sh")).replace("\\\n", " "), re.MULTILINE)
    assert [command.split()[1] for command in commands] == ["simulate", "chart", "equilibrium", "refine"]
    monkeypatch.chdir(tmp_path)
    for command in commands:
        monkeypatch.setattr("sys.argv", shlex.split(command.replace(" validation/", f" {ROOT}/validation/")))
        with pytest.raises(SystemExit) as stopped:
            main.main()
        assert not stopped.value.code
    written = {path.name for path in tmp_path.iterdir()}
    assert written == {
        "my-run",
        "chart.csv",
        "chart.csv.json",
        "chart.png",
        "profiles.png",
        "profile.parquet",
        "profile.svg",
        "fine.toml",
    }


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
            main.run(app)
        assert not stopped.value.code
    assert (tmp_path / "out" / "history.parquet").exists()


def test_every_folder_of_the_map_is_there() -> None:
    for folder in re.findall(r"^\| `(\w+)/` \|", (ROOT / "README.md").read_text(), re.MULTILINE):
        assert (ROOT / folder).is_dir()
