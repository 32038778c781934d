"""How a sweep scales: the model of two measurements, and the sweep that is timed."""

import pandas as pd
import pytest

from benchmarks.scale import CHUNK, SAMPLES, SHORT, WORKERS, Model, fitted, the_sweep
from fctd.sweep.design import samples_of


def test_the_model_gives_back_the_times_it_was_made_with() -> None:
    true = Model(0.004, 0.0007)
    rows = [
        {"workers": n, "work_s": work, "tasks_per_s": true.rate(n, work)}
        for work in (0.0, SHORT, CHUNK)
        for n in WORKERS
    ]
    found = fitted(pd.DataFrame(rows))
    assert found == pytest.approx(true)
    assert found.rate(2, CHUNK) == pytest.approx(2 / (CHUNK + 0.004))
    assert found.rate(10_000, SHORT) == pytest.approx(1 / 0.0007)


def test_the_timed_sweep_has_a_hundred_thousand_depths() -> None:
    assert len(samples_of(the_sweep())) * 71 == SAMPLES * 71 >= 100_000
