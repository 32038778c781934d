"""Folders of results, replaced as a whole: the new one is written beside the old, then two renames swap them.

A temporary file (scratch.py) stands for the replacement, and gives its name to two folders: NAME.run is the new one,
NAME.old the one before; both are there only between the two renames.  A process killed at any time leaves enough for
``repair`` to finish: what was written completely is put into place.
"""

import errno
import os
import shutil
import time
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager, suppress
from itertools import count
from pathlib import Path

from fctd.case.errors import InputError
from fctd.store.scratch import left_over, scratch_file, scratch_name
from fctd.store.whole_file import check_new

Own = Callable[[Path], Collection[str]]
"""Names of what a new folder replaces; all else is the user's and stays."""


# Attempts to find a folder that another process is replacing, and the pause between them [s].
ATTEMPTS, PAUSE = 100, 0.01


@contextmanager
def whole_folder(folder: Path, own: Own = os.listdir) -> Iterator[Path]:
    """A temporary folder that replaces ``folder``, or becomes it, when the block ends without an error.

    A failure or an interruption leaves the folder as it was.  Raises InputError, which names ``folder``, where the
    system refuses; where it refuses the swap alone, the message says where the new files are.
    """
    target = check_folder(folder)
    try:
        repair(target, own)
        target.parent.mkdir(parents=True, exist_ok=True)
        with scratch_file(_stand_in(target)) as scratch:
            new, old = _beside(scratch)
            new.mkdir()
            try:
                yield new
                if target.is_dir():
                    shutil.copymode(target, new)
                _swap(new, target, old, own)
            finally:
                _finish(target, scratch, own)
    except OSError as error:
        raise InputError(f"a folder that can be written ({error.strerror or error})", value=folder) from error


def check_folder(folder: Path, key: str = "") -> Path:
    """The folder without symlinks; InputError, which names ``key`` and ``folder``, where it could not be replaced."""
    target = Path(os.path.realpath(folder))
    room = folder if os.access(target, os.W_OK) else Path()
    advice = f"a folder for the results alone, such as {room / 'result'}"
    in_use = (Path(os.path.realpath(place)) for place in (os.curdir, os.path.expanduser("~")))
    if any(place.is_relative_to(target) for place in in_use):
        raise InputError(f"{advice} (this one is or contains the current folder or your home)", key=key, value=folder)
    try:
        if target.exists() and not target.is_dir():
            raise InputError("a folder that can be written (this is a file)", key=key, value=folder)
        inside = [target / name for name in os.listdir(target)] if target.exists() else []
        if any(os.path.ismount(place) for place in (target, *inside)):
            raise InputError(f"{advice} (this one is or contains a mount point)", key=key, value=folder)
        check_new(scratch_name(_stand_in(target)))
    except OSError as error:
        reason = error.strerror or str(error)
        here = f"{advice} (beside this one nothing can be written: {reason})"
        expected = here if os.path.isdir(target) else f"a folder that can be written ({reason})"
        raise InputError(expected, key=key, value=folder) from None
    return target


def repair(folder: Path, own: Own) -> None:
    """Complete or undo the replacements of a folder that killed processes left unfinished, as far as possible."""
    folder = Path(os.path.realpath(folder))
    for scratch in left_over(_stand_in(folder)):
        with suppress(OSError):  # the folder cannot be written and stays as it is
            _finish(folder, scratch, own)


def _stand_in(folder: Path) -> Path:
    """The path beside which the temporary file of a replacement lies."""
    return folder.parent / f"{folder.name}.lock"  # the root has no name


def _beside(scratch: Path) -> tuple[Path, Path]:
    """The new folder and the one before."""
    return scratch.with_suffix(".run"), scratch.with_suffix(".old")


def _swap(new: Path, folder: Path, old: Path, own: Own) -> None:
    """Put a new folder in the place of the present one, if any; another process may do the same at the same time."""
    try:
        while not _rename_over(new, folder):
            _hand_over(old, folder, own)
            with suppress(FileNotFoundError):  # another process is between its two renames
                folder.rename(old)
    except OSError as error:
        if old.is_dir():
            raise
        kept = folder.with_name(f"{folder.name}.new")  # a name that no repair removes
        while os.path.lexists(kept):
            kept = kept.with_name(f"{kept.name}.new")
        new.rename(kept)
        expected = f"a folder that can be renamed ({error.strerror or error}); the new files are in {kept}"
        raise InputError(expected, value=folder) from error


def _finish(folder: Path, scratch: Path, own: Own) -> None:
    """Complete or undo a replacement, whatever step it reached."""
    new, old = _beside(scratch)
    if old.is_dir():
        if new.is_dir():  # between the two renames: the new folder is complete
            if not _rename_over(new, folder) and not own(folder):
                _hand_over(new, folder, lambda _: ())
        elif not folder.exists():
            old.rename(folder)
        _hand_over(old, folder, own)
    if new.is_dir():
        shutil.rmtree(new)
    scratch.unlink()  # last: what is left is found by it


def _rename_over(new: Path, folder: Path) -> bool:
    """Rename a folder to where there is none or an empty one; False where there is one that is not empty."""
    try:
        new.rename(folder)
    except OSError as error:
        if error.errno not in (errno.ENOTEMPTY, errno.EEXIST):
            raise
        return False
    return True


def _hand_over(old: Path, folder: Path, own: Own) -> None:
    """Move the user's files from the old folder into the new one, and remove the old folder."""
    if not old.is_dir():
        return
    replaced = own(old)
    for name in sorted(os.listdir(old)):
        if name not in replaced:
            _move(old / name, folder)
        elif (old / name).is_dir():
            shutil.rmtree(old / name)
        else:
            (old / name).unlink()
    with suppress(FileNotFoundError):
        old.rmdir()


def _move(path: Path, folder: Path) -> None:
    """Move a file or folder of the user's into another folder."""
    for attempt in count(1):
        place = folder / path.name
        while os.path.lexists(place):  # the user has made another of that name meanwhile
            place = place.with_name(f"{place.name}.old")
        try:
            path.rename(place)
            return
        except FileNotFoundError:  # another process is between its two renames
            if attempt == ATTEMPTS:
                raise
            time.sleep(PAUSE)
