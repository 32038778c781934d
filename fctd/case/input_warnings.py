"""Warnings about input that can be used and is probably not what the user meant."""

from dataclasses import asdict, dataclass
from typing import Any

from fctd.case.message import Message
from fctd.case.systems import System, told
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

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", Message(self.text))
        object.__setattr__(self, "remedy", Message(self.remedy))

    def __str__(self) -> str:
        return self.told("si")

    def told(self, units: System) -> str:
        """The warning in a system of units."""
        return printable(f"{self.key}: {told(self.text, units)}: {told(self.remedy, units)}")

    def as_metadata(self) -> dict[str, Any]:
        """The warning as metadata of a file have it."""
        return asdict(self)
