"""The quantities of a series: their columns in the table [SI], the names of their headers, and which are needed."""

from collections.abc import Collection, Sequence
from dataclasses import replace
from shlex import quote
from typing import Final

from fctd.case.tables.fields import Field
from fctd.case.tables.headers import TableForm
from fctd.case.tables.readings import BIT_DEPTH, FLOW_IN, HOOK_LOAD, ROTATION_OF_DRIVE, TORQUE_OF_DRIVE, reading
from fctd.case.units import DEEPEST, FORCE, LENGTH, TIME

_TIME: Final = reading(
    "time", "time, date time, timestamp, rig time, etim, date and time, date time utc, time utc, utc, clock",
    TIME, "s", bare="",
)  # fmt: skip
_HOLE_DEPTH: Final = reading(
    "hole_depth", "hole depth, depth hole, hole md, total depth, hole measured depth, depth of hole, dmea, hdep",
    LENGTH, "m", most=DEEPEST,
)  # fmt: skip
_BLOCK: Final = reading(
    "block_position", "block position, bpos, block height, blkpos, blpos, block, hook position, hook height",
    LENGTH, "m",
)  # fmt: skip
_WEIGHT_ON_BIT: Final = reading("weight_on_bit", "weight on bit, wob, woba, swob", FORCE, "kN")
# Column of each quantity in the table, and its field.
QUANTITIES: Final[dict[str, Field]] = {
    "time_s": _TIME,
    "bit_depth_m": BIT_DEPTH,
    "hole_depth_m": replace(_HOLE_DEPTH, optional=True),
    "weight_indicator_N": HOOK_LOAD,
    "drive_torque_N_m": TORQUE_OF_DRIVE,
    "rpm": ROTATION_OF_DRIVE,
    "block_position_m": _BLOCK,
    "flow_m3_s": replace(FLOW_IN, optional=True),
    "weight_on_bit_N": replace(_WEIGHT_ON_BIT, optional=True),
    "operation": Field("operation", "operation, kind"),
}
# Beside a time of day; alone it is the time.
DATE: Final = replace(_TIME, key="date", names="date")
# What a series over time must have, and a series by depth.
OVER_TIME: Final = ("time", "bit_depth", "hook_load", "torque", "rpm", "block_position")
BY_DEPTH: Final = ("bit_depth", "operation", "hook_load", "torque")


def _needed(found: Collection[str]) -> Sequence[Sequence[str]]:
    by_depth = "operation" in found and not {"time", "date"} & {*found}
    return [["time", "date"] if key == "time" else [key] for key in (BY_DEPTH if by_depth else OVER_TIME)]


def _remedy(key: str, headers: Sequence[str], unit: str) -> str:
    """How to say which column is meant, and its unit; a series without times may say what the rig does."""
    by_depth = ", or a column operation in place of time and block position" if key == "time" and not unit else ""
    return f"by --columns '{key}={headers[0]}{f' [{unit}]' if unit else ''}'{by_depth}"


def _paste(columns: Sequence[tuple[str, str, str]]) -> str:
    return " ".join(f"--columns {quote(f'{key}={header} [{unit}]')}" for key, header, unit in columns)


SERIES: Final = TableForm(
    fields=(*QUANTITIES.values(), DATE),
    example="time, bit_depth_m, hook_load_kN, torque_kN_m, rpm, block_position_m",
    needed=_needed,
    option="--columns ",
    remedy=_remedy,
    paste=_paste,
)
