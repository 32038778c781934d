"""``fctd pipes``: the pipe of the catalogue, and what it bears."""

import re
from typing import Annotated, Final

import typer

from fctd.case.errors import InputError
from fctd.case.pipes.catalogue import Pipe, catalogue, of_grade, sources
from fctd.case.pipes.grades import drill_pipe_grade_of
from fctd.case.pipes.names import DRILL_PIPE, class_of
from fctd.case.systems import ACROSS, FORCE, LINEAR_MASS, STRENGTH, SYSTEMS, TORQUE, Kind, System
from fctd.cli.base_command import Silent
from fctd.cli.job import WHOLE, print_table
from fctd.cli.options import screen, units_option
from fctd.model.capacity import body_of
from fctd.model.connection import make_up_torque
from fctd.results.shown_tables import Head, Table, number, shown_table


def pipes_command(
    words: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[WORD]...",
            help="Words of names, such as '5 in' NC50 premium; a grade of casing or tubing.",
            show_default=False,
        ),
    ] = None,
    units: Annotated[System, units_option("Units of the table", "si")] = "si",
    quiet: Silent = False,
) -> None:
    """List pipe by the names that the key pipe of a component takes, with its capacities and the pages it is from.

    Capacities are computed from geometry and grade: tension, torque, pressure inside and outside at which the body
    yields or collapses, and the largest make-up torque of the tool joints.  Casing and tubing have them with a grade
    among the words.
    """
    found = found_by(words or [])
    if not found:
        raise InputError(
            "words of a pipe's name; `fctd pipes` without words lists all", key="WORD", value=" ".join(words or [])
        )
    if quiet:
        return
    pages = list(dict.fromkeys(key for pipe in found for key in pipe.sources))
    print_table(_table(found, pages, units), {"pipe": {"min_width": 10}}, words=WHOLE, numbers=WHOLE)
    for k, key in enumerate(pages, start=1):
        source = sources()[key]
        screen.print(f"[{k}] {source.title}, {source.address}, opened {source.opened}", soft_wrap=True)


def found_by(words: list[str]) -> list[Pipe]:
    """The pipes whose names have all of some words, with the grade and the class among them."""
    typed = " ".join(words)
    text, wall_share = class_of(re.sub(r"(?<=\d)-(?=\d+/\d)", " ", typed.lower().replace(",", " ")), typed)
    parts = re.findall(r"\d+\s+\d+/\d+|\S+", text)
    grades = [grade for part in parts if (grade := drill_pipe_grade_of(part))]
    grade = grades[0] if grades else None
    pipes = [of_grade(pipe, grade) for pipe in catalogue()]
    if wall_share != 1.0:
        pipes = [pipe._replace(wall_share=wall_share) for pipe in pipes if pipe.kind == DRILL_PIPE]
    if grade is not None:
        pipes = [pipe for pipe in pipes if pipe.grade == grade]
    whole = [f" {' '.join(part.split())} " for part in parts if drill_pipe_grade_of(part) is None]
    return [pipe for pipe in pipes if all(part in f" {pipe.name.lower().replace(',', '')} " for part in whole)]


# Heading of each column, its kind, and digits after the point in both systems.
COLUMNS: Final[tuple[tuple[str, Kind, tuple[int, int]], ...]] = (
    ("inner", ACROSS, (1, 3)),
    ("joint", ACROSS, (1, 3)),
    ("mass", LINEAR_MASS, (1, 2)),
    ("tension", FORCE, (0, 1)),
    ("torque", TORQUE, (1, 2)),
    ("burst", STRENGTH, (1, 0)),
    ("collapse", STRENGTH, (1, 0)),
    ("make-up", TORQUE, (1, 2)),
)


def _table(pipes: list[Pipe], pages: list[str], units: System) -> Table:
    rows = (
        [
            pipe.name, *(
                None if value is None else number(value * kind.shown(units).factor, digits[SYSTEMS.index(units)])
                for value, (_, kind, digits) in zip(_values(pipe), COLUMNS, strict=True)
            ), " ".join(dict.fromkeys(str(pages.index(key) + 1) for key in pipe.sources)),
        ]
        for pipe in pipes
    )  # fmt: skip
    return shown_table(["pipe", *(Head(words, kind.label(units), True) for words, kind, _ in COLUMNS), "from"], rows)


def _values(pipe: Pipe) -> list[float | None]:
    """The numbers of a pipe, SI, in the order of the columns."""
    body, joint = body_of(pipe), pipe.joint
    touching = pipe.coupling if joint is None else joint.outer
    strengths = [None] * 4 if body is None else [body.tension, body.torsion, body.burst, body.collapse]
    return [pipe.inner, touching, pipe.linear_mass, *strengths, make_up_torque(pipe)]
