"""How a sweep scales: its throughput with one and two workers, and what one scheduler can serve.

``python -m benchmarks scale`` measures, prints the tables of docs/scale.md and what its model predicts of runs that it
was not fitted to.  Workers whose tasks sleep stand for machines: they leave the processors to the scheduler.
"""

import os
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import pandas as pd

from fctd.sweep.cluster import Where, connected
from fctd.sweep.run import Summary, sweep
from fctd.sweep.spec import SweepSpec

ROOT = Path(__file__).parents[1]
CASE = ROOT / "validation" / "cases" / "paper_well.toml"
SAMPLES = 1409  # at 71 depths each: 100,000 steady depths
WORKERS = (1, 2, 4, 8, 16)
SHORT, CHUNK = 0.05, 0.4  # shortest and usual work of a chunk [s]
FITTED = 1, 16  # numbers of workers from which the model's two times are taken
SPAN = 5.0  # of a measurement with sleeping workers [s]


class Model(NamedTuple):
    """Time that a task costs its worker beside its work, and time that it costs the scheduler [s]."""

    worker: float
    scheduler: float

    def rate(self, workers: int, work: float) -> float:
        """Tasks a second: of the workers, or of the scheduler where that is less."""
        return min(workers / (work + self.worker), 1 / self.scheduler)


def the_sweep(samples: int = SAMPLES) -> SweepSpec:
    """Friction and mud of paper-well, 71 depths of tripping out, 61 segments."""
    friction = {"key": "friction", "distribution": "normal", "mean": 0.2, "sd": 0.04, "low": 0.05, "high": 0.4}
    mud = {"key": "mud.density", "distribution": "uniform", "low": 1050, "high": 1350}
    work = {"operations": ["trip_out"], "depths": "1750:2450:10"}
    raw = {"name": "friction and mud", "case": CASE, "method": "latin_hypercube", "samples": samples}
    return SweepSpec.model_validate(raw | {"parameters": [friction, mud], "work": work})


def swept(workers: int, samples: int = SAMPLES) -> Summary:
    """A whole sweep on local workers."""
    with tempfile.TemporaryDirectory() as folder:
        return sweep(the_sweep(samples), Path(folder) / "out", Where(workers=workers))


def served(workers: int, work: float) -> float:
    """Tasks a second that sleeping workers end, each task of some work [s], after a first round."""
    with connected(Where(workers=workers)) as client:
        client.gather(client.map(time.sleep, [0.0] * 4 * workers, pure=False))
        count = max(round(SPAN * workers / work), 4 * workers)
        count = min(count, 4000)
        began = time.perf_counter()
        client.gather(client.map(time.sleep, [work] * count, pure=False))
        return count / (time.perf_counter() - began)


def main() -> None:
    """Print all tables."""
    print(f"load before: {os.getloadavg()}")
    rows = []
    for workers in (1, 2):
        run = swept(workers)
        rows.append(
            {"workers": workers, "wall_s": run.wall, "start_s": run.start, "chunks": run.chunks,
             "shortest_s": run.shortest,
             "depths_per_s": run.rows / run.wall, "ms_per_depth": 1e3 * run.solving / run.rows,
             "solving": run.solving / (run.wall * workers), "writing_s": run.writing,
             "overhead_ms_per_chunk": 1e3 * (run.elapsed - run.solving) / run.chunks}
        )  # fmt: skip
    print(pd.DataFrame(rows).to_string(index=False))
    found = pd.DataFrame(
        [
            {"workers": n, "work_s": work, "tasks_per_s": served(n, work)}
            for work in (0.0, SHORT, CHUNK)
            for n in WORKERS
        ]
    )
    measured = found.set_index(["work_s", "workers"])["tasks_per_s"]
    model = Model(1 / measured[SHORT, FITTED[0]] - SHORT, 1 / measured[0.0, FITTED[1]])
    found["model"] = [model.rate(int(row.workers), row.work_s) for row in found.itertuples()]
    found["off"] = found["model"] / found["tasks_per_s"] - 1
    print(found.to_string(index=False))
    print(model)
    print(f"load after: {os.getloadavg()}")


if __name__ == "__main__":
    main()
