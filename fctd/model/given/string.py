"""The string of a WITSML ``tubular`` as components of a new case."""

import math
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, Final

from fctd.case.doubts.string import HEAVY as HEAVIEST
from fctd.case.doubts.string import LIGHT as LIGHTEST
from fctd.case.pipes.catalogue import SAME_DIAMETER, pipes_of_size
from fctd.case.pipes.filling import lacks_joints
from fctd.case.pipes.grades import drill_pipe_grade_of, grade_of
from fctd.case.pipes.names import CASING, DRILL_PIPE, HEAVY, TUBING
from fctd.case.string import SHORT, ComponentSpec
from fctd.case.systems import ACROSS, ANGLE, AREA, LENGTH, LINEAR_MASS, STRESS, Kind
from fctd.case.witsml.tubular import BIT, Tubular, TubularPart
from fctd.model.first_runs import entry
from fctd.model.given.pieces import AT_AN_END, pieces_of
from fctd.model.given.pipe import body_mass, is_steel, nominal_of, pipe_of
from fctd.model.given.table import GivenTable, Writer
from fctd.model.new_case import Blank, Block

# Pipe with tool joints or couplings, which touch first and weigh.
_JOINTED: Final = {DRILL_PIPE: "tool joints", HEAVY: "tool joints", CASING: "couplings", TUBING: "couplings"}
_UNKNOWN: Final = ("", "unknown", "other")
_LONGEST_JOINT: Final = 20.0  # [m], as of the key ``joint.length``
_THINNEST: Final = 0.025  # outer diameter [m] below that of any string: od in another unit than its uom says
_LONGEST_NAME: Final = 80  # characters
_NAMED: Final = 3  # pipes that a remark names


@dataclass
class GivenString:
    """Tables of the components; bit : lines of its table; parts : what is known, with lengths [m]; drills : whether it
    has a bit; blanks, doubts : as of ``Given``."""

    components: list[Block] = field(default_factory=list)
    bit: list[str] = field(default_factory=list)
    parts: list[tuple[ComponentSpec, float]] = field(default_factory=list)
    blanks: list[Blank] = field(default_factory=list)
    doubts: list[str] = field(default_factory=list)
    drills: bool = False


def lay_string(tubular: Tubular, file: str, depth: float, write: Writer) -> GivenString:
    """The components of a string in a hole of a depth [m]."""
    string = GivenString(drills=any(part.kind == BIT for part in tubular.parts))
    string.doubts += _doubts_of(tubular, depth, write)
    parts = [piece for part in tubular.parts for piece in pieces_of(part)]
    for i, part in enumerate(parts):
        where = f"component {part.number} of the file" + ("" if i else ", from the bit up; segments are chosen for you")
        table = GivenTable("[[string.components]]", where, f"string.components[{i}]", file, write)
        component = _Component(part, table, write)
        component.fill(_short(tubular, depth, write) if part is parts[-1] else "")
        string.components.append(table.block)
        string.blanks += table.blanks
        string.doubts += component.doubts
        length = part.length or 0.0
        if part is parts[-1]:
            length = max(depth - sum(known for _, known in string.parts), 0.0)
        if component.spec is not None and length > 0:
            string.parts.append((component.spec, min(length, depth)))
    bit = next((part for part in tubular.parts if part.kind == BIT), None)
    if bit is not None and bit.nozzles:
        nozzles = ", ".join(f'"{write(ACROSS, one)}"' for one in bit.nozzles)
        string.bit.append(f"nozzles = [{nozzles}]")
    elif bit is not None and bit.flow_area:
        string.bit.append(entry("flow_area", write(AREA, bit.flow_area)))
    return string


def _short(tubular: Tubular, depth: float, write: Writer) -> str:
    """What is wrong with the length of a string of known lengths [m] in a hole, or ""."""
    lengths = [part.length for part in tubular.parts]
    if not all(lengths):
        return ""
    whole = sum(length or 0.0 for length in lengths)
    if whole >= depth - AT_AN_END:
        return ""
    return f"the string has {write(LENGTH, whole)} in all, and the hole {write(LENGTH, depth)}"


