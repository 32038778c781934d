"""A hole of WITSML: its sections, and the intervals from the surface down that a string meets."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Final

from fctd.case.errors import InputError, naming
from fctd.case.message import quantity
from fctd.case.units import DEEPEST, FRICTION, LENGTH, Quantity
from fctd.case.wall import IntervalKind
from fctd.case.witsml.objects import GEOMETRY, Item, read_object
from fctd.case.witsml.tubular import DIAMETER

MOST_SECTIONS: Final = 1000
ROUNDING: Final = 1.0  # [m]: sections that are apart by less follow each other
_DEPTH: Final = Quantity(dimension=LENGTH, at_least=0.0, at_most=DEEPEST)
_OPEN, _UNKNOWN = "open hole", ("", "unknown")


@dataclass(frozen=True)
class Section:
    """A section as the file has it: number in the file, `typeHoleCasing`, top and bottom, inner and outer diameter [m].

    inner, outer, friction : None where they are not given; 0 is kept.
    """

    number: int
    type: str
    top: float
    bottom: float
    inner: float | None
    outer: float | None
    friction: float | None

    @property
    def kind(self) -> IntervalKind | None:
        """Whether it is cased or open; None where the file does not say."""
        word = self.type.casefold()
        return None if word in _UNKNOWN else "open" if word == _OPEN else "cased"


@dataclass(frozen=True)
class Interval:
    """A stretch of the hole [m] and the section that a string meets there, None where the file has none; others : the
    sections around it."""

    top: float
    bottom: float
    section: Section | None
    others: tuple[Section, ...] = ()


@dataclass(frozen=True)
class Geometry:
    """A hole: name, wellbore, sections, and the depth that the file has of the whole [m], or None."""

    name: str
    wellbore: str
    sections: tuple[Section, ...]
    bottom: float | None

    @property
    def intervals(self) -> list[Interval]:
        """The hole from the surface down: of sections around each other the narrowest, and stretches without any.

        A section without a diameter goes before the others there: nobody knows whether it is narrower.
        """
        edges = _edges(self.sections)
        found: list[Interval] = []
        for top, bottom in pairwise(edges):
            middle = 0.5 * (top + bottom)
            here = sorted(
                (section for section in self.sections if section.top < middle < section.bottom),
                key=lambda section: (section.inner or 0.0, section.number),
            )
            section = here[0] if here else None
            if found and found[-1].section is section and found[-1].others == tuple(here[1:]):
                found[-1] = Interval(found[-1].top, bottom, section, tuple(here[1:]))
            else:
                found.append(Interval(top, bottom, section, tuple(here[1:])))
        return found


def _edges(sections: Sequence[Section]) -> list[float]:
    """The surface, and the depths [m] at which sections begin and end; one for those that differ by rounding."""
    ends = {0.0, *(section.bottom for section in sections)}
    tops = {section.top for section in sections}
    return sorted(ends | {top for top in tops if all(abs(top - end) >= ROUNDING for end in ends)})


def read_geometry(path: Path, name: str | None = None) -> Geometry:
    """The hole of a WITSML file, of this name or uid where it has several.

    Raises InputError, which names file, element, value and what was expected, for what cannot be read.
    """
    with naming(path):
        item = read_object(path, GEOMETRY, name)
        sections = [_section(number, found) for number, found in enumerate(item.items(GEOMETRY.part), start=1)]
        if len(sections) > MOST_SECTIONS:
            raise InputError(f"at most {MOST_SECTIONS} sections of a wbGeometry")
        return Geometry(
            item.text("name"), item.text("nameWellbore"), tuple(sections), item.quantity("mdBottom", _DEPTH)
        )


def _section(number: int, item: Item) -> Section:
    depths = {}
    for name in ("mdTop", "mdBottom"):
        depth = item.quantity(name, _DEPTH)
        if depth is None:
            raise InputError("a measured depth with its uom", key=f"{item.place}, {name}")
        depths[name] = depth
    top, bottom = depths["mdTop"], depths["mdBottom"]
    if bottom <= top:
        expected = f"a depth below mdTop, {quantity(top, 'm')}"
        raise InputError(expected, key=f"{item.place}, mdBottom", value=quantity(bottom, "m"))
    return Section(
        number, item.text("typeHoleCasing"), top, bottom, item.quantity("idSection", DIAMETER),
        item.quantity("odSection", DIAMETER), item.number("factFric", FRICTION),
    )  # fmt: skip
