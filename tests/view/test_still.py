"""Still pictures need a browser: without one the message says what to install."""

import sys
from pathlib import Path

import pytest

from fctd.case.errors import InputError
from fctd.view import still


def test_a_missing_browser_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("playwright")
    monkeypatch.setenv(still.VARIABLE, "no-such-browser")
    assert still.browser_path() is None
    with pytest.raises(InputError, match="install chromium") as refused, still.open_browser(key="--png"):
        pass
    assert (refused.value.key, refused.value.value) == ("--png", "no-such-browser")


def test_a_missing_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "playwright.sync_api", None)
    with pytest.raises(InputError, match=r"the extra fctd\[browser\]"), still.open_browser():
        pass


def test_a_browser_elsewhere_is_taken(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    mine = tmp_path / "mine"
    mine.write_text("#!/bin/sh\n")
    mine.chmod(0o755)
    monkeypatch.setenv(still.VARIABLE, str(mine))
    assert still.browser_path() == mine
