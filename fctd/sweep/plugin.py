"""What Dask runs on a worker of a sweep: it is carried there once, and tasks name it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from distributed import get_worker
from distributed.diagnostics.plugin import WorkerPlugin

from fctd.sweep.chunk import Bench, Done, Sample


class Carrier(WorkerPlugin):
    """Brings a sweep to every worker, also to one that comes later."""

    def __init__(self, bench: Bench) -> None:
        self.bench = bench

    def setup(self, worker: Any) -> None:
        """Nothing: the plugin itself is what a worker needs."""


def run_chunk(name: str, samples: Sequence[Sample]) -> Done:
    """The rows of samples of the sweep that a worker was brought under a name."""
    worker = get_worker()
    return _bench(name).run(samples, lambda sample: worker.log_event(name, sample))


def try_one(name: str, sample: Sample) -> float:
    """How long a sample takes on a worker, once all is compiled [s]; NaN for work that is too long to try."""
    return _bench(name).seconds_per_sample(sample)


def _bench(name: str) -> Bench:
    carrier: Carrier = get_worker().plugins[name]
    return carrier.bench
