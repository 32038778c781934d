"""The fit with scatter between days through the engine: rows by day, its posterior, and days left out."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fctd.calibration.calibrate import calibrate, predict
from fctd.calibration.days import HOW
from fctd.calibration.forward import Forward
from fctd.calibration.predict import draw_readings, predict_rows, read_posterior
from fctd.calibration.result import Calibration
from fctd.calibration.rows import Row, days_of
from fctd.calibration.setup import Setup
from fctd.case.errors import InputError
from tests.calibration.wells import TRUTH, blank_rows, measured_rows, well

CASE = well()
KNOWN = ("friction.cased", "friction.open", "rig.block_weight", "rig.torque_offset")
TRUE = {name: TRUTH[name] for name in KNOWN}


def rows_of_days(friction: float, weight: float, noise: bool = True) -> list[Row]:
    """Three rows on each of six days whose friction and weight differ from the well's by these deviations."""
    rng, found = np.random.default_rng(3), []
    for day in range(6):
        a, b = friction * rng.normal(), weight * rng.normal()
        truth = {n: v * np.exp(a) if n.startswith("friction") else v for n, v in TRUE.items()}
        truth["rig.block_weight"] += b
        at = (700.0, 1100.0, 1500.0)[day % 3]
        some = [replace(r, id=f"{r.id}, day {day}", day=f"{day}") for r in blank_rows(CASE) if r.bit_depth == at]
        found += measured_rows(CASE, truth, some, day if noise else None)
    return found


@pytest.fixture(scope="module")
def found() -> Calibration:
    return calibrate(CASE, rows_of_days(0.15, 30e3), KNOWN, starts=1)


def test_rows_that_name_days_have_scatter(found: Calibration) -> None:
    table = found.table.set_index("name")
    assert (table["how"] == HOW).all()
    for name, truth in {**TRUE, "scatter.friction": 0.15, "scatter.hookload": 30e3}.items():
        assert table.loc[name, "low"] < truth < table.loc[name, "high"]
    assert found.misfit < 2.0  # the readings have the effects of their days
    assert calibrate(CASE, rows_of_days(0.15, 30e3), KNOWN, starts=1, scatter=False).misfit > 5.0
    assert set(found.values) == set(KNOWN)


def test_a_day_is_named_or_a_row() -> None:
    rows = blank_rows(CASE)[:3]
    names, day = days_of([replace(rows[0], day="Mon"), rows[1], replace(rows[2], day="Mon")])
    assert names == ("Mon", rows[1].id)
    assert day.tolist() == [0, 1, 0]


def test_exact_readings_have_the_well_and_little_scatter() -> None:
    found = calibrate(CASE, rows_of_days(0.0, 0.0, noise=False), KNOWN, starts=1)
    for name, truth in TRUE.items():
        assert found.values[name] == pytest.approx(truth, rel=0.04)  # its prior draws a little
    assert found.table.set_index("name").loc["scatter.hookload", "value"] < 10e3 / 3


def test_setup_may_hold_a_deviation_at_none() -> None:
    setup = Setup.model_validate({"scatter": {"friction": 0, "hookload": "2 kN"}})
    found = calibrate(CASE, rows_of_days(0.0, 5e3), KNOWN, setup=setup, starts=1)
    assert found.table["name"].tolist() == [*KNOWN, "scatter.hookload"]
    assert found.scattered is not None
    assert not found.scattered.fit.effects[:, 0].any()


def test_a_day_left_out_is_predicted_by_the_others(found: Calibration) -> None:
    rows = rows_of_days(0.15, 30e3)
    others = calibrate(CASE, rows[3:], KNOWN, starts=1)
    table = found.leave_one_out
    first = table[table["id"] == rows[0].id].iloc[0]
    for name in KNOWN:  # linear about the values of all days, against a fit of its own
        width = np.diff(others.table.set_index("name").loc[name, ["low", "high"]].to_numpy(float))[0]
        assert first[name] == pytest.approx(others.values[name], abs=0.1 * width)
    bands = predict_rows(others.posterior, [rows[0]], {"": CASE}).iloc[0]
    assert first["low95"] == pytest.approx(bands["low95"], abs=0.1 * (bands["high95"] - bands["low95"]))
    assert found.scattered is not None
    assert np.isfinite(found.scattered.score)


def test_a_day_not_seen_carries_the_scatter(found: Calibration, tmp_path: Path) -> None:
    posterior = found.posterior
    slips = blank_rows(CASE)[-2]
    wide, narrow = (
        predict_rows(one, [slips], {"": CASE}).iloc[0] for one in (posterior, replace(posterior, mixture=None))
    )
    spread = found.table.set_index("name").loc["scatter.hookload", "value"]
    assert wide["high95"] - wide["low95"] > 3.9 * np.hypot(10e3, spread)
    assert narrow["high95"] - narrow["low95"] < 0.8 * (wide["high95"] - wide["low95"])
    path = tmp_path / "well.fit.json"
    posterior.write(path)
    again = predict(found.case, [slips], path)
    assert again.iloc[0]["high95"] == pytest.approx(wide["high95"])
    old = json.loads(path.read_text(encoding="utf-8"))
    del old["scatter"]
    path.write_text(json.dumps(old), encoding="utf-8")
    assert read_posterior(path).mixture is None  # of an older fit, or of one without days
    posterior.write(path)
    raw = json.loads(path.read_text(encoding="utf-8"))
    raw["scatter"]["mean"][0] = [1.0]
    path.write_text(json.dumps(raw), encoding="utf-8")
    with pytest.raises(InputError, match="a posterior as fctd calibrate"):
        read_posterior(path)
    raw["scatter"] |= {"mean": raw["scatter"]["mean"][1:], "weight": raw["scatter"]["weight"][1:]}
    path.write_text(json.dumps(raw), encoding="utf-8")
    with pytest.raises(InputError, match=r"scatter\.deviations"):
        read_posterior(path)


def test_rows_of_a_day_share_its_effects(found: Calibration) -> None:
    """The band of a difference is narrower than that of rows of two days."""
    up, down = (replace(r, day="Mon") for r in blank_rows(CASE)[:2])
    known = found.posterior
    together, apart = (
        draw_readings(known, Forward([up, other], {"": CASE}, known.unknowns, known.setup))
        for other in (down, replace(down, day="Tue"))
    )
    spreads = [float(np.std(drawn[0] - drawn[2])) for drawn in (together, apart)]
    assert spreads[0] < 0.7 * spreads[1]
