"""How the commands refuse input: messages name the options, and give quantities in the units asked for."""

from collections.abc import Callable, Mapping
from functools import wraps
from typing import ParamSpec, TypeVar

from fctd.case.errors import InputError
from fctd.case.systems import told
from fctd.results.unit_systems import System

P = ParamSpec("P")
R = TypeVar("R")

# Arguments of the library's functions that are options of the commands.
_NAMES = "operation", "speed", "rpm", "flow", "friction", "tolerance", "most", "segments"
OPTIONS = {name: f"--{name}" for name in _NAMES}


def naming_options(command: Callable[P, R], others: Mapping[str, str] | None = None) -> Callable[P, R]:
    """The command, whose refusals name options in place of the arguments of the library's functions.

    others : further arguments and their options, whose values come from the program and lie in the case's hole.
    """

    @wraps(command)
    def told(*given: P.args, **options: P.kwargs) -> R:
        units: System = "field" if options.get("units") == "field" else "si"
        try:
            return command(*given, **options)
        except InputError as error:
            raise _told(error, others or {}, units) from error.__cause__

    return told


def _told(error: InputError, others: Mapping[str, str], units: System) -> InputError:
    """The error with the option as its key, without the case file where that does not matter, and in the units."""
    key = OPTIONS.get(error.key) or others.get(error.key) or error.key
    value = told(error.value, units) if error.key in others and isinstance(error.value, str) else error.value
    return InputError(
        told(error.expected, units), key=key, value=value, file=None if error.key in OPTIONS else error.file,
        more=[_told(other, others, units) for other in error.more], lines=error.lines,
    )  # fmt: skip
