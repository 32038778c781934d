"""The files that the page offers: the case, its tables, its pictures.

They are written in the process of its own that worker.py is, and handed to the one that serves the page.
"""

import base64
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np

from fctd.app.well import LIMITS, USUAL, Well, load_of
from fctd.case.errors import InputError
from fctd.case.input_file import tables_of
from fctd.case.message import frame_of
from fctd.case.operations import KINDS
from fctd.case.text import file_name
from fctd.plots.loads import ChartLook
from fctd.results.table_files import write_table
from fctd.results.unit_systems import in_field_units, shown
from fctd.store.origin import versions
from fctd.store.tables import to_csv

# What a name of a file is for.
FILES: Final = {
    "case.toml": "case", "chart.csv": "chart as CSV", "chart.xlsx": "chart as workbook",
    "profile.csv": "string as CSV", "chart.png": "chart as picture", "chart.html": "chart as page",
    "view.html": "string in its hole as page",
}  # fmt: skip
VIEWED: Final = 25  # strings of a view


def text(well: Well, values: Mapping[str, object], survey: str | None = None, more: str = "") -> dict[str, str]:
    """The case with the sliders at values, as text.

    survey : another name for its survey, where it has one.  more : operations to add, as lines of a case file.  Raises
    InputError for other tables in them, which might name files of this machine.
    """
    well.moved(values)
    own = {"wellbore.survey": survey} if survey and well.read.source.survey_name else {}
    found = well.read.text(well.overrides(values) | own)
    if not more.strip():
        return {"text": found}
    tables = tables_of(more, "operations")
    if [*tables] != ["operations"]:
        other = next((name for name in tables if name != "operations"), "")
        raise InputError("operations alone, each below a line [[operations]]", key="operations to add", value=other)
    return {"text": f"{found.rstrip()}\n\n{more.strip()}\n"}


def file(
    well: Well, name: str, values: Mapping[str, object], operations: Sequence[str], operation: str, depth: float,
    colour: str, measured: str,
) -> dict[str, str]:  # fmt: skip
    """A file of ``FILES``, as base64, and the name to keep it under; the other arguments are those of ``Well.solved``.

    Raises InputError for another name, and where a package is missing.
    """
    if name not in FILES or operation not in KINDS:
        raise InputError(f"one of {', '.join(FILES)}", key="file", value=name)
    path = well.read.folder / name
    kinds = [kind for kind in KINDS if kind in operations] or [*USUAL]
    at = depth / shown("bit_depth_m", well.units).factor
    try:
        _write(well, path, values, kinds, operation, at, colour, measured, operations)
        content = path.read_bytes()
    except ModuleNotFoundError as error:
        raise InputError(f"the package {error.name} beside fctd", key=name) from None
    finally:
        for left in (path, path.with_name(path.name + ".json")):
            left.unlink(missing_ok=True)
    stem, _, suffix = name.partition(".")
    own = "" if stem == "case" else f"-{stem}"
    return {"name": file_name(well.case.name, f"{own}.{suffix}"), "content": base64.b64encode(content).decode()}


def _write(
    well: Well, path: Path, values: Mapping[str, object], kinds: list[str], operation: str, depth: float, colour: str,
    measured: str, asked: Sequence[str],
) -> None:  # fmt: skip
    case, units, name = well.moved(values), well.units, path.name
    if name == "case.toml":
        path.write_text(text(well, values)["text"], encoding="utf-8")
    elif name == "profile.csv":
        profile = well.profile_at(values, operation, depth)
        to_csv(in_field_units(profile) if units == "field" else profile, path)
    elif name == "view.html":
        from fctd.view.page import save_view

        depths = np.linspace(well.depths[0], well.depths[-1], VIEWED)
        save_view(well.strings_at(values, operation, depths.tolist()), path, colour, units)
    else:
        chart = frame_of(well.chart(values, [*kinds, *asked]))
        if path.suffix in (".csv", ".xlsx"):
            table = in_field_units(chart) if units == "field" else chart
            about: dict[str, Any] = {"case": case.name, "units": units, "versions": versions()}
            write_table(table, path, about)
        else:
            from fctd import plots

            margins = well.margins_of(case, kinds) if LIMITS in asked else None
            look = ChartLook(load_of(asked), measured=well.measured(measured), margins=margins)
            if path.suffix == ".html":
                plots.save_page(plots.chart_page(chart, units, case, look), path)
            else:
                plots.save(plots.chart_figure(chart, units, case, look), path)
