"""Survey stations from a CSV file, and the checks of every list of stations.

Stations are an array of shape (n, 3): measured depth [m], inclination and azimuth [rad], the azimuth unwrapped, so
that it may exceed 2π.  Files and cases are written in degrees; only this module converts them.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Mapping, Sequence
from itertools import islice
from os import PathLike
from pathlib import Path
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from fctd.case.errors import InputError, show
from fctd.case.input_file import read_text
from fctd.case.units import conversion

StationKey = Literal["md", "inc", "azi"]
Where = Callable[[int, int], tuple[str, object]]
"""Gives the user's key and value at (row, column) of a station array."""

_UNITS: Final[dict[StationKey, tuple[str, str]]] = {
    "md": ("m", "ft"),
    "inc": ("deg", "rad"),
    "azi": ("deg", "rad"),
}
_UNIT_ENDS_HEADER: Final = re.compile(r"(?:\(\s*|_)(?P<unit>[a-z]+)\s*\)?$")
_LARGEST_FILE: Final = 32  # MiB: 100,000 stations with 40 other columns
_SAME: Final = 1e-9  # m and deg: rows closer than this are one station written twice
# Four times the deepest well drilled, and a station every half metre of it: a file beyond these limits is no survey.
DEEPEST: Final = 50_000.0  # [m] measured depth
MOST_STATIONS: Final = 100_000


def read_stations(path: str | PathLike[str], columns: Mapping[StationKey, str] | None = None) -> NDArray[np.float64]:
    """The checked stations (n, 3) of a CSV file: measured depth [m], inclination and azimuth [rad].

    Headers name their units: md_m or md_ft, inc_deg or inc_rad, azi_deg or azi_rad, in any case.
    `columns` maps md, inc, azi to other headers, which end in their unit: "Depth ( ft )", "depth_ft".
    Raises InputError, which names file, row and column, for bad data.
    """
    try:
        return _stations(_rows(Path(path)), columns or {})
    except InputError as error:
        raise error.in_file(path) from error.__cause__


def check_stations(stations: NDArray[np.float64], where: Where) -> NDArray[np.float64]:
    """Stations (n, 3) [m, rad, rad] of stations in [m, deg, deg], or an InputError.

    Exact repeats, which real surveys contain, are dropped.
    """

    def refuse(row: int, column: int, expected: str) -> InputError:
        key, value = where(row, column)
        return InputError(expected, key=key, value=value)

    for row, column in np.argwhere(~np.isfinite(stations)).tolist():
        raise refuse(row, column, "a finite number")
    if len(stations) > MOST_STATIONS:
        raise InputError(f"at most {MOST_STATIONS} stations")
    for row in np.flatnonzero(stations[:, 0] > DEEPEST).tolist():
        raise refuse(row, 0, f"a measured depth of at most {DEEPEST / 1e3:g} km")
    for row in np.flatnonzero((stations[:, 1] < 0.0) | (stations[:, 1] > 180.0)).tolist():
        raise refuse(row, 1, "an inclination from 0 to 180 deg")
    # The bound admits unwrapped azimuths and excludes -999.25 and the other null values of well logs.
    for row in np.flatnonzero(np.abs(stations[:, 2]) > 720.0).tolist():
        raise refuse(row, 2, "an azimuth from -720 to 720 deg")

    new = np.ones(len(stations), dtype=bool)
    new[1:] = np.any(np.abs(np.diff(stations, axis=0)) > _SAME, axis=1)
    kept = np.flatnonzero(new)
    if len(kept) < 2:
        raise InputError(f"at least two different stations, found {len(kept)}")
    if stations[0, 0] != 0.0:
        raise refuse(0, 0, "a first station at measured depth 0, add a tie-in station at surface")
    for row in kept[1:][np.diff(stations[kept, 0]) <= 0.0].tolist():
        raise refuse(row, 0, "a measured depth greater than that of the station before")
    return to_radians(stations[kept])


def to_radians(stations: NDArray[np.float64]) -> NDArray[np.float64]:
    """Stations (n, 3) in m and degrees to m and radians, with the azimuth unwrapped through north."""
    out = np.array(stations, dtype=float)
    out[:, 1] = np.radians(out[:, 1])
    out[:, 2] = np.unwrap(np.radians(out[:, 2]))
    return out


def _rows(path: Path) -> list[tuple[int, list[str]]]:
    """Line number in the file and stripped cells of every row that is not blank."""
    try:
        reader = csv.reader(io.StringIO(read_text(path, _LARGEST_FILE)))
        # One line more than can be used is enough to refuse a survey that is too long.
        found = islice(filter(any, reader), MOST_STATIONS + 2)
        rows = [(reader.line_num, [cell.strip() for cell in cells]) for cells in found]
    except OSError as error:
        raise InputError(f"a survey file that can be read ({error.strerror})") from error
    except InputError:
        raise
    except (ValueError, csv.Error) as error:
        raise InputError(f"a CSV file of text ({error})") from error
    return [(line, cells) for line, cells in rows if any(cells)]


def _stations(rows: Sequence[tuple[int, list[str]]], columns: Mapping[StationKey, str]) -> NDArray[np.float64]:
    if not rows:
        raise InputError("a row of headers and a row for each station, the file is empty")
    (first, headers), *body = rows
    if len(headers) == 1 and re.search(r"[;\t]", headers[0]):
        raise InputError(
            "columns separated by commas, numbers with a decimal point", key=f"row {first}", value=headers[0]
        )
    found = [_find_column(key, headers, columns.get(key)) for key in _UNITS]
    factors = [factor for _, factor in found]

    def where(row: int, column: int) -> tuple[str, object]:
        line, cells = body[row]
        place = found[column][0]
        return f"row {line}, {headers[place]}", cells[place] if place < len(cells) else ""

    stations = np.empty((len(body), len(found)))
    for row, column in np.ndindex(stations.shape):
        key, cell = where(row, column)
        try:
            stations[row, column] = float(str(cell))
        except ValueError as error:
            raise InputError("a number", key=key, value=cell) from error
    return check_stations(stations * factors, where)


def _find_column(key: StationKey, headers: Sequence[str], mapped: str | None) -> tuple[int, float]:
    """The index of a column and the factor from its unit to m or deg."""
    names = [header.lower() for header in headers]
    wanted = [f"{key}_{unit}" for unit in _UNITS[key]] if mapped is None else [mapped.strip().lower()]
    place = next((names.index(name) for name in wanted if name in names), None)
    if place is None:
        others = ", ".join(map(show, headers))
        if mapped is None:
            raise InputError(
                f"it among the headers {others}, or another header named in columns",
                key=f"column {' or '.join(wanted)}",
            )
        raise InputError(f"one of the headers {others}", key=f"columns.{key}", value=mapped)

    unit = _UNIT_ENDS_HEADER.search(names[place])
    if unit is None or unit["unit"] not in _UNITS[key]:
        raise InputError(
            f"a header that ends in its unit, {' or '.join(f'( {name} )' for name in _UNITS[key])}",
            key=f"columns.{key}",
            value=mapped,
        )
    return place, conversion(unit["unit"], _UNITS[key][0])
