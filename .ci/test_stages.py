"""Stages of .ci/run: one above its share of the time is named, and one that fails ends all, also beside another."""

import re
import subprocess
from pathlib import Path

import pytest

STAGES = Path(__file__).with_name("stages")
HEAD = f"""
set -euo pipefail
scratch=.
. {STAGES}
late() {{ # as a stage would be that takes a minute
  SECONDS=$((SECONDS + 60))
}}
one() {{ stage 'one' 50 late; stage 'two' 90 late; }}
other() {{ stage 'three' 55 late; echo 'the other says this'; }}
broken() {{ stage 'four' 50 false; echo 'not reached'; }}
"""


def said(folder: Path, *commands: str) -> tuple[int, str]:
    """Exit code and output of commands after the functions above."""
    done = subprocess.run(
        ["bash", "-c", HEAD + "\n".join(commands)], cwd=folder, capture_output=True, text=True, check=False
    )
    return done.returncode, done.stdout


def test_a_stage_above_its_share_is_named(tmp_path: Path) -> None:
    code, text = said(tmp_path, "one", "summary")
    assert code == 0
    assert re.findall(r"^== (\w+): 6\d s$", text, re.MULTILINE) == ["one", "two"]
    assert re.search(r"^== all: 12\d s\nabove its share: one, 6\d s of 50 s\n\Z", text, re.MULTILINE)


def test_two_stages_beside_each_other_are_told_one_after_the_other(tmp_path: Path) -> None:
    code, text = said(tmp_path, "beside one other", "summary")
    assert code == 0
    assert re.findall(r"^== (\w+)$|^(the other says this)$", text, re.MULTILINE) == [
        ("one", ""), ("two", ""), ("three", ""), ("", "the other says this"),
    ]  # fmt: skip
    assert sorted(re.findall(r"^above its share: (\w+), 6\d s of", text, re.MULTILINE)) == ["one", "three"]


def test_a_python_that_is_not_there_is_said(tmp_path: Path) -> None:
    """Without a later Python the stage says that it was not run; with one, the two commands run in a clone."""
    for name in ("git", "make"):
        (tmp_path / name).write_text(f'#!/bin/sh\necho "{name} $*"\n')
        (tmp_path / name).chmod(0o755)
    code, text = said(tmp_path, f"PATH={tmp_path}", "stage 'later' 240 later")
    assert (code, "not run: neither python3.13 nor python3.14 is found" in text) == (0, True)
    (tmp_path / "python3.13").write_text("#!/bin/sh\necho Python\n")
    (tmp_path / "python3.13").chmod(0o755)
    code, text = said(tmp_path, f"PATH={tmp_path}:/usr/bin:/bin", "later")
    assert code == 0
    assert "BROWSER=0 test" in text
    assert "QUICK=1 reproduce" in text


@pytest.mark.parametrize("pair", ["one broken", "broken one"])
def test_a_stage_that_fails_ends_all(pair: str, tmp_path: Path) -> None:
    code, text = said(tmp_path, f"beside {pair}", "summary")
    assert code == 1
    assert "== four" in text
    assert "not reached" not in text
    assert "== all" not in text
