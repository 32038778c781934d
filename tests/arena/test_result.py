"""The schema of a comparison: what it writes it reads again, and what its rows say."""

import pytest
from pydantic import ValidationError

from fctd.arena.result import Comparison, Cost, Loads, Quartiles, Row, WallErrors, WindowOf

TIME = Quartiles(median=2.0, low=1.0, high=4.0)
ERRORS = WallErrors(
    points=10, touching=5, no_answer=0, largest_penetration_m=1e-3, largest_angle_deg=2.0, missed=1, false_contacts=0
)
LOADS = Loads(
    status="valid", message="", hookload_N=1e5, surface_torque_N_m=1e3, sum_r_mu_fn_N_m=1e3, force_off_N=None,
    force_off_md_m=None, forces_N=[1.0, None], step_us=TIME, step_s=1e-3, steps=10, energy_error=1e-5,
)  # fmt: skip


def row(**more: object) -> Row:
    """A contact method that kept all."""
    facts = {"kind": "contact", "name": "mine", "status": "measured", "broken": [], "errors": ERRORS, "loads": LOADS}
    return Row.model_validate(facts | {"costs": [Cost(points=10, point_ns=TIME, kernels=TIME)]} | more)


def test_quartiles() -> None:
    assert Quartiles.of([1, 2, 3, 4, 5]) == Quartiles(median=3, low=2, high=4)
    assert Quartiles.of([7.0]).times(2) == Quartiles(median=14, low=14, high=14)


def test_what_is_written_is_read_again() -> None:
    found = Comparison(case="a", digest="b", reference="arcs", rows=[row(options={"facets": 96})], budget_s=1.0)
    assert Comparison.model_validate_json(found.model_dump_json()) == found
    with pytest.raises(ValidationError):
        Comparison.model_validate_json(found.model_dump_json().replace('"digest"', '"digests"'))


@pytest.mark.parametrize(
    ("more", "verdict", "struck", "sound"),
    [
        ({}, "kept", False, True),
        ({"broken": None}, "", False, True),
        ({"broken": ["a demand: wrong"]}, "BROKEN", True, False),
        ({"kind": "engine", "broken": ["a rule"]}, "FAILED", True, False),
        ({"kind": "engine"}, "passed", False, True),
        ({"loads": LOADS.model_copy(update={"status": "invalid"})}, "invalid", True, False),
        ({"status": "refused", "broken": None, "loads": None}, "refused", False, False),
        ({"loads": None, "loads_reason": "expected to take 100 s"}, "kept", False, True),
    ],
)
def test_the_verdict_of_a_row(more: dict[str, object], verdict: str, struck: bool, sound: bool) -> None:
    found = row(**more)
    assert (found.verdict, found.struck, found.sound) == (verdict, struck, sound)


def test_an_engine_and_a_method_of_one_library_have_two_names() -> None:
    assert row(name="mujoco", options={"facets": 96}).label == "mujoco, facets=96"
    assert row(name="mujoco", kind="engine").label == "engine mujoco"


def test_rows_are_flat_and_have_the_same_columns() -> None:
    bare = Row(kind="contact", name="bare")
    first, second = Comparison(case="a", digest="b", reference="c", rows=[row(), bare], budget_s=1.0).flat()
    assert list(first) == list(second)
    assert (first["point_ns_low"], first["point_ns"], first["point_ns_high"]) == (1.0, 2.0, 4.0)
    assert first["largest_penetration_m"] == 1e-3
    assert second["hookload_N"] != second["hookload_N"]  # nan


def test_the_steps_of_a_window() -> None:
    window = WindowOf(
        operation="rotating", from_md_m=1, to_md_m=1, start_s=0, duration_s=1.0, vibration="axial", period_s=0.5,
        whole=2, segments=3, step_s=0.3,
    )  # fmt: skip
    assert window.steps == 4
