"""Stations as they are written, and checked stations.

Checked stations are an array of shape (n, 3): measured depth [m], inclination and azimuth [rad], the azimuth
unwrapped, so that it may exceed 2π.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from fctd.case.errors import MISSING, InputError
from fctd.case.message import quantity
from fctd.case.units import DEEPEST

StationKey = Literal["md", "inc", "azi"]
Where = Callable[[int, int], tuple[str, object]]
"""Gives the user's key and value at (row, column) of the stations."""

# What one unit is in metres, or in degrees.  The survey foot is that of the United States, 1200/3937 m.
UNITS: Final[dict[StationKey, dict[str, float]]] = {
    "md": {"m": 1.0, "ft": 0.3048, "usft": 1200 / 3937},
    "inc": {"deg": 1.0, "rad": float(np.degrees(1.0))},
    "azi": {"deg": 1.0, "rad": float(np.degrees(1.0))},
}
_SAME: Final = 1e-9  # m and deg: rows closer than this are one station written twice
MOST_STATIONS: Final = 100_000  # one every half metre of the deepest well: a file of more is no survey
TIE_IN: Final = -1


@dataclass(frozen=True)
class Written:
    """Stations as a file or a case has them.

    values : (n, 3) in the units of their columns, such as ("ft", "deg", "deg"); where : names a value; one, several :
    names of a row and of a range of rows, to be filled with the `numbers` of the rows; file : the name of the file, ""
    for stations that the case itself holds; rejected : numbers of the stations that the file itself marks as rejected,
    which are left out; vertical : true vertical depths (n,) [m] that the file has, which only check the others.
    """

    values: NDArray[np.float64]
    units: tuple[str, str, str]
    where: Where
    numbers: Sequence[int]
    one: str = "row {}"
    several: str = "rows {} to {}"
    file: str = ""
    rejected: Sequence[int] = ()
    vertical: NDArray[np.float64] | None = None

    @property
    def factors(self) -> NDArray[np.float64]:
        """What the units of the columns are in m, deg, deg, shape (3,)."""
        return np.array([UNITS[key][unit] for key, unit in zip(UNITS, self.units, strict=True)])

    @property
    def has_columns(self) -> bool:
        """Whether they are a text or a sheet, whose columns the case may describe."""
        return self.one == "row {}"

    def rows(self, first: int, last: int) -> str:
        """The name of the rows of two indices and those between them."""
        here, there = self.numbers[first], self.numbers[last]
        name = self.one.format(here) if here == there else self.several.format(here, there)
        return f"{self.file}, {name}" if self.file else name


@dataclass(frozen=True)
class Survey:
    """Checked stations (n, 3) [m, rad, rad], how they are written, and the row of each there.

    An added station has the row `TIE_IN`.  Repeats are dropped.  Where the first row is not at measured depth 0, a
    vertical station at 0 is put before it.
    """

    stations: NDArray[np.float64]
    written: Written
    index: NDArray[np.int64]

    @property
    def tied_in(self) -> bool:
        """Whether a station at measured depth 0 was added."""
        return bool(self.index[0] == TIE_IN)

    def rows(self, first: int, last: int) -> str:
        """The name of the rows from one station to another."""
        here, there = (max(int(self.index[k]), 0) for k in (first, last))
        return self.written.rows(here, there)


def check(written: Written) -> Survey:
    """The checked survey, or an InputError that names row and column of what no hole can have."""
    stations = written.values * written.factors

    def refuse(row: int, column: int, expected: str) -> InputError:
        key, value = written.where(row, column)
        return InputError(expected, key=key, value=value)

    def angle(degrees: float, column: int) -> str:
        return f"{degrees / written.factors[column]:.4g}"

    for row, column in np.argwhere(~np.isfinite(stations)).tolist():
        raise refuse(row, column, "a finite number")
    if len(stations) > MOST_STATIONS:
        raise InputError(f"at most {MOST_STATIONS} stations")
    for row in np.flatnonzero(stations[:, 0] < 0.0).tolist():
        raise refuse(row, 0, "a measured depth of at least 0")
    for row in np.flatnonzero(stations[:, 0] > DEEPEST).tolist():
        raise refuse(row, 0, f"a measured depth of at most {quantity(DEEPEST / 1e3, 'km')}")
    for row in np.flatnonzero((stations[:, 1] < 0.0) | (stations[:, 1] > 180.0)).tolist():
        raise refuse(row, 1, f"an inclination from 0 to {angle(180.0, 1)} {written.units[1]}")
    # The bound admits unwrapped azimuths and excludes -999.25 and the other null values of well logs.
    for row in np.flatnonzero(np.abs(stations[:, 2]) > 720.0).tolist():
        largest = angle(720.0, 2)
        raise refuse(row, 2, f"an azimuth from -{largest} to {largest} {written.units[2]}")

    new = np.ones(len(stations), dtype=bool)
    new[1:] = np.any(np.abs(np.diff(stations, axis=0)) > _SAME, axis=1)
    kept = np.flatnonzero(new)
    if len(kept) < 2:
        raise InputError(f"at least two different stations, found {len(kept)}")
    for row in kept[1:][np.diff(stations[kept, 0]) <= 0.0].tolist():
        raise refuse(row, 0, "a measured depth greater than that of the station before")
    checked = stations[kept]
    if checked[0, 0] <= _SAME:
        checked[0, 0] = 0.0
    else:
        # The azimuth of a vertical station is any; that of the next one keeps interpolated azimuths from turning.
        checked = np.vstack([[0.0, 0.0, checked[0, 2]], checked])
        kept = np.concatenate([[TIE_IN], kept])
    return Survey(to_radians(checked), written, kept)


def check_listed(values: NDArray[np.float64]) -> Survey:
    """The checked survey of stations (n, 3) [m, deg, deg] that a case itself holds; InputError as of ``check``."""
    key = "wellbore.stations[{}]"

    def where(row: int, column: int) -> tuple[str, object]:
        return f"[{row}][{column}]", MISSING

    try:
        return check(Written(values, ("m", "deg", "deg"), where, range(len(values)), key, f"{key} to [{{}}]"))
    except InputError as error:
        raise error.at("stations") from None


def to_radians(stations: NDArray[np.float64]) -> NDArray[np.float64]:
    """Stations (n, 3) in m and degrees to m and radians, with the azimuth unwrapped through north."""
    out = np.array(stations, dtype=float)
    out[:, 1] = np.radians(out[:, 1])
    out[:, 2] = np.unwrap(np.radians(out[:, 2]))
    return out
