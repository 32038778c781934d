"""Stages of .ci/run: one above its share of the time is named, one that fails ends all, and skipped tests are known."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

STAGES = shlex.quote(str(Path(__file__).with_name("stages")))
PYTEST = f"{shlex.quote(sys.executable)} -m pytest -c /dev/null --rootdir=."
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


TESTS = """
import pytest

@pytest.mark.parametrize("name", ["a b.csv"])
def test_data(name): pytest.skip("no data - none at all")

def test_pages(): pytest.skip("no pages")

def test_all(): pass
"""


@pytest.mark.parametrize(
    ("named", "code"),
    [
        (["test_them.py::test_data[a b.csv]", "test_them.py::test_pages"], 0),
        (["test_them.py::test_pages"], 1),
        (["test_them.py::test_data[a b.csv]", "test_them.py::test_gone", "test_them.py::test_pages"], 1),
    ],
    ids=["equal", "one more skipped", "one more named"],
)
def test_skipped_tests_are_those_of_a_list(named: list[str], code: int, tmp_path: Path) -> None:
    """As pytest itself names them."""
    (tmp_path / "test_them.py").write_text(TESTS)
    (tmp_path / "named").write_text("".join(f"{each}\n" for each in named))
    log = f"{PYTEST} -rs --no-fold-skipped test_them.py >log"
    found, text = said(tmp_path, log, "skipped_are named log")
    assert (found, text.count("test_them.py::")) == (code, code)


def test_a_skipped_test_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "test_them.py").write_text(TESTS)
    tests = f"none_skipped {PYTEST} -q test_them.py"
    assert [said(tmp_path, f"{tests}{which}")[0] for which in ("::test_all", "::test_pages", "")] == [0, 1, 1]


@pytest.mark.parametrize("pair", ["one broken", "broken one"])
def test_a_stage_that_fails_ends_all(pair: str, tmp_path: Path) -> None:
    code, text = said(tmp_path, f"beside {pair}", "summary")
    assert code == 1
    assert "== four" in text
    assert "not reached" not in text
    assert "== all" not in text
