"""Logos: what is drawn, and what is refused with one message."""

import io
import os
import struct
import zlib
from pathlib import Path

import pytest

from fctd.case.errors import InputError
from fctd.report.logo import KEPT, LARGEST, read_logo

Image = pytest.importorskip("PIL.Image")


def picture(size: tuple[int, int], suffix: str) -> bytes:
    content = io.BytesIO()
    Image.new("RGB", size, "red").save(content, suffix)
    return content.getvalue()


def bomb() -> bytes:
    """The head of a PNG that would be 10 GB in memory."""
    head = b"IHDR" + struct.pack(">IIBBBBB", 50_000, 50_000, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + head + struct.pack(">I", zlib.crc32(head))


@pytest.mark.parametrize("suffix", ["PNG", "JPEG"])
def test_a_picture_is_kept_small(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / "logo"
    path.write_bytes(picture((2 * KEPT, KEPT), suffix))
    with Image.open(io.BytesIO(read_logo(path))) as kept:
        assert (kept.format, kept.size) == ("PNG", (KEPT, KEPT // 2))


@pytest.mark.parametrize(
    "content",
    [b"", b"no picture", picture((50, 50), "PNG")[:-40], picture((50, 50), "JPEG")[:300], picture((9, 9), "GIF"),
     picture((4001, 1), "PNG"), bomb(), b"\x89PNG" + bytes(LARGEST)],
    ids=["empty", "text", "cut", "cut JPEG", "GIF", "wide", "bomb", "large"],
)  # fmt: skip
def test_what_is_none_is_refused(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "logo.png"
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"--logo = .*logo\.png.: expected a PNG or JPEG of at most 4 MiB"):
        read_logo(path)


def test_a_missing_file_or_a_folder_is_refused(tmp_path: Path) -> None:
    for path in (tmp_path / "none.png", tmp_path):
        with pytest.raises(InputError, match="that can be read"):
            read_logo(path)


@pytest.mark.parametrize("place", ["/dev/zero", "pipe"])
def test_a_device_or_a_pipe_is_refused_at_once(place: str, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match=r"--logo = .*: expected a regular file \(this is a pipe"):
        read_logo(tmp_path / place)
