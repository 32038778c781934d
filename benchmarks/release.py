"""The sources of a release, taken out of the checkout's own history so that they can be raced against today's."""

import io
import subprocess
import tarfile
from pathlib import Path

from benchmarks.history import Record, sources_of
from benchmarks.measure import ROOT, cache

# What a worker needs of a release.
FOLDERS = ("fctd", "references", "benchmarks", "validation/cases")


class NoSourcesError(Exception):
    """The checkout does not hold the sources of a release; its text says why."""


def check_out(record: Record, file: Path, root: Path = ROOT) -> Path:
    """Folder with the sources that a record measured; NoSourcesError where the checkout's history lacks them.

    file : the record's own.  The folder is kept beside the compile cache, so that a release compiles once.
    """
    if Path(_git(root, "rev-parse", "--show-toplevel").decode().strip()) != root.resolve():
        raise NoSourcesError("this folder is no checkout of its own")
    shallow = _git(root, "rev-parse", "--is-shallow-repository").strip() == b"true"
    commits = [record.commit]
    within = file.resolve().is_relative_to(root.resolve())
    if within and not shallow:  # a commit rewritten since: the one that brought the record has the same sources
        added = _git(root, "log", "--diff-filter=A", "--format=%H", "-1", "--", str(file.resolve()))
        commits.append(added.decode().strip())
    for commit in filter(None, commits):
        try:
            archive = _git(root, "archive", commit, "--", *FOLDERS)
        except NoSourcesError:
            continue
        try:
            folder = cache() / f"release-{record.sources}-{record.reference}"
            with tarfile.open(fileobj=io.BytesIO(archive)) as tar:
                tar.extractall(folder, filter="data")
        except (OSError, RuntimeError) as error:  # RuntimeError: there is no home
            raise NoSourcesError(f"there is no cache folder to keep them in: {error}") from None
        if sources_of(folder) == record.sources:
            return folder
    raise NoSourcesError(
        f"this {'shallow clone' if shallow else 'checkout'} does not hold commit {record.commit or '(unknown)'}"
    )


def _git(root: Path, *arguments: str) -> bytes:
    try:
        return subprocess.run(["git", "-C", str(root), *arguments], capture_output=True, check=True).stdout
    except FileNotFoundError:
        raise NoSourcesError("git is not installed") from None
    except subprocess.CalledProcessError as failure:
        lines = failure.stderr.decode(errors="replace").strip().splitlines()
        raise NoSourcesError(lines[-1] if lines else f"git {arguments[0]} failed") from None
