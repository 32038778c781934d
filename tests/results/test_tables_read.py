"""Results that are read: whole ones of one run, and what is no result."""

import os
from pathlib import Path

import pandas as pd
import pytest

from fctd import open_result
from fctd.case.errors import InputError
from fctd.results import tables
from fctd.results.tables import TABLES
from tests.killed_saves import earlier, result
from tests.store.test_whole_folder import value


def test_tables_of_two_runs_are_not_read(tmp_path: Path) -> None:
    result(1.0).save(tmp_path / "out")
    result(2.0).save(tmp_path / "other")
    (tmp_path / "other" / "energy.parquet").replace(tmp_path / "out" / "energy.parquet")
    with pytest.raises(InputError) as caught:
        open_result(tmp_path / "out", pause=0.0)
    assert str(tmp_path / "out") in str(caught.value)
    assert "expected tables of one run, found those of several" in str(caught.value)
    assert "simulate the case again" in str(caught.value)


def test_a_result_that_is_replaced_while_it_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The tables read are all of the same run: the old one's are gone by then, and the new one is read."""
    folder, read = tmp_path / "out", tables.read_table
    earlier(folder)

    def replaced(source: object) -> object:
        monkeypatch.setattr(tables, "read_table", read)
        table = read(source)
        result(2.0).save(folder)
        return table

    monkeypatch.setattr(tables, "read_table", replaced)
    assert value(folder) == 2.0


@pytest.mark.parametrize("name", ["missing", "file"])
def test_what_is_no_folder_is_no_result(name: str, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(InputError) as caught:
        open_result(tmp_path / name, pause=0.0)
    assert str(tmp_path / name) in str(caught.value)
    assert "that fctd simulate wrote" in str(caught.value)


def test_a_result_is_read_as_it_was_saved(tmp_path: Path) -> None:
    saved = result(1.5)
    saved.save(tmp_path / "out")
    read = open_result(str(tmp_path / "out"))  # a folder may be given as a text
    for name in TABLES:
        pd.testing.assert_frame_equal(getattr(read, name), getattr(saved, name))
    assert (read.case, read.status, read.message, read.run, read.identity) == (
        saved.case, saved.status, saved.message, saved.run, saved.identity,
    )  # fmt: skip


@pytest.mark.parametrize("name", ["history", "profile", "energy"])
@pytest.mark.parametrize("damage", ["missing", "cut", "text", "pipe"])
def test_a_damaged_result_is_named(damage: str, name: str, tmp_path: Path) -> None:
    result(1.0).save(tmp_path / "out")
    path = tmp_path / "out" / f"{name}.parquet"
    content = path.read_bytes()
    path.unlink()
    if damage == "cut":
        path.write_bytes(content[: len(content) // 2])
    elif damage == "text":
        path.write_text("not a table")
    elif damage == "pipe":
        os.mkfifo(path)
    with pytest.raises(InputError) as caught:
        open_result(tmp_path / "out", pause=0.0)
    assert str(path) in str(caught.value)


def test_a_table_of_another_origin_is_no_result(tmp_path: Path) -> None:
    for name in TABLES:
        pd.DataFrame({"a": [1]}).to_parquet(tmp_path / f"{name}.parquet")
    with pytest.raises(InputError, match="the metadata that fctd simulate writes"):
        open_result(tmp_path, pause=0.0)
