"""A result folder is the complete old one or the complete new one, also where the replacing process is killed."""

import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pyarrow.parquet as pq
import pytest

from fctd import open_result
from fctd.case.errors import InputError
from fctd.results.tables import TABLES, own_files
from fctd.store import whole_folder as whole_folder_module
from fctd.store.whole_folder import check_folder, whole_folder
from tests.killed_saves import FOREIGN, earlier, result
from tests.left_over import left_folders

ROOT = Path(__file__).parents[2]


def value(folder: Path) -> float:
    """The value of a whole result."""
    found = open_result(folder)
    values = {float(frame["value"].iloc[0]) for frame in (found.history, found.profile, found.energy)}
    (one,) = values
    return one


def check_foreign(folder: Path) -> None:
    """The user's own files are as they were."""
    assert {name: (folder / name).read_text() for name in FOREIGN} == FOREIGN
    assert (folder / "link").readlink() == Path("sub")


def test_a_new_result_takes_the_place_of_the_old_one(tmp_path: Path) -> None:
    folder = tmp_path / "new" / "out"
    earlier(folder)
    folder.chmod(0o750)
    assert {path.name for path in folder.glob("*.csv")} == {f"{name}.csv" for name in TABLES}
    assert result(2.0).save(folder) == [folder / f"{name}.parquet" for name in TABLES]
    assert value(folder) == 2.0
    check_foreign(folder)
    assert not list(folder.glob("*.csv"))  # those of the run before would lie beside tables of this one
    assert [path.name for path in folder.parent.iterdir()] == ["out"]
    assert folder.stat().st_mode & 0o777 == 0o750


@pytest.mark.slow
def test_killed_at_every_step_it_is_the_old_or_the_new_one(tmp_path: Path) -> None:
    """SIGKILL before every change of the file system, also while it is repaired."""
    done = subprocess.run([sys.executable, "-m", "tests.killed_saves", tmp_path], cwd=ROOT, capture_output=True)
    assert done.returncode == 0, done.stderr.decode()
    found, between = [], 0
    for base in sorted(tmp_path.iterdir(), key=lambda path: [int(part) for part in path.name.split("-")]):
        folder = base / "out"
        tables = [folder / f"{name}.parquet" for name in TABLES]
        seen = {pq.read_table(table)["value"][0].as_py() for table in tables if table.exists()}
        assert len(seen) <= 1, f"{base}: tables of two runs, before any repair"
        between += not folder.exists()
        found.append(value(folder))
        check_foreign(folder)
        assert [path.name for path in base.iterdir()] == ["out"], base
        csv = {f"{name}.csv" for name in TABLES} if found[-1] == 1.0 else set()
        assert {path.name for path in folder.glob("*.csv")} == csv, base
    assert set(found) == {1.0, 2.0}
    assert between >= 2
    assert len(found) > 60


