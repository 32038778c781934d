"""LAS files as tables; the extra `las` brings the package that reads them."""

import io
import logging
import math
import re
from collections import Counter
from itertools import islice
from typing import Final

from fctd.case.errors import InputError
from fctd.case.tables.headers import Choices, TableForm, find_columns, with_units
from fctd.case.tables.rows import Rows

# Lines of the header that are read, characters of one, and lines of one name: lasio takes the square of the first two
# and the cube of the third.  Values of a row beyond the curves become curves of one name.
MOST_LINES: Final = 1000
MOST_CHARACTERS: Final = 1000
MOST_OF_NAME: Final = 10
_SECTION: Final = re.compile(r"^(?=[ \t]*~)", re.MULTILINE)


def read_las(text: str, form: TableForm, choices: Choices) -> Rows:
    """The rows of a LAS file; cells without a value are empty.

    Raises InputError for a text that is no LAS file, for bad curves, for a header that would take minutes, and where
    the package lasio is missing.
    """
    try:
        import lasio
    except ModuleNotFoundError as error:
        raise InputError("the package lasio for LAS files (pip install lasio, or the extra fctd[las])") from error
    text = _lean(text)
    try:
        logging.getLogger("lasio").setLevel(logging.CRITICAL)  # what a file lacks is an error of ours
        las = lasio.read(io.StringIO(text))
    except Exception as error:  # lasio raises errors of many kinds
        raise InputError(f"a LAS file that lasio can read ({error})") from error
    headers, units = [curve.mnemonic for curve in las.curves], [curve.unit for curve in las.curves]
    columns = with_units(find_columns((0, headers), form, choices), [(0, units)], (), form, choices)
    cells = {key: [_text(value) for value in las.curves[column.place].data] for key, column in columns.items()}
    return Rows(columns, range(1, len(las.curves[0].data) + 1), cells)


def _lean(text: str) -> str:
    """The sections that are read: parameters and remarks, which no table needs, are left out.

    Raises InputError for a header that is too large.
    """
    kept, curves, lines = [], 0, 0
    for section in _SECTION.split(text):
        title = section.lstrip().partition("\n")[0].upper()
        if title.startswith(("~P", "~O")):
            continue
        kept.append(section)
        if title.startswith("~A") or "_DATA" in title:
            _check_rows(section, curves)
            continue
        lines += section.count("\n")
        if lines > MOST_LINES:
            raise InputError(f"a LAS file with at most {MOST_LINES:,} lines of header, parameters and remarks aside")
        found = section.split("\n")
        if max(map(len, found)) > MOST_CHARACTERS:
            raise InputError(f"a LAS file with lines of header of at most {MOST_CHARACTERS:,} characters")
        items = [line for line in map(str.strip, found[1:]) if line and line[0] != "#"]
        for name, count in Counter(line.partition(".")[0].strip().upper() for line in items).most_common(1):
            if count > MOST_OF_NAME:
                most = f'{MOST_OF_NAME} lines of one name (there are {count} of "{name[:20]}")'
                raise InputError(f"a LAS file with at most {most}")
        if title.startswith("~C") or "_DEFINITION" in title:
            curves = len(items)
    return "".join(kept)


def _check_rows(section: str, curves: int) -> None:
    """Raise InputError for rows of many more values than curves."""
    for line in islice(io.StringIO(section), 1, 20):
        values = len(re.split(r"[\s,]+", line.strip()))
        if values > curves + MOST_OF_NAME and not line.lstrip().startswith("#"):
            expected = f"a LAS file with as many values in a row as curves ({values} values, {curves} curves)"
            raise InputError(expected)


def _text(value: object) -> str:
    return "" if isinstance(value, float) and math.isnan(value) else str(value).strip()
