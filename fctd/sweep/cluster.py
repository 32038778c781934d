"""Where a sweep runs: workers of this machine, or a cluster of Dask's that is there.

The workers of this machine and their scheduler listen on 127.0.0.1 alone.
"""

from __future__ import annotations

import asyncio
import json
import logging
import re
import signal
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing import resource_tracker
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from fctd.case.errors import InputError
from fctd.case.input_file import LARGEST_FILE, check_regular, read_text
from fctd.mechanics.compile_cache import hash_of_sources
from fctd.store.limits import cores

if TYPE_CHECKING:
    from distributed import Client

LOOPBACK: Final = "127.0.0.1"
# Waiting for a scheduler, and for the first of its workers [s].
CONNECT, WORKERS = 10.0, 60.0
ADDRESS: Final = re.compile(r"(?P<protocol>tcp://|tls://|)[\w.:\[\]-]+:(?P<port>\d{1,5})")
TALKERS: Final = ("asyncio", "distributed", "distributed.client", "tornado.application")
PACKAGES: Final = ("fctd", "numba", "numpy", "python")


@dataclass(frozen=True)
class ClusterChoice:
    """Local workers, by default one a core; or the address of a scheduler, or the file that it wrote.

    tls : files of certificate authority, certificate and key, or None.
    """

    workers: int | None = None
    scheduler: str | None = None
    scheduler_file: Path | None = None
    tls: tuple[Path, Path, Path] | None = None

    @property
    def local(self) -> bool:
        """Whether the workers are this machine's own."""
        return self.scheduler is None and self.scheduler_file is None


@contextmanager
def connected(choice: ClusterChoice) -> Iterator[Client]:
    """A client with at least one worker; local ones end with it.

    Raises InputError where Dask is missing, where no scheduler or worker answers, and where a worker has other versions
    of Python, numpy, numba or this program, or other sources of it.
    """
    try:
        import distributed
    except ModuleNotFoundError as error:
        expected = f"the package {error.name} (pip install 'fctd[sweep]')"
        raise InputError(expected, key="sweep", value="distributed") from None
    with warnings.catch_warnings():
        # We compare versions ourselves; the other says where the dashboard is when its usual port is taken.
        warnings.simplefilter("ignore", distributed.versions.VersionMismatchWarning)
        with _local(choice) if choice.local else _joined(choice) as client:
            check_workers(client)
            yield client


@contextmanager
def _local(choice: ClusterChoice) -> Iterator[Client]:
    import dask
    from distributed import Client, LocalCluster

    settings = {
        "distributed.scheduler.allowed-failures": 0,  # a chunk whose worker dies comes back to us at once
        # A worker that dies is started again.  After this time the cluster would take it away for good, if another one
        # were starting just then.
        "distributed.deploy.lost-worker-timeout": "1 week",
    }
    with dask.config.set(settings):
        with _deaf():
            cluster = LocalCluster(
                n_workers=choice.workers or cores(), threads_per_worker=1, processes=True, host=LOOPBACK,
                dashboard_address=f"{LOOPBACK}:0", silence_logs=logging.CRITICAL,
            )  # fmt: skip
        with cluster, Client(cluster) as client:
            yield client


@contextmanager
def _deaf() -> Iterator[None]:
    """Threads and processes that begin inside, and those that they start, get no Ctrl-C; here it waits for the end.

    A terminal sends Ctrl-C to all processes, and each worker would print its traceback.  The client ends them.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    resource_tracker.ensure_running()  # where it starts later, it unblocks the signal
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _joined(choice: ClusterChoice) -> Iterator[Client]:
    from distributed import Client

    for name in TALKERS:
        logging.getLogger(name).setLevel(logging.CRITICAL)  # a lost scheduler is told in our words
    key = "--scheduler" if choice.scheduler is not None else "--scheduler-file"
    value: Any = choice.scheduler or choice.scheduler_file
    address, security = address_of(choice), _security(choice)
    try:
        asyncio.run(_greet(address, security))
        client = Client(address, timeout=CONNECT, security=security, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise InputError(f"a scheduler that answers within {CONNECT:g} s ({reason})", key=key, value=value) from None
    with client:
        try:
            client.wait_for_workers(1, timeout=WORKERS)
        except TimeoutError:
            expected = f"a scheduler with workers (none came within {WORKERS:g} s)"
            raise InputError(expected, key=key, value=value) from None
        yield client


async def _greet(address: str, security: Any) -> None:
    """Raise OSError where no scheduler greets: Dask's client waits for ever at a port of another program."""
    from distributed.comm.core import connect
    from distributed.security import Security

    options = (security or Security()).get_connection_args("client")
    try:
        comm = await asyncio.wait_for(connect(address, timeout=CONNECT, **options), CONNECT + 1.0)
    except (TimeoutError, MemoryError):  # no answer, or one whose first bytes are no length
        raise OSError("another program answers there, or none") from None
    comm.abort()


