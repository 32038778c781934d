"""Extract the sources of a release from the checkout's history, to race them against the present sources."""

import io
import subprocess
import zipfile
from pathlib import Path

from benchmarks.history import Record, sources_of
from benchmarks.measure import ROOT, cache
from fctd.store.origin import environment_of_git

# Folders of a release that a worker needs.
FOLDERS = ("fctd", "references", "benchmarks", "validation/cases")


class NoSourcesError(Exception):
    """The checkout does not hold the sources of a release; the text gives the reason."""


def check_out(record: Record, file: Path, root: Path = ROOT) -> Path:
    """Folder with the sources of a record; NoSourcesError if the checkout's history does not have them.

    file : file of the record.  The folder is kept next to the compile cache, so that a release compiles once.
    """
    if Path(_git(root, "rev-parse", "--show-toplevel").decode().strip()) != root.resolve():
        raise NoSourcesError("this folder is not the top of a checkout")
    shallow = _git(root, "rev-parse", "--is-shallow-repository").strip() == b"true"
    commits = [record.commit]
    within = file.resolve().is_relative_to(root.resolve())
    if within and not shallow:  # if the commit was rewritten, the commit that added the record has the same sources
        added = _git(root, "log", "--diff-filter=A", "--format=%H", "-1", "--", str(file.resolve()))
        commits.append(added.decode().strip())
    for commit in filter(None, commits):
        try:
            archive = _git(root, "archive", "--format=zip", commit, "--", *FOLDERS)
        except NoSourcesError:
            continue
        try:
            folder = cache() / f"release-{record.sources}-{record.reference}"
            with zipfile.ZipFile(io.BytesIO(archive)) as packed:
                packed.extractall(folder)
        except (OSError, RuntimeError) as error:  # RuntimeError: no home folder
            raise NoSourcesError(f"the cache folder cannot be written: {error}") from None
        if sources_of(folder) == record.sources:
            return folder
    raise NoSourcesError(
        f"this {'shallow clone' if shallow else 'checkout'} does not hold commit {record.commit or '(unknown)'}"
    )


def _git(root: Path, *arguments: str) -> bytes:
    try:
        asked = ["git", "-C", str(root), *arguments]
        return subprocess.run(asked, capture_output=True, check=True, env=environment_of_git()).stdout
    except FileNotFoundError:
        raise NoSourcesError("git is not installed") from None
    except subprocess.CalledProcessError as failure:
        lines = failure.stderr.decode(errors="replace").strip().splitlines()
        raise NoSourcesError(lines[-1] if lines else f"git {arguments[0]} failed") from None
