"""The folder of the app in the user's state: its token, its port, its sessions; no other user can read it."""

import os
import re
import secrets
import stat
from html import escape
from pathlib import Path
from typing import Final, Self

from fctd.case.errors import InputError
from fctd.store.lock import NAME as LOCK
from fctd.store.lock import FolderLock, HeldError
from fctd.store.whole_file import write_whole

TOKEN: Final = re.compile(r"[A-Za-z0-9_-]{32,64}")
PRIVATE: Final = 0o600  # of files that this user alone can read
HOST: Final = "127.0.0.1"
FIRST_PORT: Final = 8522  # of a new home; the next free one where another program has it


class Home:
    """A folder that this process alone uses, from ``open`` until ``leave``.

    token : first part of every address; it lasts until ``new_token``.
    """

    def __init__(self, folder: Path, lock: FolderLock) -> None:
        self.folder, self._lock = folder, lock
        token = _read(folder / "token")
        self.token = token if TOKEN.fullmatch(token) else self.new_token()

    @classmethod
    def open(cls, folder: Path | None = None) -> Self:
        """The user's folder, or another one, made where there is none.

        Raises InputError while another process serves the app from there, and where the folder cannot be used.
        """
        folder = user_folder() if folder is None else folder
        try:
            private_folder(folder)
            lock = FolderLock.take(folder)
            (folder / LOCK).chmod(PRIVATE)
            return cls(folder, lock)
        except HeldError as held:
            expected = f"no other fctd app of this user (process {held.holder.process} serves one): end it first"
            raise InputError(expected, value=folder) from None
        except OSError as error:
            raise InputError(f"a folder that can be written ({error.strerror or error})", value=folder) from error

    def leave(self) -> None:
        """Let other processes serve from here."""
        self._lock.release()

    def new_token(self) -> str:
        """Replace the token: addresses with the old one lead nowhere."""
        self.token = secrets.token_urlsafe(24)
        write_whole(self.folder / "token", self.token.encode(), mode=PRIVATE)
        return self.token

    @property
    def port(self) -> int:
        """The port of the last time."""
        text = _read(self.folder / "port")
        return int(text) if text.isdecimal() and 0 < int(text) < 65536 else FIRST_PORT

    @port.setter
    def port(self, port: int) -> None:
        write_whole(self.folder / "port", str(port).encode(), mode=PRIVATE)

    @property
    def prefix(self) -> str:
        """The beginning of the path of every address."""
        return f"/{self.token}/"

    def redirect_file(self, address: str) -> Path:
        """A page that leads to an address: a browser is given its name, which does not show the token to others."""
        path = self.folder / "open.html"
        text = f'<!DOCTYPE html><meta charset="utf-8"><meta http-equiv="refresh" content="0; url={escape(address)}">'
        write_whole(path, text.encode(), mode=PRIVATE)
        return path


def user_folder() -> Path:
    """Where the app of this user lies, by the rules of the system.  Raises InputError without the package for them."""
    try:
        import platformdirs
    except ModuleNotFoundError as error:
        raise InputError(f"the package {error.name} (pip install 'fctd[app]')", key="app") from None
    return platformdirs.user_state_path("fctd", appauthor=False) / "app"


def private_folder(folder: Path) -> None:
    """Make a folder that only this user can look into, 0700; raises OSError, also for another user's."""
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    found = folder.lstat()
    if not stat.S_ISDIR(found.st_mode):
        raise NotADirectoryError(None, "no folder", str(folder))
    if os.name == "posix":
        if found.st_uid != os.geteuid():
            raise PermissionError(None, "it belongs to another user", str(folder))
        folder.chmod(0o700)


def _read(path: Path) -> str:
    try:
        return path.read_text("utf-8").strip()
    except (OSError, ValueError):
        return ""
