"""Values that Python hands over in place of a case file: dicts, arrays, and tables of pandas."""

import sys
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Final

import numpy as np

from fctd.case.errors import InputError, Table
from fctd.case.surveys.form import KEYS, SURVEY
from fctd.case.surveys.stations import UNITS
from fctd.case.tables.rows import Numbers
from fctd.case.tables.text import read_sheet

# A column is renamed where it stands: what the case or a command would say of it is no remedy.
_FORM: Final = replace(SURVEY, remedy=lambda *_: "")


def as_written(value: Any, key: str = "") -> Any:
    """A copy of a value as TOML would hold it: tables are dicts, arrays lists, and a case the keys that it was given.

    A DataFrame under the key ``stations`` is the stations, its columns named as those of a survey file are
    ("md_m", "inc_deg", "azi_deg"); another one is a list of tables, a row each, in which an empty cell is no key.
    Raises InputError for stations that cannot be read.
    """
    if isinstance(value, Table):
        value = value.model_dump(exclude_unset=True, exclude={"file"}, by_alias=True)
    if isinstance(value, Mapping):
        return {name: as_written(of, str(name)) for name, of in value.items()}
    if is_frame(value):
        return stations_of(value) if key.rpartition(".")[2] == "stations" else _tables(value)
    if isinstance(value, np.ndarray | np.generic) or hasattr(value, "to_numpy"):
        return value.tolist()
    if isinstance(value, list | tuple):
        return [as_written(of) for of in value]
    return value


def is_frame(value: object) -> bool:
    """Whether a value is a DataFrame; pandas, which is slow to import, is there already where one is."""
    pandas = sys.modules.get("pandas")
    return pandas is not None and isinstance(value, pandas.DataFrame)


def stations_of(frame: Any) -> list[list[float]]:
    """Stations of a DataFrame, [measured depth in m, inclination in deg, azimuth in deg] each.

    Raises InputError for columns that a survey file could not have, and for cells that are no numbers.
    """
    lines = [[str(name) for name in frame.columns], *([str(cell) for cell in row] for row in frame.to_numpy().tolist())]
    try:
        rows = read_sheet(list(enumerate(lines)), _FORM, {})  # row 0 has the headers
        values = Numbers().read(rows, KEYS, nothing=())
    except InputError as error:
        raise error.at("wellbore.stations") from None
    factors = [UNITS[key][str(rows.columns[key].unit)] for key in KEYS]
    stations: list[list[float]] = (values * factors).tolist()
    return stations


def _tables(frame: Any) -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = frame.astype(object).where(frame.notna(), None).to_dict("records")
    return as_written(rows)  # type: ignore[no-any-return]
