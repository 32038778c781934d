"""Colours and markers of operations."""

from fctd.case.operations import KINDS
from fctd.plots.palette import BUCKLED, LOOKS


def lightness(colour: str) -> float:
    """Relative luminance of a colour (ITU-R BT.601, as a grey printer weighs it)."""
    red, green, blue = (int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return 0.299 * red + 0.587 * green + 0.114 * blue


def test_every_operation_has_a_colour_and_a_marker_of_its_own() -> None:
    assert set(LOOKS) == set(KINDS)
    assert len({colour for colour, _ in LOOKS.values()}) == len({marker for _, marker in LOOKS.values()}) == len(KINDS)


def test_curves_are_darker_than_what_lies_below_them() -> None:
    below = min(lightness(grey) for grey in BUCKLED.values())
    assert max(lightness(colour) for colour, _ in LOOKS.values()) < below - 0.1
