"""Options, exit codes and consoles of the commands, and checks of values and files before any computing."""

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.text import Text

from fctd.case.errors import InputError
from fctd.case.friction import parse_frictions
from fctd.case.input_warnings import InputWarning
from fctd.case.load import Case, load_case, read_raw
from fctd.case.raw_case import parse_override
from fctd.case.systems import system_named, told
from fctd.case.text import printable, printable_lines
from fctd.results.notes import Note
from fctd.results.tables import open_result, own_files
from fctd.results.unit_systems import System
from fctd.store.run_folder import about_of
from fctd.store.tables import table_files
from fctd.store.whole_file import check_file
from fctd.store.whole_folder import repair

USUAL_WIDTH = 80  # columns of a terminal
DONE, FAILED, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130


class Terminal(Console):
    """A console that prints strings literally: no markup, no emoji codes, escapes for characters that do not print.

    Line ends are kept, so a user's text that must stay on one line passes `printable` first.
    """

    def __init__(self, *, stderr: bool = False) -> None:
        super().__init__(stderr=stderr, markup=False, emoji=False, highlight=False)

    def render_str(self, text: str, **options: Any) -> Text:
        """The string as rich lays it out; rich calls this for strings, also those in tables."""
        shown = printable_lines(text).encode(self.encoding, errors="backslashreplace")  # before columns get their width
        return super().render_str(shown.decode(self.encoding), **options)

    @property
    def keeps_numbers(self) -> bool:
        """Whether columns of numbers keep their width beside texts, which wrap; a narrow screen folds all of them."""
        return self.width >= USUAL_WIDTH


# Results go to standard output, progress and errors to standard error, so that each can be redirected.
screen, messages = Terminal(), Terminal(stderr=True)


def _system(text: str) -> System:
    """The system of units that a word of an option is of; metric units are those of SI."""
    try:
        return system_named(text)
    except InputError as error:
        raise typer.BadParameter(f"{text!r}: expected {error.expected}") from None


def units_option(what: str, default: str = "the case's units, else si") -> typer.models.OptionInfo:
    """The option ``--units`` of a command; default : in words."""
    info: typer.models.OptionInfo = typer.Option(
        "--units", metavar="si|field", parser=_system, help=f"{what}; default: {default}.", show_default=False
    )
    return info


Units = Annotated[
    System,
    units_option("Units of tables, pictures and screen, and of bare depths and speeds of options"),
]


def units_of_case(options: Mapping[str, Any]) -> System:
    """The system of units that the case of a command names, or all of its cases, valid or not; else SI.

    options : of the command, by the names of its arguments.
    """
    cases = [of for of in options.get("sources") or () if Path(of).exists()]  # others are keys that differ
    files = cases or [options.get(of) for of in ("case_file", "source", "resume", "sweep_file")]
    named = {_named(Path(file), options.get("overrides", ())) for file in files if file}
    return named.pop() if len(named) == 1 else "si"


def _named(path: Path, overrides: Sequence[str]) -> System:
    """The system of units of a case file, a sweep file, a result or an unfinished one."""
    tables: Mapping[str, Any] = {}
    with suppress(InputError):
        if (begun := about_of(path)) is not None:
            tables = begun["options"]
        elif path.is_dir():
            tables = {"units": open_result(path).case.units}
        else:
            raw = read_raw(path)
            case, changes = raw.get("case", raw), {**raw.get("set", {}), **dict(map(parse_override, overrides))}
            tables = {**(read_raw(path.parent / case) if isinstance(case, str) else case), **changes}
        return system_named(tables.get("units"))
    return "si"


CaseFile = Annotated[Path, typer.Argument(help="Case file (TOML).", show_default=False)]
Overrides = Annotated[
    list[str],
    typer.Option("--set", metavar="KEY=VALUE", help="Override a key of the case, e.g. wellbore.overlap='0.1 m'."),
]
Friction = Annotated[
    str | None,
    typer.Option(
        "--friction", metavar="X", help="Friction factor of every interval, 0.25, or by kind, cased=0.2,open=0.3."
    ),
]
Out = Annotated[
    Path | None, typer.Option("--out", metavar="FOLDER", help="Folder for the results; default: CASE-NAME-result.")
]
Csv = Annotated[bool, typer.Option("--csv", help="Write CSV files beside the Parquet ones.")]
Strict = Annotated[
    bool,
    typer.Option(
        "--strict",
        help="Exit code 1 where the case has a warning, before computing, and where the result has a note; results "
        "with notes are still written.",
    ),
]
Quiet = Annotated[bool, typer.Option("--quiet", help="No progress bar.")]


