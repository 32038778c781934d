"""Operations to begin with, as lines of TOML: what a new case has, and what a case without any may be given."""

import json
from collections.abc import Iterator
from typing import Final

# Column of the comments.
COMMENTS: Final = 38
# Off bottom, while drilling [rev/min], as of the kinds of operation.
TURNING, DRILLING = 60, 120
# A rotation lasts this many torsional periods.  At 60 rev/min the wells of the templates and four public ones are wound
# up within four of them; from then on the mean over a period changes by less than 2 %.
PERIODS: Final = 6


def entry(key: str, value: str, comment: str = "") -> str:
    """A line of TOML with a text."""
    return aligned(f"{key} = {json.dumps(value, ensure_ascii=False)}", comment)


def aligned(line: str, comment: str) -> str:
    """A line with its comment in the column of comments."""
    return f"{line:<{COMMENTS - 1}} # {comment}" if comment else line


def rotation(at: str, lasts: str, comment: str = "") -> Iterator[str]:
    """The string turns off bottom at a depth."""
    yield entry("kind", "rotate_off_bottom")
    yield entry("at_md", at)
    yield entry("duration", lasts, comment)
    yield f"rpm = {TURNING}"


def trip(kind: str, start: str, end: str, speed: str) -> Iterator[str]:
    """The string moves from one depth to another."""
    yield entry("kind", kind)
    yield entry("from_md", start)
    yield entry("to_md", end)
    yield entry("speed", speed)


def drilling(start: str, end: str, speed: str) -> Iterator[str]:
    """The bit drills from one depth to another."""
    yield from trip("drill_rotating", start, end, speed)
    yield f"rpm = {DRILLING}"


def to_paste(at: str) -> tuple[str, ...]:
    """The end of a case that has no operations: the string turns at a depth."""
    return "[[operations]]", *rotation(at, "60 s")
