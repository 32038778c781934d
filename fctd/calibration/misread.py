"""Rows that may have been misread: carried over from the report before, out of order, or short of a digit.

They are fitted all the same, with a sentence each: the rows cannot say which of two readings is wrong.
"""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Final, NamedTuple

import numpy as np

from fctd.calibration.forward import Evaluation, Forward
from fctd.calibration.rows import Load, Range, Row
from fctd.case.message import Message, joined, quantity

# A reading that is carried over must differ from what the string then reads by this many standard deviations.
MOVED: Final = 2.0
# Noises by which a weight must be out of order.
MARGIN: Final = 1.5
# A reading over the fitted one, beyond which it is doubted, and how far off it must be in standard deviations.
HOOKLOAD: Final = (0.6, 1.6)
TORQUE: Final = (0.3, 3.0)
FAR: Final = 5.0
_DIGIT: Final = 4.0
_NAMES: Final = {"hookload": ("hook load", "kN"), "torque": ("torque", "kN·m")}


# Names of weights, by the direction of the block.
WEIGHTS: Final = {1: "slack-off", 0: "rotating", -1: "pick-up"}


class Weight(NamedTuple):
    """A hook load with its row; margin [N] : by which another one must exceed it to be out of order."""

    row: int
    read: Range
    margin: float


class _Station(NamedTuple):
    """The rows of one day at one depth: readings by operation and load, with the row of each and its fitted value."""

    label: str
    depth: float
    readings: dict[tuple[str, Load], tuple[int, Range, float, float]]


def misread(forward: Forward, fitted: Evaluation) -> dict[str, str]:
    """A sentence for each row that is doubted, by id.  fitted : the readings of a fit that is robust."""
    found: dict[str, list[str]] = {}
    stations = _stations(forward, fitted)
    for before, now in pairwise(stations):
        if sentence := _carried_over(before, now):
            for k in dict.fromkeys(row for row, *_ in now.readings.values()):
                found.setdefault(forward.rows[k].id, []).append(sentence)
    for station in stations:
        for k, sentence in _out_of_order(station, forward.rows):
            found.setdefault(forward.rows[k].id, []).append(sentence)
    for i, reading in enumerate(forward.readings):
        if sentence := _digit(reading.load, reading.range, float(fitted.value[i]), reading.noise):
            found.setdefault(forward.rows[reading.row].id, []).append(sentence)
    return {name: joined(sentences) for name, sentences in found.items()}


def _stations(forward: Forward, fitted: Evaluation) -> list[_Station]:
    """Stations in the order of the rows."""
    found: dict[tuple[str, str, float], _Station] = {}
    for i, reading in enumerate(forward.readings):
        row = forward.rows[reading.row]
        if not row.has_string or np.isnan(reading.range.low):
            continue
        label = f"{row.day}, {quantity(row.bit_depth, 'm')}" if row.day else quantity(row.bit_depth, "m")
        station = found.setdefault((row.day, row.string, row.bit_depth), _Station(label, row.bit_depth, {}))
        operation = f"{row.operation}, {'turning' if row.rates.spin else 'sliding'}"
        station.readings[operation, reading.load] = (reading.row, reading.range, float(fitted.value[i]), reading.noise)
    return list(found.values())


def _carried_over(before: _Station, now: _Station) -> str:
    """The sentence where all readings that both have are the same, though the string would read something else."""
    both = before.readings.keys() & now.readings.keys()
    if len(both) < 2 or before.depth == now.depth:
        return ""
    same = all(before.readings[key][1] == now.readings[key][1] for key in both)
    moved = [abs(now.readings[key][2] - before.readings[key][2]) / now.readings[key][3] for key in both]
    if not same or not max(moved) > MOVED:
        return ""
    return Message(f"all {len(both)} readings are those of {before.label}: carried over from there?")


def _out_of_order(station: _Station, rows: Sequence[Row]) -> list[tuple[int, str]]:
    """Sentences of rows whose hook load is out of order."""
    loads: dict[str, Weight] = {}
    for (_, load), (k, read, _, noise) in station.readings.items():
        if load == "hookload" and (rows[k].operation == "rotate_off_bottom" or not rows[k].rates.spin):
            loads[WEIGHTS[rows[k].direction]] = Weight(k, read, MARGIN * noise)
    return out_of_order(loads, station.label)


def out_of_order(loads: Mapping[str, Weight], where: str) -> list[tuple[int, str]]:
    """Rows whose hook load is out of the order slack-off, rotating, pick-up, and a sentence for each.

    loads : of one depth, by their names in ``WEIGHTS``; where : the depth in words.
    """
    found: list[tuple[int, str]] = []
    pairs = (("slack-off", "rotating"), ("rotating", "pick-up"), ("slack-off", "pick-up"))
    for lower, upper in pairs:
        if lower not in loads or upper not in loads or (upper == "pick-up" and lower == "slack-off" and found):
            continue
        low, high = loads[lower], loads[upper]
        if low.read.low > high.read.high + low.margin:
            wrong = low.row if upper == "rotating" else high.row
            one = f"{lower} weight of {quantity(_kilo(low.read), 'kN', '.6g')}"
            two = f"{upper} weight of {quantity(_kilo(high.read), 'kN', '.6g')}"
            found.append((wrong, Message(f"a {one} above the {two} at {where}: swapped or misread?")))
    return found


def _digit(load: Load, read: Range, fitted: float, noise: float) -> str:
    """The sentence of a reading that is a fraction or a multiple of the fitted one."""
    least, most = HOOKLOAD if load == "hookload" else TORQUE
    middle = read.middle
    if np.isnan(middle) or not fitted > 0 or abs(middle - fitted) < FAR * noise or least < middle / fitted < most:
        return ""
    ratio = middle / fitted
    why = "a dropped digit?" if ratio < 1 / _DIGIT else "a digit too many?" if ratio > _DIGIT else "misread?"
    name, unit = _NAMES[load]
    found, fit = quantity(_kilo(read), unit, ".6g"), quantity(1e-3 * fitted, unit, ".3g")
    return Message(f"a {name} of {found} where the other rows let expect {fit}: {why}")


def _kilo(read: Range) -> float:
    return 1e-3 * read.middle
