"""Numbered files and chunks: what is read back is what was written, or nothing."""

from contextlib import suppress
from pathlib import Path

import pytest

from fctd.store.log import Log, read

PARTS = {"history.parquet": bytes(range(256)) * 8, "facts.json": b'{"a": 1}', "empty": b""}


@pytest.fixture
def log(tmp_path: Path) -> Log:
    return Log(tmp_path, tail="-chunk.zip")


def test_files_are_numbered_in_order(log: Log) -> None:
    assert (log.files, log.following) == ({}, 0)
    for name in ("x-chunk.zip", "9-chunk.zip.bak", ".11-chunk.zip", "12-chunk", "-chunk.zip"):
        (log.folder / name).touch()
    for number in (10, 9, 1):
        log.write(number, PARTS)
    assert list(log.files.items()) == [(number, log.path(number)) for number in (1, 9, 10)]
    assert log.following == 11
    log.drop_after(1)
    assert list(log.files) == [1]
    parts = Log(log.folder, "part-", ".parquet", digits=5)
    for name in ("part-00007.parquet", "part-123456.parquet"):
        (log.folder / name).touch()
    assert list(parts.files) == [7, 123456]
    assert parts.path(8).name == "part-00008.parquet"
    assert Log(log.folder / "none").files == {}


def test_parts_are_read_back_all_or_by_name(log: Log) -> None:
    log.write(1, PARTS)
    assert read(log.path(1)) == PARTS
    assert read(log.path(1), "facts.json", "none") == {"facts.json": PARTS["facts.json"]}


def test_a_chunk_is_read_whole_or_not_at_all(log: Log) -> None:
    """Every byte that is changed is noticed, or changes nothing; so is every end that is cut off."""
    log.write(1, PARTS)
    path = log.path(1)
    whole = path.read_bytes()
    damaged = [whole[:k] + bytes([whole[k] ^ 0x55]) + whole[k + 1 :] for k in range(0, len(whole), 3)]
    for content in (*damaged, *(whole[:k] for k in range(0, len(whole), 50))):
        path.write_bytes(content)
        with suppress(ValueError):
            assert read(path) == PARTS
    path.write_bytes(whole[:-1])
    with pytest.raises(ValueError, match=r"^1-chunk\.zip is damaged"):
        read(path)
    path.unlink()
    with pytest.raises(FileNotFoundError):
        read(path)
