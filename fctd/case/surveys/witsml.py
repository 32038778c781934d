"""Trajectories of WITSML 1.3.1 and 1.4.1, the exchange format of drilling data (XML)."""

from collections.abc import Sequence
from typing import Final
from xml.etree.ElementTree import Element

from fctd.case.errors import InputError, nearest, show
from fctd.case.surveys.form import SURVEY
from fctd.case.surveys.stations import MOST_STATIONS
from fctd.case.tables.fields import Column
from fctd.case.tables.rows import Rows
from fctd.case.xml_file import child, read_xml, tag, text_of

# Status of a station (TrajStationStatus) that is no longer in use; the others are open and position.
_STATUS, _REJECTED = "statusTrajStation", "rejected"
_ELEMENTS: Final[dict[str, str]] = {"md": "md", "inc": "incl", "azi": "azi"}


def read_witsml(text: str, name: str | None) -> tuple[Rows, list[int]]:
    """The stations of the named trajectory, else of the only one, and the numbers of those that are ``rejected``.

    Rejected stations and those without a direction are left out.  Raises InputError, which names station and element,
    for what cannot be read.
    """
    trajectory = _choose(read_xml(text, "a WITSML trajectory"), name)
    rejected, numbers = [], []
    elements: dict[str, list[Element | None]] = {key: [] for key in _ELEMENTS}
    for number, station in enumerate((e for e in trajectory if tag(e) == "trajectoryStation"), start=1):
        found = {key: child(station, element) for key, element in _ELEMENTS.items()}
        if text_of(child(station, _STATUS)) == _REJECTED:
            rejected.append(number)
        elif found["inc"] is not None or found["azi"] is not None:
            numbers.append(number)
            for key, element in found.items():
                elements[key].append(element)
    if len(numbers) > MOST_STATIONS:
        raise InputError(f"at most {MOST_STATIONS} stations")
    columns = {key: _column(key, numbers, found) for key, found in elements.items()}
    cells = {key: list(map(text_of, found)) for key, found in elements.items()}
    return Rows(columns, numbers, cells, "trajectoryStation {}", "trajectoryStations {} to {}"), rejected


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
        raise InputError(f"the name of the trajectory in wellbore.sheet (for init: --sheet): {names}", key="sheet")
    (found, *others) = trajectories[name or next(iter(trajectories))]
    if others:
        raise InputError(f"one trajectory of each name, found {1 + len(others)} in {names}")
    return found


def _column(key: str, numbers: Sequence[int], elements: Sequence[Element | None]) -> Column:
    """The column of an element, whose unit is the same at every station."""
    field, unit, before = SURVEY.field(key), None, None
    for number, element in zip(numbers, elements, strict=True):
        stated = before if element is None else element.get("uom", "")
        if stated is None or stated == before:
            continue
        here = field.unit_of(stated)
        if here is None or unit not in (None, here):
            expected = field.accepted if unit is None else f"{unit}, the unit of the stations before"
            raise InputError(expected, key=f"trajectoryStation {number}, {_ELEMENTS[key]}, uom", value=stated)
        unit, before = here, stated
    return Column(field, 0, _ELEMENTS[key], unit or field.dimension.units[0])
