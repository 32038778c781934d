"""Keys of stored machine code: another one after an edit of anything that the function reaches, and of nothing else."""

import importlib
import sys
from pathlib import Path
from types import ModuleType

import pytest

from fctd.mechanics.fingerprint import fingerprint

OUTER = """
import numpy as np
from numba import njit
from kept import constants
from kept.constants import SHARE
from kept.inner import halved, Pair

@njit
def outer(x):
    def twice(y):
        return halved(y) * constants.FOUR
    return SHARE * twice(x) + Pair(1.0, np.pi).first
"""
INNER = """
from typing import NamedTuple
from numba import njit
from kept.deepest import root

class Pair(NamedTuple):
    first: float
    second: float

@njit
def halved(x):
    return root(x) / 2
"""
FILES = {
    "__init__.py": "", "outer.py": OUTER, "inner.py": INNER, "constants.py": "SHARE, FOUR, UNUSED = 0.5, 4, 7\n",
    "deepest.py": "from numba import njit\n\n@njit\ndef root(x):\n    return x ** 0.5\n", "beside.py": "ONE = 1\n",
}  # fmt: skip


def key_of(folder: Path, monkeypatch: pytest.MonkeyPatch, name: str = "", old: str = "", new: str = "") -> str:
    """The key of ``outer`` where a file of the package has been edited."""
    package = folder / f"{name}{new.strip() or 'as it is'}".replace("/", "-") / "kept"
    package.mkdir(parents=True)
    for file, text in FILES.items():
        assert file != name or old in text
        (package / file).write_text(text.replace(old, new) if file == name else text)
    with monkeypatch.context() as patch:
        patch.syspath_prepend(str(package.parent))
        for module in [key for key in sys.modules if key.partition(".")[0] == "kept"]:
            del sys.modules[module]
        module: ModuleType = importlib.import_module("kept.outer")
        return fingerprint(module.outer.py_func)


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("outer.py", "twice(x) +", "twice(x) -"),
        ("inner.py", "/ 2", "/ 3"),
        ("inner.py", "second: float", "third: float"),
        ("deepest.py", "0.5", "0.6"),
        ("constants.py", "0.5, 4", "0.6, 4"),
        ("constants.py", "0.5, 4", "0.5, 5"),
        ("constants.py", "0.5, 4", "4, 0.5"),
    ],
)
def test_an_edit_of_what_is_reached_gives_another_key(
    name: str, old: str, new: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert key_of(tmp_path, monkeypatch, name, old, new) != key_of(tmp_path, monkeypatch)


@pytest.mark.parametrize(("name", "old", "new"), [("beside.py", "1", "2"), ("constants.py", "4, 7", "4, 8")])
def test_an_edit_of_anything_else_keeps_the_key(
    name: str, old: str, new: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert key_of(tmp_path, monkeypatch, name, old, new) == key_of(tmp_path, monkeypatch)


def test_a_key_hangs_neither_on_addresses_nor_on_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = key_of(tmp_path / "one", monkeypatch)
    second = key_of(tmp_path / "other", monkeypatch)
    assert first == second
