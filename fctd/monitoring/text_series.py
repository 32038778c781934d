"""Series in text files of columns, whole or growing."""

from pathlib import Path
from typing import Final

import pandas as pd

from fctd.case.errors import InputError
from fctd.case.input_file import decode
from fctd.case.tables.headers import Choices
from fctd.case.tables.text import Layout, find_layout
from fctd.monitoring.quantities import SERIES
from fctd.monitoring.rows import Converter

KINDS: Final = "a series: text in columns, Parquet, LAS or a WITSML log (XML)"


def read_text(text: str, choices: Choices) -> pd.DataFrame:
    """The rows [SI] of a whole text."""
    layout, converter = find_layout(text, SERIES, choices), Converter()
    return pd.concat([converter.take(rows) for rows in layout.pieces(text)])


class Tail:
    """The rows of a text file that grows; a last line without its end waits for the rest of it."""

    def __init__(self, path: Path, choices: Choices) -> None:
        self.path, self.choices = path, choices
        self._layout: Layout | None = None
        self._converter = Converter()
        self._read = 0
        self._waiting = b""
        self._number = 1

    def rows(self) -> pd.DataFrame | None:
        """The rows [SI] that have come since the last call; None while there are none."""
        try:
            with self.path.open("rb") as file:
                if self.path.stat().st_size < self._read:
                    raise InputError("a file that grows (it has become shorter)", value=self.path)
                file.seek(self._read)
                new = file.read()
        except OSError as error:
            raise InputError(f"a series that can be read ({error.strerror})", value=self.path) from error
        self._read += len(new)
        whole, end, self._waiting = (self._waiting + new).rpartition(b"\n")
        if not end:
            return None
        lines = decode(whole + end, KINDS)
        if self._layout is None:
            layout = find_layout(lines, SERIES, self.choices) if lines.strip() else None
            if layout is None or next(layout.below(lines), None) is None:  # a row of data tells how times are written
                self._waiting = whole + end + self._waiting
                return None
            self._layout = layout
            rows = layout.below(lines)
        else:
            rows = self._layout.below(lines, self._number)
        self._number += lines.count("\n")
        table = self._converter.take(self._layout.rows(rows))
        return table if len(table) else None
