"""The reference kernel: its source is unchanged, and it measures arithmetic only."""

import hashlib
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numba import njit

from references.timing import reference_kernel as kernel

# Costs of all subjects, and of steps in a comparison of methods, are in units of this source.
SOURCE = "3eb759ff003c3be8"
ROOT = Path(__file__).parents[2]


def test_its_source_is_unchanged() -> None:
    assert hashlib.sha256(Path(kernel.__file__).read_bytes()).hexdigest()[:16] == SOURCE


@pytest.mark.slow
def test_its_compiled_code_is_in_the_cache_folder_of_fctd() -> None:
    """Not next to its source, where another user may have no write permission."""
    program = "from references.timing import reference_kernel as k; print(k.reference_kernel.stats.cache_path)"
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=True,
        env={key: value for key, value in os.environ.items() if key != "NUMBA_CACHE_DIR"},
    )  # fmt: skip
    assert not Path(done.stdout).is_relative_to(ROOT)


def test_values_stay_normal_and_of_order_one() -> None:
    """Denormal numbers take many times longer, and would make the unit depend on the number of passes."""
    S = kernel.new_buffer()
    kernel.reference_kernel(S, 20_000)
    used = S.reshape(kernel.ROWS, kernel.STRIDE)[:, kernel.FIRST : kernel.FIRST + kernel.COLUMNS]
    directions, rates, turns = used[0:3], used[3:6], used[6:9]
    np.testing.assert_allclose(np.linalg.norm(directions, axis=0), 1, rtol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(rates, axis=0), 1, rtol=1e-12)
    assert directions.std() > 0.3  # they keep turning in all directions
    assert np.abs(turns).max() < 50
    assert not (np.abs(S[S != 0]) < np.finfo(float).tiny).any()


@pytest.mark.slow
def test_it_is_packed_arithmetic_with_division_and_root() -> None:
    fresh = njit(error_model="numpy")(kernel.reference_kernel.py_func)  # numba does not show code from its cache
    fresh(kernel.new_buffer(), 1)
    (code,) = fresh.inspect_asm().values()
    packed, scalar = (len(re.findall(rf"\bv?(?:add|sub|mul|div|sqrt|fn?m\w+){kind}\b", code)) for kind in ("pd", "sd"))
    assert packed > 10 * scalar
    assert re.search(r"\bv?divpd\b", code)
    assert re.search(r"\bv?sqrtpd\b", code)
