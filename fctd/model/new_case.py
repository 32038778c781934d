"""A case file to start from, as text: a template's string in its own well or in that of a survey."""

import json
import re
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.operations import KINDS
from fctd.case.surveys import reading as surveys
from fctd.case.systems import (
    BIT_TORQUE,
    DENSITY,
    FORCE,
    LENGTH,
    LINEAR_MASS,
    ROP,
    SPEED,
    SYSTEMS,
    VISCOSITY,
    Kind,
    System,
)
from fctd.case.tables.headers import Choice, Choices, NoUnitError
from fctd.model.first_numbers import FOOT, Laid, laid, narrowest_of, round_up, sensible_shoe, stiff_wall
from fctd.model.first_runs import COMMENTS, PERIODS, aligned, drilling, entry, rotation, trip
from fctd.model.section import section_of
from fctd.model.templates import TEMPLATES, Part, Template, TemplateName
from fctd.model.torsion import torsional_period

# The digits after the point that a person would write, in the two systems.
WRITTEN = {LENGTH: (2, 2), DENSITY: (0, 1), FORCE: (0, 0), BIT_TORQUE: (1, -2), LINEAR_MASS: (1, 1)}
# A well that is steeper than this gets the string of the template ``horizontal`` [rad].
NEARLY_HORIZONTAL = np.radians(70)
# The default damping of a contact point is for a softer wall: on a stiff one a long string would not come to rest.
DAMPING = "1e5 N*s/m"
# What the keys of a component are about.
KEY_COMMENTS = {
    "contact_diameter": "of the joints, which touch first",
    "linear_mass": "with joints",
}


WIDEST = 110  # characters of a comment
FILL_IN = "fill in"  # the comment of a key without a value
Block = tuple[str, ...]
"""Lines of TOML: a table, or a part of one."""


class Blank(NamedTuple):
    """A key that is left blank: what to write there, and what the file has in its place."""

    key: str
    expected: str
    found: str

    def __str__(self) -> str:
        return f"{self.expected} ({self.found})"


@dataclass(frozen=True)
class Given:
    """What files give in place of the template's hole or string.

    intervals, components : their tables; bit : lines of its table; parts : what is known of the string; blanks : keys
    without a value, in the order of their lines; doubts : what is probably wrong, a file and a sentence each.
    """

    intervals: tuple[Block, ...] = ()
    components: tuple[Block, ...] = ()
    bit: Block = ()
    parts: Laid = ()
    blanks: tuple[Blank, ...] = ()
    doubts: tuple[tuple[str, str], ...] = ()

    @property
    def assumed(self) -> str:
        """A comment on what no file gives."""
        return "assumed: put yours" if self.intervals or self.components else ""


