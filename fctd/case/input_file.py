"""Users' files, read up to a largest size: reading a pipe would block, and a device may never end."""

import codecs
import errno
import io
import os
import re
import stat
import tomllib
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

from fctd.case.errors import MISSING, InputError

LARGEST_FILE: Final = 4  # MiB of TOML: 100,000 stations written out; the reader takes some seconds for them
# Parts of a dotted key, of which the reader keeps every beginning, and keys and tables of a text.
MOST_PARTS: Final = 16
MOST_KEYS: Final = 50_000
_PART: Final = r"""(?:(?<![\w-])[\w-]+|"[^"\n]*"|'[^'\n]*')[ \t]*"""
_LONG_KEY: Final = re.compile(rf"(?:{_PART}\.[ \t]*){{{MOST_PARTS}}}")
_TABLE: Final = re.compile(r"^[ \t]*\[[^\],\n]*\]", re.MULTILINE)
_BINARY: Final = re.compile(r"[\x00-\x08\x0e-\x1f\x7f]")


def read_text(path: Path, largest: int, what: str) -> str:
    """The text of a UTF-8 file of at most ``largest`` MiB, with every line end as a newline.

    Raises as `read_bytes` does, and ValueError for a file that is not UTF-8.
    """
    return io.StringIO(read_bytes(path, largest, what).decode("utf-8-sig"), newline=None).read()


def decode(content: bytes, what: str) -> str:
    """The text of a file as offices save them, in UTF-8, UTF-16 or Windows 1252, with every line end as a newline.

    what : the file in messages.  Raises InputError for a file that is not text.
    """
    encodings = ["utf-8-sig", "cp1252"]
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encodings = ["utf-16"]
    elif b"\0" in content[:100]:  # UTF-16 without its mark: every other byte of a text is zero
        encodings = ["utf-16-le" if content[1:2] == b"\0" else "utf-16-be"]
    for encoding in encodings:
        with suppress(UnicodeDecodeError):
            text = content.decode(encoding).removesuffix("\x1a")  # the mark of DOS at the end of a text
            if _BINARY.search(text):
                break
            return io.StringIO(text, newline=None).read()
    raise InputError(what)


def read_toml(path: Path, what: str) -> dict[str, Any]:
    """The tables of a TOML file of at most ``LARGEST_FILE`` MiB.

    what : the file in messages, as "a case file".  Raises InputError, which does not name the path.
    """
    try:
        text = read_text(path, LARGEST_FILE, what)
    except UnicodeDecodeError as error:
        raise InputError(f"{what} in TOML ({error})") from error
    return tables_of(text, what)


def tables_of(text: str, what: str) -> dict[str, Any]:
    """The tables of a text in TOML; raises InputError as `read_toml` does."""
    if long := _LONG_KEY.search(text):
        row = text.count("\n", 0, long.start()) + 1
        raise InputError(f"{what} in TOML (line {row} has a key of more than {MOST_PARTS} parts)")
    if text.count("=") + sum(1 for _ in _TABLE.finditer(text)) > MOST_KEYS:
        raise InputError(f"{what} in TOML with at most {MOST_KEYS:,} keys")
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise InputError(f"{what} in TOML (too many arrays or tables lie in each other)") from None
    except ValueError as error:
        expected = f"{what} in TOML ({error})"
        place = re.search(r"at line (\d+)", str(error))
        if place is None:
            raise InputError(expected) from error
        line = text.split("\n")[int(place[1]) - 1].strip()
        hints = [hint for pattern, hint in _HINTS if re.search(pattern, f"{line} ({error})")]
        raise InputError("; ".join([expected, *hints[:1]]), key=f"line {place[1]}", value=line) from error


# What people write that is no TOML, and what to write.
_HINTS: Final = (
    (r"^\[\[.*\(Cannot overwrite", "each table of this list stands in double brackets, [[ and ]], the one above too"),
    (r"\(Cannot (overwrite|declare|mutate|redefine)", "it stands in the case twice: remove one"),
    ("[\u2018\u2019\u201c\u201d]", "quotes are straight"),
    (r"\\.*\([A-Z]", "a path is written with /, or in single quotes"),
    (r"\(Illegal character '\\n'", "a quote is missing at the end of a text"),
    (r"=\s*[+-]?\d+,\d+\s*(#.*)?\(", "decimals follow a point"),
    (r"=\s*[+-]?[\d.]+\s*[^\W\d_]", "a quantity with its unit stands in quotes"),
)


def read_bytes(path: Path, largest: int, what: str) -> bytes:
    """The content of a file of at most ``largest`` MiB.

    what : the file in messages, as "a case file".  Raises InputError, which does not name the path, for a file that
    cannot be read, is not regular or is too large.
    """
    try:
        check_regular(path)
        with path.open("rb") as file:
            content = file.read(largest * 2**20 + 1)
    except OSError as error:
        raise InputError(f"{what} that can be read ({error.strerror})") from error
    if len(content) > largest * 2**20:
        raise InputError(f"a file of at most {largest} MiB")
    return content


def check_regular(path: Path, key: str = "") -> None:
    """Raise InputError for a pipe or a device, OSError for a folder or a missing file.

    key : of an option, which the error then names with the path.
    """
    mode = path.stat().st_mode
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(mode):
        expected = "a regular file (this is a pipe or a device: write its content into a file first)"
        raise InputError(expected, key=key, value=path if key else MISSING)
