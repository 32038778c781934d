"""The flow curve of a mud: its parameters, and readings of a viscometer."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case import load
from fctd.case.errors import InputError
from fctd.case.rheology import DEGREE, FLATTEST, PER_RPM, Rheology, RheologySpec, fit
from tests.cases import make_case

PSF = 47.88026  # lbf/ft² [Pa]


def test_stress_is_that_of_herschel_and_bulkley() -> None:
    found = Rheology(np.array([0.0, 2.0]), np.array([0.02, 0.5]), np.array([1.0, 0.5])).stress(100.0)
    assert found.tolist() == pytest.approx([2.0, 7.0])


def test_upper_index_is_that_of_a_power_law_and_lower_with_a_yield_stress() -> None:
    assert Rheology(0.0, 0.5, 0.7).upper_index == pytest.approx(0.7)
    assert Rheology.newtonian(np.array([0.02, 0.0])).upper_index.tolist() == pytest.approx([1.0, 1.0])
    # Plastic viscosity 20 and yield point 20 of a viscometer: readings 60 and 40, n = log2(1.5).
    assert Rheology(20.0, 20 / 511, 1.0).upper_index == pytest.approx(np.log2(1.5))
    assert Rheology(10.0, 0.0, 1.0).upper_index == FLATTEST


def test_four_readings_follow_the_rule_of_rp_13d() -> None:
    """τ_y = 2 θ3 − θ6, n = log2((θ600 − τ_y)/(θ300 − τ_y)), K = (θ300 − τ_y)/511ⁿ: by hand for 60, 40, 8, 6."""
    found = fit({600: 60.0, 300: 40.0, 6: 8.0, 3: 6.0})
    index = np.log2(56 / 36)
    assert list(found.curve) == pytest.approx([4 * DEGREE, 36 * DEGREE / 511**index, index])
    assert found.rule == "RP 13D's rule"
    assert found.misfit == pytest.approx([0, 0, 4 + 36 * 0.02**index - 8, 4 + 36 * 0.01**index - 6], abs=0.01)


def test_two_readings_make_plastic_viscosity_and_yield_point() -> None:
    found = fit({600: 60.0, 300: 40.0})
    assert list(found.curve) == pytest.approx([20 * DEGREE, 0.020, 1.0])
    assert found.misfit == pytest.approx([0, 0], abs=1e-9)


@given(st.floats(0, 20), st.floats(2, 200), st.floats(0.2, 1.0))
def test_least_squares_find_the_curve_that_was_read(least: float, more: float, index: float) -> None:
    speeds = np.array([600, 300, 200, 100, 6])
    read = least + more * (speeds / 600) ** index
    found = fit(dict(zip(speeds.tolist(), read.tolist(), strict=True)))
    assert found.rule == "least squares"
    assert np.abs(found.misfit).max() < 0.02
    assert found.curve.stress(PER_RPM * 600) == pytest.approx(DEGREE * read[0], rel=2e-3)


@pytest.mark.parametrize("readings", [{600: 3, 300: 1}, {600: 6, 300: 5, 6: 5, 3: 5}, {600: 90, 300: 30, 6: 1, 3: 1}])
def test_readings_of_which_the_rule_makes_no_mud_are_fitted_with_their_misfit(readings: dict[int, float]) -> None:
    found = fit(readings)
    assert found.curve.yield_stress >= 0
    assert 0 < found.curve.index <= 1
    assert 0 < np.abs(found.misfit).max() < 16


def test_a_case_says_its_curve_in_one_of_three_ways() -> None:
    def curve(**mud: Any) -> list[float]:
        found = make_case(mud={"density": 1200.0, **mud}).mud.curve
        return [] if found is None else list(found)

    assert curve() == []
    assert curve(viscosity="30 cP") == pytest.approx([0.0, 0.03, 1.0])
    bingham = {"plastic_viscosity": "20 cP", "yield_point": "6 lbf/(100 ft^2)"}
    assert curve(rheology=bingham) == pytest.approx([0.06 * PSF, 0.02, 1.0])
    power = {"consistency": "1 lbf*s^n/(100 ft^2)", "index": 0.7}
    assert curve(rheology=power) == pytest.approx([0.0, 0.01 * PSF, 0.7])
    assert curve(rheology=power | {"yield_stress": "2 Pa", "consistency": 0.5}) == pytest.approx([2.0, 0.5, 0.7])
    assert curve(fann={"600": 60, "300": 40}) == pytest.approx([20 * DEGREE, 0.02, 1.0])


def test_a_stored_case_keeps_its_readings() -> None:
    case = make_case(mud={"density": 1200.0, "fann": {600: 60, 300: 40, 6: 8, 3: 6}})
    again = type(case).model_validate_json(case.model_dump_json())
    assert again.mud.fann == case.mud.fann
    assert again.mud.curve == case.mud.curve


def test_motion_that_changes_has_the_viscosity_at_a_hundred_per_second() -> None:
    assert make_case(mud={"density": 1200.0, "viscosity": 0.05}).mud.unsteady == pytest.approx(0.05)
    mud = make_case(mud={"density": 1200.0, "fann": {600: 60, 300: 40}}).mud
    assert mud.unsteady == pytest.approx(0.02 + 20 * DEGREE / 100)


@pytest.mark.parametrize(
    ("mud", "sentence"),
    [
        (
            {"fann": {600: 40, 300: 60}},
            "mud.fann.600 = 40.0: expected more than 60, the reading at 300 rev/min, as the stress in a mud rises with "
            "the speed",
        ),
        ({"fann": {600: 60}}, "mud.fann = {\"600\": 60}: expected a table of readings by speed, at least two, such as"),
        ({"fann": {600: 60, "low": 3}}, "mud.fann.low = 3: expected a speed of the viscometer in rev/min, such as 600"),
        ({"fann": {600: "60 Pa", 300: 40}}, 'mud.fann.600 = "60 Pa": expected a reading in degrees'),
        ({"fann": {600: 60, 300: 40}, "viscosity": 0.02}, '"300": 40}: expected viscosity or fann, not both'),
        (
            {"rheology": {"plastic_viscosity": 0.02}},
            "mud.rheology.yield_point is missing: expected plastic_viscosity and yield_point, or consistency and index",
        ),
        (
            {"rheology": {"index": 0.6}},
            "mud.rheology.consistency is missing: expected plastic_viscosity and yield_point, or consistency and index",
        ),
        (
            {"rheology": {"consistency": 0.5, "index": 0.6, "yield_point": 3}},
            "mud.rheology.yield_point = 3: expected plastic_viscosity and yield_point, or consistency and index, not",
        ),
        ({"rheology": {"plastic_viscosity": 20, "yield_point": 3}}, "(20 looks like '20 mPa*s')"),
        ({"rheology": {"consistency": "1 m", "index": 0.6}}, "expected a consistency of 0 to 200 Pa*s^n, such as 0.5"),
    ],
)  # fmt: skip
def test_wrong_curves_are_refused_in_a_sentence(mud: dict[str, Any], sentence: str) -> None:
    raw = make_case().model_dump(mode="json", exclude_none=True, exclude={"file", "mud"})
    with pytest.raises(InputError) as caught:
        load.make_case({**raw, "mud": {"density": 1200, **mud}}, None)
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_power_law_without_yield_stress_passes_through_its_consistency() -> None:
    assert RheologySpec(consistency=0.5, index=0.5).curve.stress(4.0) == pytest.approx(1.0)
