"""The table [datum]: a rig on land or at sea, and what it refuses."""

from pathlib import Path

import pytest

from fctd.case.errors import InputError
from fctd.case.load import Case, load_case
from tests.cases import make_case


def test_a_rig_on_land_and_one_at_sea() -> None:
    """Land may lie below the sea."""
    assert make_case(datum={"elevation": "-1200 ft"}).datum.elevation == pytest.approx(-365.76)
    sea = make_case(datum={"air_gap": "25 m", "water_depth": "100 m"}).datum
    assert (sea.sea_bed, make_case().datum.sea_bed) == (125.0, None)


@pytest.mark.parametrize(
    ("datum", "told"),
    [
        (
            {"elevation": 30.0, "air_gap": 30.0, "water_depth": 80.0},
            "datum.air_gap = 30.0: expected elevation or air_gap",
        ),
        ({"elevation": 30.0, "water_depth": 80.0}, "datum.air_gap is missing: .* in place of elevation"),
        ({"air_gap": 30.0}, "datum.water_depth is missing"),
        ({"air_gap": -1.0, "water_depth": 80.0}, "datum.air_gap = -1.0"),
        ({"air_gap": 30.0, "water_depth": 9000.0}, "datum.water_depth = .9000 m.: expected a sea bed above the end"),
        ({"elevation": float("nan")}, "datum.elevation"),
    ],
)
def test_what_no_rig_has_is_refused(datum: dict[str, float], told: str, case_file: Path) -> None:
    with pytest.raises(InputError, match=told):
        load_case(case_file, {"datum": datum})


def test_it_changes_nothing_that_is_computed() -> None:
    """A case without the table is the one that it was."""
    assert make_case(datum={"elevation": 5.0}).wellbore == make_case().wellbore
    assert Case.model_fields["datum"].default.model_fields_set == set()
