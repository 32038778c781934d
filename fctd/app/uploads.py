"""Files that come to the page, as a browser sends them: a case, a survey, or both make a case."""

import base64
import binascii
from collections.abc import Mapping
from pathlib import PurePath
from typing import Final

from fctd.app.pool import Pool
from fctd.app.sessions import Source
from fctd.case.errors import InputError
from fctd.case.text import printable
from fctd.results.unit_systems import System

CASE: Final = ".toml"


def content_of(text: str) -> bytes:
    """The content of a file as a browser sends it.  Raises InputError for another text."""
    try:
        return base64.b64decode(text.partition(",")[2], validate=True)
    except (binascii.Error, ValueError):
        raise InputError("a file that can be read") from None


def text_of(content: bytes) -> str:
    """The text of a file.  Raises InputError for one that is no text."""
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = "\0"
    if "\0" in text:
        raise InputError("measured rows as a text in UTF-8, such as a CSV file")
    return text


def source_of(files: Mapping[str, bytes], before: Source | None, pool: Pool, units: System) -> tuple[Source, str]:
    """The case of files that came together: a case with its survey, a survey alone, or the survey that a case lacks.

    With it comes what is to be said of a survey's unit, or "".  before : the case that the page has shown.  Raises
    InputError for files that make none; no name leads to a file.
    """
    cases = {name: content for name, content in files.items() if name.lower().endswith(CASE)}
    surveys = {name: content for name, content in files.items() if name not in cases}
    if len(cases) > 1 or len(surveys) > 1 or not files:
        raise InputError(f"one case ({CASE}), one survey, or one of each", key="upload", value=list(files))
    survey_name, survey = next(iter(surveys.items()), ("", b""))
    if cases:
        name, content = next(iter(cases.items()))
        try:
            text = content.decode("utf-8-sig")
        except UnicodeDecodeError:
            raise InputError("a case file in TOML, a text in UTF-8", key="upload", value=name) from None
        source = Source(text, survey_name, survey)
    elif (
        before is not None
        and not before.survey_name
        and any(f"{quote}{survey_name}{quote}" in before.text for quote in "\"'")  # its case names this survey
    ):
        source = Source(before.text, survey_name, survey)
    else:
        name = PurePath(survey_name.replace("\\", "/")).name or "survey"
        encoded = base64.b64encode(survey).decode()
        made = pool.ask("new_case", name=name, survey=encoded, given_units=units)
        note = f"{name}: {made['note']}" if made["note"] else ""
        return Source(made["text"], name, survey), printable(note)
    pool.ask("open", source, units)  # a case that cannot be used does not take the place of the one before
    return source, ""
