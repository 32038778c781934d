"""Statements of many draws: which held, which failed and with what seed, which are excepted and why."""

import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

from fctd.case.errors import InputError
from tests.equivalence import (  # noqa: F401  which fill the table
    of_answers,
    of_commands,
    of_files,
    of_flow,
    of_holes,
    of_joints,
    of_loads,
    of_parts,
    of_runs,
    of_strings,
    ways_in,
)
from tests.equivalence.answers import NotApplicableError
from tests.equivalence.draws import Drawn, draw
from tests.equivalence.table import STATEMENTS, Statement


class Excepted(NamedTuple):
    """A statement that does not hold of some cases: its name, whether a case is one, and the cause."""

    name: str
    of: Callable[[Drawn], bool]
    cause: str


# Delete a line where its cause is mended: the column "excepted" of the command then stays 0.
EXCEPTIONS: tuple[Excepted, ...] = ()

HELD, FAILED, NOT_APPLICABLE, EXCEPTED, REFUSED = "held", "failed", "says nothing", "excepted", "refused"


@dataclass
class Tally:
    """How many statements held, by name and outcome, and the failures: statement, seed, index, what differs."""

    counts: Counter[tuple[str, str]] = field(default_factory=Counter)
    failures: list[tuple[str, int, int, str]] = field(default_factory=list)
    refusals: list[tuple[int, int, str]] = field(default_factory=list)
    took: Counter[str] = field(default_factory=Counter)

    @property
    def held(self) -> int:
        """All statements that held."""
        return sum(count for (_, outcome), count in self.counts.items() if outcome == HELD)


def judge(of: Statement, drawn: Drawn) -> tuple[str, str]:
    """The outcome of a statement of a drawn case, and its words where it failed."""
    excepted = any(one.name == of.name and one.of(drawn) for one in EXCEPTIONS)
    try:
        of.check(drawn)
    except NotApplicableError:
        return NOT_APPLICABLE, ""
    except AssertionError as error:
        return (EXCEPTED, "") if excepted else (FAILED, str(error).splitlines()[0])
    except InputError as error:
        return (EXCEPTED, "") if excepted else (FAILED, f"refused: {str(error).splitlines()[0]}")
    except Exception as error:
        frame = traceback.extract_tb(error.__traceback__)[-1]
        return FAILED, f"{type(error).__name__}: {error} ({frame.filename.rpartition('/')[2]}:{frame.lineno})"
    return HELD, ""


def campaign(
    seed: int, indices: Iterable[int], chosen: Iterable[Statement], tell: Callable[[str], None] = lambda _: None
) -> Tally:
    """Judge statements of the draws of a seed; tell : gets each failure as it occurs."""
    tally, table = Tally(), tuple(chosen)
    for index in indices:
        drawn = draw(seed, index)
        try:
            _ = drawn.depth
        except InputError as error:
            tally.refusals.append((seed, index, str(error).splitlines()[0]))
            continue
        for of in table:
            began = time.process_time()
            outcome, words = judge(of, drawn)
            tally.took[of.name] += time.process_time() - began
            tally.counts[of.name, outcome] += 1
            if outcome == FAILED:
                tally.failures.append((of.name, seed, index, words))
                tell(f"--seed {seed} --only {index}: {of.name}: {words}")
    return tally


def fast() -> list[Statement]:
    """The statements that neither run commands nor write files."""
    return [of for of in STATEMENTS.values() if not of.slow]
