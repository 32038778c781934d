"""Files of a simulation: what is written where, and what a reader finds in it."""

import json
import platform
from importlib.metadata import version
from pathlib import Path

import numba
import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

from fctd import SimulationResult
from fctd.record import Recorder, _work
from fctd.results import versions, write_table
from fctd.run import forget_start, prepare
from fctd.topdrive import Motion
from tests.cases import make_case, pipe, rotation, trip

TABLE = pd.DataFrame({"time_s": [1.0, 2.5], "operation": ["trip_in", "trip_in"]})


@pytest.mark.parametrize("csv", [False, True])
def test_a_result_is_a_table_per_file_with_its_case(csv: bool, tmp_path: Path) -> None:
    case = make_case(operations=[rotation(1000, 1)])
    result = SimulationResult(case, "completed", "a word", TABLE, TABLE * 2, TABLE[:1], {"steps": 7, "step_s": 0.5})
    written = result.save(tmp_path, csv=csv)
    frames = {"history": TABLE, "profile": TABLE * 2, "energy": TABLE[:1]}
    suffixes = ("parquet", "csv") if csv else ("parquet",)
    assert written == [tmp_path / f"{name}.{suffix}" for name in frames for suffix in suffixes]
    assert sorted(written) == sorted(tmp_path.iterdir())
    for name, frame in frames.items():
        pd.testing.assert_frame_equal(pd.read_parquet(tmp_path / f"{name}.parquet"), frame)
        if csv:
            pd.testing.assert_frame_equal(pd.read_csv(tmp_path / f"{name}.csv"), frame)
        kept = pq.read_schema(tmp_path / f"{name}.parquet").metadata
        assert {key for key in kept if key != b"pandas"} == {b"case", b"status", b"message", b"run", b"versions"}
        assert type(case).model_validate_json(kept[b"case"]) == case
        assert (kept[b"status"], kept[b"message"]) == (b"completed", b"a word")  # texts as they are
        assert json.loads(kept[b"run"]) == {"steps": 7, "step_s": 0.5}
        assert json.loads(kept[b"versions"]) == versions()


@pytest.mark.parametrize("name", ["chart.csv", "chart.CSV", "chart.parquet"])
def test_the_suffix_says_what_a_table_is_written_as(name: str, tmp_path: Path) -> None:
    path, beside = tmp_path / name, tmp_path / f"{name}.json"
    written = write_table(TABLE, path, {"rpm": [60, 90], "operation": "trip_in"})
    if name.lower().endswith("csv"):
        assert written == [path, beside]
        pd.testing.assert_frame_equal(pd.read_csv(path), TABLE)
        assert json.loads(beside.read_text(encoding="utf-8")) == {"rpm": [60, 90], "operation": "trip_in"}
        return
    assert written == [path]
    assert not beside.exists()
    kept = pq.read_schema(path).metadata
    assert (kept[b"rpm"], kept[b"operation"]) == (b"[60, 90]", b"trip_in")


def test_versions_name_engine_language_and_libraries() -> None:
    found = versions()
    assert found.pop("commit", "0" * 7).isalnum()
    assert found == {
        "fctd": version("fctd"), "python": platform.python_version(), "numpy": np.__version__,
        "numba": numba.__version__,
    }  # fmt: skip


def test_work_is_the_larger_of_losses_and_of_what_is_not_lifting() -> None:
    columns = {name: [0.0, 1.0] for name in ("lost_friction_J", "lost_contact_J", "lost_mud_J", "lost_joints_J")}
    ledger = pd.DataFrame({**columns, "top_drive_work_J": [0.0, 90.0], "gravity_J": [0.0, 100.0]})
    assert _work(ledger) == 10.0
    assert _work(ledger.assign(gravity_J=[0.0, 87.0])) == 4.0
    assert np.isnan(_work(ledger.assign(lost_mud_J=[0.0, np.nan])))
    assert np.isnan(_work(ledger.assign(gravity_J=[0.0, np.nan])))


def test_numbers_of_a_run() -> None:
    """Means over the interval, the speed of the run, and the largest residual of the ledger over the work."""
    run, _ = prepare(make_case(components=[pipe(None, 10)], operations=[trip(1000, 990)], contact={"enabled": False}))
    forget_start(run)
    recorder = Recorder(run)
    for end in (0.5, 2.0):
        run.advance(Motion(0.0, 1.0, 0.0, 0.0, 0.0, 0.0), end - recorder.last_time)
        recorder.record(0)
    recorder.ledger[0]["residual_J"], recorder.ledger[1]["residual_J"] = -3.0, 1.0
    recorder.ledger[1]["lost_mud_J"] = 1e6
    numbers = recorder.result("completed", "", 4.0, 1e-7).run
    assert numbers["simulated_s"] == pytest.approx(2.0)
    assert (numbers["wall_s"], numbers["real_time_factor"]) == (4.0, pytest.approx(0.5))
    assert (numbers["segments"], numbers["contact"], numbers["settling_residual"]) == (10, "cylinders", 1e-7)
    assert (numbers["steps"], numbers["step_s"]) == (run.steps, run.step)
    assert numbers["energy_error"] == pytest.approx(3.0 / numbers["work_J"])
    assert numbers["work_J"] == pytest.approx(1e6, rel=1e-2)
    idle = Recorder(run).result("unsettled", "", 0.0, float("nan"))
    assert np.isnan([idle.run["real_time_factor"], idle.run["work_J"], idle.run["energy_error"]]).all()
    assert len(idle.profile) == len(idle.history) == len(idle.energy) == 0
