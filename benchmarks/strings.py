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


def newcomers(*operations: dict[str, Any], **sections: dict[str, Any]) -> Case:
    """A well of 13,000 ft with 1,000 ft of bottom-hole assembly and 5 in pipe, all else by default."""
    feet = 0.3048
    return Case.model_validate(
        {
            "name": "newcomer's well",
            "wellbore": {
                "stations": [[0, 0, 0], [900, 0, 0], [1500, 40, 30], [13_000 * feet, 40, 30]],
                "intervals": [{"to_md": 13_000 * feet, "diameter": 0.2159, "friction": 0.25}],
            },
            "mud": {"density": 1200.0},
            "string": {
                "components": [
                    {"name": "collars", "length": 1000 * feet, "outer_diameter": 0.165, "inner_diameter": 0.07},
                    {"name": "pipe", "outer_diameter": 0.127, "inner_diameter": 0.1086},
                ]
            },
            "operations": list(operations),
            **sections,
        }
    )


def tripping() -> Case:
    """Tripping out of ``newcomers`` from 12,500 ft, stand by stand."""
    start = 12_500 * 0.3048
    return newcomers({"kind": "trip_out", "from_md": start, "to_md": start - 90.0, "speed": 0.3, "ramp_time": 5.0})


def drilling() -> Case:
    """An autodriller in ``newcomers`` at 3 km."""
    ahead = {"kind": "drill_rotating", "from_md": 3000.0, "to_md": 3000.5, "speed": 20 / 3600, "rpm": 120.0}
    driller = {"drive": "speed_control", "autodriller": True}
    return newcomers(ahead | {"ramp_time": 5.0}, rig=driller, bit={"weight_on_bit": 80e3, "rock": {}})


def trip(start: float, end: float, **changes: Any) -> Case:
    """Tripping into the paper's well at 0.5 m/s."""
    operations = [{"kind": "trip_in", "from_md": start, "to_md": end, "speed": 0.5, "ramp_time": 2.0}]
    overrides = {key.replace("__", "."): value for key, value in changes.items()}
    return load_case(CASES / "paper_well.toml", {"operations": operations} | overrides)
