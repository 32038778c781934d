"""Settings that a comparison tries, by what the options of a method say."""

from typing import Annotated

from pydantic import Field

from fctd.arena.method import settings_of
from fctd.case.errors import Table
from tests.arena.test_contract import Exact


class Two(Table):
    """An option with examples and one without."""

    facets: Annotated[int, Field(examples=[12, 24])] = 24
    smooth: bool = False


def test_the_examples_of_each_option_or_the_defaults() -> None:
    assert list(settings_of(type("Both", (Exact,), {"Options": Two}))) == [{"facets": 12}, {"facets": 24}]
    assert list(settings_of(type("None", (Exact,), {"Options": Table}))) == [{}]