def address_of(choice: ClusterChoice) -> str:
    """The address of the scheduler that is named or has written the file.

    Raises InputError for another text or file, and for an address that is encrypted without files of TLS, or is not
    with them: Dask's own client answers those with errors of its insides, twenty seconds later.
    """
    key, value, address = "--scheduler", str(choice.scheduler), str(choice.scheduler)
    if choice.scheduler_file is not None:
        key, value = "--scheduler-file", str(choice.scheduler_file)
        expected = "the file that a running scheduler has written"
        with suppress(OSError):
            check_regular(choice.scheduler_file, key)
        try:
            address = str(json.loads(read_text(choice.scheduler_file, LARGEST_FILE, expected))["address"])
        except (ValueError, KeyError, TypeError, IndexError, RecursionError):
            raise InputError(expected, key=key, value=value) from None
    found = ADDRESS.fullmatch(address)
    if found is None or not 0 < int(found["port"]) < 65536:
        raise InputError("a scheduler's address such as tcp://host:8786", key=key, value=value)
    if (found["protocol"] == "tls://") != (choice.tls is not None):
        expected = (
            "--tls-ca, --tls-cert and --tls-key beside an address that begins with tls://"
            if choice.tls is None
            else f"an address that begins with tls:// beside --tls-ca (this one is {address})"
        )
        raise InputError(expected, key=key, value=value)
    return address


def _security(choice: ClusterChoice) -> Any:
    if choice.tls is None:
        return None
    from distributed.security import Security

    authority, certificate, key = map(str, choice.tls)
    return Security(tls_ca_file=authority, tls_client_cert=certificate, tls_client_key=key, require_encryption=True)


def check_workers(client: Client) -> None:
    """Raise InputError where a worker has another program or other versions than the client, or threads than one."""
    found: Any = client.get_versions(packages=list(PACKAGES))  # a dict, where the client is not asynchronous
    own = found["client"]["packages"]
    for address, worker in found["workers"].items():
        has = worker["packages"] if worker else {}
        for name in PACKAGES:
            if has.get(name) != own[name]:
                raise InputError(
                    f"workers with {name} {shown(own[name])}, as here",
                    key=f"worker {address}",
                    value=shown(has.get(name)),
                )
    sources: Any = client.run(hash_of_sources, on_error="return")
    for address, has in sources.items():
        check_sources(has if isinstance(has, str) else "", f"worker {address}")
    threads = client.nthreads()
    for address, count in threads.items():
        if count != 1:
            raise InputError("workers with one thread each (--nthreads 1)", key=f"worker {address}", value=count)


def check_sources(has: str, who: str) -> None:
    """Raise InputError where a hash of sources is not that of this program: its rows would be those of another one."""
    if has != hash_of_sources():
        raise InputError(
            f"workers whose fctd has the sources of the one here, {hash_of_sources()}", key=who, value=has or "others"
        )


def shown(version: Any) -> str:
    """A version as it is written."""
    return "none" if version is None else str(version)


def encrypted(client: Client) -> bool:
    """Whether the connection to the scheduler is encrypted, or does not leave this machine."""
    address = str(client.scheduler.address) if client.scheduler is not None else ""
    protocol, _, rest = address.partition("://")
    return protocol in ("tls", "inproc") or rest.startswith((f"{LOOPBACK}:", "localhost:", "[::1]:"))


def worker_count(client: Client) -> int:
    """Number of workers now; 0 where the scheduler does not answer."""
    with suppress(OSError, TimeoutError):
        return len(client.nthreads())
    return 0
