"""What Dask runs on a worker of a sweep: it is carried there once, and tasks name it."""

from collections.abc import Sequence
from typing import Any

from distributed import get_worker
from distributed.diagnostics.plugin import WorkerPlugin

from fctd.sweep.chunk import ChunkResult, SampleRunner
from fctd.sweep.design import Sample


class Carrier(WorkerPlugin):
    """Brings a sweep to every worker, also to one that comes later; each compiles before its first chunk."""

    def __init__(self, runner: SampleRunner) -> None:
        self.runner = runner
        self.seconds: float | None = None

    def setup(self, worker: Any) -> None:
        """Nothing: the plugin itself is what a worker needs."""

    def warm(self) -> float:
        """How long a sample takes [s], NaN where that is not known, after all is compiled."""
        if self.seconds is None:
            self.seconds = self.runner.warm_up()
        return self.seconds


def run_chunk(name: str, samples: Sequence[Sample]) -> ChunkResult:
    """The rows of samples of the sweep that a worker was brought under a name."""
    worker = get_worker()
    carrier: Any = worker.plugins[name]
    carrier.warm()
    try:
        done: ChunkResult = carrier.runner.run(samples, lambda sample: worker.log_event(name, sample))
        return done
    except Exception as error:  # its frames need not be on their way to the client, which may not be able to read them
        raise RuntimeError(f"{type(error).__name__}: {error}") from None


def warm_up(name: str) -> float:
    """How long a sample takes on a worker, once all is compiled [s]; NaN where that is not known."""
    carrier: Any = get_worker().plugins[name]
    return float(carrier.warm())
