"""Colours and markers of operations."""

from itertools import pairwise

from fctd.case.operations import KINDS
from fctd.plots.palette import BUCKLED, LOOKS


def lightness(colour: str) -> float:
    """Relative luminance of a colour (ITU-R BT.601, as a grey printer weighs it)."""
    red, green, blue = (int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return 0.299 * red + 0.587 * green + 0.114 * blue


def cie_lightness(colour: str) -> float:
    """L* of a colour of sRGB (IEC 61966-2-1; CIE 15), 0 for black to 100 for white."""
    parts = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    red, green, blue = (x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4 for x in parts)
    return 116 * max(0.2126 * red + 0.7152 * green + 0.0722 * blue, 0.002627) ** (1 / 3) - 16


def test_every_operation_has_a_colour_and_a_marker_of_its_own() -> None:
    assert set(LOOKS) == set(KINDS)
    assert len({colour for colour, _ in LOOKS.values()}) == len({marker for _, marker in LOOKS.values()}) == len(KINDS)


def test_no_two_operations_are_the_same_grey() -> None:
    """Lightness (CIE L*) at least 7 apart, of which 2 are just seen; a twentieth as a grey printer weighs it."""
    for greys, apart in (
        ([cie_lightness(c) for c, _ in LOOKS.values()], 7),
        ([lightness(c) for c, _ in LOOKS.values()], 0.05),
    ):
        assert min(b - a for a, b in pairwise(sorted(greys))) > apart


def test_curves_are_darker_than_what_lies_below_them() -> None:
    below = min(lightness(grey) for grey in BUCKLED.values())
    assert max(lightness(colour) for colour, _ in LOOKS.values()) < below - 0.1
