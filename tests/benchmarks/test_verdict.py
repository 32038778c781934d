"""The decision of the gate on samples of real processes.

recorded.json has the samples of pairs of processes with the same sources, on two cores for which five to nine processes
competed, and of pairs of which one had a planted slowdown of 15 %.
"""

import json
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from benchmarks import measure
from benchmarks.gate import MOST, PROCESSES, SUM, sampled, with_sum
from benchmarks.measure import Costs
from benchmarks.verdict import THRESHOLD, change_of, decide

RECORDED = json.loads((Path(__file__).parent / "recorded.json").read_text())
OWN = [name for name in RECORDED["unchanged"]["now"] if name != measure.REFERENCE]


def draws(count: int) -> Iterator[tuple[Costs, Costs]]:
    """The pairs of processes with the same sources in random order, each with its sides swapped at random."""
    chance = np.random.default_rng(1)
    first, second = (RECORDED["unchanged"][side] for side in ("before", "now"))
    for _ in range(count):
        order, swapped = chance.permutation(MOST), chance.integers(2, size=MOST)
        sides: tuple[Costs, Costs] = ({}, {})
        for name in first:
            for k, side in enumerate(sides):
                side[name] = [(second if swap == k else first)[name][pair]
                              for pair, swap in zip(order, swapped, strict=True)]  # fmt: skip
        yield sides


def failing(before: Costs, now: Costs) -> set[str]:
    """Kernels that the gate fails, on recorded samples in place of processes."""
    batches = iter(range(0, MOST, PROCESSES))

    def more() -> tuple[Costs, Costs]:
        k = next(batches)
        cut = slice(k, k + PROCESSES)
        return tuple({name: taken[cut] for name, taken in side.items()} for side in (before, now))  # type: ignore[return-value]

    return {verdict.kernel for verdict in sampled("", more, str, decide).verdicts if verdict.fails}


def slowed(costs: Costs, kernels: list[str], factor: float) -> Costs:
    return costs | {name: [factor * cost for cost in costs[name]] for name in kernels}


def test_no_kernel_fails_that_did_not_change() -> None:
    assert not any(failing(*sides) for sides in draws(100))


@pytest.mark.parametrize("kernel", OWN)
def test_a_kernel_slower_by_fifteen_per_cent_is_found_each_time(kernel: str) -> None:
    assert all(kernel in failing(before, slowed(now, [kernel], 1.15)) for before, now in draws(30))


def test_a_kernel_slower_by_five_per_cent_never_fails() -> None:
    for kernel in OWN:
        assert not any(kernel in failing(before, slowed(now, [kernel], 1.05)) for before, now in draws(10))


def test_planted_slowdowns_are_found_by_name() -> None:
    """Samples of races against sources with extra work in a kernel (benchmarks/planted.py)."""
    for kernel, sides in RECORDED["planted"].items():
        found = {each.kernel: each for each in decide(sides["before"], sides["now"])}
        assert found[kernel].status == "slower", kernel


def test_slow_creep_of_all_kernels_fails_by_the_sum() -> None:
    """Where each kernel alone is within noise of the threshold."""
    for before, now in draws(10):
        assert SUM in failing(before, slowed(now, OWN, 1.13))
        sides = {SUM: with_sum(before, now)[SUM]}, {SUM: with_sum(slowed(now, OWN, 1.13), before)[SUM]}
        assert decide(*sides)[0].change == pytest.approx(1.13, abs=0.02)


def test_missing_and_new_kernels_are_reported() -> None:
    before, now = {"a": [1.0] * 3, "gone": [1.0] * 3}, {"a": [1.0] * 3, "fresh": [9.0] * 3, "late": [9.0] * 3}
    found = {each.kernel: each for each in decide(before, now, brings=lambda kernel: kernel == "fresh")}
    assert list(found) == ["a", "gone", "fresh", "late"]
    assert [found[name].status for name in found] == ["as before", "missing", "new", "no baseline"]
    assert [found[name].fails for name in found] == [False, True, False, True]


def test_each_status_at_its_side_of_the_threshold() -> None:
    steady, wide = [1.0, 1.01, 0.99, 1.0], [0.8, 0.9, 1.1, 1.3]

    def status(before: list[float], factor: float, accepted: float = 1.0) -> str:
        (verdict,) = decide({"a": before}, {"a": [factor * cost for cost in before]}, {"a": accepted})
        return verdict.status

    assert [status(steady, factor) for factor in (1.13, 1.07, 0.8)] == ["slower", "as before", "faster"]
    assert status(wide, 1.2) == "perhaps slower"


def test_an_accepted_slowdown_hides_no_further_one() -> None:
    steady = [1.0, 1.01, 0.99, 1.0]
    for factor, status in ((1.2, "as before"), (1.36, "slower")):
        (verdict,) = decide({"a": steady}, {"a": [factor * cost for cost in steady]}, {"a": 1.2})
        assert verdict.status == status
        assert verdict.threshold == pytest.approx(1.2 * THRESHOLD)


def test_the_change_is_the_ratio_of_two_samples_and_robust_against_outliers() -> None:
    before, now = [4.0, 4.1, 3.9, 4.0, 40.0], [6.0, 6.1, 5.9, 0.6, 6.0]
    change, low, high = change_of(before, now)
    assert change == pytest.approx(1.5, rel=0.03)
    assert low < change < high
    assert change_of([4.0] * 5, [6.0] * 5) == (1.5, 1.5, 1.5)


def test_the_interval_has_its_nominal_coverage() -> None:
    """80 % of the intervals of lognormal samples contain the true change, with few processes and with many."""
    chance = np.random.default_rng(2)
    for count in (4, 8, 12):
        covered = []
        for _ in range(800):
            before, now = np.exp(0.05 * chance.standard_normal((2, count)))
            _, low, high = change_of(before, 1.2 * now)
            covered.append(low <= 1.2 <= high)
        assert 0.74 < np.mean(covered) < 0.90


def test_more_processes_narrow_the_interval() -> None:
    widths = []
    for count in (4, 8, 12):
        samples = np.exp(0.05 * np.random.default_rng(3).standard_normal((2, 400, count)))
        bounds = [change_of(before, now)[1:] for before, now in zip(*samples, strict=True)]
        widths.append(np.mean([high - low for low, high in bounds]))
    assert all(wide > 1.2 * narrow for wide, narrow in pairwise(widths))
