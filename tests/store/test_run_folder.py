"""The folder of an unfinished run: who may write there, what is in it, what is left of it."""

import errno
import json
import os
from pathlib import Path
from unittest.mock import Mock

import pytest

from fctd.case.errors import InputError
from fctd.store.run_folder import (
    KEYS,
    RunFolder,
    RunProgress,
    about_of,
    chunks_of,
    progress_of,
    run_path,
    writer_of,
)

ABOUT = dict.fromkeys(KEYS, "") | {"program": "fctd simulate"}


def test_a_second_run_is_refused_with_the_number_of_the_first(tmp_path: Path) -> None:
    target = tmp_path / "new" / "out"
    folder = RunFolder.take(target)
    assert folder.path == tmp_path / "new" / ".out-run"
    with pytest.raises(InputError, match=f"no other run writes to \\(process {os.getpid()} does, since 20") as refused:
        RunFolder.take(target, "--out")
    assert (refused.value.key, refused.value.value) == ("--out", target)
    writer = writer_of(target)
    assert writer is not None
    assert writer.process == os.getpid()
    folder.leave(remove=True)
    assert list((tmp_path / "new").iterdir()) == []
    assert writer_of(target) is None


def test_a_full_disk_leaves_no_folder(tmp_path: Path) -> None:
    resource = pytest.importorskip("resource")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1, hard))
    try:
        with pytest.raises(InputError, match=r"--out = .*beside which the run can be kept"):
            RunFolder.take(tmp_path / "out", "--out")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert list(tmp_path.iterdir()) == []


def test_a_hidden_folder_of_the_users_stays(tmp_path: Path) -> None:
    """Named as that of a run: it is refused, and nothing in it is removed."""
    (tmp_path / ".out-run").mkdir()
    (tmp_path / ".out-run" / "notes.txt").write_text("mine")
    with pytest.raises(
        InputError, match=r'--out = .*out": expected another place \(.*\.out-run, and that folder holds files of others'
    ):
        RunFolder.take(tmp_path / "out", "--out")
    assert [path.read_text() for path in (tmp_path / ".out-run").iterdir()] == ["mine"]


def test_what_is_described_is_there_until_it_is_cleared(tmp_path: Path) -> None:
    target = tmp_path / "out"
    assert about_of(target) is None
    folder = RunFolder.take(target)
    chunks_of(folder.path).write(3, {})
    folder.describe(ABOUT, {"survey.csv": b"0,0,0"})
    assert about_of(target) == ABOUT
    assert (folder.path / "survey.csv").read_bytes() == b"0,0,0"
    assert chunks_of(folder.path).files == {}  # of an earlier run
    folder.leave(remove=False)
    assert about_of(target) == ABOUT
    folder = RunFolder.take(target)
    folder.clear()
    assert about_of(target) is None
    assert os.listdir(folder.path) == ["lock"]
    folder.leave(remove=True)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("{", "the description of a run"),
        ("[]", "the description of a run"),
        ('{"form": 2}', "the description of a run"),
        (json.dumps(ABOUT), r"an unfinished run of this version.*go on with the version that began it, or .*--restart"),
    ],
    ids=["cut", "no table", "lacking", "of the release before"],
)
def test_a_description_that_another_program_or_version_wrote(text: str, expected: str, tmp_path: Path) -> None:
    (tmp_path / ".out-run").mkdir()
    (tmp_path / ".out-run" / "run.json").write_text(text)
    with pytest.raises(InputError, match=expected):
        about_of(tmp_path / "out")


def test_the_progress_is_read_back_or_none(tmp_path: Path) -> None:
    folder = RunFolder.take(tmp_path / "out")
    assert progress_of(tmp_path / "out") is None
    progress = RunProgress(1.5, 3.0, "s", 1.0, 60.0, 1e9)
    folder.report(progress)
    assert progress_of(tmp_path / "out") == progress
    (folder.path / "progress.json").write_text("[1]")  # as the release before did
    assert progress_of(tmp_path / "out") is None
    folder.leave(remove=True)


def test_a_link_leads_to_the_folder_of_what_it_names(tmp_path: Path) -> None:
    (tmp_path / "far").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "far" / "out")
    assert run_path(tmp_path / "link") == tmp_path / "far" / ".out-run"


@pytest.mark.parametrize(("there", "reason"), [("file", "File exists"), ("nothing", "Permission denied")])
def test_where_nothing_can_be_kept(there: str, reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file in the way, and a folder that may only be read."""
    if there == "file":
        (tmp_path / ".out-run").write_text("")
    else:  # the superuser may write everywhere
        monkeypatch.setattr(Path, "mkdir", Mock(side_effect=PermissionError(errno.EACCES, reason)))
    with pytest.raises(InputError, match=rf"a place beside which the run can be kept \({reason}"):
        RunFolder.take(tmp_path / "out", "--out")