@dataclass(frozen=True)
class Plan:
    """What a case file is made of.

    name, title : of the case, and what it is; hole : lines of TOML with survey or stations; shoe, depth [m] : casing
    shoe, 0 where there is none, and end of the hole; shoe_comment : why it is there; stiffness [N/m/m] : of the wall.
    """

    name: str
    title: str
    template: Template
    units: System
    hole: tuple[str, ...]
    shoe: float
    depth: float
    shoe_comment: str
    stiffness: float
    given: Given = Given()

    def text(self) -> str:
        """The case file."""
        return "\n\n".join("\n".join(block) for block in self._blocks()) + "\n"

    @property
    def blanks(self) -> list[tuple[int, Blank]]:
        """The keys that are to be filled in before the case can be read, with the numbers of their lines."""
        lines = enumerate(self.text().splitlines(), start=1)
        numbers = (number for number, line in lines if re.fullmatch(rf'\w+ = "" +# {FILL_IN}', line))
        return list(zip(numbers, self.given.blanks, strict=True))

    def _blocks(self) -> Iterator[tuple[str, ...]]:
        """The lines of each table, between which stand blank ones."""
        quantity, template = Quantities(self.units), self.template
        title = f"{self.title[0].upper()}{self.title[1:]}: change what differs in yours."
        yield (
            *textwrap.wrap(title, WIDEST, initial_indent="# ", subsequent_indent="# "),
            '# A quantity is a text with its unit ("8.5 in", "1250 kg/m^3"), or a bare number in SI.',
            "# A pipe is one of the catalogue, which `fctd pipes` lists: sizes, mass, joints and limits come with it.",
            '# It is new; a class, "…, premium" or "…, class 2", lowers its strength alone, and its weight stays.',
            f"name = {json.dumps(self.name, ensure_ascii=False)}",
            *([aligned('units = "field"', "in which results are shown")] if self.units == "field" else []),
        )
        stiffness = f"{self.stiffness:.0e}".replace("e+0", "e")
        yield (
            "[wellbore]",
            *self.hole,
            entry("geometry", "arcs", "the hole follows the circular arcs between stations"),
            entry("stiffness_per_length", f"{stiffness} N/m/m", "of the wall: the string presses less than 1 % of its"),
            " " * COMMENTS + "# clearance into it",
        )
        yield from self.given.intervals or self._intervals(quantity)
        yield from self.given.components or self._components(quantity)
        mud = ["[mud]", entry("density", quantity(DENSITY, template.mud), self.given.assumed)]
        if template.weight_on_bit:
            mud.append(
                entry("viscosity", f"20 {VISCOSITY.unit(self.units)}", "plastic viscosity: it damps the string in time")
            )
        yield tuple(mud)
        if template.flotation:
            yield tuple(f"# {line}" for line in self._flotation(quantity))
        weight = quantity(FORCE, 1e3 * template.block_weight)
        rig = "[rig]", entry("block_weight", weight, "added to the hook load on the indicator")
        if template.weight_on_bit:
            yield *rig, aligned("autodriller = true", "holds the weight on bit where it drills in time")
            yield (
                aligned("[bit]", "while drilling" + (self.given.assumed and f", {self.given.assumed}")),
                entry("weight_on_bit", quantity(FORCE, 1e3 * template.weight_on_bit)),
                entry("torque", quantity(BIT_TORQUE, 1e3 * template.bit_torque), "of steady strings"),
                *self.given.bit,
            )
            yield (aligned("[bit.rock]", "gives the torque in time: a PDC bit in medium rock"),)
        else:
            yield rig
        yield "[contact]", entry("damping", DAMPING, "so that the string comes to rest on the stiff wall")
        if template.weight_on_bit:
            comment = "the string's torsional period: a record is a mean over it"
            yield "[record]", entry("interval", f"{self.period:g} s", comment)
        comment = "for fctd simulate; charts ask for their operations"
        yield aligned("[[operations]]", comment), *self._first(quantity)
        if template.weight_on_bit:
            yield from (tuple(f"# {line}" for line in block) for block in self._others(quantity))

    @property
    def period(self) -> float:
        """The slowest torsional period of the string [s], rounded to 0.1 s, or to one digit of a shorter one."""
        parts = [
            (length, section.axial_inertia, section.GJ)
            for component, length in self.given.parts or laid(self.template, self.shoe, self.depth)
            for section in [section_of(component, self.template.mud)]
            if length > 0
        ]
        period = torsional_period(*zip(*reversed(parts), strict=True))
        return round(period, 1) if period >= 0.1 else float(f"{period:.1g}")

    def _intervals(self, quantity: "Quantities") -> Iterator[Block]:
        cased = "from the surface down", "cased", self.shoe, self.shoe_comment, "inside the casing"
        for hole, (where, kind, end, ends, size) in (
            (self.template.cased, cased),
            (self.template.open, ("", "open", self.depth, "the end of the hole", "")),
        ):
            yield (
                aligned("[[wellbore.intervals]]", where),
                entry("name", hole.name),
                entry("kind", kind),
                entry("to_md", quantity(LENGTH, end), ends),
                entry("diameter", f"{hole.diameter} in", size),
                f"friction = {hole.friction:.2f}",
            )

    def _components(self, quantity: "Quantities") -> Iterator[Block]:
        for k, part in enumerate(self.template.string):
            above = "" if k else "from the bit up; segments are chosen for you"
            comment = "no length: it reaches the surface" if part.length is None else above
            yield aligned("[[string.components]]", comment), *self._part(part, quantity)

    def _part(self, part: Part, quantity: "Quantities") -> Iterator[str]:
        yield entry("name", part.name)
        if part.length is not None:
            yield entry("length", quantity(LENGTH, part.length or self.depth - self.shoe))
        for key, value in part.keys.items():
            text = value if isinstance(value, str) else quantity(LINEAR_MASS, value)
            yield entry(key, text, KEY_COMMENTS.get(key, ""))

    def _flotation(self, quantity: "Quantities") -> Iterator[str]:
        """How the string floats: what takes the place of the table of the mud."""
        mud = quantity(DENSITY, self.template.mud)
        yield "Casing that floats: put this in place of [mud] and its density above, without the #."
        yield "[mud]"
        yield aligned("float = true", "a float shoe at the lower end")
        yield "[[mud.outside]]"
        yield entry("density", mud)
        yield aligned("[[mud.inside]]", "from the surface down")
        yield entry("to_md", quantity(LENGTH, self.shoe), "the flotation collar")
        yield entry("density", mud)
        yield "plug = true"
        yield "[[mud.inside]]"
        yield aligned("density = 0", "air")

    def _first(self, quantity: "Quantities") -> Iterator[str]:
        """The operation of the case."""
        end = quantity(LENGTH, self.depth)
        if self.template.weight_on_bit:
            lasts = f"{PERIODS * self.period:g} s"
            yield from rotation(end, lasts, f"{PERIODS} records: the first ones wind the string up")
        else:
            start = max(self.depth - RUN, 0.5 * self.depth)
            yield from trip("trip_in", quantity(LENGTH, start), end, HOIST[self.units])

    def _others(self, quantity: "Quantities") -> Iterator[tuple[str, ...]]:
        """What else a string that drills may begin with: blocks of comments, each with its heading."""
        end, up = quantity(LENGTH, self.depth), quantity(LENGTH, self.depth - 2 * RUN)
        ways = (("trip_out", end, up), ("trip_in", up, end))
        out, back = (trip(kind, start, to, HOIST[self.units]) for kind, start, to in ways)
        yield (
            "A first trip, a stand up and down: put this in place of the operation above, without the #.",
            "[[operations]]", *out, "[[operations]]", *back,
        )  # fmt: skip
        rate, speed = RATE[self.units]
        # It ends with a whole record, as the mean over a part of one swings; the depth is rounded.
        lasts = (4 * PERIODS - 0.1) * self.period - 0.5 * KINDS["drill_rotating"].model_fields["ramp_time"].default
        above = quantity(LENGTH, self.depth - rate * lasts)
        yield (
            "A first drilling run: put this in place of the operation above, without the #.",
            "[[operations]]", *drilling(above, end, speed),
        )  # fmt: skip


