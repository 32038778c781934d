"""A case from a text that anyone may have written, and the survey that came with it; nothing else is opened.

This runs in the process of its own that worker.py is.
"""

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import tomlkit

from fctd.app.sessions import Source
from fctd.case.errors import InputError, naming
from fctd.case.input_file import LARGEST_FILE, tables_of
from fctd.case.input_warnings import InputWarning
from fctd.case.load import Case, make_case
from fctd.case.raw_case import look_up, set_key, split_key
from fctd.case.surveys.stations import MOST_STATIONS as MOST_OF_FILE
from fctd.case.systems import System
from fctd.case.tables.workbook import ZIP, check_workbook
from fctd.case.xml_file import has_doctype
from fctd.model.layouts import segments_in_hole
from fctd.model.new_case import from_survey, read_survey

MOST_UNPACKED: Final = 50 * 2**20  # bytes of a survey's parts
MOST_STATIONS: Final = 50_000
MOST_SEGMENTS: Final = 2_000


class SourceCase:
    """A source that has been read: the raw case with the survey as a file of this process, and the case of it.

    folder : of this process, for the survey.  Raises InputError for a case that cannot be used, and before anything is
    opened where it names another file than the survey beside it.
    """

    def __init__(self, source: Source, folder: Path) -> None:
        self.source, self.folder = source, folder
        if len(source.text) > LARGEST_FILE * 2**20:
            raise InputError(f"a case file of at most {LARGEST_FILE} MiB")
        raw = tables_of(source.text, "a case file")
        self._survey = folder / f"survey{_suffix(source.survey_name)}"
        if check_paths(raw, source.survey_name):
            check_survey(source.survey, self._written)
            self._survey.write_bytes(source.survey)
            raw["wellbore"]["survey"] = str(self._survey)
        self.raw = raw
        self.case = self.changed({})

    def changed(self, overrides: Mapping[str, Any]) -> Case:
        """The case with other values of dotted keys, None where a key is dropped; the survey is read once."""
        raw: dict[str, Any] = _copied(self.raw) if overrides else self.raw
        for key, value in overrides.items():
            set_key(raw, key, value)
        try:
            case = make_case(raw, self.folder, like=getattr(self, "case", None))
            check_size(case)
        except InputError as error:
            raise self.named(error) from None
        return case

    def named(self, error: InputError) -> InputError:
        """An error with the survey's own name in place of that of the copy, and without the case's."""
        of_survey = error.file is not None and Path(error.file) == self._survey
        value = self._written if error.value == str(self._survey) else error.value
        more = [self.named(other) for other in error.more]
        file = self._written if of_survey else None
        return InputError(_here(error.expected), key=error.key, value=value, file=file, more=more)

    @property
    def warnings(self) -> list[InputWarning]:
        """Probable mistakes in the case, with the survey's own name in place of that of the copy."""
        copy = re.compile(rf"{re.escape(self._survey.name)}(?=$|, )")
        return [replace(one, key=copy.sub(lambda _: self._written, one.key, count=1)) for one in self.case.warnings]

    @property
    def _written(self) -> str:
        return Path(self.source.survey_name).name or "survey"

    def text(self, overrides: Mapping[str, Any]) -> str:
        """The text with other values, which keeps its comments."""
        document: Any = tomlkit.parse(self.source.text)
        for key, value in overrides.items():
            *parents, last = split_key(key)
            place: Any = look_up(document, *parents)
            if value is not None:
                set_key(document, key, value)
            elif isinstance(place, dict) and last in place:
                del place[last]
        return tomlkit.dumps(document)


def check_paths(raw: Mapping[str, Any], survey_name: str) -> bool:
    """Whether a raw case names the survey that came with it; raises InputError where it names another file."""
    hole = raw.get("wellbore")
    named = hole.get("survey") if isinstance(hole, dict) else None
    if named is None:
        return False
    if not survey_name or named != survey_name:
        came = f'the file that came is "{survey_name}"' if survey_name else "no survey came"
        expected = f"the name of a survey file that is uploaded with the case, without folders; {came}"
        raise InputError(expected, key="wellbore.survey", value=named)
    return True


def check_survey(content: bytes, name: str) -> None:
    """Raise InputError for a packed file that is too large when unpacked, and for XML with a document type.

    name : of the file, for messages.
    """
    with naming(name):
        if content.startswith(ZIP):
            check_workbook(content, MOST_UNPACKED)
        elif has_doctype(content):
            raise InputError("a survey without a document type (DOCTYPE)")


def check_size(case: Case) -> None:
    """Raise InputError for more stations or segments than the page takes."""
    stations = len(case.wellbore.trajectory)
    if stations > MOST_STATIONS:
        raise InputError(f"at most {MOST_STATIONS} stations, here {stations}")
    segments = segments_in_hole(case, case.deepest)
    if segments > MOST_SEGMENTS:
        raise InputError(f"a string of at most {MOST_SEGMENTS} segments in the hole, here about {segments}")


def from_upload(name: str, survey: bytes, units: System, folder: Path) -> tuple[Source, str]:
    """A case of an uploaded survey, as ``fctd init`` makes it, and what is to be said of the unit of its depths.

    Raises InputError for a file that is no survey.
    """
    check_survey(survey, name)
    path = folder / f"new{_suffix(name)}"
    path.write_bytes(survey)
    try:
        found = read_survey(path, units)
    except InputError as error:
        raise InputError(_here(error.expected), key=error.key, value=error.value, file=name, more=error.more) from None
    if len(found.stations) > MOST_STATIONS:
        raise InputError(f"at most {MOST_STATIONS} stations, here {len(found.stations)}", file=name)
    plan = from_survey(None, Path(name).stem or "my well", units, name, found.keys, found.stations)
    return Source(plan.text(), name, survey), found.note


def _here(expected: str) -> str:
    """What is expected of a survey: the page takes fewer stations than a file may have."""
    return expected if expected != f"at most {MOST_OF_FILE} stations" else f"at most {MOST_STATIONS} stations"


def _suffix(name: str) -> str:
    """What the name of a file says of its kind, where it is one of a survey."""
    suffix = Path(name).suffix.lower()
    return suffix if suffix in (".xlsx", ".xml", ".csv", ".txt") else ".txt"


def _copied(value: Any) -> Any:
    """A copy of nested tables and lists; stations and other leaves are shared."""
    if isinstance(value, dict):
        return {key: _copied(inner) for key, inner in value.items()}
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return [_copied(inner) for inner in value]
    return value
