"""The compiled rows of a string: contact points and joints one by one, against numpy's formulas."""

import numpy as np

from fctd.model import string_rows
from fctd.model.drillstring import String, lay_out
from fctd.model.section import Section
from tests.cases import make_case, pipe


def string_of(*components: dict[str, object]) -> String:
    return lay_out(make_case(components=list(components)), 1000.0)


def test_contact_points_of_short_components() -> None:
    """A stabiliser touches at its middle with its own radius, the bit at its end; each bears all of its wall force."""
    string = string_of(pipe(1.0, 1, outer=0.2), pipe(50.0, 5), pipe(2.0, 1, outer=0.19), pipe(None, 94))
    assert np.flatnonzero(string.mid_contact()).tolist() == [94]
    at = [93, 94, 99, 100]
    assert string.contact_radius()[at].tolist() == [0.0635, 0.095, 0.0635, 0.1]
    assert string.tributary()[at].tolist() == [0.5 * (string.length[93] + 2.0), 2.0, 5.5, 1.0]


def test_stiffness_of_joints_is_that_of_half_segments_in_series() -> None:
    """To the last bit as numpy rounds: stored results of runs depend on it."""
    string = string_of(pipe(100.0, 10, outer=0.16), pipe(None, 30))
    for column, name in ((string_rows.EA, "EA"), (string_rows.GJ, "GJ")):
        compliance = 0.5 * string.length / string.of(name)
        expected = 1 / (np.append(0.0, compliance[:-1]) + compliance)
        assert np.array_equal(string.joints(name), expected)
        assert Section._fields[column] == name


def test_the_columns_are_the_fields_of_a_section() -> None:
    names = [name.upper() for name in Section._fields]
    assert [getattr(string_rows, name) for name in names] == list(range(len(names)))
