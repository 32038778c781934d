"""What a result rests on, so that it is repeated when, and only when, some of that has changed.

The code: the study's module and every module of the project that it can come to import.  The files that it read
while it ran.  What is installed, and the processor.  ``expected.toml`` is no input: it judges, it changes no number.
"""

import ast
import hashlib
import importlib.util
import json
import os
import platform
import re
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter

from references.timing.stopwatch import cpu_name
from validation.harness.study import ROOT

# "package.module" or "package.module:Class", as in the registries of modules that are imported by name.
MODULE_NAME = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)+(:\w+)?")
ABSENT = "absent"
LENGTH = "quick or full"
# Sources are followed by their imports; compiled code follows from sources.
NO_INPUTS = {".py", ".pyc", ".nbi", ".nbc"}
NO_FOLDERS = {".venv", ".git", "__pycache__"}


@dataclass
class Inputs:
    """Everything a result rests on, each thing with a digest or a version.

    code : module's file -> digest.  files : file read -> digest.  around : packages, processor, quick or full.
    """

    code: dict[str, str]
    around: dict[str, str]
    files: dict[str, str] = field(default_factory=dict)

    def changed_since(self, kept: "Inputs") -> str:
        """The first thing that is not as it was for the ``kept`` result; empty when all of it is."""
        files_now = {name: _digest(Path(name) if Path(name).is_absolute() else ROOT / name) for name in kept.files}
        pairs = ((kept.around, self.around), (kept.files, files_now), (kept.code, self.code))
        for before, now in pairs:
            for name in sorted(before.keys() | now.keys()):
                if before.get(name) != now.get(name):
                    return name
        return ""

    def write(self, folder: Path) -> None:
        """Store beside a result."""
        text = json.dumps(asdict(self), indent=1, ensure_ascii=False) + "\n"
        (folder / "inputs.json").write_text(text, encoding="utf-8", errors="backslashreplace")


_STORED: TypeAdapter[Inputs] = TypeAdapter(Inputs)


def read(folder: Path) -> Inputs | None:
    """The inputs stored beside a result; None where there are none that can be read."""
    try:
        return _STORED.validate_json((folder / "inputs.json").read_bytes())
    except (OSError, ValueError):
        return None


def surroundings(quick: bool) -> dict[str, str]:
    """What numbers and times depend on beside code and files.

    The processor counts for every study: compiled code is made for it, and most studies tell what they cost.
    """
    found = {LENGTH: "quick" if quick else "full", "processor": cpu_name(), "cores": str(os.cpu_count())}
    found["python"] = platform.python_version()
    for name in re.findall(r"^([\w.-]+)==", (ROOT / "requirements.lock").read_text(), re.MULTILINE):
        try:
            found[f"package {name}"] = version(name)
        except PackageNotFoundError:
            found[f"package {name}"] = ABSENT
    return found


class Sources:
    """The modules of the project as they stand on disk, each read once."""

    def __init__(self) -> None:
        self._root = ROOT
        self._read: dict[str, tuple[str, list[str]]] = {}

    def used_by(self, module: str) -> dict[str, str]:
        """File -> digest of a module and of all that it can come to import.

        Followed are import statements wherever they stand, and every text that is the name of a module: that is
        how registries name what is imported only when it is asked for.
        """
        found: dict[str, str] = {}
        waiting = [module]
        while waiting:
            parts = waiting.pop().split(".")
            for count in range(1, len(parts) + 1):  # importing a.b runs a/__init__.py
                name = ".".join(parts[:count])
                file = self.file(name)
                if file is None or (key := file.relative_to(self._root).as_posix()) in found:
                    continue
                found[key], named = self._module(name, file)
                waiting += named
        return found

    def file(self, module: str) -> Path | None:
        """The file of a module of the project, None for any other name."""
        path = self._root.joinpath(*module.split("."))
        return next((file for file in (path.with_suffix(".py"), path / "__init__.py") if file.is_file()), None)

    def strays(self, modules: set[str], code: Mapping[str, str]) -> list[str]:
        """Those of the modules that are the project's and not among the code that was found."""
        files = {name: self.file(name) for name in modules}
        return sorted(
            name for name, file in files.items() if file and file.relative_to(self._root).as_posix() not in code
        )

    def _module(self, name: str, file: Path) -> tuple[str, list[str]]:
        """Digest of what a module says, without comments and layout, and the names of modules in it."""
        if name not in self._read:
            source = file.read_bytes()
            try:
                tree = ast.parse(source)
            except (SyntaxError, ValueError):
                self._read[name] = _hash(source), []  # importing it will tell
            else:
                package = name if file.name == "__init__.py" else name.rpartition(".")[0]
                self._read[name] = _hash(ast.dump(tree).encode()), list(_named(tree, package))
        return self._read[name]


def _named(tree: ast.Module, package: str) -> Iterator[str]:
    """Every name in a module that may be that of another one."""
    for node in ast.walk(tree):
        match node:
            case ast.Import(names=names):
                yield from (alias.name for alias in names)
            case ast.ImportFrom(module=module, names=names, level=level):
                base = importlib.util.resolve_name("." * level + (module or ""), package)
                yield base
                yield from (f"{base}.{alias.name}" for alias in names)
            case ast.Constant(value=str(text)) if MODULE_NAME.fullmatch(text):
                yield text.partition(":")[0]


@contextmanager
def files_read(*folders: Path) -> Iterator[dict[str, str]]:
    """Gathers the files of these folders that are opened for reading meanwhile, file -> digest, sources apart.

    As a compiler writes down the headers it read: what is seen is what Python opens, in this process.
    """
    global _gathering
    _install_hook()
    found: dict[str, str] = {}
    _gathering = (tuple(folder.resolve() for folder in folders), found)
    try:
        yield found
    finally:
        _gathering = None


_gathering: tuple[tuple[Path, ...], dict[str, str]] | None = None
_hooked = False


def _install_hook() -> None:
    """Audit hooks stay for the life of the process, so there is one."""
    global _hooked
    if not _hooked:
        sys.addaudithook(_on_event)
        _hooked = True


def _on_event(event: str, arguments: tuple[Any, ...]) -> None:
    global _gathering
    if event != "open" or _gathering is None:
        return
    opened, _, flags = arguments
    if not isinstance(opened, str | os.PathLike) or flags & (os.O_WRONLY | os.O_RDWR):
        return
    gathering, _gathering = _gathering, None  # opening the file to digest it is an event as well
    try:
        folders, found = gathering
        path = Path(os.path.realpath(os.fspath(opened)))
        ours = path.suffix not in NO_INPUTS and not NO_FOLDERS & set(path.parts)
        if ours and any(path.is_relative_to(folder) for folder in folders):
            name = path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else str(path)
            found.setdefault(name, _digest(path))
    finally:
        _gathering = gathering


def _digest(path: Path) -> str:
    """What a file holds, in short; also that it is not there."""
    try:
        return _hash(path.read_bytes())
    except OSError:
        return ABSENT


def _hash(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:16]
