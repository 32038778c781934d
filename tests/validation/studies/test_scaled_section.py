"""How the study of the scaled section measures: contacts, and differences between two models."""

import numpy as np
import pandas as pd
import pytest

from validation.parts import scaled_models
from validation.parts.scaled_models import Comparable, differences
from validation.studies import scaled_section


def model(force=1.0, shift=0.0, late=0.0, deeper=0.0):
    time, above = np.linspace(0.2, 10, 50), np.linspace(18, 0, 181)
    total = 1000 * force / (1 + np.exp(5 + late - time))
    shares = {f"{side}_N": total / 3 for side in scaled_models.SIDES}
    string = {"above_bit_m": above, "md_m": 44 - above, "horizontal_m": (18 - above) ** 2 / 60 + shift}
    contacts = {"md_m": [29.0 + deeper, 35.0, 44.0], "force_N": [-300.0, 900.0, -600.0]}
    return Comparable(
        pd.DataFrame({"time_s": time, "total_N": total} | shares),
        pd.DataFrame(string).assign(offset_high_m=0.0),
        pd.DataFrame(contacts),
    )


def test_a_model_does_not_differ_from_itself():
    found = differences(model(), model(), 0.025)
    assert found["correlation"] == pytest.approx(1.0)
    for name in ("total_rms_percent", "displacement_max_percent", "position_difference_m"):
        assert found[name] == pytest.approx(0.0, abs=1e-6)


def test_differences_are_measured():
    scaled = differences(model(force=1.1), model(), 0.025)
    total = model().history["total_N"]
    assert scaled["total_rms_percent"] == pytest.approx(10 * np.sqrt((total**2).mean()) / total.max())
    assert scaled["correlation"] == pytest.approx(1.0)
    assert differences(model(late=1.0), model(), 0.025)["correlation"] < 0.99
    shifted = differences(model(shift=-0.002, deeper=0.3), model(), 0.025)
    assert shifted["displacement_max_percent"] == pytest.approx(8.0)
    assert shifted["displacement_rms_percent"] == pytest.approx(8.0)
    assert shifted["position_difference_m"] == pytest.approx(0.3)


def test_displacement_is_that_of_the_same_points_of_the_string():
    coarse = model(shift=0.002).string.iloc[::30]
    coarse.loc[coarse.index[-1], "horizontal_m"] -= 0.006
    found = scaled_models.displacements(coarse, model().string, 0.025)
    assert found["displacement_bit_percent"] == found["displacement_max_percent"] == pytest.approx(16.0)
    assert found["displacement_above_end_percent"] == pytest.approx(8.0)
    assert found["displacement_rms_percent"] == pytest.approx(np.sqrt((6 * 8**2 + 16**2) / 7))


def test_the_steady_string_lies_where_its_own_shape_is():
    """Compared with itself it has zero difference; the count is the requested one."""
    case = scaled_section.load("scaled_section")
    point = scaled_section.equilibrium(case, "trip_in", 44.0)
    truth = model()._replace(string=scaled_models.shape_of(case, point.profile.iloc[1:]))
    (row,) = scaled_section.steady_differences((30,), truth, 0.025).to_dict("records")
    assert row["segments"] == 30
    assert row["displacement_max_percent"] == pytest.approx(0.0, abs=1e-9)


def test_a_contact_that_one_model_lacks_is_infinitely_far():
    outer = model()._replace(contacts=model().contacts.iloc[[0, 2]])
    assert differences(outer, model(), 0.025)["position_difference_m"] == np.inf
    assert differences(model(), outer, 0.025)["position_difference_m"] == np.inf


def test_contacts_part_where_the_side_changes_or_a_gap_is():
    md = np.array([10.0, 10.3, 10.6, 10.9, 15.0, 15.3])
    force = np.array([-1.0, -3.0, 0.0, 2.0, 4.0, 4.0])
    found = scaled_models.contact_forces(md, force)
    assert found["force_N"].to_list() == [-4.0, 2.0, 8.0]
    assert found["md_m"].to_list() == pytest.approx([10.225, 10.9, 15.15])
    assert scaled_models.contact_forces(md, 0 * force).empty


def test_sides_add_up_to_the_total():
    case = scaled_section.load("scaled_section")
    md, force = np.array([[30.0, 35.0, 43.0]]), np.array([[-2.0, 3.0, -4.0]])
    found = scaled_models.history_of(np.array([1.0]), force, md, case).iloc[0]
    assert found.to_list() == [1.0, 9.0, 2.0, 3.0, 4.0]


def test_the_last_metre_may_be_cut_finer():
    """As many segments in all, those of the end shorter; distances from the bit are those of their ends."""
    case = scaled_section.load("scaled_section", string__components__0__segments=240)
    finer = scaled_models.cut_at_the_end(case)
    above = scaled_models.ends_above_bit(finer)
    assert len(above) == len(scaled_models.ends_above_bit(case)) == 241
    assert above[-1] == pytest.approx(18.0)
    np.testing.assert_allclose(np.diff(above)[:24], 0.9 / 24)
    np.testing.assert_allclose(np.diff(above)[24:], 17.1 / 216)
