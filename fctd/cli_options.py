"""What the commands share: options, exit codes, the screen, and values and files checked before any computing."""

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from fctd.case import Case, load_case, parse_override
from fctd.errors import InputError
from fctd.notes import Note
from fctd.units import Dimension, Quantity

DONE, FAILED, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130

# Results go to standard output; progress and errors to standard error, so that neither spoils the other.
screen, messages = Console(), Console(stderr=True)

CaseFile = Annotated[Path, typer.Argument(help="Case file (TOML).", show_default=False)]
Overrides = Annotated[
    list[str],
    typer.Option("--set", metavar="KEY=VALUE", help="Override a key of the case, e.g. wellbore.overlap='0.1 m'."),
]
Friction = Annotated[float | None, typer.Option("--friction", metavar="X", help="Friction factor of every interval.")]
Out = Annotated[
    Path | None, typer.Option("--out", metavar="FOLDER", help="Where results go; default: CASE-NAME-result.")
]
Csv = Annotated[bool, typer.Option("--csv", help="Write CSV files beside the Parquet ones.")]
Quiet = Annotated[bool, typer.Option("--quiet", help="No progress bar.")]


def read_case(path: Path, overrides: Sequence[str], friction: float | None = None) -> Case:
    """The case of a file after ``--set`` and ``--friction``."""
    changes: dict[str, Any] = dict(parse_override(text) for text in overrides)
    if friction is not None:
        changes["friction"] = friction
    return load_case(path, changes)


def print_notes(notes: Iterable[Note]) -> None:
    """Print notes, a line each."""
    for note in notes:
        messages.print(f"note: {note}", highlight=False, markup=False, soft_wrap=True)


def read_quantity(text: str, dimension: Dimension, key: str) -> float:
    """A quantity of at least 0 as a case file has it, "1750" or "1750 m", in SI; InputError names the option."""
    try:
        value: object = float(text)
    except ValueError:
        value = text
    try:
        return Quantity(dimension=dimension, at_least=0.0).parse(value)
    except InputError as error:
        raise InputError(error.expected, key=key, value=text) from None


def read_share(text: str, key: str) -> float:
    """A share above 0 and below 1, "1%", "1 %" or "0.01"; InputError names the option."""
    number, percent = text.strip(), 1.0
    if number.endswith("%"):
        number, percent = number[:-1], 0.01
    try:
        share = float(number) * percent
    except ValueError:
        share = float("nan")
    if not 0 < share < 1:
        raise InputError("a share above 0 and below 100 %, such as '1%' or 0.01", key=key, value=text)
    return share


def check_target(path: Path | None, key: str, suffixes: Sequence[str]) -> None:
    """Refuse a file of another suffix, and one that could not be written: before the computing, not after."""
    if path is None:
        return
    if path.suffix.lower() not in suffixes:
        raise InputError(f"a file name that ends in {' or '.join(suffixes)}", key=key, value=path)
    try:
        folder = next(parent for parent in path.absolute().parents if parent.exists())
        taken = path.is_dir() or not folder.is_dir()
        places = [folder, path] if path.exists() else [folder]
        writable = not taken and all(os.access(place, os.W_OK) for place in places)
    except OSError:  # a name too long for the file system
        writable = False
    if not writable:
        raise InputError("a file that can be written", key=key, value=path)


def spare_sources(case: Case, path: Path | None, key: str) -> None:
    """Refuse to write over the case file or its survey."""
    for source in (case.file, case.wellbore.survey):
        if path is not None and source is not None and path.exists() and path.samefile(source):
            raise InputError("another file than the case and its survey", key=key, value=path)
