"""Sessions: kept in files, found by their keys alone, at most so many."""

import os
from pathlib import Path

import pytest

from fctd.app.sessions import KEY, MOST_SESSIONS, Sessions, Source
from tests.app.made import source


def test_a_session_is_what_it_was_after_a_restart(tmp_path: Path) -> None:
    session = Sessions(tmp_path).new()
    assert session.source is None
    assert session.measured == ""
    session.put(source())
    session.keep(values={"mud": 1300}, measured="rows")
    again = Sessions(tmp_path).get(session.key)
    assert again is not None
    assert again.source == source()
    assert again.source.digest == source().digest != Source("x").digest
    assert again.settings["values"] == {"mud": 1300}
    assert again.measured == "rows"
    well = again.well
    assert well == session.well != ""
    again.put(Source("name = 1"))  # another case has neither sliders nor rows of the one before
    assert (again.settings, again.measured) == ({"survey": "", "well": again.well}, "")
    again.keep(well, values={"mud": 1300})
    assert "values" not in again.settings
    assert {path.stat().st_mode & 0o777 for path in (tmp_path / session.key).iterdir()} == {0o600}
    assert (tmp_path / session.key).stat().st_mode & 0o777 == 0o700


@pytest.mark.parametrize("key", ["", ".", "..", "../../etc", "a" * 12, "a/../../etcx", "..........", "\0" * 12])
def test_no_other_folder_is_a_session(key: str, tmp_path: Path) -> None:
    (tmp_path / "etc").mkdir()
    assert Sessions(tmp_path / "sessions").get(key) is None


def test_damaged_settings_are_none(tmp_path: Path) -> None:
    session = Sessions(tmp_path).new()
    for text in ("[1]", "{", "\xff"):
        (tmp_path / session.key / "settings.json").write_bytes(text.encode("latin-1"))
        again = Sessions(tmp_path).get(session.key)
        assert again is not None
        assert again.settings == {}


def test_the_oldest_sessions_go(tmp_path: Path) -> None:
    sessions, keys = Sessions(tmp_path), list[str]()
    assert sessions.newest() is None
    for k in range(MOST_SESSIONS + 2):
        keys.append(sessions.new().key)
        os.utime(tmp_path / keys[-1], (k, k))
    assert all(KEY.fullmatch(key) for key in keys)
    assert {path.name for path in sessions.folders()} == set(keys[2:])
    newest = sessions.newest()
    assert newest is not None
    assert newest.key == keys[-1]
    assert sessions.get(keys[0]) is None


def test_a_session_whose_run_goes_on_stays(tmp_path: Path) -> None:
    sessions = Sessions(tmp_path)
    first = sessions.new().key
    os.utime(tmp_path / first, (0, 0))
    for _ in range(MOST_SESSIONS + 5):
        sessions.new({first})
    assert sessions.get(first) is not None
    assert len(sessions.folders()) == MOST_SESSIONS
    sessions.new()
    assert sessions.get(first) is None
