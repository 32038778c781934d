"""How a computation ended: every status with what it means, whether it has loads, and whether it is good enough.

The members are plain text to tables and files: ``status == "converged"`` holds, and Parquet keeps the word.
"""

from enum import StrEnum
from typing import Self


class Status(StrEnum):
    """A word with its meaning.

    message : what happened, a clause; empty where all is well.  has_loads : whether the loads beside it may be read.
    acceptable : whether a command that ends so has done what it was asked for (exit code 0).
    """

    message: str
    has_loads: bool
    acceptable: bool

    def __new__(cls, word: str, message: str = "", has_loads: bool = False, acceptable: bool = False) -> Self:
        """A member of the table."""
        member = str.__new__(cls, word)
        member._value_ = word
        member.message, member.has_loads, member.acceptable = message, has_loads, acceptable
        return member


class SteadyStatus(Status):
    """Of a steady string. A string that is locked up is an answer; one that would leave its balance is not drilled."""

    CONVERGED = "converged", "", True, True
    LOCKED_UP = "locked_up", "the top would have to be pushed with more than the block weight", True, True
    UNSTABLE = "unstable", "the string would not keep this balance", True, False
    MAX_ITERATIONS = "max_iterations", "no balance was found: the string may have no steady shape", False, False
    DIVERGED = "diverged", "the string lies deeper in the wall than the hole is wide", False, False
    NOT_FINITE = "not_finite", "a force is not finite", False, False
    NOT_POSSIBLE = "not_possible", "string and hole do not fit at this bit depth", False, False


class RunStatus(Status):
    """Of a run in time. What an interrupted run has recorded is sound."""

    COMPLETED = "completed", "", True, True
    INACCURATE = "inaccurate", "the energy ledger is off by more than a tenth of the work", True, False
    UNSTABLE = "unstable", "the state is no longer that of a string in its hole", False, False
    UNSETTLED = "unsettled", "the string did not come to rest before the start", False, False
    INTERRUPTED = "interrupted", "the run was interrupted", True, False


class RefineStatus(Status):
    """Of a search for the number of segments."""

    WITHIN_TOLERANCE = "within_tolerance", "", True, True
    NOT_REACHED = "not_reached", "the error stayed above the tolerance up to the most segments", True, False
    NO_ANSWER = "no_answer", "no string has found its balance", False, False
