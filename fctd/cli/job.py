"""What commands on a case have in common: they read it, warn, compute under a bar, write, print and end.

Options that several of them have stand here too, and the one table that a screen has.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final, Union, cast

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Column
from rich.table import Table as Grid

from fctd.case.doubts import warnings_of
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.systems import told
from fctd.case.text import printable
from fctd.cli.options import changes_of, finish, messages, print_written, read_case, refuse_sources, screen, tell
from fctd.cli.pictures import PICTURES, TABLES, File, check_files
from fctd.cli.quantities import DEPTHS, Given, quantity
from fctd.cli.steady import DEPTHS_HELP, in_units, metadata_of, metadata_of_case
from fctd.model.operations import rates_of_all
from fctd.results.differences import in_a_row
from fctd.results.doing import told_of
from fctd.results.notes import meanings_of
from fctd.results.shown_tables import Cell, Head, Table, short
from fctd.results.table_files import write_table
from fctd.results.unit_systems import System, in_words, shown
from fctd.store.tables import Rows

if TYPE_CHECKING:
    import pandas as pd

Show = Callable[..., None]
Row = dict[str, Any]
Looks = Mapping[str, Mapping[str, Any]]  # options of rich for columns by the words of their heads
# Options of rich for columns.
FOLD: Final = {"overflow": "fold"}
WHOLE: Final = {"no_wrap": True}
# A table, or what writes to a path and returns the files; None of a file without content.
Written = Union["pd.DataFrame", Rows, Callable[[Path], list[Path]], None]


def depths_option(example: str) -> Any:
    """The option of bit depths of a command that takes one depth too."""
    return quantity(DEPTHS, "D or FROM:TO:STEP", f"{DEPTHS_HELP} Or one depth, such as {example}.")


Depths = Annotated[Given, depths_option("shoe")]


class Job:
    """A case, or several by name, and what a command does with it.

    source : the file of a case, or what was read already.  overrides, friction, resolve : as of ``changes_of``.  out is
    a picture where its suffix is that of one, and the command ``draws``.  files : further files by option, with their
    suffixes.  reads : files beside the case that the command reads, and must not write over.  silent : a quiet command
    prints no results.  Raises InputError, before anything is computed, for files that cannot be written.
    """

    def __init__(
        self, source: Path | Case | Mapping[str, Case], overrides: Sequence[str] = (), friction: str | None = None,
        resolve: bool | None = None, *, units: System, strict: bool = False, quiet: bool, out: Path | None = None,
        plot: Path | None = None, draws: bool = False, silent: bool = False, files: Mapping[str, File] = {},
        reads: Iterable[Path | None] = (),
    ) -> None:  # fmt: skip
        drawn = draws and out is not None and out.suffix.lower() in PICTURES
        if drawn and plot is not None:
            raise InputError(f"a table, {' or '.join(TABLES)}, beside the picture of --plot", key="--out", value=out)
        table = {"--out": (out, (*TABLES, *PICTURES) if draws else TABLES), "--plot": (plot, PICTURES)}
        check_files(wanted := {**table, **files})
        self.changes = changes_of(overrides, friction, resolve)
        if isinstance(source, Path):
            source = read_case(source, self.changes)
        self.cases = {source.name: source} if isinstance(source, Case) else dict(source)
        self.case = next(iter(self.cases.values()))
        self.paths = {key: path for key, (path, _) in wanted.items()}
        for case in self.cases.values():
            for key, path in self.paths.items():
                refuse_sources(case, path, key, reads)
        if drawn:
            self.paths |= {"--out": None, "--plot": out}
        self.units, self.strict, self.quiet, self.silent = units, strict, quiet, silent and quiet

    def warn(self, *asked: Any, **options: Any) -> None:
        """Print what is probably not meant, of a file once; the arguments are those of ``warnings_of``."""
        self.warnings = {name: warnings_of(case, *asked, **options) for name, case in self.cases.items()}
        known: set[tuple[Path | None, str]] = set()
        owners: dict[str, list[str]] = {}
        for name, case in self.cases.items():
            found = self.warnings[name]
            new = [warning for warning in found if (case.file, str(warning)) not in known]
            tell(case, new, strict=self.strict, units=self.units)
            known.update((case.file, str(warning)) for warning in found)
            for text in dict.fromkeys(warning.told(self.units) for warning in found):
                owners.setdefault(text, []).append(name)
        every = len(self.cases)
        self.told = [text if len(of) == every else f"{text} ({in_a_row(of)})" for text, of in owners.items()]

    @property
    def lines(self) -> list[str]:
        """The warnings as lines of a picture."""
        return [f"warning {text}" for text in self.told]

    @contextmanager
    def bar(self, first: str | None = None) -> Iterator[Show]:
        """A bar of rows, and what moves it; first : what it says first; default: the name of the case.

        What moves it takes what it says from then on, if that changes, the rows that are done, and all of them.
        """
        columns = TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn()
        with Progress(*columns, console=messages, disable=self.quiet, transient=True) as bar:
            task = bar.add_task(printable(first or self.case.name), total=None)

            def show(*of: Any) -> None:
                *what, done, total = of
                bar.update(task, completed=done, total=total, description=printable(what[0]) if what else None)

            yield show

    @contextmanager
    def status(self, doing: str) -> Iterator[Callable[[str], None]]:
        """What is being done, on a terminal, and what changes the words."""
        with messages.status(doing) as status:
            if self.quiet:
                status.stop()
            yield status.update

    def _about(self, rates: tuple[Sequence[str], Row] | None, more: Row) -> Row:
        """Metadata of a table."""
        of: dict[str, Row] = {}
        for name, case in self.cases.items():
            if rates is None:
                of[name] = metadata_of_case(case, self.warnings[name]) | {"units": self.units}
            else:
                of[name] = metadata_of(case, self.units, *rates, self.warnings[name])
        return of[self.case.name] | more if len(of) == 1 else {"units": self.units, **more, "cases": of}

    def end(
        self, files: Mapping[str, Written], show: Callable[[], None], *, title: str | None = None,
        rates: tuple[Sequence[str], Row] | None = None, more: Row | None = None, notes: Iterable[str] | None = None,
        then: Callable[[], object] = lambda: None, acceptable: bool = True, codes: Iterable[str] = (),
    ) -> None:  # fmt: skip
        """Write files, print, and end the command.

        files : by option, a table or what writes to a path.  title : above what is printed; default: the case's name.
        rates : operations and their drive, of which tables tell, and a line above them; more : metadata.  notes :
        cells of codes, whose meanings tables have too; codes : of other notes.  then : called once all is written.
        """
        meanings = {} if notes is None else meanings_of(notes)
        about = (more or {}) | ({} if notes is None else {"notes": meanings})
        written: list[Path] = []
        try:  # written before anything is printed, as the terminal may be closed; printed also where writing fails
            for key, content in files.items():
                if (path := self.paths[key]) is None or content is None:
                    continue
                if callable(content):
                    written += content(path)
                else:
                    written += write_table(in_units(self.units, content), path, self._about(rates, about))
            then()
        finally:
            if not self.silent:
                if title is None or title:
                    screen.print(printable(title or self.case.name), style="bold", soft_wrap=True)
                if rates is not None:
                    self._say_doing(*rates)
                show()
        if not self.silent:
            print_written(written)
        finish(acceptable, [*codes, *meanings], self.strict)

    def say(self, *lines: str) -> None:
        """Print lines."""
        for line in lines:
            screen.print(line, soft_wrap=True)

    def _say_doing(self, kinds: Sequence[str], drive: Row) -> None:
        """Print what the strings of a table do: once where it is the same in all cases, else for each.

        kinds, drive : operations, and their speed, rpm and flow where they are given.
        """
        lines = {
            name: told_of(case, rates_of_all(case, kinds, **drive), self.units) for name, case in self.cases.items()
        }
        if len({tuple(of) for of in lines.values()}) == 1:
            lines = {"": next(iter(lines.values()))}
        for name, of in lines.items():
            self.say(*(f"{printable(name)}: {line}" if name else line for line in of))

    def words(self, row: Row, column: str) -> str:
        """A number of a row with its unit."""
        return in_words(row[column], column, self.units)

    def depth(self, depth: float) -> str:
        """A bit depth [m] with its unit, to a tenth."""
        unit = shown("bit_depth_m", self.units)
        return f"{depth * unit.factor:.1f} {unit.label}"

    def depths_in_words(self, table: "pd.DataFrame", column: str = "bit_depth_m") -> str:
        """The different depths of a table."""
        unit = shown(column, self.units)
        return f"{', '.join(f'{depth * unit.factor:.0f}' for depth in table[column].unique())} {unit.label}"

    def say_reasons(self, table: "pd.DataFrame") -> None:
        """Print why rows have no numbers."""
        for _, of in table[table["reason"] != "none"].groupby("reason", sort=False):
            self.say(f"at {self.depths_in_words(of)}: {told(of['reason'].iloc[0], self.units)}")


def rows_of(table: "pd.DataFrame", most: int = 0, also: Iterable[int] = ()) -> list[Row]:
    """The rows of a table by column; of many, ``most`` at even distances from the last, and the ``also``."""
    rows = cast("list[Row]", table.to_dict("records"))
    if not most:
        return rows
    ends = np.linspace(len(rows) - 1, 0, min(most, len(rows))).round().astype(int)
    return [rows[k] for k in np.unique([*ends, *also])]


def right(*heads: str) -> list[Head]:
    """Heads of numbers, whose units stand on lines of their own."""
    return [Head(*head.partition("\n")[::2], numbers=True) for head in heads]


def headed(columns: Mapping[str, str], units: System) -> list[Head]:
    """Heads of numbers by the names of their columns, with words and units."""
    return [Head(words, shown(name, units).label, numbers=True) for name, words in columns.items()]


def numbers(row: Row, columns: Iterable[str], units: System) -> list[Cell]:
    """The numbers of a row in the units of the screen, in four digits; nothing for NaN."""
    return [short(row.get(name, np.nan) * shown(name, units).factor, none="") for name in columns]


def print_table(
    table: Table, looks: Mapping[str, Mapping[str, Any]] = {}, *, words: Mapping[str, Any] = {},
    numbers: Mapping[str, Any] = {}, **options: Any,
) -> None:  # fmt: skip
    """Print a table, the unit of a head below its words.

    looks : options of rich for columns by the words of their heads; words, numbers : for the other columns of texts and
    of numbers; options : of the table, in place of the usual ones.
    """
    heads = [Head(head) if isinstance(head, str) else head for head in table.heads]
    columns = (
        Column(
            "\n".join(filter(None, (head.words, head.unit))),
            justify="right" if right else "left",
            **looks.get(head.words, numbers if right else words),
        )
        for head, right in zip(heads, table.numeric, strict=True)
    )
    drawn = Grid(*columns, **{"box": SIMPLE_HEAD, "collapse_padding": True, "pad_edge": False, **options})
    for k, row in enumerate(table.rows):
        drawn.add_row(*(cell.text for cell in row), style="strike" if k in table.struck else None)
    screen.print(drawn)


def print_facts(table: Table, **options: Any) -> None:
    """Print a table of facts, if it has any; their values stand to the right; options : as of ``print_table``."""
    heads = Head(""), Head("", "", True), Head("")
    if table.rows:
        print_table(replace(table, heads=heads), show_header=False, collapse_padding=False, **options)
