"""Memory of a process is its own, whatever has started it."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from references.timing.footprint import peak, resident

PROGRAM = "from references.timing.footprint import peak; print(peak())"


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="no /proc")
def test_the_peak_of_a_process_is_not_that_of_its_parent() -> None:
    held = np.ones(300 * 2**20, np.uint8)
    assert peak() >= 0.95 * resident() > 285
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True)
    assert 20 < float(done.stdout) < 285
    assert held.all()
