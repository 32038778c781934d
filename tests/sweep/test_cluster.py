"""Where a sweep runs: loopback sockets alone, schedulers of others, versions, and schedulers that are not there."""

import importlib.metadata
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
from contextlib import suppress
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import fctd
from fctd.case.errors import InputError
from fctd.sweep import cluster
from fctd.sweep.cluster import ClusterChoice, address_of, connected, encrypted, worker_count
from fctd.sweep.dataset import open_dataset
from fctd.sweep.run import sweep
from fctd.sweep.spec import read_sweep
from validation.parts import clusters
from validation.parts.small_sweep import sweep_file


@pytest.mark.slow
def test_a_local_sweep_listens_on_the_loopback_alone_and_its_workers_get_no_ctrl_c() -> None:
    import psutil

    with connected(ClusterChoice(workers=2)) as client:
        assert worker_count(client) == 2
        assert encrypted(client)
        here = psutil.Process(os.getpid())
        listening = [
            connection.laddr
            for process in (here, *here.children(recursive=True))
            for connection in process.net_connections(kind="inet")
            if connection.status == psutil.CONN_LISTEN
        ]
        ports = {port for _, port in listening}
        dashboard = int(client.dashboard_link.rsplit(":", 1)[1].split("/")[0])
        scheduler = int(client.scheduler.address.rsplit(":", 1)[1])
        assert {dashboard, scheduler} <= ports
        assert len(ports) >= 4  # of two workers and their nannies, too
        assert {address for address, _ in listening} == {"127.0.0.1"}
        # A terminal sends Ctrl-C to the workers too, who would each print a traceback.
        assert all(signal.SIGINT in held for held in client.run(signal.pthread_sigmask, signal.SIG_BLOCK, []).values())
        assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])


@pytest.mark.slow
def test_a_scheduler_with_workers_of_its_own_runs_a_sweep(tmp_path: Path) -> None:
    spec = read_sweep(sweep_file(tmp_path))
    with clusters.cluster(tmp_path, workers=2) as dask:
        found = sweep(spec, tmp_path / "out", ClusterChoice(scheduler_file=dask.file))
    assert (found.workers, found.rows) == (2, 48)
    sweep(spec, tmp_path / "local", ClusterChoice(workers=1))
    assert open_dataset(tmp_path / "out").rows().equals(open_dataset(tmp_path / "local").rows())


@pytest.mark.slow
def test_workers_with_more_threads_than_one_are_refused(tmp_path: Path) -> None:
    with clusters.cluster(tmp_path, threads=2) as dask:
        expected = pytest.raises(InputError, match="workers with one thread each")
        with expected, connected(ClusterChoice(scheduler_file=dask.file)):
            pass


@pytest.mark.slow
def test_workers_of_another_version_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """The client, whose version is another than that of the workers, is this process."""
    from distributed import versions

    real = importlib.metadata.version
    monkeypatch.setattr(versions, "version", lambda name: "0.1" if name == "numba" else real(name))
    versions._version_cached.cache_clear()
    expected = pytest.raises(InputError, match=rf"{real('numba')}.*workers with numba 0\.1, as here")
    try:
        with expected, connected(ClusterChoice(workers=1)):
            pass
    finally:
        versions._version_cached.cache_clear()


@pytest.mark.slow
def test_workers_with_other_sources_are_refused(tmp_path: Path) -> None:
    """A copy of the program in which gravity is 9, of the same version."""
    copy = shutil.copytree(Path(fctd.__file__).parent, tmp_path / "other" / "fctd")
    for source in copy.rglob("topdrive.py"):
        text = source.read_text(encoding="utf-8")
        source.write_text(re.sub(r"^(GRAVITY\b[^=]*= )[\d.]+", r"\g<1>9.0", text, flags=re.MULTILINE), encoding="utf-8")
    with clusters.cluster(tmp_path, program=copy.parent) as dask:
        expected = pytest.raises(InputError, match="workers whose fctd has the sources of the one here")
        with expected, connected(ClusterChoice(scheduler_file=dask.file)):
            pass


@pytest.mark.slow
def test_rows_of_other_sources_are_refused_whoever_sent_them(tmp_path: Path) -> None:
    """As of a worker that joined later, and was not asked."""
    preload = tmp_path / "other.py"
    preload.write_text("from fctd.sweep import chunk\nchunk.hash_of_sources = lambda: 'other'\n", encoding="utf-8")
    with clusters.cluster(tmp_path, preload=preload) as dask:
        expected = pytest.raises(InputError, match='a worker = "other": expected workers whose fctd has the sources')
        with expected:
            sweep(read_sweep(sweep_file(tmp_path)), tmp_path / "out", ClusterChoice(scheduler_file=dask.file))
    assert open_dataset(tmp_path / "out").done == set()


def test_a_scheduler_that_is_not_there_is_answered(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "CONNECT", 1.0)
    where = ClusterChoice(scheduler="tcp://127.0.0.1:9")
    with pytest.raises(InputError, match="a scheduler that answers within"), connected(where):
        pass


@pytest.mark.parametrize(
    ("address", "expected"),
    [
        ("tls://10.0.0.5:8786", True),
        ("tcp://127.0.0.1:8786", True),
        ("tcp://[::1]:8786", True),
        ("inproc://10.0.0.5/1/1", True),
        ("tcp://10.0.0.5:8786", False),
        ("tcp://127.0.0.1.example.org:8786", False),
        ("ws://10.0.0.5:8786", False),
    ],
)
def test_only_tls_and_this_machine_itself_need_no_warning(address: str, expected: bool) -> None:
    client: Any = SimpleNamespace(scheduler=SimpleNamespace(address=address))
    assert encrypted(client) == expected


