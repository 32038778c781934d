"""The hole of a WITSML ``wbGeometry`` as intervals of a new case."""

from dataclasses import dataclass, field
from typing import Final

from fctd.case.doubts.hole import BELOW_TD, NARROWEST, WIDEST
from fctd.case.pipes.catalogue import SAME_DIAMETER, catalogue
from fctd.case.pipes.names import CASING, TUBING, in_inches
from fctd.case.systems import ACROSS, LENGTH
from fctd.case.witsml.geometry import ROUNDING, Geometry, Interval
from fctd.model.given.table import GivenTable, Writer
from fctd.model.new_case import Blank, Block
from fctd.model.templates import Template

# A bit leaves little room in the casing above: narrower open hole of exactly the diameter of a pipe is none that was
# drilled, but the pipe in it.
_DRILLED: Final = 0.9
_SIZES: Final = (CASING, TUBING)


@dataclass
class GivenHole:
    """Tables of the intervals; shoe : the lowest end of casing above the end of the hole [m], 0 without one; depth : of
    the hole [m]; narrowest : the least diameter [m], infinite without any; blanks, doubts : as of ``Given``."""

    intervals: list[Block] = field(default_factory=list)
    blanks: list[Blank] = field(default_factory=list)
    doubts: list[str] = field(default_factory=list)
    shoe: float = 0.0
    depth: float = 0.0
    narrowest: float = float("inf")


def lay_hole(geometry: Geometry, file: str, template: Template, end: float, write: Writer) -> GivenHole:
    """The intervals of a hole, with the friction factors of a template where the file has none.

    end : of the survey [m].
    """
    found, hole = geometry.intervals, GivenHole()
    hole.depth = min(end, found[-1].bottom)
    bore = 0.0
    for k, interval in enumerate(found):
        table = GivenTable(
            "[[wellbore.intervals]]", "" if k else "from the surface down", f"wellbore.intervals[{k}]", file, write
        )
        diameter = _fill(table, interval, bore, template, write)
        hole.intervals.append(table.block)
        hole.blanks += table.blanks
        bore = diameter or bore
        hole.narrowest = min(hole.narrowest, diameter or hole.narrowest)
        if interval.section is not None and interval.section.kind == "cased" and interval.bottom < hole.depth:
            hole.shoe = interval.bottom
    hole.doubts += _doubts(geometry, found, end, write)
    return hole


def _fill(table: GivenTable, interval: Interval, bore: float, template: Template, write: Writer) -> float | None:
    """Write an interval; gives its diameter [m] where the file has one.  bore : of the interval above [m]."""
    section = interval.section
    stretch = f"from {write(LENGTH, interval.top)} to {write(LENGTH, interval.bottom)}"
    words = "no section" if section is None else section.type or "section"
    if section is not None and section.outer:
        words += f", {write(ACROSS, section.outer)} outside"
    table.text("name", words)
    kind = None if section is None else section.kind
    if kind is None:
        given = "has no section" if section is None else f'section {section.number} has no typeHoleCasing or "unknown"'
        table.blank("kind", '"cased" or "open"', f"{given}, {stretch}")
    else:
        table.text("kind", kind)
    table.value("to_md", LENGTH, interval.bottom)
    diameter, why = (None, "no section") if section is None else _diameter(interval, bore, write)
    if why:
        of = "of the bit that drilled it" if kind == "open" else "inside"
        table.blank("diameter", f"the diameter {of}, such as '8.5 in'", f"{why}, {stretch}")
        diameter = None
    elif diameter is not None:
        table.value("diameter", ACROSS, diameter, "inside the casing" if kind == "cased" else "")
    friction = None if section is None else section.friction
    if friction:
        table.line(f"friction = {friction:.9g}")
    else:
        usual = template.cased if kind == "cased" else template.open
        table.line(f"friction = {usual.friction:.2f}", "assumed" + ("" if friction is None else ", factFric is 0"))
    return diameter


def _diameter(interval: Interval, bore: float, write: Writer) -> tuple[float | None, str]:
    """The diameter of a section [m], and what is wrong with it, or ""."""
    section = interval.section
    assert section is not None  # a stretch without one has no diameter
    inner, name = section.inner, f"section {section.number}, idSection"
    if inner is None:
        return None, f"{name} is missing"
    text = f"{name} is {write(ACROSS, inner)}"
    if not NARROWEST <= inner <= WIDEST:
        return inner, f"{text}, which no hole has"
    if section.outer and inner >= section.outer:
        return inner, f"{text}, and odSection {write(ACROSS, section.outer)}"
    if section.kind == "open" and 0 < inner < _DRILLED * bore:
        pipes = [pipe.size for pipe in catalogue() if pipe.kind in _SIZES and abs(pipe.outer - inner) <= SAME_DIAMETER]
        if pipes:
            above = f"{write(ACROSS, bore)} above it"
            return inner, f"{text}, the outer diameter of {in_inches(pipes[0])} in pipe, and the hole has {above}"
    return inner, ""


def _doubts(geometry: Geometry, found: list[Interval], end: float, write: Writer) -> list[str]:
    doubts = []
    bottom = found[-1].bottom
    if abs(bottom - end) > BELOW_TD:
        doubts.append(f"its sections end at {write(LENGTH, bottom)}, the survey at {write(LENGTH, end)}")
    if geometry.bottom and abs(bottom - geometry.bottom) > ROUNDING:
        whole = write(LENGTH, geometry.bottom)
        doubts.append(f"its sections end at {write(LENGTH, bottom)}, and its mdBottom is {whole}")
    for interval in found:
        if interval.others and interval.section is not None:
            numbers = ", ".join(str(section.number) for section in interval.others)
            stretch = f"from {write(LENGTH, interval.top)} to {write(LENGTH, interval.bottom)}"
            inner = f"that of section {interval.section.number} counts, the narrowest"
            doubts.append(f"{stretch} it also has section {numbers}: the diameter {inner}")
    return doubts
