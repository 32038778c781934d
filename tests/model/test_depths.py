"""Depths as people write them: in equal steps, by words, and those that are taken where none is asked for."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.errors import InputError
from fctd.model.depths import MOST_DEPTHS, depth_of, depths_of, read_depth, read_depths, usual_depths
from tests.cases import make_case, pipe
from tests.cli.tiny import FOOT
from tests.plots.made import well

SHOD = well()


@given(
    first=st.integers(1, 50_000), step=st.integers(1, 400), count=st.integers(0, 300), beyond=st.integers(0, 399),
    unit=st.sampled_from([("", 1.0), (" m", 1.0), (" ft", FOOT), (" cm", 0.01)]),
)  # fmt: skip
def test_depths_rise_from_first_to_last_in_equal_steps(
    first: int, step: int, count: int, beyond: int, unit: tuple[str, float]
) -> None:
    """The last step may be shorter: the end is always in."""
    name, metres = unit
    last = first + count * step + beyond % step
    depths = read_depths(f"{first}{name}:{last}{name}:{step}{name}", SHOD, "--depths")
    expected = metres * np.unique(np.append(first + step * np.arange(count + 1), last))
    np.testing.assert_allclose(depths, expected, rtol=0, atol=1e-6)


def test_the_grid_has_a_limit() -> None:
    assert len(read_depths(f"1:{MOST_DEPTHS}:1", SHOD, "--depths")) == MOST_DEPTHS
    with pytest.raises(InputError):
        read_depths(f"1:{MOST_DEPTHS + 1}:1", SHOD, "--depths")


def test_calls_from_python_take_numbers_and_texts() -> None:
    assert [depth_of(given, SHOD, "at") for given in (1750, np.float64(1.5), "5000 ft", "td", "shoe")] == [
        1750, 1.5, 1524, 2000, 1500,
    ]  # fmt: skip
    assert depths_of("shoe:td:200", SHOD, "at") == read_depths("shoe:td:200", SHOD, "at")
    assert depths_of("td", SHOD, "at") == depths_of([2000.0], SHOD, "at") == [2000]
    assert depths_of(["500 m", "shoe", "td"], SHOD, "at") == [500, 1500, 2000]
    assert depths_of(range(1000, 2001, 500), SHOD, "at") == [1000, 1500, 2000]


def test_words_stand_for_the_shoe_and_the_end_of_the_hole() -> None:
    """A shoe at 1,500 m in a hole of 2,000 m."""
    assert read_depths("shoe:td:200", SHOD, "--depths") == [1500, 1700, 1900, 2000]
    assert read_depths("1400: shoe :100", SHOD, "--depths") == [1400, 1500]
    assert read_depths("td:td:1", SHOD, "--depths") == [2000]


def test_depths_from_the_surface_begin_below_it() -> None:
    """No string hangs at its top."""
    assert read_depths("0:td:800", SHOD, "--depths") == [800, 1600, 2000]
    with pytest.raises(InputError, match=r"a depth below string.top_md, 0 m"):
        read_depths("0:0:1", SHOD, "--depths")


def test_bare_numbers_are_in_the_given_unit() -> None:
    assert read_depth("1000", SHOD, "--bit-depth", "ft") == pytest.approx(1000 * FOOT)
    assert read_depth("1000 m", SHOD, "--bit-depth", "ft") == 1000
    assert read_depths("1000:2000:1000", SHOD, "--depths", "ft") == pytest.approx([1000 * FOOT, 2000 * FOOT])


@pytest.mark.parametrize("text", ["600", "600:900", "900:600:10", "600:900:0", "600:900:ten", "500:td:td"])
def test_wrong_depths_name_the_key(text: str) -> None:
    with pytest.raises(InputError) as error:
        read_depths(text, SHOD, "work.depths")
    assert error.value.key == "work.depths"


def test_usual_depths_of_a_long_segment_are_those_that_the_case_moves_it_through() -> None:
    long = [pipe(200, 20), pipe(None, 1)]
    moved = {"kind": "trip_in", "from_md": 250.0, "to_md": 400.0, "speed": 0.2}
    stations = [[0.0, 0, 0], [300, 0, 0], [500, 45, 0], [900, 45, 0]]
    assert usual_depths(make_case(stations, long, [moved]), 70)[::69] == [250.0, 400.0]
    assert usual_depths(make_case(stations, [pipe(None, None, segment_length=20.0)]), 70)[::69] == [450.0, 900.0]
