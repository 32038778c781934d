"""Sweeps from Python: a dict with a case in memory, rows as workers make them, what they tell, their pictures."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import fctd
from fctd.case.errors import InputError
from fctd.sweep.design import sample_of
from fctd.sweep.run import prepare
from fctd.sweep.spec import read_sweep
from tests.cases import make_case

CASE = make_case([[0, 0, 0], [300, 0, 0], [1000, 40, 0]], mud={"density": 1200.0})
FRICTION = {"key": "friction", "distribution": "uniform", "low": 0.1, "high": 0.4}
SWEEP = {
    "name": "in memory", "case": CASE, "method": "latin_hypercube", "samples": np.int64(12),
    "parameters": [FRICTION, {"key": "mud.density", "values": ["1.1 sg", "1.3 sg"]}],
    "work": {"kind": "chart", "operations": ["trip_in", "trip_out"], "depths": [800.0, "900 m"]},
}  # fmt: skip


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> fctd.Swept:
    return fctd.run_sweep(SWEEP, tmp_path_factory.mktemp("swept") / "out", workers=0)


def test_its_rows_are_those_of_workers(swept: fctd.Swept) -> None:
    runner, samples = prepare(read_sweep(SWEEP))
    wanted = pd.DataFrame([row for k in range(12) for row in runner.rows_of(sample_of(samples, k))])
    pd.testing.assert_frame_equal(swept.rows[wanted.columns], wanted, check_exact=True, check_dtype=False)
    assert swept.statuses == {"converged": 48}
    assert repr(swept) == "Swept('in memory', 12 samples, rows: 48 converged)"


def test_another_call_computes_what_is_missing(swept: fctd.Swept, tmp_path: Path) -> None:
    class StopError(Exception):
        pass

    def stop(done: int, total: int, lacking: int) -> None:
        if done == 3:
            raise StopError

    with pytest.raises(StopError):
        fctd.run_sweep(SWEEP, tmp_path / "out", workers=0, progress=stop)
    seen: list[int] = []
    again = fctd.run_sweep(SWEEP, tmp_path / "out", workers=0, progress=lambda done, *_: seen.append(done))
    assert seen == list(range(4, 13))
    pd.testing.assert_frame_equal(again.rows, swept.rows)


def test_samples_tell_percentiles_and_influences(swept: fctd.Swept) -> None:
    found = fctd.run_uncertainty(swept, bit_depth="800 m")
    from_folder = fctd.run_uncertainty(SWEEP, swept.dataset.folder, 800.0)
    pd.testing.assert_frame_equal(found.percentiles, from_folder.percentiles)
    pulled = found.percentiles.query("operation == 'trip_out' and column == 'hookload_N' and bit_depth_m == 800")
    loads = swept.rows.query("operation == 'trip_out' and bit_depth_m == 800")["hookload_N"]
    assert pulled.set_index("percentile")["value"][50] == pytest.approx(loads.median(), rel=0.01)
    assert {"friction", "mud.density"} <= set(found.indices["parameter"])
    assert "hookload_N" in found._repr_html_()


def test_it_draws_bands_and_influences(swept: fctd.Swept) -> None:
    words = [{axes.get_xlabel() for axes in one.figure.axes} for one in (swept.plot("field"), found_tornado(swept))]
    assert any("klbf" in word for word in words[0])
    assert words[0] != words[1]


def found_tornado(swept: fctd.Swept) -> Any:
    return swept.uncertainty.plot("tornado", operation="trip_out")


@pytest.mark.parametrize(
    ("sweep", "message"),
    [
        (3, "sweep = 3: expected the path of a sweep file, or a dict of its tables"),
        ({**SWEEP, "case": 3}, "case = 3: expected a file name in quotes"),
        ({**SWEEP, "case": {"name": "x"}}, "case.wellbore is missing"),
        ({**SWEEP, "case": "nothing.toml"}, 'case = "nothing.toml": expected a case file that can be read'),
    ],
)
def test_what_is_no_sweep_is_refused(sweep: Any, message: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        fctd.run_sweep(sweep, tmp_path / "out", workers=0)
    assert message in str(caught.value)


def test_a_sweep_file_names_its_case(tmp_path: Path) -> None:
    (tmp_path / "sweep.toml").write_text(
        'name = "x"\nmethod = "sobol"\nsamples = 8\ntortuosity_seeds = true\ncase = {}\n[work]\nkind = "simulate"\n'
    )
    with pytest.raises(InputError, match="the name of a case file in quotes"):
        read_sweep(tmp_path / "sweep.toml")


def test_the_folder_of_another_sweep_is_refused(swept: fctd.Swept) -> None:
    with pytest.raises(InputError, match="the folder of this sweep"):
        fctd.run_uncertainty({**SWEEP, "seed": 1}, swept.dataset.folder)
