"""Keys of a case on the axes of pictures: words, and the unit of numbers that are written without one."""

import pytest

from fctd.plots.keys import labelled


@pytest.mark.parametrize(
    ("key", "unit", "label"),
    [
        ("operations[0].rpm", "", "rotation, operation 1, rev/min"),
        ("operations[1].speed", "ft/min", "speed, operation 2, ft/min"),
        ("bit.weight_on_bit", "", "weight on bit, N"),
        ("bit.torque", "", "bit torque, N·m"),
        ("mud.density", "kg/m^3", "mud density, kg/m³"),
        ("friction", "", "friction factor"),
        ("friction.open", "", "friction factor, open hole"),
        ("wellbore.intervals[0].friction", "", "friction factor, interval 1"),
        ("wellbore.tortuosity.amplitude", "mm", "tortuosity amplitude, mm"),
        ("string.components.1.outer_diameter", "", "outer diameter, component 2, m"),
    ],
)
def test_a_key_is_labelled_in_words_with_its_unit(key: str, unit: str, label: str) -> None:
    assert labelled(key, unit) == label
