"""The timed strings: the curved chain in contact or hanging freely, and the paper's well."""

from pathlib import Path
from typing import Any

from fctd import Case, load_case

CASES = Path(__file__).parents[1] / "validation" / "cases"
BIT = 2450.0
# Without contact, vertical, from the same top.
OPEN = {"contact.enabled": False, "wellbore.stations": [[0, 0, 0], [2600, 0, 0]]}
# Simulated time before a timing [s], after which the first wave has passed the string.
LEAD = 6.0


def chain(segments: int = 60, **changes: Any) -> Case:
    """The curved chain with this number of segments, rotating off bottom; keys of changes with ``__`` for dots."""
    schedule = {"kind": "rotate_off_bottom", "at_md": BIT, "duration": 2e4 if segments <= 1000 else 60.0}
    turning = [schedule | {"rpm": 60.0, "ramp_time": 4.0}]
    overrides = {key.replace("__", "."): value for key, value in changes.items()}
    return load_case(
        CASES / "curved_chain.toml", {"operations": turning, "string.components[0].segments": segments} | overrides
    )


def hanging(segments: int = 60) -> Case:
    """The same chain hanging freely in a vertical line, rotating."""
    return chain(segments, **OPEN)


def trip(start: float, end: float, **changes: Any) -> Case:
    """Tripping into the paper's well at 0.5 m/s."""
    operations = [{"kind": "trip_in", "from_md": start, "to_md": end, "speed": 0.5, "ramp_time": 2.0}]
    overrides = {key.replace("__", "."): value for key, value in changes.items()}
    return load_case(CASES / "paper_well.toml", {"operations": operations} | overrides)
