"""The files that a study reads: whoever opens one declares it, so that its digest is kept with the result."""

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

ABSENT = "absent"

_declared: ContextVar[dict[Path, str] | None] = ContextVar("declared", default=None)


def declare(path: Path) -> Path:
    """Note that the study being run reads this file; returns the path."""
    found = _declared.get()
    if found is not None:
        found.setdefault(path.resolve(), digest(path))
    return path


@contextmanager
def declared() -> Iterator[dict[Path, str]]:
    """Gathers the files that are declared meanwhile, file -> digest."""
    found: dict[Path, str] = {}
    token = _declared.set(found)
    try:
        yield found
    finally:
        _declared.reset(token)


def digest(path: Path) -> str:
    """Digest of a file; ``absent`` where there is none."""
    try:
        return digest_of(path.read_bytes())
    except OSError:
        return ABSENT


def digest_of(content: bytes) -> str:
    """The same of bytes."""
    return hashlib.sha256(content).hexdigest()[:16]
