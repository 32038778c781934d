"""Statuses of computations: each with its message, whether it has loads, and whether it is acceptable.

The members are strings: ``status == "converged"`` is true, and tables and files store the name.
"""

from enum import StrEnum
from typing import Final, Self


class Status(StrEnum):
    """A status and its properties.

    message : what happened, a clause; empty for a normal end.  has_loads : whether the result has valid loads.
    acceptable : whether a command with this status succeeds (exit code 0).
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
    """Status of a steady string.

    Lock-up is an acceptable answer, for coarse segments too: they bend less than the string, and miss some of its
    friction.  So is a string that rolls steadily round the hole: its loads stay while its shape goes round.  An
    unstable equilibrium is not, nor is a buckled string whose segments cannot bend that way.
    """

    CONVERGED = "converged", "", True, True
    LOCKED_UP = "locked_up", "the top would have to be pushed with more than the block weight", True, True
    ROLLING = "rolling", "the string rolls round the hole", True, True
    UNDER_RESOLVED = "under_resolved", "the segments are too long to bend as the string does", True, False
    UNSTABLE = "unstable", "the equilibrium is unstable: the string would leave it", True, False
    MAX_ITERATIONS = "max_iterations", "no equilibrium was found: the string may have no steady shape", False, False
    DIVERGED = "diverged", "the string lies deeper in the wall than the hole is wide", False, False
    NOT_FINITE = "not_finite", "a force is not finite", False, False
    NOT_POSSIBLE = "not_possible", "string and hole do not fit at this bit depth", False, False


class RunStatus(Status):
    """Status of a run in time. The records of an interrupted run are valid."""

    COMPLETED = "completed", "", True, True
    INACCURATE = "inaccurate", "the energy ledger is off by more than a tenth of the work", True, False
    UNSTABLE = "unstable", "the computed motion is not that of a string in its hole", False, False
    UNSETTLED = "unsettled", "the string did not come to rest before the start", False, False
    INTERRUPTED = "interrupted", "the run was interrupted", True, False
    STOPPED = "stopped", "the run reached its limit of time or memory", True, False


class RefineStatus(Status):
    """Status of a search for the number of segments."""

    WITHIN_TOLERANCE = "within_tolerance", "", True, True
    NOT_REACHED = "not_reached", "the error exceeds the tolerance at the largest number of segments", True, False
    NO_ANSWER = "no_answer", "no equilibrium was found with any number of segments", False, False


ACCEPTABLE: Final = frozenset(
    str(status) for kind in (SteadyStatus, RunStatus, RefineStatus) for status in kind if status.acceptable
)
"""Statuses, of any kind of computation, with which a command succeeds."""
