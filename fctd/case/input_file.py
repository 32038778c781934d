"""Users' files, read up to a largest size: reading a pipe would block, and a device may never end."""

import codecs
import errno
import io
import os
import re
import stat
import tomllib
from pathlib import Path
from typing import Any, Final

from fctd.case.errors import InputError


def read_text(path: Path, largest: int) -> str:
    """The text of a UTF-8 file of at most ``largest`` MiB, with every line end as a newline.

    Raises as `read_bytes` does, and ValueError for a file that is not UTF-8.
    """
    return io.StringIO(read_bytes(path, largest).decode("utf-8-sig"), newline=None).read()


def read_office_text(path: Path, largest: int) -> str:
    """As `read_text`, of a file in any encoding in which an office saves text.

    Raises as `read_bytes` does, and ValueError for a file that is not text.
    """
    content = read_bytes(path, largest)
    return io.StringIO(content.decode(encoding_of(content)), newline=None).read()


def encoding_of(content: bytes) -> str:
    """The encoding of a text as offices save them: UTF-8, UTF-16, or Windows 1252 where it is neither."""
    if content.startswith(codecs.BOM_UTF8):
        return "utf-8-sig"
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    if b"\0" in content[:100]:  # UTF-16 without its mark: every other byte of a text is zero
        return "utf-16-le" if content[1:2] == b"\0" else "utf-16-be"
    try:
        content.decode("utf-8")
    except UnicodeDecodeError:
        return "cp1252"
    return "utf-8"


def read_toml(path: Path, largest: int, what: str) -> dict[str, Any]:
    """The tables of a TOML file of at most ``largest`` MiB.

    what : the file in messages, as "a case file".  Raises InputError, which does not name the path.
    """
    try:
        text = read_text(path, largest)
    except OSError as error:
        raise InputError(f"{what} that can be read ({error.strerror})") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{what} in TOML ({error})") from error
    return tables_of(text, what)


def tables_of(text: str, what: str) -> dict[str, Any]:
    """The tables of a text in TOML; raises InputError as `read_toml` does."""
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
        hints = [hint for pattern, hint in _HINTS if re.search(pattern, line)]
        raise InputError("; ".join([expected, *hints[:1]]), key=f"line {place[1]}", value=line) from error


# What people write that is no TOML, and what to write.
_HINTS: Final = (
    ("[\u2018\u2019\u201c\u201d]", "quotes are straight"),
    (r"\\", "a path is written with /, or in single quotes"),
    (r"=\s*[+-]?\d+,\d+\s*(#.*)?$", "decimals follow a point"),
    (r"=\s*[+-]?[\d.]+\s*[^\W\d_]", "a quantity with its unit stands in quotes"),
)


def read_bytes(path: Path, largest: int) -> bytes:
    """The content of a file of at most ``largest`` MiB.

    Raises InputError for a file that is not regular or is too large, and OSError for one that cannot be read.
    """
    check_regular(path)
    with path.open("rb") as file:
        content = file.read(largest * 2**20 + 1)
    if len(content) > largest * 2**20:
        raise InputError(f"a file of at most {largest} MiB")
    return content


def check_regular(path: Path) -> None:
    """Raise InputError for a pipe or a device, OSError for a folder or a missing file."""
    mode = path.stat().st_mode
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(mode):
        raise InputError("a regular file (this is a pipe or a device: write its content into a file first)")
