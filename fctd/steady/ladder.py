"""The ladder of methods that look for the steady string of a row: which, when, in which order, and what the row then
says.

A new method is a rung: its attempt in a file of its own, and a line of ``LADDER``.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from fctd.steady import attempts
from fctd.steady.attempts import TOO_FINE, TOO_MUCH
from fctd.steady.continuation import CONVERGED
from fctd.steady.fed_row import fed
from fctd.steady.findings import Findings
from fctd.steady.problem import Problem
from fctd.steady.rolling import rolled
from fctd.steady.steady_string import HOMOGENISED, Equilibrium

NEWTON = "newton"  # also of the strings that a batch finds (batch.py)
# Sentences: {} is what the status or the path of the string says.
AS_FOUND = "{}"
ANALYTIC = "the wall force of the helix is the analytic one, r F²/4EI"


class Rung(NamedTuple):
    """A method of the ladder.

    name : of the method, which the strings that it finds carry; a rung may also give a string that one before it has
    found.  is_due : whether it is tried.  attempt : returns None where the next rung is to be tried.
    sentence : what a row's message says, if anything; of an attempt that found nothing, what that of a later rung says.
    """

    name: str
    is_due: Callable[[Findings], bool]
    attempt: Callable[[Problem, Findings], Equilibrium | None]
    sentence: str = AS_FOUND


LADDER = (
    Rung("open", lambda so_far: not so_far.case.contact.enabled, attempts.in_the_open),
    Rung(NEWTON, lambda _: True, attempts.newton),
    # The case asks for segments on which a buckled string can bend.
    Rung("carried", lambda so_far: so_far.is_to_be_carried, attempts.carried),
    Rung("fed", lambda so_far: so_far.is_to_be_fed, fed),
    Rung("resolved", lambda so_far: so_far.is_to_be_resolved and so_far.resolved is None, attempts.resolved),
    Rung(HOMOGENISED, lambda so_far: so_far.is_to_be_resolved, attempts.homogenised),
    Rung("resolved in part", lambda so_far: so_far.lacks_segments, attempts.as_resolved, f"{TOO_FINE}; {{}}"),
    Rung("as cut", lambda so_far: so_far.is_to_be_resolved, attempts.as_cut,
         f"{TOO_MUCH}; with the segments of the case: {{}}"),
    # Newton's method found no balance in which the string would stay.
    Rung("bisected", lambda _: True, attempts.bisected),
    Rung("patient", lambda so_far: so_far.has_no_balance and not so_far.is_analytic, attempts.patient),
    Rung("climbed", lambda so_far: so_far.ended is None, attempts.climbed),
    # No rung found the string with its loads.
    Rung("outside", lambda so_far: so_far.has_left_hole, attempts.as_first_found),
    Rung("unstable", lambda so_far: so_far.code == CONVERGED and not so_far.is_locked_up, attempts.as_unstable,
         "the string would leave this balance, and {}"),
    Rung("too coarse", lambda so_far: so_far.is_too_coarse, attempts.as_under_resolved),
    Rung("without loads", lambda _: True, attempts.as_ended),
)  # fmt: skip

# Of a string without a steady shape.
ROLL = Rung("rolled", lambda so_far: so_far.may_roll, rolled)
# Added to a helix that was found on segments which cannot bend into it.
HELIX = Rung("analytic helix", lambda so_far: so_far.lacks_helix, attempts.with_helix, f"{{}}; {ANALYTIC}")


def look_for(so_far: Findings) -> Equilibrium:
    """The string of a row, by the first rung that finds it."""
    so_far.found = _first_found(so_far)
    for rung in (ROLL, HELIX):
        if rung.is_due(so_far) and (point := _try(rung, so_far)) is not None:
            return point
    return so_far.found


def _first_found(so_far: Findings) -> Equilibrium:
    around = AS_FOUND
    for rung in LADDER:
        if not rung.is_due(so_far):
            continue
        point = _try(rung, so_far)
        if point is None:
            around = around if rung.sentence == AS_FOUND else rung.sentence
        elif around == AS_FOUND:
            return point
        else:
            return replace(point, message=around.format(point.message or str(point.status)))
    raise AssertionError("the last rung ends the ladder")


def _try(rung: Rung, so_far: Findings) -> Equilibrium | None:
    """What a rung finds, with its sentence; a converged row has no message."""
    so_far.rung = rung.name
    point = rung.attempt(so_far.problem, so_far)
    if point is None or not point.message or rung.sentence == AS_FOUND:
        return point
    return replace(point, message=rung.sentence.format(point.message))
