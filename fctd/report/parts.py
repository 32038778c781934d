"""What a report is made of: sections of tables, texts and pictures, which every kind of file draws as they are."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from fctd.results.shown_tables import Table
from fctd.results.unit_systems import System

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Text:
    """A paragraph."""

    text: str


@dataclass(frozen=True)
class Picture:
    """A picture with its caption."""

    caption: str
    figure: Figure

    @property
    def size(self) -> tuple[float, float]:
        """Width and height [in]."""
        width, height = self.figure.get_size_inches()
        return float(width), float(height)

    def drawn(self, suffix: str, **options: Any) -> bytes:
        """The picture in a format; options : of matplotlib's ``savefig``."""
        from fctd.plots.style import drawn

        return drawn(self.figure, suffix, **options)


Part = Table | Text | Picture


@dataclass(frozen=True)
class Section:
    """A section: its title, and what stands in it, in this order."""

    title: str
    parts: tuple[Part, ...]


@dataclass(frozen=True)
class Report:
    """A report: title, company, who made it (both may be empty), the date, a logo (PNG), its sections, its subject."""

    title: str
    company: str
    by: str
    date: str
    logo: bytes | None
    units: System
    sections: tuple[Section, ...] = field(default=())
    subject: str = "Torque and drag"

    @property
    def tables(self) -> list[Table]:
        """All tables in their order."""
        return [part for section in self.sections for part in section.parts if isinstance(part, Table)]
