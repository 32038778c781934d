"""What a worker is brought: a chunk runs there as it runs here."""

from pathlib import Path

import pytest

from fctd.sweep.cluster import ClusterChoice, connected
from fctd.sweep.design import Sample
from fctd.sweep.run import prepare
from fctd.sweep.spec import read_sweep
from validation.parts.small_sweep import sweep_file


@pytest.mark.slow
def test_a_chunk_runs_on_a_worker_as_it_runs_here(tmp_path: Path) -> None:
    from fctd.sweep.plugin import Carrier, run_chunk, warm_up

    runner, _ = prepare(read_sweep(sweep_file(tmp_path)))
    samples = [
        Sample(number, {"friction.open": friction, "mud.density": density})
        for number, friction, density in ((2, 0.3, 1.2), (5, 0.2, 1.0))
    ]
    with connected(ClusterChoice(workers=1)) as client:
        client.register_plugin(Carrier(runner), name="here")
        done = client.submit(run_chunk, "here", samples).result()
        seconds = client.submit(warm_up, "here").result()
    assert done.samples == (2, 5)
    assert done.rows == runner.run(samples, lambda number: None).rows
    assert 0 < seconds < 10
