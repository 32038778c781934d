"""Numbered files of a folder, which a computation adds one after the other, each written whole or not at all.

A chunk is such a file with several parts, an archive in the format of zip, which has a checksum of each.
"""

import io
import os
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from zipfile import ZipFile, ZipInfo

from fctd.store.whole_file import write_whole

Parts = dict[str, bytes]


class Log:
    """The files ``HEAD N TAIL`` of a folder; digits : least number of them."""

    def __init__(self, folder: Path, head: str = "", tail: str = "", digits: int = 1) -> None:
        self.folder, self._head, self._tail, self._digits = folder, head, tail, digits

    @property
    def files(self) -> dict[int, Path]:
        """The files that are there, by their numbers, in their order."""
        found = {}
        with suppress(OSError):
            for name in os.listdir(self.folder):
                number = name.removeprefix(self._head).removesuffix(self._tail)
                if number.isdecimal() and name == f"{self._head}{number}{self._tail}":
                    found[int(number)] = self.folder / name
        return dict(sorted(found.items()))

    @property
    def following(self) -> int:
        """The number after the last one, 0 where there is none."""
        return max(self.files, default=-1) + 1

    def path(self, number: int) -> Path:
        """The file of a number."""
        return self.folder / f"{self._head}{number:0{self._digits}d}{self._tail}"

    def write(self, number: int, parts: Mapping[str, bytes]) -> None:
        """Write the chunk of a number, which outlasts a failure of power.  Raises OSError."""
        sink = io.BytesIO()
        with ZipFile(sink, "w") as archive:
            for name, content in parts.items():
                # Without the time, which may be before the first that zip knows.
                archive.writestr(ZipInfo(name), content)
        write_whole(self.path(number), sink.getvalue(), lasting=True)

    def drop_after(self, number: int) -> None:
        """Remove the files beyond a number."""
        for later, path in self.files.items():
            if later > number:
                path.unlink(missing_ok=True)


def read(chunk: Path, *names: str) -> Parts:
    """The parts of a chunk, or those of some names that it has.

    Raises OSError where it cannot be opened, and ValueError where it is damaged.
    """
    with chunk.open("rb") as file:
        try:
            archive = ZipFile(file)
            return {name: archive.read(name) for name in archive.namelist() if not names or name in names}
        except Exception as error:  # zipfile raises nearly anything
            raise ValueError(f"{chunk.name} is damaged: {error}") from error
