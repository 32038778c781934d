"""Names in place of indices in the keys of components and intervals."""

from typing import Any

import pytest

from fctd.case.errors import InputError
from fctd.case.named_items import by_index

NAMES = ["6 3/4 in collar", "HWDP", "5 in drill pipe, 19.5 lb/ft", "5 in drill pipe", "hwdp 2", "twin", "TWIN"]
RAW: dict[str, Any] = {
    "string": {"components": [*({"name": name} for name in NAMES), {"pipe": "5 in 19.5 S-135 NC50, premium"}, 3]},
    "wellbore": {"intervals": [{"name": "9 5/8 in casing"}, {}]},
}


@pytest.mark.parametrize(
    ("key", "index"),
    [
        ("string.components.HWDP.length", "string.components[1].length"),
        ("string.components.hwdp.joint.length", "string.components[1].joint.length"),
        ("string.components.HWDP 2", "string.components[4]"),
        ("string.components.5 in drill pipe, 19.5 lb/ft.length", "string.components[2].length"),
        ('string.components."5 in drill pipe".length', "string.components[3].length"),
        ("string.components.5 in 19.5 S-135 NC50, premium.length", "string.components[7].length"),
        ("wellbore.intervals.9 5/8 in casing.friction", "wellbore.intervals[0].friction"),
        *((key, key) for key in ("string.components[1].length", "string.components.1.length", "string.components")),
        *((key, key) for key in ("mud.density", "operations.trip.speed", "string.componentsx.a")),
    ],
)
def test_a_name_is_an_index(key: str, index: str) -> None:
    assert by_index(RAW, key) == index


@pytest.mark.parametrize(
    ("key", "message"),
    [
        ("string.components.HWPD.length", 'string.components = "HWPD": expected the component "HWDP"'),
        ("string.components.drill pipe.length", 'the components "5 in drill pipe, 19.5 lb/ft", "5 in drill pipe"'),
        ("string.components.collar.length", 'expected the component "6 3/4 in collar"'),
        ("wellbore.intervals.liner.friction", 'wellbore.intervals = "liner": expected one of the intervals "9 5/8 in'),
        ("string.components.twin.length", "expected one of string.components[5], string.components[6], which all have"),
    ],
)
def test_a_name_that_no_item_or_several_have(key: str, message: str) -> None:
    with pytest.raises(InputError) as refused:
        by_index(RAW, key)
    assert message in str(refused.value)


@pytest.mark.parametrize("raw", [{}, {"string": 3}, {"string": {"components": 3}}])
def test_a_case_without_the_list_has_no_names(raw: dict[str, Any]) -> None:
    assert by_index(raw, "string.components.HWDP.length") == "string.components.HWDP.length"
