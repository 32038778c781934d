"""The sources of a commit from the checkout's history, to race them against the present ones."""

import hashlib
import io
import os
import shutil
import subprocess
import tempfile
import zipfile
from datetime import datetime
from pathlib import Path

from benchmarks.measure import ROOT
from fctd.case.errors import InputError
from fctd.store.origin import environment_of_git

# Folders of a commit that a worker needs.
FOLDERS = ("fctd", "references", "benchmarks", "validation/cases")
SUBJECTS = "benchmarks/subjects.py"


def sources_of(root: Path) -> str:
    """Hash of the engine's sources in a checkout: names relative to ``fctd/`` and contents, subfolders included."""
    folder, found = root / "fctd", hashlib.sha256()
    for file in sorted(folder.rglob("*.py")):
        found.update(file.relative_to(folder).as_posix().encode() + file.read_bytes())
    return found.hexdigest()[:16]


def check_out(commit: str, root: Path = ROOT) -> Path:
    """Folder with the sources of a commit, in the user's cache.

    InputError where the clone does not hold the commit, and where there is no git, clone or cache.
    """
    full = resolved(commit, root)
    try:
        kept = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "fctd" / "commits"
        folder = kept / full
        if not folder.is_dir():  # numba compiles anew what has a new time
            kept.mkdir(parents=True, exist_ok=True)
            scratch = Path(tempfile.mkdtemp(dir=kept))
            with zipfile.ZipFile(io.BytesIO(_git(root, "archive", "--format=zip", full, "--", *FOLDERS))) as packed:
                packed.extractall(scratch)
            try:
                scratch.rename(folder)
            except OSError:  # another process was faster
                shutil.rmtree(scratch)
    except (OSError, RuntimeError) as error:  # RuntimeError: no home folder
        raise InputError("a cache folder for the sources of a commit", key="XDG_CACHE_HOME", value=error) from None
    return folder


def resolved(commit: str, root: Path = ROOT) -> str:
    """The full name of a commit; InputError where this clone does not hold it."""
    if Path(_git(root, "rev-parse", "--show-toplevel").decode().strip()) != root.resolve():
        raise InputError("a clone, so that the gate can race two commits", key="git", value=root)
    try:
        return _git(root, "rev-parse", "--verify", "--end-of-options", f"{commit}^{{commit}}").decode().strip()
    except InputError:
        shallow = _git(root, "rev-parse", "--is-shallow-repository").strip() == b"true"
        wanted = "a commit of this clone" + (" (it is shallow: run git fetch --unshallow)" if shallow else "")
        raise InputError(wanted, key="commit", value=commit) from None


def commit_of(file: Path, root: Path = ROOT) -> str:
    """The commit that added a file; empty where none did."""
    return _git(root, "log", "--diff-filter=A", "--format=%H", "-1", "--", str(file.resolve())).decode().strip()


def date_of(commit: str, root: Path = ROOT) -> datetime:
    """When a commit was made."""
    return datetime.fromisoformat(_git(root, "log", "-1", "--format=%cI", commit).decode().strip())


def brought(kernel: str, root: Path = ROOT) -> bool:
    """Whether the change at hand brings a kernel: the parent of the last commit does not name it."""
    try:
        return f'"{kernel}"' not in _git(root, "show", f"HEAD^:{SUBJECTS}").decode()
    except InputError:  # the first commit has no parent
        return True


def uncommitted(root: Path = ROOT) -> str:
    """Uncommitted changes in the folders that a record depends on, as git reports them."""
    return _git(root, "status", "--porcelain", "--", "fctd", "references", "benchmarks/*.py").decode().strip()


def _git(root: Path, *arguments: str) -> bytes:
    try:
        asked = ["git", "-C", str(root), *arguments]
        return subprocess.run(asked, capture_output=True, check=True, env=environment_of_git()).stdout
    except FileNotFoundError:
        raise InputError("git, since the gate races two commits", key="git") from None
    except subprocess.CalledProcessError as failure:
        lines = failure.stderr.decode(errors="replace").strip().splitlines()
        said = lines[-1] if lines else f"git {arguments[0]} failed"
        raise InputError("a clone with its history, since the gate races two commits", key="git", value=said) from None
