"""The tables of a case file for how it is computed: step, dampings, buckling, and what is recorded."""

import os
from typing import Any, Literal

from pydantic import Field, field_validator

from fctd.case import units
from fctd.case.errors import InputError, Table

# Values of `buckling` with which a buckled string is laid out in segments that can bend as it does.
RESOLVING = ("resolve", "feed")
# The environment's default of `perturbed`, which processes and commands that a program starts inherit.
PERTURBED = "FCTD_PERTURBED"


def _seed_of_environment() -> int | None:
    text = os.environ.get(PERTURBED, "")
    if text and not text.isdecimal():
        raise InputError("a whole number, the seed of the noise, in the environment", key=PERTURBED, value=text)
    return int(text) if text else None


class SolverSpec(Table):
    """The time step [s], and dampings of the joints as multiples of their stiffness [s].

    "largest" is the largest step that is certain to be stable, "auto" four fifths of it. `shape_damping` damps the
    change of the string's shape in space, which ends the chatter of segments on the wall; a bent string that turns
    steadily keeps its shape, and is not braked. `joint_damping` is that of the steel, a loss of 0.2 % at 30 Hz by
    default: it acts on what bends and stretches in the string's own frame, and brakes a bent string that turns.
    `loss_factor` is that of the string's torsion at its first torsional frequency, in addition; a large one makes the
    largest step smaller.

    Where a steady string is buckled, "detect" says whether its segments can bend that way, and "resolve" lays it out
    in segments that can. "feed" does so too, and feeds a string that slides down from rest. `resolve_work` is the work
    that a row may take for it, iterations times segments: the default is some twenty seconds. Kilometres of helix that
    slides with friction take three to ten times as much.

    With `perturbed` stations and segments have noise of the size of rounding, 1e-13 of each, drawn by this seed. Where
    loads differ between seeds, the string has several balances. The environment variable FCTD_PERTURBED sets the
    default.
    """

    step: float | Literal["auto", "largest"] = Field(
        default="auto", description='"auto", "largest" or a time such as "2 ms"'
    )
    joint_damping: units.Time = 1e-5
    shape_damping: units.Time = 3e-3
    loss_factor: units.LossFactor = 0.0
    buckling: Literal["detect", "resolve", "feed"] = "detect"
    resolve_work: units.Work = 8e6
    perturbed: units.Seed | None = Field(default_factory=_seed_of_environment)

    @field_validator("step", mode="before", json_schema_input_type=float | str)
    @classmethod
    def _read_step(cls, raw: Any) -> Any:
        if raw in ("auto", "largest"):
            return raw
        try:
            return units.Quantity(dimension=units.TIME, above=0.0).parse(raw)
        except InputError as error:
            raise InputError(f'"auto", "largest" or {error.expected}', value=raw) from None


class RecordSpec(Table):
    """Time between rows of the history [s], and bit depths [m] at which a profile is recorded."""

    interval: units.PositiveTime = 1.0
    profile_at: tuple[units.Length, ...] = ()
