"""``fctd app``: it says where the page is, and ends with Ctrl-C."""

import re
import signal
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest

from tests.app.made import SURVEY, TEXT
from tests.commands import HANG, Command


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "survey.csv").write_bytes(SURVEY)
    (tmp_path / "well.toml").write_text(TEXT)
    return tmp_path


@pytest.mark.slow
def test_a_case_is_shown_until_ctrl_c(here: Path) -> None:
    command = [sys.executable, "-m", "fctd", "app", "well.toml", "--no-browser"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        match = re.fullmatch(r"The page: (http://127\.0\.0\.1:\d+/\S{32}/s/\S{12}/)\n", process.stdout.readline())
        assert match is not None
        with urllib.request.urlopen(match[1], timeout=HANG) as answer:
            assert answer.status == 200
        assert match[1].split("/")[3] not in Path(f"/proc/{process.pid}/cmdline").read_text()
    finally:
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=HANG)
    assert process.returncode == 0, said
    assert "Traceback" not in said
    left = {path.relative_to(here / "state" / "fctd" / "app").parts[0] for path in here.glob("state/fctd/app/*")}
    assert left == {"token", "port", "lock", "sessions"}
    for path in here.glob("state/fctd/app/**/*"):
        assert path.stat().st_mode & 0o777 == (0o700 if path.is_dir() else 0o600), path


def test_bad_input_is_refused(here: Path, monkeypatch: pytest.MonkeyPatch, cli: Command) -> None:
    (here / "well.toml").write_text(TEXT.replace('"survey.csv"', '"other.csv"'))
    assert "other.csv" in cli("app", "well.toml", code=2).err
    assert not (here / "state").exists()
    monkeypatch.setitem(sys.modules, "waitress", None)
    assert "the extra fctd[app]" in cli("app", code=2).err
