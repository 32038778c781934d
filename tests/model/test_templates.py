"""Templates: wells of straights and bends, with a string that fits and loads that no part of the well contradicts."""

from typing import get_args

import numpy as np
import pytest

from fctd.case.string import ComponentSpec
from fctd.model.templates import TEMPLATES, Template, TemplateName

EACH = pytest.mark.parametrize("template", TEMPLATES.values(), ids=list(TEMPLATES))


def test_every_name_of_the_option_is_a_template() -> None:
    assert tuple(TEMPLATES) == get_args(TemplateName)


@EACH
def test_stations_follow_the_courses(template: Template) -> None:
    stations = np.array(template.stations)
    md, inclination = stations[:, 0], stations[:, 1]
    assert len(stations) >= 5
    assert (np.diff(md) > 0).all()
    assert md[-1] == sum(length for length, _ in template.courses)
    ends = np.cumsum([length for length, _ in template.courses])
    assert [inclination[md == end].item() for end in ends] == [end for _, end in template.courses]
    assert (np.diff(md)[np.diff(inclination) != 0] <= 160).all()


@EACH
def test_a_bend_is_one_that_is_drilled(template: Template) -> None:
    stations = np.array(template.stations)
    rate = np.abs(np.diff(stations[:, 1])) / np.diff(stations[:, 0]) * 30
    assert 1.0 < rate.max() <= 3.4  # °/30 m


@EACH
def test_the_shoe_lies_in_the_well_and_the_last_component_reaches_the_surface(template: Template) -> None:
    assert 0 < template.shoe < template.stations[-1][0]
    assert [part.length is None for part in template.string] == [False] * (len(template.string) - 1) + [True]


@EACH
def test_pipe_is_named_where_the_catalogue_has_it(template: Template) -> None:
    """Drill pipe with its joints, collars and casing; heavy-weight pipe is in no row of the catalogue."""
    for part in template.string:
        assert (set(part.keys) == {"pipe"}) == ("heavy-weight" not in part.name)
        component = ComponentSpec.model_validate({"name": part.name, **part.keys})
        assert (component.joint is not None) == ("drill pipe" in part.name)
