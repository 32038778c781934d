"""Where a sweep runs: loopback sockets alone, schedulers of others, versions, and schedulers that are not there."""

import importlib.metadata
import os
from pathlib import Path

import pytest

from fctd.case.errors import InputError
from fctd.sweep import cluster
from fctd.sweep.cluster import Where, connected, encrypted, worker_count
from fctd.sweep.dataset import open_dataset
from fctd.sweep.run import sweep
from fctd.sweep.spec import read_sweep
from tests.sweep.made import sweep_file
from validation.parts import clusters

pytest.importorskip("distributed")


def test_a_local_sweep_listens_on_the_loopback_alone() -> None:
    psutil = pytest.importorskip("psutil")
    with connected(Where(workers=2)) as client:
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


@pytest.mark.slow
def test_a_scheduler_with_workers_of_its_own_runs_a_sweep(tmp_path: Path) -> None:
    spec = read_sweep(sweep_file(tmp_path))
    with clusters.cluster(tmp_path, workers=2) as dask:
        found = sweep(spec, tmp_path / "out", Where(scheduler_file=dask.file))
    assert (found.workers, found.rows) == (2, 48)
    sweep(spec, tmp_path / "local", Where(workers=1))
    assert open_dataset(tmp_path / "out").rows().equals(open_dataset(tmp_path / "local").rows())


@pytest.mark.slow
def test_workers_with_more_threads_than_one_are_refused(tmp_path: Path) -> None:
    with clusters.cluster(tmp_path, threads=2) as dask:
        expected = pytest.raises(InputError, match="workers with one thread each")
        with expected, connected(Where(scheduler_file=dask.file)):
            pass


def test_workers_of_another_version_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """The client, whose version is another than that of the workers, is this process."""
    from distributed import versions

    real = importlib.metadata.version
    monkeypatch.setattr(versions, "version", lambda name: "0.1" if name == "numba" else real(name))
    versions._version_cached.cache_clear()
    expected = pytest.raises(InputError, match=rf"{real('numba')}.*workers with numba 0\.1, as here")
    try:
        with expected, connected(Where(workers=1)):
            pass
    finally:
        versions._version_cached.cache_clear()


def test_a_scheduler_that_is_not_there_is_answered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "CONNECT", 1.0)
    for where, words in {
        Where(scheduler="tcp://127.0.0.1:9"): "a scheduler that answers within",
        Where(scheduler="nonsense://127.0.0.1:9"): "a scheduler that answers within",
        Where(scheduler_file=tmp_path / "none.json"): "the file that a running scheduler has written",
    }.items():
        with pytest.raises(InputError, match=words), connected(where):
            pass


@pytest.mark.slow
def test_a_scheduler_without_workers_is_answered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "WORKERS", 1.0)
    with clusters.cluster(tmp_path, workers=0) as dask:
        expected = pytest.raises(InputError, match="a scheduler with workers")
        with expected, connected(Where(scheduler_file=dask.file)):
            pass
