"""Trajectories of WITSML 1.3.1 and 1.4.1, the exchange format of drilling data (XML)."""

from collections.abc import Sequence
from typing import Final
from xml.etree.ElementTree import Element

import numpy as np

from fctd.case.errors import InputError, nearest, show
from fctd.case.surveys.headers import KEYS, accepted_units, unit_of
from fctd.case.surveys.stations import MOST_STATIONS, UNITS, StationKey, Where, Written
from fctd.case.surveys.table import read_number
from fctd.case.xml_file import child, read_xml, tag, text_of

# Status of a station (TrajStationStatus) that is no longer in use; the others are open and position.
_STATUS, _REJECTED = "statusTrajStation", "rejected"
_ELEMENTS: Final[dict[StationKey, str]] = {"md": "md", "inc": "incl", "azi": "azi"}


def read_witsml(text: str, name: str | None) -> Written:
    """The stations of the named trajectory, else of the only one.

    Stations without a direction are left out, and those whose status is ``rejected``.
    Raises InputError, which names station and element, for what cannot be read.
    """
    trajectory = _choose(read_xml(text, "a WITSML trajectory"), name)
    stations, rejected = [], []
    for place, station in enumerate((e for e in trajectory if tag(e) == "trajectoryStation"), start=1):
        if text_of(child(station, _STATUS)) == _REJECTED:
            rejected.append(place)
        else:
            stations.append((place, [child(station, element) for element in _ELEMENTS.values()]))
    stations = [(number, cells) for number, cells in stations if cells[1] is not None or cells[2] is not None]
    if len(stations) > MOST_STATIONS:
        raise InputError(f"at most {MOST_STATIONS} stations")

    def where(row: int, column: int) -> tuple[str, object]:
        number, cells = stations[row]
        return f"trajectoryStation {number}, {_ELEMENTS[KEYS[column]]}", text_of(cells[column])

    units = [_common_unit(key, [cells[column] for _, cells in stations], where) for column, key in enumerate(KEYS)]
    values = np.empty((len(stations), len(KEYS)))
    for row, column in np.ndindex(values.shape):
        key, cell = where(row, column)
        number = read_number(str(cell))
        if number is None:
            raise InputError("a number", key=key, value=cell)
        values[row, column] = number
    numbers = [number for number, _ in stations]
    names = ("trajectoryStation {}", "trajectoryStations {} to {}")
    return Written(values, (units[0], units[1], units[2]), where, numbers, *names, rejected=rejected)


def _choose(root: Element, name: str | None) -> Element:
    """The named trajectory, or the only one with stations."""
    trajectories: dict[str, list[Element]] = {}
    for number, element in enumerate((e for e in root.iter() if tag(e) == "trajectory"), start=1):
        if any(tag(inner) == "trajectoryStation" for inner in element):
            trajectories.setdefault(text_of(child(element, "name")) or f"trajectory {number}", []).append(element)
    if not trajectories:
        raise InputError(f"a WITSML trajectory with stations, found the element {show(tag(root))}")
    names = ", ".join(map(show, trajectories))
    if name is not None and name not in trajectories:
        raise InputError(nearest(name, trajectories, "name"), key="sheet", value=name)
    if name is None and len(trajectories) > 1:
        raise InputError(f"the name of the trajectory in wellbore.sheet: {names}", key="sheet")
    (found, *others) = trajectories[name or next(iter(trajectories))]
    if others:
        raise InputError(f"one trajectory of each name, found {1 + len(others)} in {names}")
    return found


def _common_unit(key: StationKey, cells: Sequence[Element | None], where: Where) -> str:
    """The unit of an element, the same at every station."""
    column, first, before = KEYS.index(key), None, None
    for row, cell in enumerate(cells):
        if cell is None:
            continue  # refused with the numbers
        stated = cell.get("uom", "")
        if stated == before:
            continue
        unit = unit_of(stated)
        if unit not in UNITS[key] or first not in (None, unit):
            expected = accepted_units(key) if first is None else f"{first}, the unit of the stations before"
            raise InputError(expected, key=f"{where(row, column)[0]}, uom", value=stated)
        first, before = unit, stated
    return first or next(iter(UNITS[key]))
