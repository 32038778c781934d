"""The inputs of a result: a study is repeated when, and only when, one of them has changed.

The code: the study's module, and every module of the project that it imports or that a registry names, "module:class".
Of ``fctd.plots``, which answers import and which changes no number, it is the list of names alone.
The files that are read while it runs.  The packages of engine and suite, and the processor.  ``expected.toml`` is no
input: it changes verdicts, not numbers.
"""

import ast
import json
import os
import platform
import re
import tomllib
from dataclasses import asdict, dataclass, field
from functools import cache
from importlib.metadata import PackageNotFoundError, requires, version
from importlib.util import find_spec
from pathlib import Path

import grimp
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from pydantic import TypeAdapter

from fctd.case.solver import PERTURBED
from fctd.store.limits import cores
from references import contact, engines
from references.registry import RIVAL_PACKAGES, label, version_of
from references.timing.stopwatch import cpu_name
from validation.harness import targets
from validation.harness.files import ABSENT, digest, digest_of
from validation.harness.study import ROOT

LENGTH = "quick or full"
# Inputs by which a variation of a run differs from the plain one.
VARIED = tuple(f"environment {name}" for name in (PERTURBED, *targets.VARIABLES))
# What studies are made of.
PACKAGES = ("fctd", "references", "validation")
PICTURES = "fctd.plots"
# An entry of a registry, "module:class".
REGISTERED = re.compile(rb'"([A-Za-z_][\w.]*):[A-Za-z_]\w*"')


@dataclass
class Inputs:
    """All inputs of a result, each with a digest or a version.

    code : module's file -> digest.  files : file read -> digest.  around : packages, processor, quick or full.
    """

    code: dict[str, str]
    around: dict[str, str]
    files: dict[str, str] = field(default_factory=dict)

    def changed_since(self, kept: "Inputs", root: Path = ROOT) -> str:
        """The first input that differs from that of the ``kept`` result; empty if none does."""
        files_now = {name: digest(root / name) for name in kept.files}  # an absolute name stays one
        pairs = ((kept.around, self.around), (kept.files, files_now), (kept.code, self.code))
        for before, now in pairs:
            # What is no longer used follows from another change.
            for name in (*sorted(now), *sorted(before.keys() - now.keys())):
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


def surroundings(quick: bool, root: Path = ROOT) -> dict[str, str]:
    """Inputs of numbers and times other than code and files.

    The processor counts for every study: compiled code is made for it, and most studies report times.  So does what the
    environment says of noise and of the processor to compile for.
    """
    found = {LENGTH: "quick" if quick else "full", "processor": cpu_name(), "cores": str(cores())}
    found["python"] = platform.python_version()
    found |= {name: value for name in VARIED if (value := os.environ.get(name.split()[-1]))}
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    asked = (*project["dependencies"], *project["optional-dependencies"]["suite"])
    return found | {f"package {name}": installed for name, installed in sorted(_packages(asked).items())}


# Inputs of studies of rivals begin so.
RIVAL, PLUGIN = "rival ", "plugin "


def rivals() -> dict[str, str]:
    """Inputs of the studies of rivals: versions of their packages; of each plugin name, version and digest of code."""
    found = {f"{RIVAL}{name}": version_of(name) or ABSENT for name in RIVAL_PACKAGES}
    for registry in (contact.REGISTRY, engines.REGISTRY):
        for name, point in registry.plugins().items():
            found[f"{PLUGIN}{registry.noun} {name}"] = f"{label(point)}, {_digest_of_package(point.module)}"
    return found


def _digest_of_package(module: str) -> str:
    """Digest of all sources of the package or file that a module belongs to; ``absent`` where there is none."""
    try:
        spec = find_spec(module.partition(".")[0])
    except (ImportError, ValueError):
        spec = None
    if spec is None:
        return ABSENT
    folders = [Path(folder) for folder in spec.submodule_search_locations or ()]
    files = sorted(file for folder in folders for file in folder.rglob("*.py")) or [Path(str(spec.origin))]
    return digest_of(b"".join(file.read_bytes() for file in files if file.is_file()))


@cache  # a process keeps the packages that it has imported
def _packages(asked: tuple[str, ...]) -> dict[str, str]:
    """Version of every package asked for, and of those that they need in turn; ``absent`` for one that is not there."""
    found: dict[str, str] = {}
    waiting = [Requirement(text) for text in asked]
    while waiting:
        wanted = waiting.pop()
        name = canonicalize_name(wanted.name)
        if name in found or (wanted.marker is not None and not wanted.marker.evaluate({"extra": ""})):
            continue
        try:
            found[name] = version(name)
            waiting += [Requirement(text) for text in requires(name) or []]
        except PackageNotFoundError:
            found[name] = ABSENT
    return found


class Sources:
    """The modules of the project as they stand on disk and what they import, read when this is built.

    Raises ``grimp.exceptions.SourceSyntaxError`` for a module that is no Python.
    """

    def __init__(self, root: Path = ROOT, packages: tuple[str, ...] = PACKAGES) -> None:
        self.root = root
        self._graph = grimp.build_graph(*packages, cache_dir=None)
        # All of them now: what is edited while studies run is repeated by the next run.
        files = {name: file for name in self._graph.modules if (file := self.file(name))}
        texts = {name: file.read_bytes() for name, file in files.items()}
        self._digests = {name: (self.name_of(files[name]), _digest_of_source(text)) for name, text in texts.items()}
        self._registered = {
            name: {found.decode() for found in REGISTERED.findall(text)} for name, text in texts.items()
        }

    def used_by(self, *modules: str) -> dict[str, str]:
        """File -> digest of modules and of all that they import or name in a registry, wherever that stands."""
        found: set[str] = set()
        waiting = set(modules)
        while waiting:
            name = waiting.pop()
            if name in found or name not in self._graph.modules:
                continue
            found.add(name)
            if name != PICTURES:
                waiting |= self._graph.find_modules_directly_imported_by(name) | self._registered.get(name, set())
            waiting.add(name.rpartition(".")[0])  # importing a.b runs a/__init__.py
        return dict(self._digests[name] for name in sorted(found) if name in self._digests)

    def file(self, module: str) -> Path | None:
        """The file of a module of the project, None for any other name."""
        path = self.root.joinpath(*module.split("."))
        return next((file for file in (path.with_suffix(".py"), path / "__init__.py") if file.is_file()), None)

    def name_of(self, file: Path) -> str:
        """A file's name in a fingerprint: relative to the project where it lies in there."""
        return file.relative_to(self.root).as_posix() if file.is_relative_to(self.root) else str(file)


@cache
def _digest_of_source(source: bytes) -> str:
    """Digest of a module's source without comments and layout."""
    return digest_of(ast.dump(ast.parse(source)).encode())