def test_without_a_scheduler_nothing_is_encrypted() -> None:
    client: Any = SimpleNamespace(scheduler=None)
    assert not encrypted(client)


@pytest.mark.parametrize("answer", [b"", b"HTTP/1.0 400 Bad Request\r\n\r\n"])
def test_a_port_of_another_program_is_answered(answer: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    """Dask's own client waits for ever there."""
    monkeypatch.setattr(cluster, "CONNECT", 1.0)
    with socket.create_server((cluster.LOOPBACK, 0)) as server:

        def accept() -> None:
            with suppress(OSError):
                while True:
                    held.append(server.accept()[0])
                    held[-1].sendall(answer)

        held: list[socket.socket] = []
        threading.Thread(target=accept, daemon=True).start()
        where = ClusterChoice(scheduler=f"tcp://{cluster.LOOPBACK}:{server.getsockname()[1]}")
        with pytest.raises(InputError, match=r"answers within 1 s .another program answers"), connected(where):
            pass
        server.shutdown(socket.SHUT_RDWR)
    for one in held:
        one.close()


FILES = (Path("ca.pem"), Path("me.pem"), Path("key.pem"))


@pytest.mark.parametrize(
    ("address", "tls", "words"),
    [
        ("nonsense://127.0.0.1:9", None, "a scheduler's address such as tcp://host:8786"),
        ("tcp://127.0.0.1", None, "a scheduler's address"),
        ("tcp://127.0.0.1:0", None, "a scheduler's address"),
        ("tcp://127.0.0.1:65536", None, "a scheduler's address"),
        ("", None, "a scheduler's address"),
        ("tls://127.0.0.1:9", None, "--tls-ca, --tls-cert and --tls-key beside"),
        ("tcp://127.0.0.1:9", FILES, "an address that begins with tls://"),
    ],
)
def test_an_address_that_cannot_be_one_is_answered_at_once(
    address: str, tls: tuple[Path, Path, Path] | None, words: str, tmp_path: Path
) -> None:
    (tmp_path / "cluster.json").write_text(json.dumps({"address": address}))
    for where in (
        ClusterChoice(scheduler=address, tls=tls),
        ClusterChoice(scheduler_file=tmp_path / "cluster.json", tls=tls),
    ):
        with pytest.raises(InputError, match=re.escape(words)):
            address_of(where)


@pytest.mark.parametrize("content", [None, "junk", "[]", "{}", "5", "\x00", pytest.param("[" * 100_000, id="deep")])
def test_a_file_that_no_scheduler_wrote_is_answered(content: str | None, tmp_path: Path) -> None:
    if content is not None:
        (tmp_path / "cluster.json").write_text(content)
    with pytest.raises(InputError, match="the file that a running scheduler has written"):
        address_of(ClusterChoice(scheduler_file=tmp_path / "cluster.json"))


@pytest.mark.parametrize("place", ["/dev/zero", "pipe"])
def test_a_device_or_a_pipe_is_refused_at_once(place: str, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match=r"--scheduler-file = .*: expected a regular file \(this is a pipe"):
        address_of(ClusterChoice(scheduler_file=tmp_path / place))


@pytest.mark.slow
def test_a_sweep_runs_on_an_encrypted_cluster(tmp_path: Path) -> None:
    """The commands of the guide, with certificates of our own; no warning."""
    if shutil.which("openssl") is None:
        pytest.skip("openssl, which makes the certificates, is not installed")
    at = certificates(tmp_path)
    sweep_file(tmp_path)
    tls = ["--tls-ca-file", at["ca"], "--tls-cert", at["cert"], "--tls-key", at["key"]]
    own = ["--tls-ca", at["ca"], "--tls-cert", at["cert"], "--tls-key", at["key"]]
    with clusters.cluster(tmp_path, tls=tls) as dask:
        command = ["sweep", tmp_path / "sweep.toml", "--out", tmp_path / "out", "--scheduler-file", dask.file, *own]
        ended = subprocess.run([sys.executable, "-m", "fctd", *command], capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stderr
    assert "12 samples; 48 rows" in ended.stdout
    assert "warning" not in ended.stderr


def certificates(folder: Path) -> dict[str, Path]:
    """Files of an authority, and of a certificate that it has signed with its key."""
    at = {name: folder / f"{name}.pem" for name in ("ca", "ca-key", "cert", "key", "request")}

    def openssl(*arguments: object) -> None:
        subprocess.run(["openssl", *map(str, arguments)], check=True, capture_output=True)

    new = "-newkey", "rsa:2048", "-nodes"
    openssl("req", "-x509", *new, "-subj", "/CN=authority", "-days", 2, "-keyout", at["ca-key"], "-out", at["ca"])
    openssl("req", *new, "-subj", "/CN=sweep", "-keyout", at["key"], "-out", at["request"])
    signed = "-CA", at["ca"], "-CAkey", at["ca-key"], "-set_serial", 1, "-days", 2
    openssl("x509", "-req", "-in", at["request"], *signed, "-out", at["cert"])
    return at


@pytest.mark.slow
def test_a_scheduler_without_workers_is_answered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "WORKERS", 1.0)
    with clusters.cluster(tmp_path, workers=0) as dask:
        expected = pytest.raises(InputError, match="a scheduler with workers")
        with expected, connected(ClusterChoice(scheduler_file=dask.file)):
            pass
