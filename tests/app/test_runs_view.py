"""The curves of a run: of its chunks while it lasts, of its result afterwards."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fctd.app.runs_view import records
from fctd.case.load import load_case
from fctd.simulation.run_saver import RunSaver
from fctd.simulation.simulate import simulate
from fctd.store import save_interval
from fctd.store.run_folder import RunFolder
from fctd.view.strings import of_run
from tests.app.made import SURVEY, TEXT, unpacked


def test_a_run_is_seen_from_its_first_chunk_to_its_result(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(save_interval, "SHARE", 1e9)  # a chunk a record
    target = tmp_path / "result"
    assert records(tmp_path, str(target), "si")["records"] == 0
    (tmp_path / "survey.csv").write_bytes(SURVEY)
    (tmp_path / "case.toml").write_text(TEXT)
    case = load_case(tmp_path / "case.toml")
    folder, seen = RunFolder.take(target), list[dict[str, Any]]()

    def progress(now: float, total: float, factor: float) -> None:
        seen.append(records(tmp_path, str(target), "si", "tension"))

    result = simulate(case, progress=progress, checkpointer=RunSaver(folder, 0.0))
    folder.leave(remove=True)
    assert seen[0]["records"] < seen[-1]["records"]
    result.save(target)
    found = records(tmp_path, str(target), "field")
    assert found["records"] == len(result.history)
    assert found["status"].startswith(str(result.status))
    np.testing.assert_allclose(unpacked(found["time"]), result.history["time_s"], rtol=1e-6)
    np.testing.assert_allclose(
        unpacked(found["curves"]["hookload_N"]), result.history["hookload_N"] / 4448.2216, rtol=1e-6
    )
    assert found["last"].startswith(f"{case.name}, 2 s: hook load")
    run = of_run(result)
    assert seen[-1]["string"] is not None
    for shows in (one for one in seen if one["string"]):  # each the string of the last record kept by then
        last = run.snapshots[shows["records"] - 1]
        assert shows["string"]["where"] == f"{last.at:.0f} s, rotating off bottom"
        assert f"{last.touching.sum()} of {len(last.offset)} points touch" in shows["string"]["words"]
        line = next(trace for trace in shows["string"]["figure"]["data"] if trace["name"] == "string")["line"]
        np.testing.assert_allclose(unpacked(line["color"]), last.columns["effective_tension_N"] / 1e3, rtol=1e-5)
    assert found["string"]["where"] == "2 s, rotating off bottom"


def test_a_run_that_was_stopped_says_so_and_names_its_case(tmp_path: Path) -> None:
    """What it kept, to go on with, lies beside its result, and another well may be on the page."""
    target = tmp_path / "run" / "result"
    target.parent.mkdir()
    (target.parent / "survey.csv").write_bytes(SURVEY)
    file = target.parent / "case.toml"
    file.write_text(re.sub('^name = ".*"', 'name = "<b>old"', TEXT, count=1, flags=re.M), encoding="utf-8")
    case = load_case(file)
    folder = RunFolder.take(target)

    def until_stopped(now: float, total: float, factor: float) -> None:
        if now > 1.0:
            raise KeyboardInterrupt

    simulate(case, progress=until_stopped, checkpointer=RunSaver(folder, 0.0)).save(target)
    folder.leave(remove=False)
    found = records(tmp_path, str(target), "si")
    assert found["status"].startswith("interrupted")
    assert found["last"].startswith("<b>old, ")
    assert "-0.0" not in found["last"]
