"""The sessions of the page: what a user has put in, kept in files, so that an address works after a restart."""

import hashlib
import json
import re
import secrets
import shutil
import threading
from collections.abc import Collection
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from fctd.app.home import PRIVATE, private_folder
from fctd.store.whole_file import write_whole

KEY: Final = re.compile(r"[A-Za-z0-9_-]{12}")
MOST_SESSIONS: Final = 20  # kept; the one that was used longest ago goes first


@dataclass(frozen=True)
class Source:
    """A case as it came: its text, and the survey that lies beside it with the name by which the text names it."""

    text: str
    survey_name: str = ""
    survey: bytes = field(default=b"", repr=False)

    @property
    def digest(self) -> str:
        """A name for the content."""
        parts = (self.text.encode("utf-8", "surrogatepass"), self.survey_name.encode("utf-8", "surrogatepass"))
        return hashlib.sha256(b"\0".join([*parts, self.survey])).hexdigest()


class Session:
    """A folder with the case, the measured rows, and the settings of the page.

    settings : of the page, plain JSON; the page writes them with ``keep``.  Two belong to the case itself: the name of
    its survey and ``well``, another word each time that a case is taken, the same one taken again among them.
    """

    def __init__(self, folder: Path) -> None:
        self.key, self.folder, self._lock = folder.name, folder, threading.Lock()
        self.settings: dict[str, Any] = {}
        with suppress(OSError, ValueError):
            found = json.loads((folder / "settings.json").read_bytes())
            self.settings = found if isinstance(found, dict) else {}
        self._source: Source | None = None

    @property
    def source(self) -> Source | None:
        """The case, None before there is one."""
        with self._lock:
            if self._source is None:
                with suppress(OSError, ValueError):
                    text = (self.folder / "case.toml").read_bytes().decode()
                    name, survey = str(self.settings.get("survey", "")), b""
                    if name:
                        survey = (self.folder / "survey").read_bytes()
                    self._source = Source(text, name, survey)
            return self._source

    def put(self, source: Source) -> None:
        """Take a case in place of the one before, whose settings and measured rows are dropped."""
        with self._lock:
            write_whole(self.folder / "survey", source.survey, mode=PRIVATE)
            write_whole(self.folder / "case.toml", source.text.encode("utf-8", "backslashreplace"), mode=PRIVATE)
            self._source = source
            self._write({"survey": source.survey_name, "well": secrets.token_urlsafe(6)})

    @property
    def well(self) -> str:
        """A name for the case since it was taken, empty before there is one."""
        return str(self.settings.get("well", ""))

    @property
    def measured(self) -> str:
        """The text of the measured rows, empty without any."""
        return str(self.settings.get("measured", ""))

    def keep(self, of: str | None = None, **settings: Any) -> None:
        """Change some settings; of : the ``well`` that they belong to, in place of which another may have come."""
        with self._lock:
            if of in (None, self.well):
                self._write({**self.settings, **settings})

    def _write(self, settings: dict[str, Any]) -> None:
        self.settings = settings
        write_whole(self.folder / "settings.json", json.dumps(settings).encode(), mode=PRIVATE)


class Sessions:
    """The sessions of a home folder."""

    def __init__(self, folder: Path) -> None:
        private_folder(folder)
        self._folder, self._lock, self._open = folder, threading.Lock(), dict[str, Session]()

    def get(self, key: str) -> Session | None:
        """A session by its key, None where there is none."""
        if not KEY.fullmatch(key):
            return None
        with self._lock:
            if key not in self._open and (self._folder / key).is_dir():
                self._open[key] = Session(self._folder / key)
            return self._open.get(key)

    def new(self, running: Collection[str] = ()) -> Session:
        """A new session; the oldest ones beyond ``MOST_SESSIONS`` are removed, those aside whose run is ``running``."""
        with self._lock:
            idle = [path for path in self._by_age() if path.name not in running]
            for old in idle[max(0, MOST_SESSIONS - 1 - len(running)) :]:
                self._open.pop(old.name, None)
                shutil.rmtree(old, ignore_errors=True)
            folder = self._folder / secrets.token_urlsafe(9)
            private_folder(folder)
            self._open[folder.name] = Session(folder)
            return self._open[folder.name]

    def newest(self) -> Session | None:
        """The session that was changed last, None without any."""
        found = self._by_age()
        return self.get(found[0].name) if found else None

    def folders(self) -> list[Path]:
        """The folders of all sessions."""
        return self._by_age()

    def _by_age(self) -> list[Path]:
        """Folders of the sessions, the one that was changed last first."""
        folders = [path for path in self._folder.iterdir() if KEY.fullmatch(path.name) and path.is_dir()]
        return sorted(folders, key=lambda path: path.stat().st_mtime, reverse=True)
