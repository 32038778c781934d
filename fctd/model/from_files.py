"""A new case with the string and the hole of WITSML files in place of a template's."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.text import printable
from fctd.case.witsml.geometry import Geometry, read_geometry
from fctd.case.witsml.tubular import Tubular, read_tubular
from fctd.model.first_numbers import laid, stiff_wall
from fctd.model.given.hole import lay_hole
from fctd.model.given.string import lay_string
from fctd.model.given.table import Writer
from fctd.model.new_case import Blank, Given, Plan


class Files(NamedTuple):
    """WITSML files of a string (`tubular`) and of a hole (`wbGeometry`), and the name or uid of the object in each."""

    string: Path | None = None
    hole: Path | None = None
    string_name: str | None = None
    hole_name: str | None = None


def with_files(plan: Plan, stations: Array, files: Files) -> Plan:
    """A plan of a survey, whose stations (n, 3) [m, rad, rad] these are, with what files give; see ``Given``.

    Mud, rig, loads of the bit and friction remain those of the template, a string without a bit has no loads of it.
    Raises InputError for a file that cannot be read, and for a hole that the template's string does not fit.
    """
    for name, file, chosen in (("string", files.string, files.string_name), ("hole", files.hole, files.hole_name)):
        if file is None and chosen is not None:
            raise InputError(f"a file of the {name} beside it", key=f"{name}_name", value=chosen)
    if files.string is None and files.hole is None:
        return plan
    write, given, template, end = Writer(plan.units), Given(), plan.template, float(stations[-1, 0])
    narrowest = 0.0254 * min(float(hole.diameter) for hole in (template.cased, template.open))
    parts, doubts, blanks = [], [], []
    geometry, tubular = None, None
    if files.hole is not None:
        geometry = read_geometry(files.hole, files.hole_name)
        hole = lay_hole(geometry, _name(files.hole), template, end, write)
        given, narrowest = replace(given, intervals=tuple(hole.intervals)), hole.narrowest
        plan = replace(plan, shoe=hole.shoe, depth=hole.depth)
        blanks += hole.blanks
        doubts += [(_name(files.hole), doubt) for doubt in hole.doubts]
    if files.string is not None:
        tubular = read_tubular(files.string, files.string_name)
        string = lay_string(tubular, _name(files.string), plan.depth, write)
        given = replace(given, components=tuple(string.components), bit=tuple(string.bit), parts=string.parts)
        parts = string.parts
        blanks += string.blanks
        doubts += [(_name(files.string), doubt) for doubt in string.doubts]
        if not string.drills:
            template = template._replace(weight_on_bit=0.0, bit_torque=0.0)
    else:
        parts = laid(template, plan.shoe, plan.depth)
        widest = max(component.contact_diameter for component, _ in parts)
        if narrowest <= widest:
            wide, narrow = write("diameter", widest), write("diameter", narrowest)
            raise InputError(
                f"a hole wider than the string of the template, {wide}, or a string of its own", key="hole",
                value=narrow,
            )  # fmt: skip
    if geometry is not None and tubular is not None and _differ(geometry, tubular):
        doubts.append(
            (_name(files.hole), f"its wellbore is {geometry.wellbore}, that of the string {tubular.wellbore}")
        )
    return replace(
        plan, title=_title(plan, files), template=template,
        stiffness=stiff_wall(parts, template.mud, narrowest, stations) if parts else plan.stiffness,
        given=replace(given, blanks=tuple(blanks), doubts=tuple(doubts)),
    )  # fmt: skip


def _name(path: Path | None) -> str:
    return "" if path is None else printable(path.name)


def _differ(geometry: Geometry, tubular: Tubular) -> bool:
    """Whether both say which wellbore they are of, and not the same."""
    return bool(geometry.wellbore and tubular.wellbore) and geometry.wellbore != tubular.wellbore


def _title(plan: Plan, files: Files) -> str:
    """What the case is made of."""
    well, _, template = plan.title.partition(" with the string of ")
    string = template if files.string is None else _name(files.string)
    hole = "" if files.hole is None else f" and the hole of {_name(files.hole)}"
    rest = "" if files.string is None else f"; the rest is that of {template}"
    return f"{well} with the string of {string}{hole}{rest}"


def refuse_blanks(blanks: Sequence[Blank], out: Path | None) -> None:
    """Raise InputError, a line for each key that is to be filled in, where there is one.

    out : the file in which they are.
    """
    if blanks:
        first, *more = (InputError(str(blank), key=blank.key, file=out) for blank in blanks)
        raise InputError(first.expected, key=first.key, file=out, more=more)
