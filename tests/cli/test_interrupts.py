"""SIGTERM and SIGHUP end a program as Ctrl-C does: results so far are written, exit code 130, no temporary files."""

import ctypes
import os
import pty
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from importlib import import_module
from pathlib import Path
from typing import Any
from uuid import uuid4

import pytest

from fctd import open_result
from fctd.cli import chart, interrupts, refine, simulate
from fctd.cli.interrupts import as_interrupts, deferred, is_fctd
from fctd.store.run_folder import RunFolder
from tests.commands import HANG, Command

ROOT = Path(__file__).parents[2]
SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]
KILL = (signal.SIGTERM, signal.SIGHUP)


def sending(real: Callable[..., object], number: int, after: int) -> Callable[..., object]:
    """A command's function that gets a signal, twice, when it reports its progress."""
    assert threading.current_thread() is threading.main_thread()  # elsewhere the signal would end the tests

    def call(*arguments: object, progress: Callable[..., object], **more: object) -> object:
        calls = []

        def report(*values: object) -> None:
            progress(*values)
            calls.append(values)
            if len(calls) == after:
                os.kill(os.getpid(), number)

        return real(*arguments, progress=report, **more)

    return call


@pytest.mark.parametrize("number", SIGNALS)
def test_a_run_keeps_what_it_has(
    number: int, small_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    monkeypatch.setattr(simulate, "simulate", sending(simulate.simulate, number, 2))
    out = tmp_path / "out"
    printed = cli("simulate", small_file, "--out", out, "--set", "record.interval=1 s", "--quiet", code=130)
    result = open_result(out)
    assert (result.status, result.message) == ("interrupted", "at 2 s")
    assert list(result.history["time_s"]) == pytest.approx([1.0, 2.0])
    assert "interrupted: at 2 s" in printed.err


@pytest.mark.parametrize("number", SIGNALS)
@pytest.mark.parametrize("command", ["settling", "chart", "refine"])
def test_a_command_without_results_ends_without_files(
    command: str, number: int, small_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command,
) -> None:  # fmt: skip
    def settle(*_: object, **more: object) -> None:
        os.kill(os.getpid(), number)

    options = {
        "settling": ("simulate", small_file, "--out", tmp_path / "out", "--quiet"),
        "chart": ("chart", small_file, "--operation", "trip_in", "--depths", "700:750:10", "--out", tmp_path / "a.csv"),
        "refine": ("refine", small_file, "--out", tmp_path / "fine.toml"),
    }
    monkeypatch.setattr(sys.modules["fctd.simulation.simulate"], "settle", settle)
    monkeypatch.setattr(chart, "chart_rows", sending(chart.chart_rows, number, 2))
    monkeypatch.setattr(refine, "refine", sending(refine.refine, number, 1))
    assert "Traceback" not in cli(*options[command], code=130).err
    assert [path.name for path in tmp_path.iterdir()] == ["small.toml"]


@pytest.mark.parametrize("number", SIGNALS)
@pytest.mark.parametrize("method", ["take", "clear", "leave"])
def test_a_folder_in_which_nothing_has_begun_goes(
    method: str, number: int, small_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    """Whether the signal comes once it is locked or while it is emptied or removed."""
    real, sent = getattr(RunFolder, method), []

    def interrupted(*arguments: Any, **more: Any) -> Any:
        answer = None if method == "leave" else real(*arguments, **more)
        if not sent:
            sent.append(os.kill(os.getpid(), number))
        return real(*arguments, **more) if method == "leave" else answer

    monkeypatch.setattr(RunFolder, method, interrupted)
    table = tmp_path / "a.csv"
    cli("chart", small_file, "--operation", "trip_in", "--depths", "700", "--out", table, "--quiet", code=130)
    assert not (tmp_path / ".a.csv-run").exists()


@pytest.mark.parametrize("number", KILL)
def test_a_second_signal_does_not_stop_the_writing_of_results(
    number: int, small_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    """A terminal that closes sends SIGHUP from the system and from the shell."""
    save = simulate.SimulationResult.save

    def again(*arguments: object, **more: object) -> object:
        for each in KILL:
            os.kill(os.getpid(), each)
        return save(*arguments, **more)

    monkeypatch.setattr(simulate, "simulate", sending(simulate.simulate, number, 1))
    monkeypatch.setattr(simulate.SimulationResult, "save", again)
    cli("simulate", small_file, "--out", tmp_path / "out", "--quiet", code=130)
    assert open_result(tmp_path / "out").status == "interrupted"


@pytest.mark.parametrize("number", SIGNALS)
def test_a_signal_while_results_are_written_waits(
    number: int, small_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    """The results of a whole run are not lost because it is stopped in its last tenth of a second."""
    save = simulate.SimulationResult.save

    def stopped(*arguments: object, **more: object) -> object:
        os.kill(os.getpid(), number)
        return save(*arguments, **more)

    monkeypatch.setattr(simulate.SimulationResult, "save", stopped)
    printed = cli("simulate", small_file, "--out", tmp_path / "out", "--quiet", code=130)
    assert open_result(tmp_path / "out").status == "completed"
    assert "Written: " in printed.out
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith(".")] == []


@pytest.mark.slow
def test_results_are_written_after_the_terminal_has_closed(small_file: Path, tmp_path: Path) -> None:
    """With its bar and its tables on that terminal."""
    code = (
        "import os, signal, time\nfrom fctd.cli import main, simulate as cli\nreal = cli.simulate\n"
        "def simulate(*a, progress, **k):\n"
        "    def report(*v):\n"
        "        progress(*v)\n"
        "        os.write(1, b'going') if v[0] < 1.5 else None\n"
        "        time.sleep(3600) if v[0] > 1.5 else None\n"
        "    return real(*a, progress=report, **k)\n"
        "cli.simulate = simulate\nmain.main()\n"
    )
    leader, follower = pty.openpty()
    arguments = ["simulate", str(small_file), "--out", str(tmp_path / "out"), "--set", "record.interval=1 s"]
    started = subprocess.Popen(
        [sys.executable, "-c", code, *arguments], cwd=ROOT, stdin=follower, stdout=follower, stderr=follower,
        start_new_session=True, preexec_fn=lambda: os.close(os.open(os.ttyname(1), os.O_RDWR)),
    )  # fmt: skip
    os.close(follower)
    seen = b""
    while b"going" not in seen:
        seen += os.read(leader, 4096)
    os.close(leader)  # the system sends SIGHUP
    started.wait(HANG)
    assert open_result(tmp_path / "out").status == "interrupted"


class Finalized:
    """Its finalizer gets a signal, as those of compiled code do, which Python runs where it drops them."""

    def __init__(self, number: int) -> None:
        self.number = number

    def __del__(self) -> None:
        os.kill(os.getpid(), self.number)


def in_finalizer(number: int) -> None:
    Finalized(number)


def in_callback(number: int) -> None:
    """As LLVM calls the cache of numba."""
    ctypes.CFUNCTYPE(None)(lambda: os.kill(os.getpid(), number))()


def in_llvm_lock(number: int) -> None:
    """Its holder would never give it back."""
    from llvmlite.binding import ffi

    lock = ffi._LLVMLock()
    lock.register(lambda: os.kill(os.getpid(), number), lambda: None)
    try:
        with lock:
            pass
    finally:
        assert not lock._lock._is_owned()


def in_import(number: int) -> None:
    """Of a package that drops whatever is raised in one that it does not need."""
    with tempfile.TemporaryDirectory() as folder:
        needless, package = (Path(folder, f"{name}_{uuid4().hex}.py") for name in ("needless", "package"))
        needless.write_text(f"import os\nos.kill(os.getpid(), {int(number)})\n")
        package.write_text(f"try:\n    import {needless.stem}\nexcept BaseException:\n    pass\n")
        sys.path.insert(0, folder)
        try:
            import_module(package.stem)
        finally:
            sys.path.remove(folder)


def at_the_end(number: int) -> None:
    """Nothing comes after it."""
    in_llvm_lock(number)
    raise ZeroDivisionError


@pytest.mark.parametrize("number", SIGNALS)
@pytest.mark.parametrize("place", [in_finalizer, in_callback, in_llvm_lock, in_import, at_the_end])
def test_a_signal_is_not_lost(
    place: Callable[[int], None], number: int, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where Python drops an exception, it comes once more, a moment later; nothing is printed."""
    monkeypatch.setattr(sys, "unraisablehook", sys.__unraisablehook__)  # pytest has its own
    handlers = [signal.getsignal(each) for each in (*SIGNALS, signal.SIGALRM)]

    def go_on() -> None:
        with as_interrupts():
            place(number)
            end = time.monotonic() + 10.0
            while time.monotonic() < end:
                pass

    with pytest.raises(KeyboardInterrupt):
        go_on()
    assert capfd.readouterr().err == ""
    assert [signal.getsignal(each) for each in (*SIGNALS, signal.SIGALRM)] == handlers
    assert sys.unraisablehook is sys.__unraisablehook__


@pytest.mark.slow
def test_an_interrupted_command_ends_at_once(tmp_path: Path) -> None:
    """Whatever threads still do: the end of Python would take what they need away from them."""
    code = (
        "import os, signal, sys, threading, time\nimport fctd.__main__ as program, fctd.cli.schema as schema\n"
        "def check(*_):\n"
        "    threading.Thread(target=time.sleep, args=(3600,)).start()\n"
        "    os.kill(os.getpid(), signal.SIGINT); time.sleep(3600)\n"
        "schema.check_target = check\nprogram.main()\n"
    )
    arguments = ["schema", "--out", str(tmp_path / "s.json")]
    done = subprocess.run([sys.executable, "-c", code, *arguments], cwd=ROOT, capture_output=True, timeout=HANG)
    assert (done.returncode, done.stderr) == (130, b"")


@pytest.mark.parametrize(("block", "inside"), [(deferred, []), (as_interrupts, [signal.SIGTERM])])
def test_signals_that_the_caller_ignores_or_handles_stay_so(
    block: Callable[[], AbstractContextManager[None]], inside: list[int]
) -> None:
    """``nohup fctd …`` goes on when its terminal closes; where signals wait, the caller's handlers get them afterwards.

    inside : what its handlers have got when the block ends.
    """
    handled: list[int] = []
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN), signal.signal(signal.SIGTERM, lambda n, _: handled.append(n))
    try:
        with block():
            for number in KILL:
                os.kill(os.getpid(), number)
            assert handled == inside
        assert handled == [signal.SIGTERM]
        assert signal.getsignal(signal.SIGHUP) == signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, before[0])
        signal.signal(signal.SIGTERM, before[1])


def test_ctrl_c_stops_what_a_script_has_started_in_the_background() -> None:
    """Its shell has told the process to ignore Ctrl-C, and it does so again afterwards."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with pytest.raises(KeyboardInterrupt), as_interrupts():
            os.kill(os.getpid(), signal.SIGINT)
        assert signal.getsignal(signal.SIGINT) == signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, before)


@pytest.mark.slow
def test_a_run_in_the_background_of_a_script_keeps_what_it_has(small_file: Path, tmp_path: Path) -> None:
    """Stopped as scripts do."""
    out, going = tmp_path / "out", tmp_path / ".out-run" / "progress.json"
    run = f"'{sys.executable}' -m fctd simulate {small_file} --out {out} --set operations[0].duration=1e5 --quiet"
    script = f"{run} & until [ -e {going} ]; do sleep 0.1; done; kill -INT $!; wait $!"
    done = subprocess.run(["sh", "-c", script], cwd=ROOT, capture_output=True, text=True, timeout=HANG)
    assert done.returncode == 130, done.stderr
    assert open_result(out).status == "interrupted"


def test_afterwards_the_signals_are_the_systems_again() -> None:
    with pytest.raises(KeyboardInterrupt), as_interrupts():
        os.kill(os.getpid(), signal.SIGTERM)
    assert [signal.getsignal(number) for number in KILL] == [signal.SIG_DFL] * 2


def test_in_another_thread_nothing_is_changed() -> None:
    seen: list[object] = []

    def inside() -> None:
        with as_interrupts():
            seen.append(signal.getsignal(signal.SIGTERM))

    thread = threading.Thread(target=inside)
    thread.start()
    thread.join()
    assert seen == [signal.SIG_DFL]


IMPORTING = (
    "import os, signal, sys; sys.argv[0] = sys.argv[1]; ignored = sys.argv[3:]\n"
    "if ignored: signal.signal(signal.SIGINT, signal.SIG_IGN)\n"
    "import fctd.__main__; os.kill(os.getpid(), int(sys.argv[2]))"
)


@pytest.mark.slow
@pytest.mark.parametrize("number", SIGNALS)
@pytest.mark.parametrize("ignored", [[], ["as a script's shell does"]])
def test_between_the_imports_and_the_command(ignored: list[str], number: int) -> None:
    """While the package is imported and nothing has begun, a signal leaves no traceback."""
    arguments = ["/usr/bin/fctd.exe", str(int(number)), *ignored]
    done = subprocess.run([sys.executable, "-c", IMPORTING, *arguments], cwd=ROOT, capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


def ended(folder: Path, before: str, stdout: int | None = subprocess.PIPE) -> "subprocess.CompletedProcess[str]":
    """``fctd schema`` in a process that has done something before."""
    imports = "import atexit, os, signal, sys\nimport fctd.__main__ as program, fctd.cli.schema as schema\n"
    code = f"{imports}{before}\nprogram.main()\n"
    arguments = [sys.executable, "-c", code, "schema", "--out", str(folder / "s.json")]
    return subprocess.run(arguments, cwd=ROOT, stdout=stdout, stderr=subprocess.PIPE, text=True, timeout=HANG)


@pytest.mark.slow
@pytest.mark.parametrize("number", SIGNALS)
def test_a_signal_to_a_command_that_is_done_changes_nothing(number: int, tmp_path: Path) -> None:
    """The end of Python lasts a second, in which the system would answer."""
    done = ended(tmp_path, f"atexit.register(lambda: os.kill(os.getpid(), {int(number)}))")
    assert (done.returncode, done.stderr) == (0, "")
    assert "Written" in done.stdout


@pytest.mark.slow
def test_what_an_interrupted_command_had_half_begun_says_nothing(tmp_path: Path) -> None:
    """As Dask's cluster, which is to be closed before it has come up."""
    begun = "atexit.register(lambda: 1 / 0)\nschema.check_target = lambda *_: os.kill(os.getpid(), signal.SIGINT)"
    done = ended(tmp_path, begun)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


@pytest.mark.slow
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="the system has no file that is always full")
def test_output_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    with Path("/dev/full").open("w") as full:
        assert ended(tmp_path, "", full.fileno()).returncode not in (0, 130)


def test_an_alarm_may_come_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a busy machine the pause is over before the next line runs."""
    monkeypatch.setattr(signal, "setitimer", lambda *_: os.kill(os.getpid(), signal.SIGALRM))
    with pytest.raises(KeyboardInterrupt), as_interrupts():
        interrupts._again(signal.SIGINT)


@pytest.mark.parametrize(
    ("command", "ours"),
    [
        ("fctd", True),
        ("/usr/bin/fctd.exe", True),
        ("/lib/fctd/__main__.py", True),
        ("/home/a/fctd.py.d/x.py", False),
        ("", False),
    ],
)
def test_a_program_is_known_by_its_name(command: str, ours: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", [command])
    assert is_fctd() == ours


def test_other_programs_that_import_it_get_ctrl_c() -> None:
    program = IMPORTING.replace("fctd.__main__", "fctd")
    arguments = [sys.executable, "-c", program, "fctd", str(int(signal.SIGINT))]
    other = subprocess.run(arguments, cwd=ROOT, capture_output=True)
    assert b"KeyboardInterrupt" in other.stderr


@pytest.mark.parametrize("number", KILL)
def test_while_it_is_imported(number: int, tmp_path: Path) -> None:
    (tmp_path / "numba.py").write_text(f"import os\nos.kill(os.getpid(), {int(number)})\n")
    environment = os.environ | {"PYTHONPATH": f"{tmp_path}{os.pathsep}{ROOT}"}
    done = subprocess.run([sys.executable, "-m", "fctd"], env=environment, capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")
