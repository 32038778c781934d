"""``fctd schema``: JSON on the screen or in a file."""

import json
from pathlib import Path

import pytest

from fctd.case.schema import case_schema
from tests.cli.test_main import run


def test_the_schema_is_printed(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(monkeypatch, "schema") == 0
    assert json.loads(capsys.readouterr().out) == case_schema()


def test_the_schema_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "case.json"
    assert run(monkeypatch, "schema", "-o", out) == 0
    assert json.loads(out.read_text(encoding="utf-8"))["$schema"].startswith("https://json-schema.org/")
    assert "case.json" in capsys.readouterr().out
    assert run(monkeypatch, "schema", "-o", tmp_path / "case.toml") == 2
