"""Files that users write, read with a bound: a pipe would block, and a device may have no end."""

import errno
import io
import os
import stat
from pathlib import Path

from fctd.errors import InputError

LARGEST = 64 * 2**20  # bytes: more than 100,000 stations with a dozen other columns


def read_text(path: Path) -> str:
    """The text of a file in UTF-8, line ends as "\\n".

    Raises InputError for what is no regular file or too large, OSError where it cannot be read, and ValueError where
    it is not UTF-8.
    """
    check_regular(path)
    with path.open("rb") as file:
        content = file.read(LARGEST + 1)
    if len(content) > LARGEST:
        raise InputError(f"a file of at most {LARGEST // 2**20} MiB")
    return io.StringIO(content.decode("utf-8-sig"), newline=None).read()


def check_regular(path: Path) -> None:
    """Raise InputError for a pipe or a device, OSError for a folder and for what is not there."""
    mode = path.stat().st_mode
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(mode):
        raise InputError("a regular file (this is a pipe or a device: write its content into a file first)")
