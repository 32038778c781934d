"""The table of statements: each a name, a bound in its words, and a function that takes a drawn case and asserts."""

from collections.abc import Callable
from typing import Final, NamedTuple

from tests.equivalence.answers import NotApplicableError
from tests.equivalence.draws import Drawn

Check = Callable[[Drawn], None]


class Statement(NamedTuple):
    """A statement that must hold of every drawn case.

    check : raises AssertionError where it does not hold, NotApplicableError of a case of which it says nothing; slow :
    whether it runs commands, writes files, or takes longer than others.
    """

    name: str
    check: Check
    slow: bool = False


STATEMENTS: Final[dict[str, Statement]] = {}


def statement(name: str, *, slow: bool = False) -> Callable[[Check], Check]:
    """Add a statement to the table."""

    def add(check: Check) -> Check:
        assert name not in STATEMENTS
        STATEMENTS[name] = Statement(name, check, slow)
        return check

    return add


def applies(condition: object) -> None:
    """Raise NotApplicableError unless a statement applies."""
    if not condition:
        raise NotApplicableError