class _Component:
    """The lines of a component."""

    def __init__(self, part: TubularPart, table: GivenTable, write: Writer) -> None:
        self._part, self._table, self._write = part, table, write
        length = f" of {write(LENGTH, part.length)}" if part.length else ""
        self._title = f'component {part.number}, "{part.type or "without a type"}"{length}'
        self._keys: dict[str, Any] = {}
        self.doubts: list[str] = []

    @property
    def spec(self) -> ComponentSpec | None:
        """The component as far as it is known; None without its body."""
        if "pipe" not in self._keys and not {"outer_diameter", "inner_diameter"} <= {*self._keys}:
            return None
        return ComponentSpec.model_validate({"name": "", **self._keys})

    def fill(self, short: str) -> None:
        """Write all lines; short : why the length of the uppermost component cannot be right, or ""."""
        part, table = self._part, self._table
        name = part.type or "component"
        if part.description and part.description.casefold() != name.casefold():
            name += f": {part.description}"
        table.text("name", textwrap.shorten(name, _LONGEST_NAME, placeholder=" ..."))
        self._length(short)
        pipe = pipe_of(part)
        if pipe is not None:
            self._keys["pipe"] = pipe.name
            table.text("pipe", pipe.name)
        else:
            self._body()
            self._mass()
            self._contact()
            self._strength()
            self._material()
        self._bends()
        if part.joint_length is not None and part.joint_length > _LONGEST_JOINT:
            several = f", numJointStand {part.joints_of_stand:g}" if part.joints_of_stand else ""
            joint = self._write(LENGTH, part.joint_length)
            self._doubt(f"lenJointAv {joint}{several}, is that of a stand and not of a joint: it is not used")
        if part.type.casefold() in _UNKNOWN:
            self._doubt("is taken for a tool, which weighs as its body without wtPerLen")

    def _length(self, short: str) -> None:
        part = self._part
        here = self._write(LENGTH, part.length or 0.0)
        if short:
            expected = "its length, and add the pipe above it, or delete the line if it reaches the surface"
            self._blank("length", expected, f"len is {here}, {short}")
        elif part.length:
            self._keys["length"] = part.length
            self._table.value("length", LENGTH, part.length)
        else:
            self._blank("length", "its length", self._missing("len", part.length))

    def _body(self) -> None:
        """Outer and inner diameter."""
        part = self._part
        outer, inner = part.outer or part.gauge if part.kind == BIT else part.outer, part.inner
        if not outer:
            self._blank("outer_diameter", "the diameter of its body", self._missing("od", part.outer))
        elif outer < _THINNEST:
            thin = f"od is {self._write(ACROSS, outer)}, thinner than any pipe: see its uom"
            self._blank("outer_diameter", "the diameter of its body", thin)
            outer = None
        elif part.gauge and outer > part.gauge + SAME_DIAMETER:
            gauge = self._write(ACROSS, part.gauge)
            self._blank("outer_diameter", "that of its body", f"od is {self._write(ACROSS, outer)}, diaBit {gauge}")
        else:
            self._value("outer_diameter", ACROSS, outer)
        if not inner:
            self._blank("inner_diameter", "the diameter of its bore", self._missing("id", inner))
        elif outer and inner >= outer:
            outside = self._write(ACROSS, outer)
            found = f"id is {self._write(ACROSS, inner)}, od {outside}"
            self._blank("inner_diameter", "the diameter of its bore, below outer_diameter", found)
        else:
            self._value("inner_diameter", ACROSS, inner)

    def _mass(self) -> None:
        """Mass with joints; a tool without one weighs as its body."""
        part = self._part
        joints, mass = _JOINTED.get(part.kind or ""), part.mass
        body = body_mass(self._keys)
        if mass and joints and body and not LIGHTEST * body <= mass <= HEAVIEST * body:
            found = f"wtPerLen is {self._write(LINEAR_MASS, mass)}, its body alone has {self._write(LINEAR_MASS, body)}"
            self._blank("linear_mass", f"its mass with {joints}, such as '36.8 kg/m'", found)
        elif mass:
            self._value("linear_mass", LINEAR_MASS, mass, f"with {joints}" if joints else "")
            if (nominal := nominal_of(part)) is not None:
                self._doubt(f"wtPerLen is the nominal weight, {nominal:g} lb/ft: with tool joints it is more")
        elif joints:
            found = self._missing("wtPerLen", mass)
            self._blank("linear_mass", f"its mass with {joints}, such as '36.8 kg/m'", found)
            self._suggest()

    def _suggest(self) -> None:
        """Name the pipes of the catalogue with this body, one of which may take the place of the lines."""
        part = self._part
        found = pipes_of_size(part.kind or "", part.outer or 0.0, part.inner or 0.0)
        same = [pipe for pipe in found if not lacks_joints(pipe)]
        if same:
            names = " or ".join(f"'{pipe.name}'" for pipe in same[:_NAMED])
            more = " or others" if len(same) > _NAMED else ""
            self._table.remark(f"Or write pipe = {names}{more} in place of all lines from outer_diameter on.")

    def _contact(self) -> None:
        """The diameter that touches, where it is not that of the body."""
        part, outer = self._part, self._keys.get("outer_diameter")
        joints = _JOINTED.get(part.kind or "")
        widest = part.touching
        if part.widest and outer and part.widest < outer - SAME_DIAMETER:
            stated, outside = (self._write(ACROSS, one) for one in (part.widest, outer))
            self._blank("contact_diameter", "the diameter that touches", f"odMx is {stated}, od {outside}")
        elif widest and (outer is None or widest > outer):
            self._value("contact_diameter", ACROSS, widest)
            if part.length and part.kind is None and part.length > SHORT * widest:
                touches = f"touches with {self._write(ACROSS, widest)} along all of it"
                self._doubt(f"{touches}: give the part that is so wide as a component of its own")
        elif joints and (not widest or (outer and widest < outer)):
            found = self._missing("odMx, and no od of a connection", part.widest)
            if widest and outer:
                found = f"od of a connection is {self._write(ACROSS, widest)}, od {self._write(ACROSS, outer)}"
            self._blank("contact_diameter", f"the diameter of its {joints}", found)

    def _strength(self) -> None:
        part = self._part
        grade = drill_pipe_grade_of(part.grade) if part.kind == DRILL_PIPE else grade_of(part.grade)
        if grade is not None:
            self._table.text("yield_strength", grade)
        elif part.strength:
            self._table.value("yield_strength", STRESS, part.strength)
        elif part.grade or part.strength == 0:
            said = f'grade "{part.grade}" is not known' if part.grade else "tensYield is 0"
            self._table.remark(f"Note: {said}: give yield_strength, else it is that of S-135.")

    def _material(self) -> None:
        part = self._part
        if not is_steel(part):
            for key, words in (("density", "the density"), ("youngs_modulus", "Young's modulus")):
                self._blank(key, f"{words} of its material", f'typeMaterial is "{part.material}"')

    def _bends(self) -> None:
        part = self._part
        for bend in part.bends:
            angle = self._write(ANGLE, bend.angle)
            if bend.distance is not None and part.length and abs(bend.distance - part.length) <= AT_AN_END:
                self._value("bend", ANGLE, bend.angle, "at its upper end")
                continue
            self._doubt(f"its bend of {angle} is left out: give the part below it as a component of its own, with bend")

    def _value(self, key: str, kind: Kind, value: float, comment: str = "") -> None:
        self._keys[key] = value
        self._table.value(key, kind, value, comment)

    def _blank(self, key: str, expected: str, found: str) -> None:
        self._table.blank(key, expected, f"{self._title}, {found}")

    def _doubt(self, text: str) -> None:
        self.doubts.append(f"{self._title}: {text}")
        self._table.remark(f"Note: {text}.")

    @staticmethod
    def _missing(element: str, value: float | None) -> str:
        return f"{element.split(',')[0]} is 0" if value == 0 else f"has no {element}"


def _doubts_of(tubular: Tubular, depth: float, write: Writer) -> Iterator[str]:
    """What is probably wrong with a string as a whole."""
    if tubular.reversed:
        yield "its last component is the bit: its order is taken to be that from the surface down"
    drilling = "drilling" in tubular.assembly.casefold()
    if drilling and not any(part.kind == BIT for part in tubular.parts):
        yield f'no component is a bit, and typeTubularAssy is "{tubular.assembly}": the case does not drill'
    for part in tubular.parts:
        if drilling and part.kind in (CASING, TUBING):
            length = f" of {write(LENGTH, part.length)}" if part.length else ""
            what = f'component {part.number} is "{part.type}"{length}'
            yield f'{what}, and typeTubularAssy is "{tubular.assembly}": check both'
    below = math.fsum(part.length or 0.0 for part in tubular.parts[:-1])
    if below > depth:
        yield f"the components below the uppermost have {write(LENGTH, below)}, and the hole {write(LENGTH, depth)}"
