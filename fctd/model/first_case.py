"""A case to start from, made from Python: what ``fctd init`` writes."""

import json
import os
import warnings
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, get_args

import numpy as np

from fctd.case.errors import InputError, known_keys, naming, nearest
from fctd.case.from_python import is_frame, stations_of
from fctd.case.input_file import tables_of
from fctd.case.load import Case, load_case
from fctd.case.raw_case import checked, look_up, split_key
from fctd.case.surveys.form import ColumnSpec
from fctd.case.surveys.stations import StationKey, check_listed
from fctd.case.systems import SYSTEMS, System
from fctd.case.tables.headers import Choice
from fctd.case.text import is_utf8
from fctd.model.from_files import Files, refuse_blanks, with_files
from fctd.model.new_case import Plan, from_survey, from_template, read_survey
from fctd.model.templates import TEMPLATES

PathLike = str | os.PathLike[str]


def new_case(
    survey: Any = None,
    template: str | None = None,
    units: System = "si",
    *,
    columns: Mapping[str, Any] | None = None,
    sheet: str | None = None,
    string: PathLike | None = None,
    hole: PathLike | None = None,
    string_name: str | None = None,
    hole_name: str | None = None,
    name: str = "my well",
    out: PathLike | None = None,
) -> Case:
    """A case that runs, of your survey with a template's string, or of a template's own well; change what differs.

    survey : path of a survey file, or a DataFrame as of ``load_case``.  template : by default "build-hold", or
    "horizontal" for a survey beyond 70°.  units : "si" or "field", in which the case is written.  columns, sheet : of
    the file, as the keys wellbore.columns and wellbore.sheet.  string, hole : WITSML files, a tubular and a wbGeometry,
    in place of the template's; string_name, hole_name : name or uid of one of several objects there.  out : a file that
    the case is written into, with comments; without one it is only in memory.  Raises InputError for what cannot be
    used, and, after the file is written, for keys that string and hole leave blank.
    """
    if units not in SYSTEMS:
        raise InputError('"si" or "field"', key="units", value=units)
    if template is not None and template not in TEMPLATES:
        raise InputError(nearest(template, TEMPLATES, "template"), key="template", value=template)
    files = Files(_path(string, "string"), _path(hole, "hole"), string_name, hole_name)
    target = None if out is None else Path(out)
    plan = _plan(survey, template, units, columns or {}, sheet, name, target, files)
    for of, doubt in plan.given.doubts:
        warnings.warn(f"{of}: {doubt}", stacklevel=2)
    if out is None:
        refuse_blanks(plan.given.blanks, None)
        return load_case(tables_of(plan.text(), "a case"))
    try:
        with Path(out).open("x", encoding="utf-8") as file:
            file.write(plan.text())
    except OSError as error:
        raise InputError(f"a new file that can be written ({error.strerror})", key="out", value=out) from None
    refuse_blanks(plan.given.blanks, target)
    return load_case(out)


def _path(file: object, argument: str) -> Path | None:
    if file is not None and not isinstance(file, str | os.PathLike):
        raise InputError("the path of a WITSML file", key=argument, value=file)
    return None if file is None else Path(file)


def _plan(
    survey: Any, template: Any, units: System, columns: Mapping[str, Any], sheet: str | None, name: str,
    out: Path | None, files: Files,
) -> Plan:  # fmt: skip
    if survey is None or is_frame(survey):
        if columns or sheet is not None:
            raise InputError("a survey file beside columns and sheet", key="survey")
        if survey is None:
            if any(files):
                raise InputError("a survey beside string and hole", key="survey")
            return from_template(TEMPLATES[template or "build-hold"], name, units)
        listed = stations_of(survey)
        try:
            stations = check_listed(np.array(listed)).stations
        except InputError as error:
            value = look_up({"stations": listed}, *split_key(error.key))
            raise InputError(error.expected, key=f"wellbore.{error.key}", value=value) from None
        plan = from_survey(template, name, units, "the table", (), stations)
        rows = [f"    {json.dumps(row)}," for row in listed]
        plan = with_files(plan, stations, files)
        return replace(plan, hole=("stations = [                          # [m], [deg], [deg]", *rows, "]"))
    if not isinstance(survey, str | os.PathLike):
        raise InputError("the path of a survey, or a DataFrame", key="survey", value=survey)
    path = Path(survey)
    with naming(path):
        found = read_survey(path, units, _choices(columns), sheet)
    written = Path(os.path.relpath(path, (Path() if out is None else out.parent).absolute())).as_posix()
    if not is_utf8(written):
        raise InputError("a file whose path is UTF-8, as a case file is", key="survey", value=path)
    if found.note:
        warnings.warn(f"{path}: {found.note}", stacklevel=3)
    plan = from_survey(template, name, units, written, found.keys, found.stations)
    return with_files(plan, found.stations, files)


def _choices(columns: Mapping[str, Any]) -> dict[str, Choice]:
    """Headers and units of the columns of a survey."""
    given = {key: {"header": of} if isinstance(of, str) else of for key, of in columns.items()}
    found = {}
    for key, of in known_keys(given, get_args(StationKey)).items():
        try:
            spec = checked(ColumnSpec, of)
        except InputError as error:
            raise error.at(f"columns.{key}") from None
        found[key] = Choice(spec.header, spec.unit)
    return found
