"""The folder of the app: this user's alone, with a token that lasts."""

import os
import stat
from pathlib import Path

import pytest

from fctd.app.home import FIRST_PORT, TOKEN, Home, private_folder, user_folder
from fctd.case.errors import InputError


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def test_folder_and_files_are_this_users_and_the_token_lasts(tmp_path: Path) -> None:
    folder = tmp_path / "state" / "app"
    folder.mkdir(parents=True)
    folder.chmod(0o755)
    home = Home.open(folder)
    assert TOKEN.fullmatch(home.token)
    assert home.port == FIRST_PORT
    home.port = 12345
    home.redirect_file("http://127.0.0.1:1/a&b/")
    assert "url=http://127.0.0.1:1/a&amp;b/" in (folder / "open.html").read_text()
    home.leave()
    assert mode(folder) == 0o700
    assert {mode(path) for path in folder.iterdir()} == {0o600}
    again = Home.open(folder)
    assert (again.token, again.port) == (home.token, 12345)
    assert again.new_token() != home.token
    again.leave()
    (folder / "token").write_text("short")
    (folder / "port").write_text("99999999")
    damaged = Home.open(folder)
    assert TOKEN.fullmatch(damaged.token)
    assert damaged.port == FIRST_PORT
    damaged.leave()


def test_one_process_serves_at_a_time(tmp_path: Path) -> None:
    home = Home.open(tmp_path / "app")
    with pytest.raises(InputError, match="no other fctd app"):
        Home.open(tmp_path / "app")
    home.leave()
    Home.open(tmp_path / "app").leave()


def test_a_folder_that_cannot_be_used_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("")
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "elsewhere")
    for name in ("file", "file/below", "link"):
        with pytest.raises(InputError, match="a folder that can be written"):
            Home.open(tmp_path / name)
    monkeypatch.setattr(os, "geteuid", lambda: 12345)
    with pytest.raises(PermissionError, match="another user"):
        private_folder(tmp_path / "elsewhere")


def test_the_users_folder_is_where_the_system_keeps_state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    assert user_folder() == tmp_path / "fctd" / "app"
