"""Result files: written whole or not at all."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from fctd.errors import InputError


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A file to write that takes the place of ``path`` once all of it is written; folders on the way are made.

    A full disk or an interruption leaves what was there before.  Raises InputError, which names ``path``, where
    the system refuses.
    """
    scratch = path.with_stem(f".{path.stem}-{os.getpid()}")  # the suffix stays: it may say the format
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield scratch
        scratch.replace(path)
    except OSError as error:
        raise InputError(f"a file that can be written ({error.strerror or error})", value=path) from error
    finally:
        with suppress(OSError):
            scratch.unlink(missing_ok=True)