# Distance of a casing's trip [m], half of that of a drill string's.
RUN = 15.24
# Speed of a trip; rate of penetration [m/s], and as it is written.
HOIST = {system: f"{number} {SPEED.unit(system)}" for system, number in zip(SYSTEMS, (0.3, 60), strict=True)}
RATE = {
    system: (number * ROP.si(system), f"{number} {ROP.unit(system)}")
    for system, number in zip(SYSTEMS, (20, 60), strict=True)
}


@dataclass(frozen=True)
class Quantities:
    """Writes SI values with the units of a system, rounded to digits that a person would write."""

    units: System

    def __call__(self, kind: Kind, value: float) -> str:
        digits = WRITTEN[kind][SYSTEMS.index(self.units)]
        number = value / kind.si(self.units)
        if kind is LENGTH:  # a depth must not be rounded beyond the end of the survey
            number = np.floor(number * 10**digits + 1e-6) / 10**digits
        return f"{round(float(number), digits):.10g} {kind.unit(self.units)}"

    def round_length(self, length: float) -> str:
        """A bare length of at least this [m]: 1, 2 or 5 times a power of ten in the system's unit."""
        return f"{round_up(length / LENGTH.si(self.units)):g}"


def _scaled(template: Template, units: System) -> tuple[float, Template]:
    """What a template's metre is written as, 1 m or 3 ft [m], and the template with parts of such lengths."""
    scale = 1.0 if units == "si" else 3 * FOOT
    parts = (part._replace(length=part.length and part.length * scale) for part in template.string)
    return scale, template._replace(string=tuple(parts))


