"""Colours of all pictures and pages, and the marker of each operation."""

from typing import Final

from fctd.case.operations import KINDS
from fctd.results import buckling

# After Okabe and Ito's palette, which colour-blind readers can distinguish; some of the colours are darker or lighter
# than theirs, so that no two are the same grey.
PALETTE: Final = {
    "blue": "#004C98",
    "vermilion": "#B43600",
    "black": "#000000",
    "sky": "#6CBEF2",
    "green": "#00946C",
    "purple": "#D27AB0",
}
QUIET, DARK, SHADE = "#6e6e6e", "#303030", "#e4e4e4"
# An operation has a colour and, for print in grey, a marker: one of its own, or what all others share.
_OWN_LOOKS: Final = {
    "trip_out": (PALETTE["vermilion"], "^"),
    "rotate_off_bottom": (PALETTE["black"], "o"),
    "trip_in": (PALETTE["blue"], "v"),
    "back_ream": (PALETTE["purple"], "D"),
    "drill_rotating": (PALETTE["green"], "s"),
    "drill_sliding": (PALETTE["sky"], "P"),
}
LOOKS: Final = _OWN_LOOKS | {kind: (DARK, "p") for kind in KINDS if kind not in _OWN_LOOKS}
# Greys of a buckled string by mode, and of their edges; light enough for a curve of any colour on them.
BUCKLED: Final = dict(zip(buckling.BUCKLED, ("#f0f0f0", "#c6c6c6"), strict=True))
EDGE = "#8a8a8a"
MEASURED = "#ffe04d"  # of the faces of measured points
# Of the cases of a comparison.
CASES: Final = tuple(PALETTE.values())
# Dashes, drawn and left out in turn, in widths of a line.
Dash = tuple[float, ...]
SOLID: Final[Dash] = ()
# A set of friction factors has a dash.
DASHES: Final[tuple[Dash, ...]] = (
    SOLID, (5, 2), (1, 1.3), (7, 2, 1.5, 2), (3, 1.5), (9, 3), (7, 1.5, 1, 1.5, 1, 1.5), (1, 3), (12, 2, 4, 2),
    (5, 1.5, 5, 1.5, 1, 1.5),
)  # fmt: skip
