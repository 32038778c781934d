"""The JSON Schema of a case: every case of the project conforms, wrong ones do not."""

import copy
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.raw_case import set_key
from fctd.case.schema import case_schema
from tests.cases import case_files

ROOT = Path(__file__).parents[2]
FILES = sorted([*case_files(ROOT / "examples"), *(ROOT / "validation" / "cases").glob("*.toml")])
SCHEMA = case_schema()
TYPES: dict[str, type | tuple[type, ...]] = {
    "object": dict, "array": list, "string": str, "number": (int, float), "integer": int, "boolean": bool,
}  # fmt: skip
KNOWN = {
    "$schema", "$defs", "$ref", "title", "description", "default", "format", "discriminator", "type", "properties",
    "required", "additionalProperties", "propertyNames", "items", "prefixItems", "minItems", "maxItems", "anyOf",
    "oneOf", "const", "enum", "pattern", "minimum", "maximum", "exclusiveMinimum",
}  # fmt: skip


def conforms(value: Any, schema: dict[str, Any]) -> bool:
    """Whether a value conforms; of JSON Schema, what the schema of a case uses, and an AssertionError for more."""
    assert set(schema) <= KNOWN
    if "$ref" in schema and not conforms(value, SCHEMA["$defs"][schema["$ref"].removeprefix("#/$defs/")]):
        return False
    if "anyOf" in schema and not any(conforms(value, part) for part in schema["anyOf"]):
        return False
    if "oneOf" in schema and sum(conforms(value, part) for part in schema["oneOf"]) != 1:
        return False
    if "const" in schema and value != schema["const"]:
        return False
    if "enum" in schema and value not in schema["enum"]:
        return False
    kind = schema.get("type")
    if kind == "null":
        return value is None
    if kind is not None and (not isinstance(value, TYPES[kind]) or (isinstance(value, bool) and kind != "boolean")):
        return False
    if isinstance(value, str) and not re.search(schema.get("pattern", ""), value):
        return False
    if isinstance(value, int | float) and kind in ("number", "integer"):
        low, high = schema.get("minimum", -float("inf")), schema.get("maximum", float("inf"))
        if not (low <= value <= high and value > schema.get("exclusiveMinimum", -float("inf"))):
            return False
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            return False
        first = schema.get("prefixItems", [])
        parts = [*first, *[schema.get("items", {})] * (len(value) - len(first))]
        return all(conforms(item, part) for item, part in zip(value, parts, strict=True))
    if isinstance(value, dict):
        if not set(schema.get("required", [])) <= set(value):
            return False
        others = schema.get("additionalProperties", {})
        for key, item in value.items():
            part = schema.get("properties", {}).get(key, others)
            if part is False or not conforms(item, part) or not conforms(key, schema.get("propertyNames", {})):
                return False
    return True


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_the_cases_of_the_project_conform(file: Path) -> None:
    assert len(FILES) >= 9
    assert conforms(tomllib.loads(file.read_text(encoding="utf-8")), SCHEMA)


SMALL: dict[str, Any] = {
    "name": "small",
    "wellbore": {
        "stations": [["0 ft", 0, 0], [300, 10, 0]],
        "intervals": [{"to_md": "300 m", "diameter": 0.2, "friction": 0.2, "kind": "open"}],
    },
    "string": {"components": [{"name": "pipe", "outer_diameter": "5 in", "inner_diameter": 0.1}]},
    "solver": {"step": "2 ms"},
    "operations": [
        {"kind": "trip_in", "from_md": 100, "to_md": 200, "speed": "60 ft/min"},
        {"kind": "rotate_off_bottom", "duration": "10 s", "rpm": 60},
    ],
}


def changed(key: str, value: Any) -> dict[str, Any]:
    """The small case with another value."""
    raw = copy.deepcopy(SMALL)
    set_key(raw, key, value)
    return raw


def test_a_case_conforms() -> None:
    assert conforms(SMALL, SCHEMA)
    Case.model_validate(SMALL)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("wellbore.ovrlap", "0.1 m"),
        ("wellbore.geometry", "spline"),
        ("wellbore.survey", 3),
        ("wellbore.stations", [[0, 0]]),
        ("wellbore.intervals.0.friction", -0.1),
        ("wellbore.intervals.0.friction", "0.2"),
        ("wellbore.intervals.0.diameter", 0),
        ("wellbore.intervals.0.diameter", 8.5),
        ("wellbore.intervals.0.diameter", "wide"),
        ("string.components.0.segments", 2.5),
        ("string.components.0.segments", "3"),
        ("string.components.0.bend", True),
        ("string.components", {}),
        ("file", "x.toml"),
        ("operations.0.kind", "trip_up"),
        ("operations.0.duration", 3),
        ("operations.1.rpm", -1),
        ("contact", {"enabled": "yes"}),
        ("contact", {"friction_law": "none"}),
        ("name", 3),
    ],
)
def test_what_a_case_refuses_does_not_conform(key: str, value: Any) -> None:
    raw = changed(key, value)
    assert not conforms(raw, SCHEMA)
    with pytest.raises((InputError, ValueError)):
        Case.model_validate(raw, context={"folder": ROOT})


def test_a_required_key() -> None:
    assert not conforms({key: value for key, value in SMALL.items() if key != "string"}, SCHEMA)


def test_every_table_says_what_its_keys_expect() -> None:
    part = SCHEMA["$defs"]["ComponentSpec"]["properties"]
    assert part["outer_diameter"]["description"] == "a length such as '12 m' or '40 ft'"
    assert "S-135" in SCHEMA["$defs"]["ComponentSpec"]["description"]
