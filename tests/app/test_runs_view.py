"""The curves of a run: of its chunks while it lasts, of its result afterwards."""

from pathlib import Path

import numpy as np
import pytest

from fctd.app.runs_view import records
from fctd.results import pacing
from fctd.results.run_folder import RunFolder
from fctd.simulation.kept_run import KeptRun
from fctd.simulation.simulate import simulate
from tests.app.test_well import unpacked
from tests.cases import make_case, pipe, rotation


def test_a_run_is_seen_from_its_first_chunk_to_its_result(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pacing, "SHARE", 1e9)  # a chunk a record
    target = tmp_path / "result"
    assert records(tmp_path, str(target), "si")["records"] == 0
    case = make_case(components=[pipe(None, None, segment_length=100.0)], operations=[rotation(900, 4.0, ramp=1.0)])
    folder, seen = RunFolder.take(target), list[int]()

    def progress(now: float, total: float, factor: float) -> None:
        seen.append(records(tmp_path, str(target), "si")["records"])

    result = simulate(case.model_copy(), progress=progress, keeper=KeptRun(folder, 0.0))
    folder.leave(remove=True)
    assert seen[0] < seen[-1]
    result.save(target)
    found = records(tmp_path, str(target), "field")
    assert found["records"] == len(result.history)
    assert found["status"].startswith(str(result.status))
    np.testing.assert_allclose(unpacked(found["time"]), result.history["time_s"], rtol=1e-6)
    np.testing.assert_allclose(
        unpacked(found["curves"]["hookload_N"]), result.history["hookload_N"] / 4448.2216, rtol=1e-6
    )
    assert found["last"].startswith("4 s: hook load")


def test_a_run_that_was_stopped_says_so_and_names_its_case(tmp_path: Path) -> None:
    """What it kept, to go on with, lies beside its result, and another well may be on the page."""
    target = tmp_path / "run" / "result"
    target.parent.mkdir()
    (target.parent / "case.toml").write_text('name = "<b>old"', encoding="utf-8")
    case = make_case(components=[pipe(None, None, segment_length=100.0)], operations=[rotation(900, 4.0, ramp=1.0)])
    folder = RunFolder.take(target)

    def until_stopped(now: float, total: float, factor: float) -> None:
        if now > 2.0:
            raise KeyboardInterrupt

    simulate(case, progress=until_stopped, keeper=KeptRun(folder, 0.0)).save(target)
    folder.leave(remove=False)
    found = records(tmp_path, str(target), "si")
    assert found["status"].startswith("interrupted")
    assert found["last"].startswith("<b>old, ")
    assert "-0.0" not in found["last"]
