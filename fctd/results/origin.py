"""Where the numbers of an unfinished run come from: its files, the versions, the processor."""

import hashlib
import platform
from collections.abc import Iterator, Mapping
from pathlib import Path

import llvmlite.binding as llvm

from fctd.case.load import Case
from fctd.mechanics.compile_cache import hash_of_sources
from fctd.results.tables import versions

Origin = dict[str, str]
GONE, SOURCES = "gone", "sources of fctd"


def files_of(case: Case) -> dict[str, Path]:
    """The files that a case was read from, absolute, by what they are."""
    files = {"case file": case.file, "survey": case.wellbore.survey}
    return {name: path.absolute() for name, path in files.items() if path is not None}


def origin_of(files: Mapping[str, Path]) -> Origin:
    """Hashes of files, versions, and the processor with all that compiled code may use of it.

    The same on another processor, or with other sources, is rounded in another way.
    """
    found = {f"{name} {path}": _hash(path) for name, path in files.items()}
    found |= {name: version for name, version in versions().items() if name != "commit"}
    found[SOURCES] = hash_of_sources()
    features = hashlib.sha256(llvm.get_host_cpu_features().flatten().encode()).hexdigest()[:8]
    found["processor"] = f"{platform.machine()} {llvm.get_host_cpu_name()} (features {features})"
    return found


def changes(before: Mapping[str, str], now: Mapping[str, str]) -> Iterator[str]:
    """What differs, a phrase each; hashes are not printed."""
    for name, was in before.items():
        value = now.get(name, GONE)
        if value == was:
            continue
        if name == SOURCES:
            yield f"the {name} have changed"
        elif name.startswith(("case file ", "survey ")):
            yield f"the {name} is gone" if value == GONE else f"the {name} has changed"
        else:
            yield f"{name} was {was} and is {value}"


def _hash(path: Path) -> str:
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError:
        return GONE
