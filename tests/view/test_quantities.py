"""Quantities that colour the string: names, units, ranges of colours."""

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.view.quantities import QUANTITIES, quantity_of


def test_an_unknown_quantity_is_refused_with_the_nearest() -> None:
    assert quantity_of("stress") is QUANTITIES["stress"]
    with pytest.raises(InputError, match="the quantity tension") as refused:
        quantity_of("tensoin", "--colour")
    assert refused.value.key == "--colour"


def test_units_are_those_of_the_system() -> None:
    labels = {name: (one.shown("si").label, one.shown("field").label) for name, one in QUANTITIES.items()}
    assert labels["side_force"] == ("kN/m", "lbf/ft")
    assert labels["clearance"] == ("mm", "in")
    assert labels["buckling"] == ("", "")
    assert QUANTITIES["torque"].shown("si") == (1e-3, "kN·m")


def test_a_signed_range_has_zero_in_its_middle_and_a_peak_does_not_set_it() -> None:
    tension, force = QUANTITIES["tension"], QUANTITIES["side_force"]
    ten = np.full(2, 10.0)
    assert tension.limits(np.array([-3.0, 1.0]), ten) == (-3.0, 3.0)
    assert tension.limits(np.array([0.0, 4.0]), ten)[0] == 0.0
    assert tension.colours(0.0) == force.colours(0.0) != tension.colours(-1.0)
    # A hundred short segments at the bit are less than a hundredth of the string.
    values, lengths = np.repeat([1.0, 1e6], 100), np.repeat([100.0, 0.5], 100)
    assert force.limits(values, lengths) == (0.0, 1.0)
    assert force.limits(np.array([np.nan]), ten[:1]) == (0.0, 1.0)
    assert QUANTITIES["buckling"].limits(values, lengths) == (-0.5, 2.5)


def test_touching_is_the_dark_end_of_the_distance_to_the_wall() -> None:
    near, far = (QUANTITIES[name].colours(0.0) for name in ("clearance", "side_force"))
    assert near[0][1] == far[-1][1]
    assert [at for at, _ in near] == sorted(at for at, _ in near)
