"""What commands on a case have in common: they read it, warn, compute under a bar, write, print and end.

Options that several of them have stand here too, and the one table that a screen has.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, cast

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.table import Column, Table

from fctd.case.doubts import warnings_of
from fctd.case.load import Case
from fctd.case.message import told
from fctd.case.text import printable
from fctd.cli.chart import DEPTHS_HELP
from fctd.cli.options import changes_of, finish, print_written, read_case, refuse_sources, screen, tell
from fctd.cli.pictures import draw_panels
from fctd.cli.quantities import DEPTHS, Given, quantity
from fctd.cli.steady import check_table, check_targets, in_units, metadata_of, metadata_of_case, row_bar
from fctd.results.table_files import write_table
from fctd.results.unit_systems import System, in_words, shown

if TYPE_CHECKING:
    import pandas as pd

    from fctd.plots.depth_panels import Panels

Show = Callable[[int, int], None]
Row = dict[str, Any]


def depths_option(example: str) -> Any:
    """The option of bit depths of a command that takes one depth too."""
    return quantity(DEPTHS, "D or FROM:TO:STEP", f"{DEPTHS_HELP} Or one depth, such as {example}.")


Depths = Annotated[Given, depths_option("shoe")]


class Job:
    """A case, and what a command does with it.

    tables : files of tables by option; out is a picture where its suffix is that of one, and the command draws.
    """

    def __init__(
        self, case_file: Path, overrides: Sequence[str], friction: str | None = None, *, units: System, strict: bool,
        quiet: bool, out: Path | None, plot: Path | None = None, draws: bool = False, silent: bool = False,
        tables: Mapping[str, Path | None] = {},
    ) -> None:  # fmt: skip
        if draws:
            table, self.plot = check_targets(out, plot, {})
        else:
            check_table(out)
            table, self.plot = out, None
        for path in tables.values():
            check_targets(path, None, {})
        self.case: Case = read_case(case_file, changes_of(overrides, friction))
        for key, path in {"--out": out, **tables, "--plot": plot}.items():
            refuse_sources(self.case, path, key)
        self.tables = {"--out": table, **tables}
        self.units, self.strict, self.quiet, self.silent = units, strict, quiet, silent and quiet

    def warn(self, *asked: Any, **options: Any) -> None:
        """Print what is probably not meant; the arguments are those of ``warnings_of``."""
        self.warnings = warnings_of(self.case, *asked, **options)
        self.told = [f"warning {text}" for text in tell(self.case, self.warnings, strict=self.strict, units=self.units)]

    @contextmanager
    def bar(self) -> Iterator[Show]:
        """A bar of rows, and what moves it."""
        with row_bar(self.quiet) as bar:
            task = bar.add_task(printable(self.case.name), total=None)
            yield lambda done, total: bar.update(task, completed=done, total=total)

    def end(
        self, tables: Mapping[str, "pd.DataFrame | None"], show: Callable[[], None],
        draw: Callable[[list[str]], "Panels"] | None = None, *, rates: tuple[Sequence[str], Row] | None = None,
        more: Row | None = None, acceptable: bool = True, codes: Iterable[str] = (),
    ) -> None:  # fmt: skip
        """Write tables and picture, print, and end the command.

        rates : operations and their drive, of which tables tell; more : metadata; codes : of notes.
        """
        if rates is None:
            metadata = metadata_of_case(self.case, self.warnings) | {"units": self.units}
        else:
            metadata = metadata_of(self.case, self.units, *rates, self.warnings)
        written: list[Path] = []
        try:  # written before anything is printed, as the terminal may be closed
            for key, table in tables.items():
                if (path := self.tables[key]) is not None and table is not None:
                    written += write_table(in_units(self.units, table), path, metadata | (more or {}))
            if self.plot is not None and draw is not None:
                written += draw_panels(self.plot, draw(self.told))
        finally:
            if not self.silent:
                screen.print(printable(self.case.name), style="bold", soft_wrap=True)
                show()
        if not self.silent:
            print_written(written)
        finish(acceptable, codes, self.strict)

    def say(self, *lines: str) -> None:
        """Print lines."""
        for line in lines:
            screen.print(line, soft_wrap=True)

    def words(self, row: Row, column: str) -> str:
        """A number of a row with its unit."""
        return in_words(row[column], column, self.units)

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


def grid(*columns: Column) -> Table:
    """An empty table of a screen."""
    return Table(*columns, box=SIMPLE_HEAD, collapse_padding=True, pad_edge=False)


def right(*heads: str, no_wrap: bool = False) -> list[Column]:
    """Columns of numbers."""
    return [Column(head, justify="right", no_wrap=no_wrap) for head in heads]


def headed(columns: Mapping[str, str], units: System, **options: bool) -> list[Column]:
    """Columns of numbers by their names, with words and units."""
    return right(*(f"{words}\n{shown(name, units).label}" for name, words in columns.items()), **options)


def number(value: float) -> str:
    """A number in four digits; nothing for NaN."""
    return "" if np.isnan(value) else f"{value:.0f}" if abs(value) >= 1000 else f"{value:z.4g}"


def numbers(row: Row, columns: Iterable[str], units: System) -> list[str]:
    """The numbers of a row in the units of the screen."""
    return [number(row.get(name, np.nan) * shown(name, units).factor) for name in columns]
