"""Strange machines and the newcomer's: whose they are, what they have of ours, and the table that ends .ci/strange."""

import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
GIT = ("git", "-c", "user.name=a", "-c", "user.email=a")
# Both commands, which say what they have; the tests fail where there is no git, and set-up is said.
MAKEFILE = """
test reproduce: .venv/installed
	@echo "$@: LC_ALL=$$LC_ALL TZ=$$TZ data=$$FCTD_DATA cache=$$NUMBA_CACHE_DIR pip=$$PIP_FIND_LINKS in=$$PWD"
	@[ $@ = reproduce ] || [ -e .git ] || \\
	{ echo "FAILED tests/t.py::test_git - a | b"; echo "1 failed, 2 passed in 3.4s"; exit 3; }
	@echo "= 7 passed, 1 skipped, 2 deselected in 5.6s (0:00:05) ="
	@echo home=$$(stat -c %A "$$HOME" "$$HOME/.cache" 2>&1)
.venv/installed: Makefile
	@echo set-up; mkdir -p .venv/bin; cp python .venv/bin; touch $@
"""
# The table of targets, of which this machine cannot run one.
PYTHON = """#!/bin/sh
[ $3 != x86-64-v4 ] || { echo "$3: this processor lacks avx512f" >&2; exit 1; }
echo "LC_ALL=two words"
echo "TZ=$2 $3"
"""


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A project with both commands and this folder; programs before ours: no user is made, and no Python is later."""
    folder, programs = tmp_path / "ours", tmp_path / "programs"
    shutil.copytree(HERE, folder / ".ci", ignore=shutil.ignore_patterns("__pycache__"))
    programs.mkdir()
    (programs / "id").write_text('#!/bin/sh\n[ "$1" = -u ] && echo 1000 || exec /usr/bin/id "$@"\n')
    for version in ("12", "13", "14"):
        (programs / f"python3.{version}").write_text("#!/bin/sh\nexit 127\n")
    for program in programs.iterdir():
        program.chmod(0o755)
    (folder / "Makefile").write_text(MAKEFILE)
    (folder / "python").write_text(PYTHON)
    (folder / "python").chmod(0o755)
    (folder / ".gitignore").write_text(".venv\nresults\n")
    for command in (["init", "--quiet"], ["add", "."], ["commit", "--quiet", "-m", "all"]):
        subprocess.run([*GIT, *command], cwd=folder, check=True)
    (folder / "results").write_text("stored")
    return folder


def strange(checkout: Path, *arguments: str) -> tuple[int, str, list[list[str]]]:
    """Exit code, what was said, and the rows of the table."""
    variables = {
        "PATH": f"{checkout.parent / 'programs'}:{os.environ['PATH']}",
        "PYENV_ROOT": str(checkout.parent), "FCTD_DATA": "ours", "NUMBA_CACHE_DIR": "ours", "PIP_FIND_LINKS": "theirs",
        "TMPDIR": str(checkout.parent),
    }  # fmt: skip
    done = subprocess.run(
        [checkout / ".ci" / "strange", *arguments], env={**os.environ, **variables}, capture_output=True, text=True
    )
    _, _, *rows = [line.strip("|") for line in done.stdout.splitlines() if line[:1] == "|"] or ["", ""]
    return done.returncode, done.stdout + done.stderr, [[cell.strip() for cell in row.split("|")] for row in rows]


def test_each_condition_is_a_row(checkout: Path) -> None:
    """Conditions that no installer sees share one environment; a condition holds for both commands."""
    code, text, rows = strange(checkout, "time-zone", "busy", "c-locale", "python3.14", "numbers")
    assert code == 0, text
    assert [[*row[:3], *row[4:5]] for row in rows[:3]] == [
        [name, "0", "7/0/1", "0"] for name in ("time-zone", "busy", "c-locale")
    ]  # fmt: skip
    assert rows[3] == ["python3.14", "", "", "", "", "", "absent: no such interpreter starts"]
    assert rows[4] == ["numbers", "0", "0/0/0", rows[4][3], "", "", ""]
    assert "TZ=pytest -m" in text
    assert text.count("TZ=Pacific/Chatham") == text.count("LC_ALL=C ") == 2
    assert text.count("\nset-up\n") == 2


def test_a_target_is_that_of_the_studies(checkout: Path) -> None:
    """The processor may lack what a target needs; a table that cannot be read is no target that is absent."""
    code, text, rows = strange(checkout, "x86-64-v3", "x86-64-v4")
    assert code == 0, text
    assert text.count("LC_ALL=two words TZ=validation.harness.targets x86-64-v3 ") == 2
    assert rows[1] == ["x86-64-v4", "", "", "", "", "", "absent: this processor lacks avx512f"]
    program = checkout / "python"
    program.write_text("#!/bin/sh\necho 'No module named targets' >&2\nexit 1\n")
    subprocess.run([*GIT, "commit", "--quiet", "-am", "broken"], cwd=checkout, check=True)
    code, text, rows = strange(checkout, "x86-64-v3")
    assert (code, rows) == (1, [])
    assert "No module named targets" in text


def test_a_machine_has_nothing_of_ours_but_the_way_to_packages(checkout: Path) -> None:
    code, text, _ = strange(checkout, "c-locale")
    assert code == 0
    assert text.count("data= cache= pip=theirs in=") == 2
    assert text.count("/new comer ü/fctd\n") == 2


def test_a_command_that_fails_is_told_and_is_exit_code_1(checkout: Path) -> None:
    code, _, ((name, *cells),) = strange(checkout, "archive")
    assert (code, name) == (1, "archive")
    assert cells[:2] == ["2", "2/1/0"]  # make's own exit code
    assert cells[3] == "0"
    assert cells[5].startswith("FAILED tests/t.py::test_git - a / b; make: ***")


def test_a_home_that_is_read_only_can_keep_nothing(checkout: Path) -> None:
    """Its folder of caches neither; root, as whom the tests may run, is not held by that."""
    _, text, _ = strange(checkout, "read-only")
    assert text.count("home=dr-xr-xr-x dr-xr-xr-x") == 2


def test_a_python_of_an_option_is_used(checkout: Path) -> None:
    """It is looked for by its version; one on the way of commands that does not start is passed over."""
    python = checkout.parent / "other"
    python.write_text(f'#!/bin/sh\n[ "$1" != --version ] && [ -z "$2" ] || echo {shlex.quote(sys.executable)}\n')
    python.chmod(0o755)
    code, text, ((name, *cells),) = strange(checkout, "--python", str(python), "python3.13")
    assert code == 0, text
    assert (name, cells[0]) == ("python3.13", "0")


def test_an_unknown_condition_is_exit_code_2(checkout: Path) -> None:
    code, text, rows = strange(checkout, "archive", "moon")
    assert (code, rows) == (2, [])
    assert text.startswith("error: condition moon: expected one of numbers busy x86-64-v2")
