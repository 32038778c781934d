"""Fits with scatter between days: one factor of a setup, readings carried on, frozen posteriors."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fctd.calibration.forward import Forward
from fctd.calibration.predict import read_posterior
from fctd.calibration.rows import Range, Row
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import find_unknowns
from fctd.model.operations import SteadyRates
from tests.cases import make_case, pipe
from validation.parts.day_fits import carried_on, fit_by_day, freeze, furthest, one_factor

LEVEL = make_case([[0, 90, 0], [900, 90, 0]], [pipe(None, None, segment_length=50.0)])
SETUP = Setup.model_validate({"unknowns": {"friction": {"bounds": (0.05, 0.6)}}, "scatter": {"friction": 0.1}})


def pull(name: str, depth: float, force: float, day: str) -> Row:
    return Row(f"{name} up", "", depth, "trip_out", SteadyRates(-0.1, 0.0), Range(force, force), day=day)


def rows(*days: float) -> list[Row]:
    """A pull of 500 m on each day, with that friction."""
    forward = Forward([pull("x", 500.0, 0.0, "")], {"": LEVEL}, find_unknowns({}, SETUP, [LEVEL]), SETUP)
    return [
        pull(f"r{k}", 500.0, float(forward.evaluate(np.array([factor])).value[0]), f"day {k}")
        for k, factor in enumerate(days)
    ]


def test_one_factor_takes_the_place_of_a_pair() -> None:
    prior = {"mean": 0.2, "sd": 0.1}
    both = {"friction.open.axial": {"prior": prior}, "friction.open.rotational": {}, "rig.block_weight": {}}
    setup = one_factor(Setup.model_validate({"unknowns": both}))
    assert [*setup.unknowns] == ["friction.open", "rig.block_weight"]
    assert setup.unknowns["friction.open"].prior is not None


def test_a_frozen_posterior_is_that_of_its_fit(tmp_path: Path) -> None:
    found = fit_by_day({"": LEVEL}, rows(0.25, 0.3, 0.36), SETUP, starts=1)
    freeze(found, tmp_path / "one.fit.json")
    kept = read_posterior(tmp_path / "one.fit.json")
    assert kept.best == pytest.approx(found.fit.best, rel=1e-8)
    assert furthest(found, kept) < 1e-6
    assert kept.mixture is not None
    whole = found.posterior.mixture
    assert whole is not None
    assert len(kept.mixture.weight) < len(whole.weight)
    assert kept.mixture.weight.sum() == pytest.approx(1.0)
    assert found.fit.best[0] == pytest.approx(0.3, abs=0.02)


def test_the_last_reading_is_that_of_the_same_kind_before() -> None:
    unknowns = find_unknowns({}, SETUP, [LEVEL])
    fitted = [pull("a", 300.0, 10e3, ""), pull("b", 400.0, 20e3, ""), pull("c", 600.0, 30e3, "")]
    judged = [pull("x", 500.0, 0.0, ""), pull("y", 200.0, 0.0, "")]
    judged.append(replace(judged[0], id="x down", operation="trip_in", rates=SteadyRates(0.1, 0.0)))
    old, new = (Forward(part, {"": LEVEL}, unknowns, SETUP) for part in (fitted, judged))
    # Nothing is earlier than y, which has the first; no slack-off was fitted.
    assert carried_on(old, new, lambda row: row.bit_depth) == {("x", "weight up"): 20.0, ("y", "weight up"): 10.0}
