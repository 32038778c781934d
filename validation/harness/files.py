"""The files that a study reads: they belong to the inputs of its result."""

import hashlib
import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

ABSENT = "absent"
# Sources are followed by their imports; compiled code follows from sources.
NO_INPUTS = {".py", ".pyc", ".nbi", ".nbc"}
NO_FOLDERS = {".venv", ".git", "__pycache__"}


@dataclass
class Read:
    """Files of the folders that this process opens for reading, file -> digest when it was opened first."""

    folders: tuple[Path, ...]
    files: dict[Path, str] = field(default_factory=dict)


_read: Read | None = None


@contextmanager
def reading(*folders: Path) -> Iterator[Read]:
    """Gathers the files of these folders that are read meanwhile."""
    global _read
    _install_hook()
    _read = Read(tuple(folder.resolve() for folder in folders))
    try:
        yield _read
    finally:
        _read = None


def watched() -> tuple[Path, ...]:
    """The folders that are watched now, for a process that does a part of the work."""
    return _read.folders if _read is not None else ()


def also_read(files: Mapping[Path, str]) -> None:
    """Add what such a process has read."""
    if _read is not None:
        _read.files = {**files, **_read.files}


def digest(path: Path) -> str:
    """Digest of a file; ``absent`` where there is none."""
    try:
        return digest_of(path.read_bytes())
    except OSError:
        return ABSENT


def digest_of(content: bytes) -> str:
    """The same of bytes."""
    return hashlib.sha256(content).hexdigest()[:16]


@cache
def _install_hook() -> None:
    """An audit hook stays for the life of the process, so there is one."""
    sys.addaudithook(_on_event)


def _on_event(event: str, arguments: tuple[Any, ...]) -> None:
    if _read is None or event != "open":
        return
    opened, _, flags = arguments
    if not isinstance(opened, str | os.PathLike) or flags & (os.O_WRONLY | os.O_RDWR):
        return
    path = Path(os.path.realpath(os.fspath(opened)))
    known = path in _read.files or path.suffix in NO_INPUTS or NO_FOLDERS & set(path.parts)
    # A name that is opened in an open folder, as by shutil.rmtree, says nothing of where it lies.
    if not known and any(path.is_relative_to(folder) for folder in _read.folders) and path.is_file():
        _read.files[path] = ABSENT  # known, as the digest opens the file once more
        _read.files[path] = digest(path)