def from_template(template: Template, name: str, units: System) -> Plan:
    """The template's own well."""
    scale, scaled = _scaled(template, units)
    stations = np.array(template.stations) * [scale, 1.0, 1.0]
    quantity = Quantities(units)
    md = [json.dumps(quantity(LENGTH, depth)) if units == "field" else f"{depth:g}" for depth in stations[:, 0]]
    rows = [f"    [{at}, {inc:g}, {azi:g}]," for at, (_, inc, azi) in zip(md, stations, strict=True)]
    hole = [
        aligned("stations = [", f"measured depth [{LENGTH.unit(units)}], inclination and azimuth [deg]"),
        *rows,
        "]",
    ]
    shoe, depth = scale * template.shoe, float(stations[-1, 0])
    stiffness = wall_of(scaled, np.radians(stations) * [180 / np.pi, 1.0, 1.0], shoe)
    return Plan(name, template.title, scaled, units, tuple(hole), shoe, depth, "the casing shoe", stiffness)


def from_survey(
    name_of_template: TemplateName | None,
    name: str,
    units: System,
    path: str,
    columns: tuple[str, ...],
    stations: Array,
) -> Plan:
    """A template's string in the well of a survey; without a name of one, that which suits the inclination.

    path : as the case writes it; columns, stations : of `ReadSurvey`.
    """
    if name_of_template is None:
        steep = float(stations[:, 1].max()) > NEARLY_HORIZONTAL
        name_of_template = "horizontal" if steep else "build-hold"
    _, template = _scaled(TEMPLATES[name_of_template], units)
    hole = (entry("survey", path), *columns)
    shoe, depth = sensible_shoe(stations, 10.0 if units == "si" else 50 * FOOT), float(stations[-1, 0])
    comment = "an assumed casing shoe, below the build: put yours"
    title = f"the well of {path} with the string of {template.title}"
    return Plan(name, title, template, units, hole, shoe, depth, comment, wall_of(template, stations, shoe))


def wall_of(template: Template, stations: Array, shoe: float) -> float:
    """Stiffness [N/m/m] of the wall for a template's string in its hole; see `stiff_wall`."""
    parts = laid(template, shoe, float(stations[-1, 0]))
    return stiff_wall(parts, template.mud, narrowest_of(template), stations)


class ReadSurvey(NamedTuple):
    """A survey for a new case.

    keys : lines of TOML that the case needs beside its name; stations : (n, 3) [m, rad, rad]; note : what is to be
    said of the unit of its depths, or "".
    """

    keys: tuple[str, ...]
    stations: Array
    note: str


def read_survey(path: Path, units: System, columns: Choices | None = None, sheet: str | None = None) -> ReadSurvey:
    """A survey, with what is told of its columns and its sheet.

    A file that names no unit of depth is read in that of ``units``.  Raises InputError for a file that cannot be used.
    """
    said, assumed = dict(columns or {}), ""
    unit = LENGTH.unit(units)
    try:
        survey = surveys.read_survey(path, said, sheet)
    except NoUnitError:
        said["md"] = Choice(said.get("md", Choice()).header, unit)
        survey = surveys.read_survey(path, said, sheet)
        assumed = f"the file names no unit of depth: {unit} is assumed"
    written = survey.written.units[0]
    other = "ft" if unit == "m" else "m"
    remedy = f"if it is {other}, write the case anew with --columns md.unit={other}"
    note = f"{assumed}, as in the key wellbore.columns: {remedy}" if assumed else ""
    if written != unit and "md" not in said:
        note = f"its depths are in {written}, as the file says, those of the case in {unit}"
    of_sheet = () if sheet is None else (entry("sheet", sheet),)
    return ReadSurvey((*of_sheet, *_lines_of(said, assumed)), survey.stations, note)


def _lines_of(said: Choices, comment: str) -> tuple[str, ...]:
    """``columns`` of a case, as a line of TOML."""
    if not said:
        return ()
    tables = []
    for key, wanted in said.items():
        pairs = [("header", wanted.header), ("unit", wanted.unit)]
        inner = ", ".join(f"{name} = {json.dumps(text, ensure_ascii=False)}" for name, text in pairs if text)
        tables.append(f"{key} = {{{inner}}}")
    return (aligned(f"columns = {{{', '.join(tables)}}}", comment),)
