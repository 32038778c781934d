"""The table [limits]: what it takes and what it refuses."""

import pytest
from pydantic import ValidationError

from tests.cases import make_case


def test_all_of_each_capacity_may_be_used_by_default() -> None:
    limits = make_case().limits
    assert (limits.design_factor, limits.torque_share, limits.overpull_margin) == (1.0, 1.0, 0.0)


def test_margins_take_units() -> None:
    assert make_case(limits={"overpull_margin": "200 kN"}).limits.overpull_margin == 200e3


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("design_factor", 0.9),
        ("design_factor", 12),
        ("torque_share", 0),
        ("torque_share", 1.1),
        ("overpull_margin", -1.0),
    ],
)
def test_shares_beyond_the_capacity_are_refused(key: str, value: float) -> None:
    with pytest.raises(ValidationError, match=f"limits.{key}"):
        make_case(limits={key: value})
