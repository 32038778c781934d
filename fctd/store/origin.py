"""Where numbers that are kept come from: files, versions, sources, the processor."""

import hashlib
import os
import platform
import subprocess
from collections.abc import Iterator, Mapping
from importlib.metadata import version
from pathlib import Path

Origin = dict[str, str]
GONE, SOURCES = "gone", "sources of fctd"
__version__ = version("fctd")


def versions() -> dict[str, str]:
    """Versions of the engine and of the packages that its numbers depend on, and the commit of the checkout if any."""
    found = {"fctd": __version__, "python": platform.python_version()}
    found |= {name: version(name) for name in ("numpy", "numba")}
    root = Path(__file__).resolve().parents[2]
    try:
        git = subprocess.run(
            ["git", "-C", str(root), "rev-parse", "--show-toplevel", "--short", "HEAD"],
            capture_output=True, text=True, timeout=5, check=True, env=environment_of_git(),
        )  # fmt: skip
        above, commit = git.stdout.splitlines()
    except (OSError, ValueError, subprocess.SubprocessError):
        return found  # an installed wheel has no checkout: the version stands alone
    # An environment of Python may lie in a checkout of something else.
    return found | {"commit": commit} if Path(above) == root else found


def environment_of_git() -> dict[str, str]:
    """This process's environment, in which git takes the checkout of a folder, not the one that a hook of git names."""
    return {name: value for name, value in os.environ.items() if name not in ("GIT_DIR", "GIT_WORK_TREE")}


def origin_of(files: Mapping[str, Path], sources: str) -> Origin:
    """Hashes of files and of the sources, versions, and the processor with all that compiled code may use of it.

    The same on another processor, or with other sources, is rounded in another way.
    """
    import llvmlite.binding as llvm

    found = {f"{name} {path}": _hash(path) for name, path in files.items()} | versions_alone(versions(), sources)
    features = hashlib.sha256(llvm.get_host_cpu_features().flatten().encode()).hexdigest()[:8]
    found["processor"] = f"{platform.machine()} {llvm.get_host_cpu_name()} (features {features})"
    return found


def versions_alone(found: Mapping[str, str], sources: str) -> Origin:
    """Versions without the commit, in whose place stands a hash of the sources: commits change more than numbers."""
    return {name: version for name, version in found.items() if name != "commit"} | {SOURCES: sources}


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
