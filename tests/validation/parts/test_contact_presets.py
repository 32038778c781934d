"""Settings of contact methods that studies try: those of the suite, and any option of a method of one's own."""

from typing import Annotated

import pytest
from pydantic import Field

from fctd.arena.result import Comparison, Cost, Quartiles, Row
from fctd.case import units
from fctd.case.errors import Table
from references import contact
from references.contact.own import Arcs
from references.methods.asked import every_setting
from validation.parts.contact_presets import by_size, is_default, left_out, settings


class Options(Table):
    """Options whose names are those of meshes and grids, and mean something else."""

    facets: Annotated[int, Field(examples=[8, 16])] = 8
    cell: bool = False
    spacing: units.PositiveLength = 1.0


class Mine(Arcs):
    name, distribution, does, Options = "mine", "numpy", "asks the engine", Options  # type: ignore[assignment]


@pytest.fixture(autouse=True)
def mine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(contact.METHODS, "mine", f"{__name__}:Mine")


def labels(*names: str, defaults: bool = False) -> list[str]:
    return [row.label for row in every_setting(names, defaults=defaults)]


def test_settings_are_what_a_method_says_and_their_labels_can_be_asked_for() -> None:
    assert labels("mine") == ["mine, facets=8", "mine, facets=16"]
    assert labels("mine", "fcl", defaults=True) == ["mine", "fcl"]
    assert labels("arcs") == ["arcs"]
    meshes = labels("libigl")
    assert meshes[:1] + meshes[-1:] == [
        "libigl, facets=12, ring_spacing=4.0",
        "libigl, facets=96, ring_spacing=1.0, smooth_normals=True",
    ]
    for label in (*meshes, *labels("sdf"), *labels("cylinders")):
        assert labels(label) == [label]


def test_defaults_are_known_whether_they_are_written_or_not() -> None:
    rows = {row.label: is_default(row) for row in every_setting(["fcl", "mine", ("mine", {"cell": True})])}
    assert [label for label, usual in rows.items() if usual] == ["fcl, facets=48, ring_spacing=2.0", "mine, facets=8"]
    assert not is_default(Row(kind="contact", name="mine", options={"no_such": 1}))


def quartiles(of: float) -> Quartiles:
    return Quartiles(median=of, low=0.9 * of, high=1.2 * of)


def row(name: str, calls: dict[int, float], **more: object) -> Row:
    costs = [Cost(points=count, point_ns=quartiles(ns), kernels=quartiles(1.0)) for count, ns in calls.items()]
    return Row.model_validate({"kind": "contact", "name": name, "status": "measured", "costs": costs} | more)


def test_a_size_that_takes_too_long_has_the_cost_of_the_largest_call_before() -> None:
    found = Comparison(
        case="a", digest="d", reference="r", budget_s=1,
        rows=[row("fast", {1: 90.0, 1000: 9.0}), row("slow", {1: 900.0, 40: 800.0})],
    )  # fmt: skip
    table = by_size(found, (1, 1000)).set_index("setting")
    assert table["ns_1000"].to_dict() == {"fast": 9.0, "slow": 800.0}
    assert table["ns_1000_high"]["slow"] == pytest.approx(960.0)
    assert table["measured_1000"].to_dict() == {"fast": True, "slow": False}
    assert table["measured_1"].all()


def test_what_failed_is_apart_with_its_reason() -> None:
    bad = row("bad", {}, status="failed", reason="RuntimeError: a wall is missing")
    rows = [row("good", {1: 1.0}, options={"smooth": True, "facets": 8}), bad, row("gone", {}, status="not installed")]
    found = Comparison(case="a", digest="d", reference="r", budget_s=1, rows=rows)
    refused, missing = left_out(found)
    assert refused.to_dict("records") == [{"setting": "bad", "why": "failed: RuntimeError: a wall is missing"}]
    assert missing == ["gone"]
    assert settings(found)[["setting", "series"]].to_numpy().tolist() == [
        ["good, smooth=True, facets=8", "good, smooth=True"]
    ]
