"""Flow and trips of a case whose string lies where it lies."""

import pytest

from fctd import InputError, hydraulics_of, lie_along, surge_pressures
from tests.cases import make_case, pipe

WELL = [[0, 0, 0], [500, 0, 0], [800, 60, 0], [1200, 60, 0]]
PIPE = [pipe(None, None, segment_length=50.0)]


def test_the_word_of_the_case_is_where_the_string_lies() -> None:
    """As an argument, and as a key of the case."""
    mud = {"density": 1200.0, "viscosity": 0.03, "eccentricity": "string"}
    case = make_case(WELL, PIPE, mud=mud)
    lost = [
        float(hydraulics_of(case, 0.03, [1100.0], **given)["annulus_drop_Pa"].iloc[0])
        for given in ({"eccentricity": lie_along}, {"eccentricity": "string"}, {})
    ]
    assert lost[0] == lost[1] == lost[2] > 0
    assert (surge_pressures(case, [0.5], [1100.0])["surge_Pa"] != 0).all()
    with pytest.raises(InputError, match=r'eccentricity = "strnig": expected a number, or "string"'):
        hydraulics_of(case, 0.03, eccentricity="strnig")
