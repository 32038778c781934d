"""``fctd equilibrium --plot-feeding``: the picture of a string that is fed from rest, and which strings have none."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Final

from fctd import plots
from fctd.case.errors import InputError
from fctd.case.friction import pairs_of
from fctd.case.load import Case
from fctd.case.message import Message
from fctd.case.operations import KINDS
from fctd.case.systems import told
from fctd.cli.steady import file_option
from fctd.model.operations import SteadyRates
from fctd.results.buckling import NOT_BUCKLED
from fctd.results.unit_systems import System
from fctd.steady.steady_string import Equilibrium

OPTION: Final = "--plot-feeding"
SLIDING: Final = " or ".join(kind for kind, of in KINDS.items() if of.direction > 0 and not of.turns)

PlotFeeding = Annotated[
    Path | None,
    file_option(OPTION, "Loads against feed, of a string fed from rest (solver.buckling=feed), .png, .svg or .pdf."),
]


def check_feeding(path: Path | None, case: Case, rates: SteadyRates) -> None:
    """Raise InputError where a picture of feeding cannot be written, before anything is computed.

    The block feeds a string that slides down without rotation, against friction, in a case that resolves buckling.
    """
    if path is None:
        return
    lacking = ""
    if rates.speed <= 0:
        lacking = f"a string that slides down without rotation ({SLIDING}), which the block feeds"
    elif rates.spin:
        lacking = "a string without rotation: one that turns is not fed from rest (--rpm 0)"
    elif not case.contact.enabled or not any(pair.along or pair.around for pair in pairs_of(case.wellbore.intervals)):
        lacking = "a hole with friction: a string that slides without it is not fed from rest"
    elif case.solver.buckling != "feed":
        lacking = 'solver.buckling = "feed" (--set solver.buckling=feed): else no string is fed from rest'
    if lacking:
        raise InputError(lacking, key=OPTION, value=path)


def draw_feeding(path: Path, point: Equilibrium, units: System, warnings: Sequence[str]) -> list[Path]:
    """Write the picture of a string that was fed; returns the file.  Raises InputError for one that was not."""
    if not point.fed:
        raise InputError(told(Message(_lacking(point)), units), key=OPTION, value=path)
    return plots.save(plots.feeding_figure(point, units, warnings=warnings), path)


def _lacking(point: Equilibrium) -> str:
    """What a string lacks that was not fed, and what to do."""
    if point.answered and point.buckling.mode == NOT_BUCKLED.mode:
        return (
            "a string that buckles, which alone is fed from rest: this one is compressed beyond no limit, so look at "
            "a larger weight on bit, more friction or a larger depth"
        )
    return (
        f"a string that was fed from rest: this one is {point.status} by another method, as its line above explains, "
        f"so try a larger solver.resolve_work (it is {point.case.solver.resolve_work:g}) or smaller loads"
    )