def changes_of(overrides: Sequence[str], friction: str | None = None, resolve: bool | None = None) -> dict[str, Any]:
    """Keys and values of ``--set``, ``--friction`` and ``--resolve-buckling``, as ``load_case`` takes them."""
    changes: dict[str, Any] = dict(map(_override, overrides))
    if friction is not None:
        sets = parse_frictions([friction], "--friction")
        if len(sets) > 1:
            raise InputError("one set of friction factors (fctd chart takes several)", key="--friction", value=friction)
        changes["friction"] = sets[0].override
    if resolve is not None:
        changes["solver.buckling"] = "resolve" if resolve else "detect"
    return changes


def _override(text: str) -> tuple[str, Any]:
    try:
        return parse_override(text)
    except InputError as error:
        raise (error if error.key else error.at("--set")) from None


def read_case(path: Path, changes: Mapping[str, Any]) -> Case:
    """The case of a file with changes."""
    repair(path.parent, own_files)  # a killed ``simulate`` may have left the case file in a renamed folder
    return load_case(path, changes)


def tell(case: Case, warnings: Sequence[InputWarning], *, strict: bool, units: System = "si") -> list[str]:
    """Print probable mistakes of the input, a line each; with ``strict`` end the command with exit code 1.

    Returns their texts, for pictures.
    """
    lines = [warning.told(units) for warning in warnings]
    for text in lines:
        messages.print(f"warning: {printable(str(case.file))}: {text}", soft_wrap=True)
    if strict and warnings:
        codes = ", ".join(sorted({warning.code for warning in warnings}))
        messages.print(f"strict: warnings are errors ({codes}); nothing is computed", soft_wrap=True)
        raise typer.Exit(FAILED)
    return lines


def warn(path: Path, text: str) -> None:
    """Print what was assumed of a file."""
    messages.print(f"warning: {printable(str(path))}: {printable(text)}", soft_wrap=True)


def finish(acceptable: bool, codes: Iterable[str], strict: bool) -> None:
    """End a command with exit code 1 where its status is not acceptable, or where ``strict`` finds a note's code."""
    found = sorted(set(codes)) if strict else []
    if found:
        messages.print(f"strict: notes are errors ({', '.join(found)})", soft_wrap=True)
    if found or not acceptable:
        raise typer.Exit(FAILED)


def print_notes(notes: Iterable[Note], units: System = "si") -> None:
    """Print notes, a line each."""
    for note in notes:
        messages.print(f"note: {note.told(units)}", soft_wrap=True)


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
    """Raise InputError for a file of another suffix, and for one that cannot be written."""
    if path is None:
        return
    if path.suffix.lower() not in suffixes:
        raise InputError(f"a file name that ends in {' or '.join(suffixes)}", key=key, value=path)
    for file in table_files(path):
        check_file(file, key)


def refuse_sources(case: Case, path: Path | None, key: str, others: Iterable[Path | None] = ()) -> None:
    """Raise InputError where a table, or its metadata file, would replace a file that the command reads.

    others : files beside the case file and its survey.
    """
    if path is not None:
        refuse_source_files(case, table_files(path), key, others)


def refuse_source_files(case: Case, paths: Iterable[Path], key: str, others: Iterable[Path | None] = ()) -> None:
    """Raise InputError where one of the files is the case file, its survey, or one of the others that are read."""
    read = [other for other in others if other is not None and other.exists()]
    for path in paths:
        caliper = case.wellbore.caliper
        for source in (case.file, case.wellbore.survey, None if caliper is None else caliper.log):
            if source is not None and path.exists() and path.samefile(source):
                raise InputError("another file than the case, its survey and its caliper", key=key, value=path)
        for other in read:
            if path.exists() and path.samefile(other):
                raise InputError(f"another file than {other}, which this command reads", key=key, value=path)


def print_status(status: str, message: str, units: System = "si") -> None:
    """Print how a computation ended and why, on standard error."""
    text = printable(told(message, units))
    messages.print(Text.assemble((status, "bold"), f": {text}"), soft_wrap=True)


def print_written(paths: Sequence[Path]) -> None:
    """Print the files that were written, if any, on one line."""
    if paths:
        screen.print(f"Written: {', '.join(printable(str(path)) for path in paths)}", soft_wrap=True)