def test_what_the_user_made_meanwhile_is_kept(tmp_path: Path) -> None:
    """Killed between the renames; then the user makes the folder again and writes notes into it."""
    folder = tmp_path / "out"
    new, old = left_folders(folder)
    earlier(old)
    result(2.0).save(new)
    folder.mkdir()
    (folder / "notes.txt").write_text("meanwhile")
    assert value(folder) == 2.0
    assert (folder / "notes.txt").read_text() == "meanwhile"
    assert (folder / "notes.txt.old").read_text() == FOREIGN["notes.txt"]
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_a_result_of_another_process_that_came_between_is_kept(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    new, old = left_folders(folder)
    earlier(old)
    result(2.0).save(new)
    result(3.0).save(folder)
    assert value(folder) == 3.0
    check_foreign(folder)
    assert not list(folder.glob("*.old"))
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_a_new_result_completes_what_a_killed_process_began(tmp_path: Path) -> None:
    new, old = left_folders(tmp_path / "out")
    earlier(old)
    result(2.0).save(new)
    result(3.0).save(tmp_path / "out")
    assert value(tmp_path / "out") == 3.0
    check_foreign(tmp_path / "out")
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


@pytest.mark.parametrize("name", [".out-run-2024", ".out-old-2024", ".out-2024.run", ".out-2024.old"])
def test_a_hidden_folder_of_the_users_stays(name: str, tmp_path: Path) -> None:
    (tmp_path / name).mkdir()
    (tmp_path / name / "notes.txt").write_text("mine")
    for number in (1.0, 2.0):
        result(number).save(tmp_path / "out")
        assert value(tmp_path / "out") == number
    assert (tmp_path / name / "notes.txt").read_text() == "mine"
    assert {path.name for path in tmp_path.iterdir()} == {"out", name}


def test_where_the_new_folder_is_lost_the_old_one_comes_back(tmp_path: Path) -> None:
    earlier(left_folders(tmp_path / "out")[1])
    assert value(tmp_path / "out") == 1.0
    check_foreign(tmp_path / "out")


def test_a_symlink_is_repaired_where_it_leads(tmp_path: Path) -> None:
    (tmp_path / "far").mkdir()
    new, old = left_folders(tmp_path / "far" / "real")
    earlier(old)
    result(2.0).save(new)
    (tmp_path / "out").symlink_to("far/real")
    assert value(tmp_path / "out") == 2.0
    check_foreign(tmp_path / "out")


def test_another_process_puts_its_own_between_the_two_renames(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder, rename = tmp_path / "out", os.rename
    earlier(folder)

    def meanwhile(source: Path, target: Path) -> None:
        rename(source, target)
        if Path(target).suffix == ".old":
            monkeypatch.setattr(os, "rename", rename)
            other = tmp_path / "other"
            result(3.0).save(other)
            rename(other, folder)

    monkeypatch.setattr(os, "rename", meanwhile)
    result(2.0).save(folder)
    assert value(folder) == 2.0
    check_foreign(folder)
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_what_the_user_keeps_waits_for_another_process_between_its_renames(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder, rename = tmp_path / "out", os.rename
    earlier(folder)

    def hidden(source: Path, target: Path) -> None:
        if Path(source).name == "notes.txt":
            monkeypatch.setattr(os, "rename", rename)
            rename(folder, tmp_path / "hidden")
        rename(source, target)

    monkeypatch.setattr(os, "rename", hidden)
    moment = SimpleNamespace(sleep=lambda _: rename(tmp_path / "hidden", folder))
    monkeypatch.setattr(whole_folder_module, "time", moment)
    result(2.0).save(folder)
    assert value(folder) == 2.0
    check_foreign(folder)
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_a_process_that_lives_is_left_alone(tmp_path: Path) -> None:
    earlier(tmp_path / "out")
    with whole_folder(tmp_path / "out", own_files) as writing:
        assert value(tmp_path / "out") == 1.0
        assert writing.is_dir()


@pytest.mark.parametrize("failure", [OSError(28, "No space left on device"), KeyboardInterrupt(), SystemExit(1)])
@pytest.mark.parametrize("moment", ["write", "rename"])
def test_a_failure_leaves_the_old_or_the_new_one(
    moment: str, failure: BaseException, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder, rename = tmp_path / "out", os.rename
    earlier(folder)

    def fail(*_: object) -> None:
        raise failure

    def fail_between(source: Path, target: Path) -> None:
        rename(source, target)
        if Path(target).suffix == ".old":
            monkeypatch.setattr(os, "rename", rename)
            raise failure

    monkeypatch.setattr(*((pq, "write_table", fail) if moment == "write" else (os, "rename", fail_between)))
    with pytest.raises((InputError, KeyboardInterrupt, SystemExit)) as caught:
        result(2.0).save(folder)
    if isinstance(failure, OSError):
        assert str(caught.value) == f'"{folder}": expected a folder that can be written (No space left on device)'
    assert value(folder) == (1.0 if moment == "write" else 2.0)
    check_foreign(folder)
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


@pytest.mark.parametrize("replaced", [True, False])
def test_where_the_swap_is_refused_the_message_says_where_the_files_are(
    replaced: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A folder of another user in /tmp may be written and not renamed."""
    folder, rename = tmp_path / "out", os.rename
    if replaced:
        earlier(folder)

    def refuse(source: Path, target: Path) -> None:
        if folder in (Path(source), Path(target)):
            raise PermissionError(1, "Operation not permitted")
        rename(source, target)

    monkeypatch.setattr(os, "rename", refuse)
    with pytest.raises(InputError) as caught:
        result(2.0).save(folder)
    kept = tmp_path / "out.new"
    assert f"a folder that can be renamed (Operation not permitted); the new files are in {kept}" in str(caught.value)
    assert value(kept) == 2.0
    assert not replaced or value(folder) == 1.0


def test_a_symlink_stays_one(tmp_path: Path) -> None:
    earlier(tmp_path / "real")
    (tmp_path / "out").symlink_to("real")
    result(2.0).save(tmp_path / "out")
    assert (tmp_path / "out").readlink() == Path("real")
    assert value(tmp_path / "real") == 2.0
    check_foreign(tmp_path / "out")


def test_what_cannot_be_moved_for_a_second_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder, rename = tmp_path / "out", os.rename
    earlier(folder)
    pauses: list[float] = []

    def vanish(source: Path, target: Path) -> None:
        if Path(source).name == "notes.txt":
            raise FileNotFoundError(2, "No such file or directory")
        rename(source, target)

    monkeypatch.setattr(whole_folder_module, "time", SimpleNamespace(sleep=pauses.append))
    with monkeypatch.context() as patched:
        patched.setattr(os, "rename", vanish)
        with pytest.raises(InputError, match="No such file or directory"):
            result(2.0).save(folder)
    assert sum(pauses) == pytest.approx(0.99)
    assert value(folder) == 2.0


@pytest.mark.parametrize("place", [".", "..", "~", "link", "/"])
def test_the_current_folder_is_not_replaced(place: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "around" / "here").mkdir(parents=True)
    (tmp_path / "home").mkdir()
    monkeypatch.chdir(tmp_path / "around" / "here")
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    Path("link").symlink_to(".")
    with pytest.raises(InputError) as caught:
        check_folder(Path(place).expanduser(), "--out")
    room = Path(place).expanduser()
    remedy = (room if os.access(room, os.W_OK) else Path()) / "result"  # only root may write to /
    assert f"expected a folder for the results alone, such as {remedy} (this one is or contains" in str(caught.value)
    assert check_folder(remedy).name == "result"


@pytest.mark.parametrize("mounted", ["out", "out/inside"])
def test_a_mount_point_is_refused(mounted: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "out" / "inside").mkdir(parents=True)
    monkeypatch.setattr(os.path, "ismount", lambda place: place == tmp_path / mounted)
    with pytest.raises(InputError, match=r"this one is or contains a mount point"):
        check_folder(tmp_path / "out")


def test_a_folder_in_one_that_cannot_be_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "out").mkdir()
    monkeypatch.setattr(os, "access", lambda place, mode: place != tmp_path)
    with pytest.raises(InputError, match=r"out/result \(beside this one nothing can be written: Permission denied\)"):
        check_folder(tmp_path / "out")
    with pytest.raises(InputError, match=r"a folder that can be written \(Permission denied\)"):
        check_folder(tmp_path / "new")
    assert check_folder(tmp_path / "out" / "result")


@pytest.mark.parametrize("name", ["x" * 250, "a/" + "x" * 300, "/".join(["x" * 200] * 30), "file", "file/out"])
def test_what_cannot_be_made_is_refused_before(name: str, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="a folder that can be written"):
        check_folder(tmp_path / name)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_a_csv_file_of_the_users_own_stays(tmp_path: Path) -> None:
    result(1.0).save(tmp_path / "out")
    (tmp_path / "out" / "profile.csv").write_text("my own")
    result(2.0).save(tmp_path / "out")
    assert (tmp_path / "out" / "profile.csv").read_text() == "my own"


def test_without_names_a_folder_is_replaced_with_all_that_is_in_it(tmp_path: Path) -> None:
    for name in ("old", "new"):
        with whole_folder(tmp_path / "out") as new:
            assert new.parent == tmp_path  # beside the old one until it is whole
            (new / name).mkdir()
            (new / name / "page.html").write_text(name)
    assert [str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*.*")] == ["out/new/page.html"]
