"""How a sweep scales: its throughput with one and two workers, and what one scheduler can serve.

``python -m benchmarks scale`` measures, prints the tables of docs/scale.md and what its model predicts of runs that it
was not fitted to.  Workers whose tasks sleep stand for machines: they leave the processors to the scheduler.
"""

import os
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import pandas as pd

from fctd.sweep.chunk import as_stream, from_stream
from fctd.sweep.cluster import ClusterChoice, connected
from fctd.sweep.dataset import begin_dataset
from fctd.sweep.design import sample_of
from fctd.sweep.run import Summary, prepare, sweep
from fctd.sweep.spec import SweepSpec
from fctd.sweep.work import WORK

ROOT = Path(__file__).parents[1]
CASE = ROOT / "validation" / "cases" / "paper_well.toml"
SAMPLES = 1409  # at 71 depths each: 100,000 steady depths
WORKERS = (1, 2, 4, 8, 16)
SHORT, CHUNK = 0.05, 0.4  # shortest and usual work of a chunk [s]
FITTED = 1, 16  # numbers of workers from which the model's two times are taken
SPAN = 5.0  # of a measurement with sleeping workers [s]
MOST_TASKS = 4000  # of one measurement
ALONE = 60  # samples whose processor time is taken in this process


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
        return sweep(the_sweep(samples), Path(folder) / "out", ClusterChoice(workers=workers))


def served(workers: int, work: float) -> float:
    """Tasks a second that sleeping workers end, each task of some work [s], after a first round."""
    with connected(ClusterChoice(workers=workers)) as client:
        client.gather(client.map(time.sleep, [0.0] * 4 * workers, pure=False))
        count = max(round(SPAN * workers / work), 4 * workers) if work else MOST_TASKS
        count = min(count, MOST_TASKS)
        began = time.perf_counter()
        client.gather(client.map(time.sleep, [work] * count, pure=False))
        return count / (time.perf_counter() - began)


def _through_a_stream(rows: list[dict[str, Any]]) -> Any:
    """Rows as a worker sends them and the client reads them."""
    return from_stream(as_stream(rows))


def shares(samples: int = ALONE) -> pd.DataFrame:
    """Processor time of what is done for a sample, in this process: it does not depend on what else the machine does.

    A row for each part of the work, with its time [ms] and its share; ``solving`` includes layout and rows.
    """
    runner, table = prepare(the_sweep(samples))
    runner.warm_up()
    spent = dict.fromkeys(("making the case", "solving", "stream of the rows", "writing"), 0.0)

    def timed(part: str, act: Callable[[], Any]) -> Any:
        began = time.process_time()
        found = act()
        spent[part] += time.process_time() - began
        return found

    with tempfile.TemporaryDirectory() as folder:
        dataset = begin_dataset(Path(folder) / "out", runner.template, table)
        tables = []
        for number in range(samples):
            case = timed("making the case", partial(runner.template.case, *sample_of(table, number)))
            rows = timed("solving", partial(WORK["chart"], case, runner.task, lambda: None))
            named = [{"sample": number, **row} for row in rows]
            tables.append(timed("stream of the rows", partial(_through_a_stream, named)))
        timed("writing", partial(dataset.write, tables))
    whole = sum(spent.values())
    return pd.DataFrame(
        {"part": part, "ms_per_sample": 1e3 * taken / samples, "share": taken / whole} for part, taken in spent.items()
    )


def measure(tell: Callable[[str], None]) -> None:
    """Tell the tables as they are measured, the model, and the load of the machine before and after."""
    tell(f"load before: {os.getloadavg()}")
    tell(shares().to_string(index=False))
    for workers in (1, 2):
        tell(pd.DataFrame([costs(swept(workers))]).to_string(index=False))
    rows = []
    for work in (0.0, SHORT, CHUNK):
        rows += [{"workers": n, "work_s": work, "tasks_per_s": served(n, work)} for n in WORKERS]
    table = pd.DataFrame(rows)
    model = fitted(table)
    table["model"] = [model.rate(int(n), work) for n, work in zip(table["workers"], table["work_s"], strict=True)]
    table["off"] = table["model"] / table["tasks_per_s"] - 1
    tell(table.to_string(index=False))
    tell(str(model))
    tell(f"load after: {os.getloadavg()}")


def costs(run: Summary) -> dict[str, float]:
    """What a sweep cost, a row of a table."""
    return {
        "workers": run.workers,
        "wall_s": run.wall,
        "start_s": run.start,
        "chunks": run.chunks,
        "shortest_s": run.shortest,
        "depths_per_s": run.rows / run.wall,
        "ms_per_depth": 1e3 * run.solving / run.rows,
        "solving_share": run.solving / (run.wall * run.workers),
        "writing_s": run.writing,
        "overhead_ms_per_chunk": 1e3 * (run.elapsed - run.solving) / run.chunks,
    }


def fitted(table: pd.DataFrame) -> Model:
    """The model of two measurements: one worker with short tasks, and the most workers with empty ones."""
    rate = table.set_index(["work_s", "workers"])["tasks_per_s"]
    return Model(float(1 / rate[SHORT, FITTED[0]] - SHORT), float(1 / rate[0.0, FITTED[1]]))
