"""Warnings about input that can be used and is probably not what the user meant."""

from dataclasses import asdict, dataclass
from typing import Any

from fctd.case.text import printable


@dataclass(frozen=True)
class InputWarning:
    """A probable mistake in the input.

    code : its kind, such as "no_mud", the same whatever the numbers are; key : dotted key, or rows of a survey file,
    such as "rows 4 to 9"; text : what is found there, a sentence without its full stop; remedy : what to do about it.
    """

    code: str
    key: str
    text: str
    remedy: str

    def __str__(self) -> str:
        return printable(f"{self.key}: {self.text}: {self.remedy}")

    def as_metadata(self) -> dict[str, Any]:
        """The warning as metadata of a file have it."""
        return asdict(self)
