"""Runs in time as answers: they show and draw themselves, run or read from a folder."""

from pathlib import Path

import numpy as np

import fctd
from tests.cases import make_case


def test_a_run_shows_and_draws_itself(tmp_path: Path) -> None:
    rotate = {"kind": "rotate_off_bottom", "at_md": 900, "duration": 2.0, "rpm": 60.0, "ramp_time": 1.0}
    case = make_case(operations=[rotate])
    result = fctd.simulate(case)
    assert repr(result) == "SimulationResult('test': completed, 2 records, rotate_off_bottom at 900.0 m)"
    hookload = float(result.history["hookload_N"].iloc[-1])
    assert f"{hookload / 1e3:.1f} kN" in result._repr_html_()
    assert np.isfinite(hookload)
    assert result.plot()._repr_png_().startswith(b"\x89PNG")
    result.save(tmp_path / "out")
    assert repr(fctd.open_result(tmp_path / "out")) == repr(result)
    simulation = fctd.Simulation(case)
    assert len(list(simulation)) == 2
    assert repr(simulation.result()) == repr(result)
