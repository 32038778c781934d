"""A new case with the string and the hole of WITSML files in place of a template's."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.systems import ACROSS
from fctd.case.text import printable
from fctd.case.witsml.geometry import Geometry, read_geometry
from fctd.case.witsml.tubular import Tubular, read_tubular
from fctd.model.first_numbers import Laid, laid, narrowest_of, stiff_wall
from fctd.model.given.hole import GivenHole, lay_hole
from fctd.model.given.string import GivenString, lay_string
from fctd.model.given.table import Writer, writer
from fctd.model.new_case import Blank, Given, Plan


class Files(NamedTuple):
    """WITSML files of a string (`tubular`) and of a hole (`wbGeometry`), and the name or uid of the object in each."""

    string: Path | None = None
    hole: Path | None = None
    string_name: str | None = None
    hole_name: str | None = None


def with_files(plan: Plan, stations: Array, files: Files) -> Plan:
    """A plan of a survey, whose stations (n, 3) [m, rad, rad] these are, with what files give; see ``Given``.

    Mud, rig, loads of the bit and missing friction factors are those of the template; a string without a bit does not
    drill.  Raises InputError for a file that cannot be read, and for a hole that the template's string does not fit.
    """
    for name, file, chosen in (("string", files.string, files.string_name), ("hole", files.hole, files.hole_name)):
        if file is None and chosen is not None:
            raise InputError(f"a file of the {name} beside it", key=f"{name}_name", value=chosen)
    if files.string is None and files.hole is None:
        return plan
    template, write, end = plan.template, writer(plan.units), float(stations[-1, 0])
    geometry = None if files.hole is None else read_geometry(files.hole, files.hole_name)
    tubular = None if files.string is None else read_tubular(files.string, files.string_name)
    hole = GivenHole(shoe=plan.shoe, depth=plan.depth, narrowest=narrowest_of(template))
    if geometry is not None:
        hole = lay_hole(geometry, _name(files.hole), template, end, write)
    string = GivenString(parts=laid(template, hole.shoe, hole.depth), drills=True)
    if tubular is not None:
        string = lay_string(tubular, _name(files.string), hole.depth, write)
    else:
        _check_room(string.parts, hole.narrowest, write)
    doubts = [(_name(files.hole), doubt) for doubt in hole.doubts]
    doubts += [(_name(files.string), doubt) for doubt in string.doubts]
    if geometry is not None and tubular is not None and _differ(geometry, tubular):
        wellbores = f"its wellbore is {geometry.wellbore}, that of the string {tubular.wellbore}"
        doubts.append((_name(files.hole), wellbores))
    return replace(
        plan, title=_title(plan, files), shoe=hole.shoe, depth=hole.depth,
        template=template if string.drills else template._replace(weight_on_bit=0.0, bit_torque=0.0),
        stiffness=stiff_wall(string.parts, template.mud, hole.narrowest, stations) if string.parts else plan.stiffness,
        given=Given(
            tuple(hole.intervals), tuple(string.components), tuple(string.bit), tuple(string.parts),
            (*hole.blanks, *string.blanks), tuple(doubts),
        ),
    )  # fmt: skip


def _check_room(parts: Laid, narrowest: float, write: Writer) -> None:
    """Raise InputError where a template's string is wider than the hole at its narrowest [m]."""
    widest = max(component.contact_diameter for component, _ in parts)
    if narrowest <= widest:
        expected = f"a hole wider than the string of the template, {write(ACROSS, widest)}, or a string of its own"
        raise InputError(expected, key="hole", value=write(ACROSS, narrowest))


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
