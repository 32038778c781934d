"""Keys of a case and the quantities that they are declared with."""

import pytest

from fctd.case.key_quantities import quantities_of, unit_of


@pytest.mark.parametrize(
    ("key", "unit"),
    [("bit.weight_on_bit", "N"), ("operations[0].speed", "m/s"), ("wellbore.tortuosity.amplitude", "m"),
     ("friction", ""), ("mud.colour.shade", ""), ("", "")],
)  # fmt: skip
def test_a_key_has_the_unit_of_bare_numbers(key: str, unit: str) -> None:
    assert unit_of(key) == unit


def test_a_plain_number_is_no_quantity() -> None:
    assert quantities_of("wellbore.intervals[0].friction") == []
    assert [of.noun for of in quantities_of("string.components.1.joint.length")] == ["a length"]
