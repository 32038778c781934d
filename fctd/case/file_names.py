"""Names of files in a case."""

import os
import re
from pathlib import Path
from typing import Annotated

from pydantic import BeforeValidator, ValidationInfo

from fctd.case.errors import InputError
from fctd.case.text import is_utf8


def _as_path(raw: object) -> object:
    """A file name as a path; pydantic would refuse a string that is not UTF-8, which a file name may be."""
    return Path(raw) if isinstance(raw, str) and not is_utf8(raw) else raw


FileName = Annotated[Path, BeforeValidator(_as_path)]


def beside_case(file: Path | None, info: ValidationInfo, what: str) -> Path | None:
    """A file relative to the folder of the case file while one is loaded; InputError where there is none.

    what : it is, in messages.
    """
    if file is None or info.context is None:
        return file
    path: Path = info.context["folder"] / file
    if not os.path.exists(path):  # Path.exists raises on names too long for the file system
        escaped = re.search(r"[\a\b\t\n\f\r\x1b]", str(file))  # "D:\temp": the text holds a tab
        hint = ": a backslash in double quotes stands for another sign, write / or put single quotes" if escaped else ""
        raise InputError(f"{what} that exists, looked for {path}{hint}")
    return path
