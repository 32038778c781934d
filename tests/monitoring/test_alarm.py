"""Page's sums: steps found, false alarms within the stated rate, what a step is called."""

import numpy as np
import pytest

from fctd.monitoring.alarm import Alarm, Detector
from fctd.monitoring.friction import Apparent
from fctd.monitoring.stretches import Mode, Quartiles, Stretch

MODES: tuple[Mode, ...] = ("rotating", "pick_up", "slack_off")
NOISE = {"rotating": 0.02, "pick_up": 0.05, "slack_off": 0.05}


def reading(k: int, factor: float, noise: float, mode: Mode) -> Apparent:
    none = Quartiles(0.0, 0.0, 0.0, 0.0)
    depth = 1000.0 + 10 * k
    stretch = Stretch(mode, k, k, k, k, depth, 1, none, none, 60.0, 0.0, 0.0, "", np.empty((0, 3)))
    return Apparent(stretch, factor, noise, 0.0, 0.0, "")


def alarms(seed: int, count: int, step_at: int | None = None, step: float = 0.075, scatter: float = 1.0) -> list[Alarm]:
    """Of readings of 0.3, 0.35 and 0.25 by mode, with a step from one of them on."""
    generator, detector = np.random.default_rng(seed), Detector()
    found = []
    for k in range(count):
        mode = MODES[k % 3]
        true = 0.3 + 0.05 * (k % 3 - (k % 3 == 2) * 3) + (step if step_at is not None and k >= step_at else 0.0)
        factor = true + scatter * NOISE[mode] * generator.standard_normal()
        alarm = detector.feed(reading(k, factor, NOISE[mode], mode))
        found += [] if alarm is None else [alarm]
    return found


@pytest.mark.parametrize("scatter", [1.0, 2.0])
def test_false_alarms_are_fewer_than_stated(scatter: float) -> None:
    """One in 50 readings is accepted: 60 in 3,000; also where readings scatter twice as much as they say."""
    assert sum(len(alarms(seed, 300, scatter=scatter)) for seed in range(10)) <= 60


@pytest.mark.parametrize("step", [0.075, -0.075])
def test_a_step_of_a_quarter_is_found_with_its_depth_and_size(step: float) -> None:
    found = [[a for a in alarms(seed, 90, 60, step) if a.row >= 60] for seed in range(20)]
    first = [each[0] for each in found if each]
    assert len(first) >= 19
    assert np.median([alarm.row for alarm in first]) <= 60 + 9  # three stands of three readings
    assert np.median([alarm.start for alarm in first]) == pytest.approx(1600, abs=40)
    assert np.mean([alarm.size for alarm in first]) == pytest.approx(step, abs=0.025)


def test_readings_without_a_factor_change_nothing() -> None:
    detector = Detector()
    assert all(detector.feed(reading(k, float("nan"), 0.02, "rotating")) is None for k in range(50))
    assert np.isnan(detector.band("rotation")[0])


def test_a_constant_factor_raises_no_alarm() -> None:
    detector = Detector()
    assert all(detector.feed(reading(k, 0.3, 0.02, "rotating")) is None for k in range(200))
    assert detector.band("rotation") == pytest.approx((0.3, 0.02 / 197**0.5))  # three of them wait


def test_a_sentence_has_start_size_and_share() -> None:
    text = Alarm(2200.0, 2230.0, 7, 0.0, 0.075, 0.03, 0.12, 0.3).sentence
    for part in ("from 2200 m", "0.07 above the 0.30", "25%", "+0.03 to +0.12", "at 2230 m"):
        assert part in text
