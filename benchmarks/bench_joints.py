"""The packed joint loads alone, springs and damping."""

from numba import njit
from pytest_benchmark.fixture import BenchmarkFixture

from benchmarks.records import COMPILED, describe
from benchmarks.strings import LEAD, chain
from fctd.mechanics.joints import update_joint_loads
from references.timing.workloads import moving

JOINTS = 64


@njit(error_model="numpy")
def many_joint_loads(S, n, count):  # type: ignore[no-untyped-def]
    """The loads of n joints, ``count`` times."""
    for _ in range(count):
        update_joint_loads(S, n, 1e-5, 1e-3)


def bench_joints(benchmark: BenchmarkFixture) -> None:
    """64 joints of a turning chain of 60 segments; the other columns pad the last packed instruction."""
    run, _ = moving(chain(), LEAD)
    count = COMPILED // JOINTS
    describe(benchmark, "joints", joints=JOINTS)
    benchmark.pedantic(many_joint_loads, args=(run.S, JOINTS, count), rounds=15, warmup_rounds=2)
    if benchmark.stats is not None:
        benchmark.extra_info["ns_per_joint"] = 1e9 * benchmark.stats.stats.median / count / JOINTS
