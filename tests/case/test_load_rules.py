"""The tables of a case: every rule that a value can break."""

import json
from pathlib import Path
from typing import Any

import pytest

from fctd.case.errors import MISSING
from tests.case.test_load import refusal
from tests.rules import COMBINED, RULES


def check(path: Path, overrides: dict[str, Any], key: str, value: object, expected: str) -> None:
    """The overrides are refused by a message with file, key, value and what was expected."""
    error = refusal(path, overrides)
    assert (error.file, error.key, error.value) == (path, key, value)
    shown = f"{key} is missing: " if value is MISSING else f"{key} = {json.dumps(value)}: "
    first = str(error).splitlines()[0]
    assert first.startswith(f"{path}: {shown}expected ")
    assert expected in first


@pytest.mark.parametrize(("key", "value", "expected"), RULES)
def test_rule(case_file: Path, key: str, value: object, expected: str) -> None:
    """One key set to a wrong value, or deleted where the value is None."""
    check(case_file, {key: value}, key, MISSING if value is None else value, expected)


@pytest.mark.parametrize(("overrides", "key", "value", "expected"), COMBINED)
def test_combined_rule(case_file: Path, overrides: dict[str, Any], key: str, value: object, expected: str) -> None:
    """Keys that do not go together, and wrong items inside lists."""
    check(case_file, overrides, key, value, expected)
