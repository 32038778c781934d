"""The caliper of a case: a table or a file of diameters or radii over measured depth, and the radii of the hole."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, Literal, Self

import numpy as np
from pydantic import Field, ValidationInfo, field_validator, model_validator

from fctd.arrays import Array
from fctd.case import units
from fctd.case.calipers.form import ARMS, CALIPER, MOST_ARMS
from fctd.case.calipers.reading import Measured, read_caliper
from fctd.case.errors import InputError, Table, exclusive, known_keys
from fctd.case.file_names import FileName, beside_case
from fctd.case.message import quantity
from fctd.case.surveys.form import ColumnKey, ColumnSpec, check_units
from fctd.case.tables.headers import Choice

Reference = Literal["high_side", "north"]
_KEYS: Final = ("md", "orientation", *ARMS)


@dataclass(frozen=True)
class Caliper:
    """Radii of open hole over measured depth.

    md (k,) [m], increasing; radii (k, arms) [m], NaN where nothing was measured; angles (k, arms) [rad] of the arms,
    clockwise looking downhole from ``reference``.  One arm: a round hole.  Two: an ellipse with these half axes.
    """

    md: Array
    radii: Array
    angles: Array
    reference: Reference


class CaliperSpec(Table):
    """Measured size of open hole, which goes before the `diameter` of intervals that are not cased.

    One of `log`, a text in columns or a LAS file, and `rows` is set. `values` says what its arms measure. One arm: a
    round hole. Two: an oval with these axes, at right angles. Three or more: radii at equal angles around the hole, or
    diameters at equal angles over half a turn. Angles count clockwise looking downhole from `reference`; the first arm
    is at `first_arm`, added to the orientation that a file may have. `columns` says what the headers of a file do not.
    Where nothing is measured, the interval's `diameter` is the size.
    """

    log: FileName | None = Field(
        default=None, description="the name of a file, relative to the case file: text in columns or LAS"
    )
    rows: tuple[tuple[units.Bare, ...], ...] | None = Field(
        default=None, description="a list of [measured depth in m, diameter in m, ...]"
    )
    values: Literal["diameter", "radius"] = "diameter"
    reference: Reference = "high_side"
    first_arm: units.Angle = 0.0
    columns: dict[str, ColumnKey] | None = Field(
        default=None, description='headers of the file, or their units: {arm1 = {header = "HCAL", unit = "in"}}'
    )

    @field_validator("columns", mode="before")
    @classmethod
    def _check_columns(cls, raw: Any) -> Any:
        return known_keys(raw, _KEYS) if isinstance(raw, Mapping) else raw

    @field_validator("columns")
    @classmethod
    def _check_units(cls, columns: dict[str, ColumnSpec] | None) -> dict[str, ColumnSpec] | None:
        check_units(columns, CALIPER)
        return columns

    @field_validator("log")
    @classmethod
    def _find_log(cls, log: Path | None, info: ValidationInfo) -> Path | None:
        """The file, relative to the folder of the case file while one is loaded."""
        return beside_case(log, info, "a caliper file")

    @model_validator(mode="after")
    def _check(self) -> Self:
        exclusive(self, "log", "rows", required=True)
        if self.columns is not None and self.log is None:
            raise InputError("columns only beside log", key="columns")
        if self.rows is not None:
            self.read()
        return self

    def read(self) -> Caliper:
        """The radii of the table or the file; raises InputError for one that cannot be used."""
        if self.log is None:
            found = _of_rows(self.rows or ())
        else:
            choices = {str(key): Choice(column.header, column.unit) for key, column in (self.columns or {}).items()}
            found = read_caliper(self.log, choices)
        return _caliper(self, found)


def _of_rows(rows: tuple[tuple[float, ...], ...]) -> Measured:
    """The measured rows of a case."""
    if len(rows) < 2:
        raise InputError("two rows or more", key="rows", value=list(rows))
    for k, row in enumerate(rows):
        if len(row) != len(rows[0]) or not 2 <= len(row) <= MOST_ARMS + 1:
            expected = f"a depth and {len(rows[0]) - 1} values, as many as in the first row"
            if k == 0:
                expected = f"a depth and 1 to {MOST_ARMS} values"
            raise InputError(expected, key=f"rows[{k}]", value=list(row))
    values = np.array(rows, dtype=float)
    return Measured(values[:, 0], values[:, 1:], np.zeros(len(values)), lambda row, _: f"rows[{row}]")


def _caliper(spec: CaliperSpec, found: Measured) -> Caliper:
    """The radii that measured rows stand for."""
    for row, md in enumerate(found.md.tolist()):
        if row and md <= found.md[row - 1]:
            expected = f"a depth greater than that of the row above, {quantity(found.md[row - 1], 'm')}"
            raise InputError(expected, key=found.where(row, "md"), value=quantity(md, "m"), file=spec.log)
    bad = np.argwhere((found.values <= 0) | (found.values > units.WIDEST))
    if len(bad):
        row, arm = bad[0].tolist()
        raise InputError(
            f"a {spec.values} above 0 and up to {quantity(units.WIDEST, 'm')} (check the unit; a value that is "
            "missing is empty)",
            key=found.where(row, ARMS[arm]), value=quantity(found.values[row, arm], "m", ".6g"), file=spec.log,
        )  # fmt: skip
    arms = found.values.shape[1]
    radii = found.values if spec.values == "radius" else 0.5 * found.values
    if arms > 2 and spec.values == "diameter":
        radii = np.hstack([radii, radii])
    step = 0.5 * np.pi if arms == 2 else 2 * np.pi / radii.shape[1]
    angles = (spec.first_arm + found.orientation)[:, None] + step * np.arange(radii.shape[1])
    return Caliper(found.md, radii, angles, spec.reference)
