"""Answers as notebooks show them: a small table, and a picture; and records that become answers."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import wraps
from html import escape
from inspect import getdoc
from math import isnan
from pathlib import Path
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from fctd import plots
from fctd.case.errors import InputError
from fctd.results.columns import COLUMNS, LOADS
from fctd.results.shown_tables import NONE, Table, frame_table, of_column
from fctd.results.unit_systems import System, shown

if TYPE_CHECKING:
    from os import PathLike

    import pandas as pd
    from matplotlib.figure import Figure

Asked = ParamSpec("Asked")
Answer = TypeVar("Answer")
# Loads that say most: hook load and surface torque.
MAIN = LOADS[:2]
MOST = 12  # rows of a table in a notebook


def html_table(table: Table) -> str:
    """A table below its title, as HTML; texts are escaped."""
    import pandas as pd

    shown = pd.DataFrame([[cell.text for cell in row] for row in table.rows], columns=[*map(str, table.heads)] or None)
    # Of a wide text all is shown.
    with pd.option_context("display.max_colwidth", None):
        return f"<p><b>{escape(table.title)}</b></p>{shown.to_html(header=bool(table.heads), index=False)}"


def html_of(title: str, rows: pd.DataFrame, units: System = "si", columns: Sequence[str] = ()) -> str:
    """An SI table below a title, as HTML; of a long one the first and the last rows.

    columns : that are shown, by default all.  units : of what is shown.
    """
    return html_table(frame_table(title, rows, columns or list(map(str, rows)), units, most=MOST))


def load_rows(loads: Mapping[str, float], units: System) -> dict[str, str]:
    """Labels of columns and their values with units, "hook load": "957.9 kN"; a dash for NaN."""
    return {
        COLUMNS[name].label: NONE if isnan(value) else f"{of_column(name, value, units).text} {unit}"
        for name, value in loads.items()
        for _, unit in [shown(name, units)]
    }


@dataclass(eq=False, repr=False)
class Picture:
    """A picture of a result, which notebooks show.  figure : matplotlib's, to change or to add to."""

    figure: Figure

    def save(self, path: str | PathLike[str]) -> list[Path]:
        """Write it as .png, .svg or .pdf; returns the file.  Raises InputError where it cannot be written."""
        return plots.save(self.figure, Path(path))

    def _repr_png_(self) -> bytes:
        image = io.BytesIO()
        self.figure.savefig(image, format="png")
        return image.getvalue()


def picture(draw: Callable[[], Figure]) -> Picture:
    """The picture that a function of ``fctd.plots`` draws; raises InputError where its package is missing."""
    try:
        return Picture(draw())
    except ModuleNotFoundError as error:
        raise InputError(f"the package {error.name} (pip install 'fctd[plot]')", key="plot") from None


def answering(kind: type[Answer], compute: Callable[Asked, Any]) -> Callable[Asked, Answer]:
    """The function of a lower room, with its arguments and errors, whose record becomes an answer.

    kind : the class of the answer, a subclass of the record's.  It gets the docstring of its record, and so the meaning
    of each field.
    """

    @wraps(compute)
    def asked(*args: Asked.args, **kwargs: Asked.kwargs) -> Answer:
        record = compute(*args, **kwargs)
        return kind(**{field.name: getattr(record, field.name) for field in fields(record)})

    kind.__doc__ = getdoc(kind)
    asked.__module__ = kind.__module__  # where pickle looks for it
    return asked
