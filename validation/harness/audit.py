"""The files that a study reads and the modules that it imports, compared with its fingerprint."""

import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from references.registry import FOUND
from validation.harness.fingerprint import Sources

# Sources are followed by their imports; compiled code follows from sources.
NO_INPUTS = {".py", ".pyc", ".nbi", ".nbc"}
NO_FOLDERS = {".venv", ".git", "__pycache__"}


@dataclass
class Seen:
    """Files opened for reading in the folders that are watched, and modules that were imported or asked for."""

    folders: tuple[Path, ...]
    files: set[Path] = field(default_factory=set)
    modules: set[str] = field(default_factory=set)

    def undeclared(self, files: Mapping[Path, str], code: Mapping[str, str], sources: Sources) -> list[str]:
        """What a fingerprint of these files and this code lacks: names of files and of the project's modules."""
        modules = [name for name in self.modules if (file := sources.file(name)) and sources.name_of(file) not in code]
        return sorted(map(sources.name_of, self.files - files.keys())) + sorted(modules)


@contextmanager
def watched(*folders: Path) -> Iterator[Seen]:
    """Gathers what is read in these folders and imported meanwhile, by this process.

    A module counts that is imported for the first time, and an entry of a registry whenever it is asked for.
    """
    global _seen
    _install_hook()
    loaded = set(sys.modules)
    seen = Seen(tuple(folder.resolve() for folder in folders))
    _seen = seen
    try:
        yield seen
    finally:
        _seen = None
        seen.modules |= set(sys.modules) - loaded


_seen: Seen | None = None
_hooked = False


def _install_hook() -> None:
    """Audit hooks stay for the life of the process, so there is one."""
    global _hooked
    if not _hooked:
        sys.addaudithook(_on_event)
        _hooked = True


def _on_event(event: str, arguments: tuple[Any, ...]) -> None:
    seen = _seen
    if seen is None:
        return
    if event == FOUND:
        seen.modules.add(arguments[0])
    elif event == "open":
        opened, _, flags = arguments
        if not isinstance(opened, str | os.PathLike) or flags & (os.O_WRONLY | os.O_RDWR):
            return
        path = Path(os.path.realpath(os.fspath(opened)))
        ours = path.suffix not in NO_INPUTS and not NO_FOLDERS & set(path.parts)
        # A name that is opened in an open folder, as by shutil.rmtree, says nothing of where it lies.
        if ours and any(path.is_relative_to(folder) for folder in seen.folders) and path.is_file():
            seen.files.add(path)
