"""Seeded faults of a sweep: what resumes has the rows of a run that nothing disturbed.

Each fault takes half a minute.  The environment variable FCTD_FAULTS sets their number; the study ``sweep_faults``
tries twenty.
"""

import os
from collections.abc import Iterator

import pytest

from validation.parts.swept_faults import Sweeps

pytest.importorskip("distributed")
psutil = pytest.importorskip("psutil")
pytestmark = pytest.mark.slow(seconds=20)


@pytest.fixture(scope="module")
def sweeps(tmp_path_factory: pytest.TempPathFactory) -> Sweeps:
    return Sweeps(tmp_path_factory.mktemp("sweep"))


@pytest.mark.parametrize("seed", range(int(os.environ.get("FCTD_FAULTS", 1))))
def test_a_sweep_resumes_after_a_fault_with_the_rows_of_one_undisturbed(seed: int, sweeps: Sweeps) -> None:
    assert sweeps.try_fault(seed).wrong == ""


@pytest.fixture(autouse=True)
def _no_process_stays() -> Iterator[None]:
    yield
    left = [child for child in psutil.Process().children(recursive=True) if child.is_running()]
    psutil.wait_procs(left, timeout=20)
