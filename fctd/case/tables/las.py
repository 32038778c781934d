"""LAS files as tables; the extra `las` brings the package that reads them."""

import io
import logging
import math

from fctd.case.errors import InputError
from fctd.case.tables.headers import Choices, TableForm, find_columns, with_units
from fctd.case.tables.rows import Rows


def read_las(text: str, form: TableForm, choices: Choices) -> Rows:
    """The rows of a LAS file; cells without a value are empty.

    Raises InputError for a text that is no LAS file, for bad curves, and where the package lasio is missing.
    """
    try:
        import lasio
    except ModuleNotFoundError as error:
        raise InputError("the package lasio for LAS files (pip install lasio, or the extra fctd[las])") from error
    try:
        logging.getLogger("lasio").setLevel(logging.CRITICAL)  # what a file lacks is an error of ours
        las = lasio.read(io.StringIO(text))
    except Exception as error:  # lasio raises errors of many kinds
        raise InputError(f"a LAS file that lasio can read ({error})") from error
    headers, units = [curve.mnemonic for curve in las.curves], [curve.unit for curve in las.curves]
    columns = with_units(find_columns((0, headers), form, choices), [(0, units)], (), form, choices)
    cells = {key: [_text(value) for value in las.curves[column.place].data] for key, column in columns.items()}
    return Rows(columns, range(1, len(las.curves[0].data) + 1), cells)


def _text(value: object) -> str:
    return "" if isinstance(value, float) and math.isnan(value) else str(value).strip()
