"""Judging on numbers whose answers are known."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from fctd.calibration.forward import Forward
from fctd.calibration.predict import Posterior
from fctd.calibration.quadrature import Mixture
from fctd.calibration.rows import Range, Row
from fctd.calibration.scatter import coordinate
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import find_unknowns, parse_fits
from fctd.model.operations import SteadyRates
from tests.cases import make_case, pipe
from validation.parts.judging import (
    Forecast,
    Judged,
    count_probabilities,
    coverage_interval,
    differences_of,
    judge,
    readings_of,
    summarise,
    widths,
)

RNG = np.random.default_rng(1)


def of_normal(truths: list[float], days: list[str], sd: float = 2.0) -> Forecast:
    """Independent normal forecasts about 100."""
    draws = 100 + sd * RNG.normal(size=(len(truths), 100_000))
    judged = tuple(Judged(f"r{k}", "weight up", ((k, 1.0),)) for k in range(len(truths)))
    middle = np.array(truths)
    return Forecast(judged, ("kN",) * len(truths), tuple(days), middle - 0.5, middle + 0.5, draws)


def test_bands_and_scores_of_a_normal_forecast() -> None:
    table = judge("well", "model", of_normal([100.0, 103.0, 105.0], ["a", "b", "c"]))
    assert table["high_95"].to_numpy() == pytest.approx(np.full(3, 100 + 2 * 1.959964), abs=0.05)
    assert table["in_50"].to_list() == [True, False, False]
    assert table["in_95"].to_list() == [True, True, False]
    # Of a normal distribution at its mean: sd (sqrt 2 - 1) / sqrt pi (Gneiting & Raftery 2007, Eq. 5).
    assert table["crps"][0] == pytest.approx(2 * (np.sqrt(2) - 1) / np.sqrt(np.pi), rel=0.02)
    assert table["distance_percent"].to_list() == pytest.approx([0, 100 * 2.5 / 103, 100 * 4.5 / 105], abs=0.05)


def test_a_summary_has_the_last_reading_carried_on_and_the_bias() -> None:
    found = of_normal([100.0, 103.0], ["a", "b"])
    carried = {("r0", "weight up"): 96.0, ("r1", "weight up"): 105.0}
    (row,) = summarise(found, judge("well", "model", found), carried).to_dict("records")
    assert row["crps_carried_on"] == pytest.approx(3.0)
    assert row["bias"] == pytest.approx(-1.5, abs=0.05)
    assert (row["readings"], row["days"], row["in_95"], row["compatible"]) == (2, 2, 2, True)


def test_without_a_reading_to_carry_on_there_is_no_score_of_it() -> None:
    found = of_normal([100.0, 103.0], ["a", "b"])
    table = summarise(found, judge("well", "model", found), {("r0", "weight up"): 96.0})
    assert np.isnan(table["crps_carried_on"][0])


def test_readings_that_miss_together_say_less() -> None:
    """Ten alike are all outside once in twenty times; ten independent ones never."""
    one = RNG.normal(size=20_000)
    assert count_probabilities(np.tile(one, (10, 1)), 10)[1] == pytest.approx(0.05, abs=0.005)
    apart = RNG.normal(size=(10, 20_000))
    assert count_probabilities(apart, 10)[1] == 0.0
    # Binomial: none outside with probability 0.95^10.
    assert count_probabilities(apart, 0)[0] == pytest.approx(0.95**10, abs=0.02)


def test_coverage_is_resampled_by_days() -> None:
    """Two days, one inside and one outside: a share of 0, 1/2 or 1 whatever the number of their readings."""
    assert coverage_interval(np.array([True] * 5 + [False] * 5), ["a"] * 5 + ["b"] * 5) == (0.0, 1.0)
    assert coverage_interval(np.ones(4, bool), ["a", "a", "b", "b"]) == (1.0, 1.0)


def test_the_width_of_a_difference_beside_that_of_the_scatter() -> None:
    """In a level hole the difference is twice the friction: of 10 % a day its width is 2 x 1.96 x 10 %."""
    case = make_case([[0, 90, 0], [500, 90, 0]], [pipe(None, None, segment_length=25.0)])
    unknowns = find_unknowns(parse_fits(["friction"]), Setup(), [case])
    up = Row("one up", "", 500.0, "trip_out", SteadyRates(-0.1, 0.0), Range(0.0, 0.0), day="Mon")
    down = replace(up, id="one down", operation="trip_in", rates=SteadyRates(0.1, 0.0))
    forward = Forward([up, down], {"": case}, unknowns, Setup())
    drag = forward.evaluate(np.array([0.3])).value[0]
    forward = Forward([replace(up, hookload=Range(drag, drag)), replace(down, hookload=Range(-drag, -drag))],
                      {"": case}, unknowns, Setup())  # fmt: skip
    at = float(coordinate(unknowns[0], 0.3))
    quiet = Setup.model_validate({"sources": {"": {"hookload_noise": "1 N"}}})
    spread = 0.1
    mixture = Mixture(np.ones(1), np.array([[spread, 0.0]]), np.array([[at]]), np.array([[[spread**2]]]))
    posterior = Posterior(tuple(unknowns), np.array([0.3]), np.array([[9e-4]]), quiet, {}, mixture)
    quiet_forward = Forward(forward.rows, {"": case}, unknowns, quiet)
    (row,) = widths(posterior, quiet_forward).to_dict("records")
    assert row["difference_kN"] == pytest.approx(2e-3 * drag)
    assert row["scatter_width"] == pytest.approx(np.exp(0.196) - np.exp(-0.196), rel=0.04)
    assert row["ratio"] == pytest.approx(np.sqrt(2), rel=0.06)  # the well's friction is as little known as a day's
    assert [one.quantity for one in readings_of(forward)] == ["weight up", "weight down"]
    assert [one.parts for one in differences_of(forward)] == [((0, 1.0), (2, -1.0))]
    assert isinstance(widths(posterior, quiet_forward), pd.DataFrame)
