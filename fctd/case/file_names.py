"""Names of files in a case."""

from pathlib import Path
from typing import Annotated

from pydantic import BeforeValidator

from fctd.case.text import is_utf8


def _as_path(raw: object) -> object:
    """A file name as a path; pydantic would refuse a string that is not UTF-8, which a file name may be."""
    return Path(raw) if isinstance(raw, str) and not is_utf8(raw) else raw


FileName = Annotated[Path, BeforeValidator(_as_path)]
