"""The public well: what fits judges nothing, the reading of a report, and the score of a prediction."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fctd.calibration.predict import read_posterior
from fctd.calibration.rows import Range, Row
from fctd.calibration.setup import Setup, read_setup
from fctd.calibration.unknowns import find_unknowns, parse_fits
from fctd.model.operations import SteadyRates, rad_per_s
from tests.cases import make_case, pipe
from validation.parts import volve_f4 as split
from validation.parts import volve_f4_days as days
from validation.parts.judged_well import ONE_FACTOR
from validation.parts.volve_f4_fits import Frozen, frozen, setup_of, setup_of_b
from validation.parts.volve_f4_judging import predict
from validation.parts.volve_f4_rows import FOLDER, REPORTS, TONNE, report_rows
from validation.parts.volve_f4_soft import SoftForward

# Columns that are read.
HEADER = "id,date,bit_depth_m,rpm,torque_low_kN_m,torque_high_kN_m,up_weight_t,down_weight_t,rotating_weight_t\n"


def test_no_row_both_fits_and_judges() -> None:
    assert not set(split.FIT_A) & set(split.JUDGED_A)
    assert not {*split.FIT_RIG, *split.FIT_B} & set(split.JUDGED_B)
    assert {*split.FIT_B, *split.JUDGED_B, *split.FIT_A} - {split.SERIES} == set(split.STRINGS)


def test_the_frozen_values_are_of_the_rows_that_fit() -> None:
    fits = frozen()
    assert {row.rsplit(" ", 1)[0] for row in fits["B"].rows} == set(split.FIT_B)
    assert not any(row.startswith("F4") for name in fits if name != "B" for row in fits[name].rows)


def test_the_first_stage_is_the_prior_of_the_second() -> None:
    rig = frozen()["rig"]
    block = setup_of_b(rig).unknowns["rig.block_weight"]
    assert block.prior is not None
    assert block.prior.mean == rig.best["rig.block_weight"]
    assert "rig.block_weight" not in setup_of("reports").unknowns


@pytest.mark.parametrize("name", days.SPLITS)
def test_the_second_round_has_the_splits_of_the_first(name: str) -> None:
    one = days.SPLITS[name]
    assert not set(one.fit) & set(one.judged)
    for model in days.ROUTES:
        kept = read_posterior(days.frozen_file(name, model))
        paired = [unknown.name for unknown in kept.unknowns if unknown.name.endswith((".axial", ".rotational"))]
        assert bool(paired) == (model != ONE_FACTOR)
        assert kept.mixture is not None
        assert kept.setup.model_error.hookload == 0.0


def test_what_the_well_says_of_others_is_wider_than_what_it_says_of_itself() -> None:
    others = read_setup(days.FOR_OTHERS)
    prior = others.unknowns["friction.cased.axial"].prior
    assert prior is not None
    assert float(prior.sd) / float(prior.mean) > np.sqrt(np.expm1(days.AMONG_WELLS**2)) > 0.4
    assert others.scatter.friction == pytest.approx(0.217, abs=0.001)


def reports(tmp_path: Path, *lines: str) -> list[Row]:
    (tmp_path / FOLDER).mkdir()
    (tmp_path / FOLDER / REPORTS).write_text(HEADER + "".join(f"{line}\n" for line in lines), encoding="utf-8")
    strings = dict.fromkeys(split.STRINGS.values(), make_case())
    return report_rows(tmp_path, strings, [line.split(",")[0] for line in lines])


def test_a_report_is_two_strokes_and_a_rotation(tmp_path: Path) -> None:
    up, down, turning = reports(tmp_path, "F4-10,2008-03-07,500,10-20,6,9,150,120,130")
    assert [row.operation for row in (up, down, turning)] == ["trip_out", "trip_in", "rotate_off_bottom"]
    assert up.hookload == Range(150 * TONNE, 150 * TONNE)
    assert turning.torque == Range(6e3, 9e3)
    assert turning.rates.spin == pytest.approx(rad_per_s(15))
    assert (up.rates.spin, up.torque) == (0.0, None)


def test_the_string_that_turns_on_its_way_has_no_torque_of_its_own_and_a_slow_speed(tmp_path: Path) -> None:
    up, down = reports(tmp_path, "F4-13r,2008-03-15,500,20,,,137,129,")
    assert (up.operation, down.operation) == ("back_ream", "trip_in")
    assert (up.rates.speed, down.rates.speed) == (-0.1, 0.1)
    assert down.rates.spin == pytest.approx(rad_per_s(20))


def test_torque_at_rest_is_left_out(tmp_path: Path) -> None:
    assert [row.operation for row in reports(tmp_path, "F4-07,2008-03-06,500,0,2,3,150,120,")] == [
        "trip_out",
        "trip_in",
    ]


def test_a_spread_is_scored_with_the_errors_of_its_two_readings() -> None:
    """A vertical string without friction has no spread: 10 kN were read, where each reading is off by 10 and 10 kN."""
    setup = Setup.model_validate(
        {
            "unknowns": {"rig.block_weight": {"prior": {"mean": 300e3, "sd": 5e3}}},
            "sources": {"report": {"hookload_noise": 10e3}},
            "model_error": {"hookload": 10e3},
        }
    )
    case = make_case()
    blank = Row("F4-10 up", "", 100.0, "trip_out", SteadyRates(-0.1, 0.0), Range(20e3, 20e3), source="report")
    down = replace(blank, id="F4-10 down", operation="trip_in", rates=SteadyRates(0.1, 0.0), hookload=Range(0.0, 0.0))
    assert [unknown.name for unknown in find_unknowns({}, setup, [case])] == ["rig.block_weight"]
    (found,) = predict(
        {"": case}, [blank, down], setup, Frozen({"rig.block_weight": 300e3}, np.array([[25e6]]), ())
    ).to_dict("records")
    # Half of the root of four errors of 10 kN; the block is in both readings.
    assert found["high_95"] - found["median"] == pytest.approx(1.959964 * 10.0, rel=1e-6)
    assert found["measured_low"] == pytest.approx(10.0)
    assert (found["in_50"], found["in_95"]) == (False, True)
    assert found["distance_percent"] == pytest.approx(100.0, abs=1.0)


def test_the_soft_string_gives_readings_and_their_slopes() -> None:
    """Pulled along a level hole it weighs μ times its weight in air."""
    case = make_case([[0, 90, 0], [500, 90, 0]], [pipe(None, None, segment_length=25.0)])
    row = Row("up", "", 500.0, "trip_out", SteadyRates(-0.1, 0.0), Range(0.0, 0.0))
    unknowns = find_unknowns(parse_fits(["friction"]), Setup(), [case])
    found = SoftForward([row], {"": case}, unknowns, Setup()).evaluate(np.array([0.3]))
    weight = 500 * 7850 * 9.80665 * 0.25 * np.pi * (0.127**2 - 0.07**2)
    assert found.value[0] == pytest.approx(0.3 * weight, rel=1e-6)
    assert found.slopes[0, 0] == pytest.approx(weight, rel=1e-6)
