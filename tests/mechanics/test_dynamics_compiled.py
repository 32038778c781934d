"""The compiled code of a step: packed arithmetic, inert columns, rows on cache lines, and no allocations."""

import platform
import re

import numpy as np
import pytest
from numba import config, njit
from numba.core.runtime import _nrt_python, rtsys

from fctd.mechanics import dynamics, joints, query, state, topdrive
from fctd.mechanics.contact import Arc
from fctd.mechanics.law_names import CODES
from fctd.mechanics.stored_walls import follow_arcs, follow_cylinders
from fctd.simulation.preparation import prepare
from tests.cases import make_case, pipe, rotation
from tests.compiled import kept

may_touch = kept(dynamics.may_touch)

FREE = state.Laws(state.OPEN, CODES["coulomb"], 1.0, 0.0, 0.0, 0.0)
ORTHOTROPIC = FREE._replace(orthotropic=True)
STILL = topdrive.Motion(0.0, 1.0, 0.0, 0.0, 0.0, 0.0)
# For tests of the compiled code itself; all others pass with NUMBA_DISABLE_JIT=1 too, so that coverage can be measured.
compiled = pytest.mark.skipif(bool(config.DISABLE_JIT), reason="reads what numba compiled")


@compiled
@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="reads x86-64 instructions")
@pytest.mark.parametrize(
    ("kernel", "arguments"),
    [
        (dynamics.update_axes, ()),
        pytest.param(joints.update_joint_loads, (1e-4, 1e-3), marks=pytest.mark.slow),
        (follow_cylinders, ()),
        pytest.param(follow_arcs, (), marks=pytest.mark.slow),
        pytest.param(dynamics.PUSHES[CODES["coulomb"]], (FREE, 1e-3), marks=pytest.mark.slow),
        pytest.param(dynamics.PUSHES[CODES["coulomb"]], (ORTHOTROPIC, 1e-3), marks=pytest.mark.slow),
        pytest.param(dynamics.PUSHES[CODES["paper"]], (FREE, 1e-3), marks=pytest.mark.slow),
        pytest.param(dynamics.push_freely, (FREE, 1e-3), marks=pytest.mark.slow),
        pytest.param(dynamics.move_bodies, (1e-3,), marks=pytest.mark.slow),
    ],
)
def test_kernels_are_packed(kernel, arguments: tuple) -> None:
    """The main loop of every arithmetic kernel is vector code.

    Its packed operations match the scalar ones of the remainder loop; a helper that stayed a call, or rows
    that may alias, would leave none.  The largest kernels take seconds to compile.
    """
    packed, scalar = operations(kernel, state.new_state(8), 8, *arguments)
    assert packed > 10
    assert packed >= 0.9 * scalar


@pytest.mark.slow
@compiled
@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="reads x86-64 instructions")
def test_the_query_of_one_arc_is_packed() -> None:
    packed, scalar = operations(query.walls_of_arc, Arc(*[0.0] * 22), np.zeros(11 * query.TOGETHER), 8)
    assert packed > 10
    assert packed >= 0.8 * scalar


def operations(kernel, *arguments) -> tuple[int, int]:
    """Packed and scalar operations of a kernel, compiled again: code from the cache has no assembly to read."""
    kernel = njit(error_model="numpy", fastmath={"contract"})(kernel.py_func)
    kernel(*arguments)
    assembly = "\n".join(kernel.inspect_asm().values())
    arithmetic = r"\bv?(?:add|sub|mul|div|sqrt|fn?m(?:add|sub)\d{3})"
    return len(re.findall(arithmetic + r"pd\b", assembly)), len(re.findall(arithmetic + r"sd\b", assembly))


@pytest.mark.parametrize("lane", range(state.LANES))
@pytest.mark.parametrize(("off", "hole", "touching"), [
    (0.0499, 0.1, False), (0.0501, 0.1, True), (0.0, 0.0499, True), (0.0, 0.0501, False),
    (np.inf, 0.1, True), (np.nan, 0.1, True),
])  # fmt: skip
def test_one_touching_body_starts_the_contact_arithmetic(lane, off, hole, touching):
    S = state.new_state(16)
    assert not may_touch(S, 9)  # inert columns
    S[state.HOLE + 9 : state.HOLE + 17], S[state.RADIUS + 9 : state.RADIUS + 17] = 0.1, 0.05
    assert not may_touch(S, 9)
    S[state.PZ + 9 + lane], S[state.HOLE + 9 + lane] = -off, hole
    assert may_touch(S, 9) == touching
    assert not may_touch(S, 1)


def test_an_inert_column_stays_finite() -> None:
    """The columns that fill the last packed operation must never grow a NaN that a sum could pick up."""
    run, _ = prepare(make_case(components=[pipe(1000, 21)], operations=[rotation(1000, 1)]))
    run.advance(STILL, 100 * run.step)
    per_body = state.columns(run.S)[:, run.segments + 1 : run.segments + 9]
    assert np.isfinite(per_body).all()


def test_rows_begin_on_cache_lines() -> None:
    S = state.new_state(3)
    for buffer in (S, state.copy_state(S)):
        for offset in (state.X, state.VX, state.LOST_JOINT):
            assert state.row(buffer, offset, 3).ctypes.data % 64 == 0
    assert np.array_equal(state.columns(S), state.columns(state.copy_state(S)))


@compiled
def test_steps_allocate_nothing() -> None:
    """As many allocations for a thousand steps as for one."""
    run, _ = prepare(make_case(operations=[rotation(1000, 1)]))
    _nrt_python.memsys_enable_stats()
    counts = []
    for steps in (1, 1, 1000):
        before = rtsys.get_allocation_stats().alloc
        run.advance(STILL, steps * run.step)
        counts.append(rtsys.get_allocation_stats().alloc - before)
    _nrt_python.memsys_disable_stats()
    assert counts[2] == counts[1]
