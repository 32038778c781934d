"""``fctd schema``: JSON on the screen or in a file."""

import json
from pathlib import Path

from fctd.case.schema import case_schema
from tests.commands import Command


def test_the_schema_is_printed(cli: Command) -> None:
    assert json.loads(cli("schema").out) == case_schema()


def test_the_schema_is_written(tmp_path: Path, cli: Command) -> None:
    out = tmp_path / "case.json"
    printed = cli("schema", "-o", out)
    assert json.loads(out.read_text(encoding="utf-8"))["$schema"].startswith("https://json-schema.org/")
    assert "case.json" in printed.out
    cli("schema", "-o", tmp_path / "case.toml", code=2)
