"""Settings of contact methods that studies try: those of the suite, and any option of a method of one's own."""

from typing import Annotated

import pytest
from pydantic import Field

from fctd.case import units
from fctd.case.errors import Table
from references import contact
from references.registry import Registry
from validation.parts.contact_settings import label, settings


class Options(Table):
    """Distance of points on the axis [m], tried at three values, and a switch that no study turns."""

    spacing: Annotated[units.PositiveLength, Field(examples=[4.0, 1.0, 0.25])] = 1.0
    exact: bool = False


class NamedAsOthers(Table):
    """Options whose names are those of meshes and grids, and mean something else."""

    facets: Annotated[int, Field(examples=[8, 16])] = 8
    cell: bool = False


class NearestPoint:
    Options = Options


@pytest.fixture(autouse=True)
def plugin(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Registry, "plugins", lambda self: {"nearest_point": None})
    monkeypatch.setattr(
        contact, "method_class", lambda name: NearestPoint if name == "nearest_point" else contact.REGISTRY.find(name)
    )


def test_what_an_option_of_a_plugin_is_called_means_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(NearestPoint, "Options", NamedAsOthers)
    tried = list(settings("nearest_point", quick=False))
    assert [label("nearest_point", one) for one in tried] == ["nearest_point, facets 8", "nearest_point, facets 16"]


def test_examples_of_an_option_are_tried_from_coarse_to_fine() -> None:
    tried = list(settings("nearest_point", quick=False))
    assert [label("nearest_point", one) for one in tried] == [f"nearest_point, spacing {s}" for s in (4.0, 1.0, 0.25)]
    assert list(settings("nearest_point", quick=True)) == [{"spacing": 1.0}]


def test_those_of_the_suite_have_their_own_names() -> None:
    assert list(settings("arcs", quick=False)) == [{}]
    assert label("arcs", {}) == "arcs"
    assert label("cylinders", {"cylinder_length": 2.0, "overlap": 0.2}) == "cylinders, 2 m"
    assert label("fcl", {"facets": 24, "ring_spacing": 2.0}) == "fcl, 24 facets, 2 m"
