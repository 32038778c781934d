"""The fit: recovery without noise, ranges, priors, bounds, and a robust loss."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from fctd.calibration.fit import ROUGH, SOFT, Fit, cost_of, fit, residuals_of
from fctd.calibration.forward import Forward
from fctd.calibration.rows import Range, Row
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import find_unknowns, parse_fits
from tests.calibration.wells import TRUTH, exact_rows, well


def forward_of(rows: list[Row], names: list[str], *priors: str) -> Forward:
    return Forward(rows, {"": well()}, find_unknowns(parse_fits(names, priors), Setup(), [well()]), Setup())


def fitted(forward: Forward, **more: object) -> Fit:
    return fit(forward, range(len(forward.rows)), **{"starts": 1, **more})  # type: ignore[arg-type]


def test_rows_without_noise_give_the_values_that_made_them() -> None:
    found = fitted(forward_of(exact_rows(), list(TRUTH)))
    np.testing.assert_allclose(found.best, list(TRUTH.values()), rtol=1e-4)
    assert found.cost < 1e-6
    assert found.used == tuple(range(len(exact_rows())))


def test_every_start_ends_there() -> None:
    found = fitted(forward_of(exact_rows()[4:], ["friction.open", "rig.block_weight"]), starts=3)
    assert len(found.costs) == 3
    assert max(found.costs) - min(found.costs) < ROUGH * max(found.costs)


def test_a_range_counts_as_zero_inside() -> None:
    """The block lies anywhere in the range: its value stays where the fit starts."""
    slips = replace(exact_rows()[-2], hookload=Range(225e3, 240e3))
    forward = forward_of([slips], ["rig.block_weight=100 kN:300 kN"])
    inside = residuals_of(forward, forward.evaluate(np.array([230e3])), np.array([230e3]), [0])
    assert inside.value.tolist() == [0.0]
    assert inside.jacobian.tolist() == [[0.0]]
    outside = residuals_of(forward, forward.evaluate(np.array([250e3])), np.array([250e3]), [0])
    assert outside.value == pytest.approx([1.0])  # 10 kN beyond it, over 10 kN of noise
    assert 225e3 <= fitted(forward).best[0] <= 240e3


def test_a_prior_is_a_residual() -> None:
    """Two sources of one standard deviation each: the mean of both."""
    forward = forward_of([exact_rows()[-2]], ["rig.block_weight"], "rig.block_weight=250e3+-10e3")
    assert fitted(forward, loss="linear").best == pytest.approx([240e3], rel=1e-6)


def test_the_weight_of_a_row_multiplies_its_squares() -> None:
    """Four times the weight of the prior, whose standard deviation is that of the noise: a fifth of the way."""
    forward = forward_of([replace(exact_rows()[-2], weight=4.0)], ["rig.block_weight"], "rig.block_weight=250e3+-10e3")
    assert fitted(forward, loss="linear").best == pytest.approx([234e3], rel=1e-6)


def test_a_fit_ends_at_its_bounds() -> None:
    forward = forward_of([exact_rows()[-2]], ["rig.block_weight=240 kN:300 kN"])
    assert fitted(forward).best == pytest.approx([240e3], rel=1e-6)


def test_a_robust_loss_limits_an_outlier() -> None:
    """Of three in-slips rows one is 200 kN off: its pull is that of three standard deviations (soft l1)."""
    rows = [replace(exact_rows()[-2], id=str(k), hookload=Range(w, w)) for k, w in enumerate((230e3, 230e3, 430e3))]
    forward = forward_of(rows, ["rig.block_weight"])
    robust, linear = (fitted(forward, loss=loss).best[0] for loss in ("soft_l1", "linear"))
    assert linear == pytest.approx((2 * 230e3 + 430e3) / 3)

    def pull(x: float) -> float:
        return x / np.sqrt(1 + x**2 / SOFT**2)

    balance = brentq(lambda x: 2 * pull(x) - pull(20 - x), 0, 20)  # in standard deviations, 10 kN
    assert robust == pytest.approx(230e3 + 10e3 * balance, rel=1e-4)
    at = residuals_of(forward, forward.evaluate(np.array([230e3])), np.array([230e3]), [0, 1, 2])
    assert cost_of(at, "linear") == pytest.approx(0.5 * 20**2)
    assert cost_of(at, "soft_l1") == pytest.approx(SOFT**2 * (np.sqrt(1 + (20 / SOFT) ** 2) - 1))


def test_an_unknown_may_be_fixed() -> None:
    forward = forward_of(exact_rows()[-2:], ["rig.block_weight", "rig.torque_offset"])
    assert fitted(forward, fixed={0: 200e3}, loss="linear").best == pytest.approx([200e3, 1280.0])
