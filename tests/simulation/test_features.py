"""Each feature of a case has its effect with another contact method, or is refused; no key of a case is forgotten."""

from collections.abc import Callable, Iterator
from typing import Any, get_args

import pytest
from pydantic import BaseModel

from fctd import Case, InputError, SimulationResult, simulate
from fctd.simulation.features import ASKED, EVERYWHERE, FEATURES, OWN, UNKNOWN_KEYS, refuse
from fctd.simulation.preparation import prepare
from references import contact
from tests.cases import make_case, pipe, rotation
from tests.simulation.features import CROSSED, shown

# Cylinders are round, and refuse a case whose hole is not.
MESHED = {"caliper": "libigl"}


@pytest.fixture(scope="module")
def own() -> Callable[[Case], SimulationResult]:
    """A run with the hole's own contact, once for each case: many features share the case without them."""
    runs: dict[str, SimulationResult] = {}

    def run(case: Case) -> SimulationResult:
        key = case.model_dump_json()
        if key not in runs:
            runs[key] = simulate(case)
        return runs[key]

    return run


def keys_of(model: type[BaseModel], before: str = "") -> Iterator[str]:
    """Dotted keys of a table and of those within it."""
    for name, field in model.model_fields.items():
        inner = list(tables_in(field.annotation))
        for table in inner:
            yield from keys_of(table, f"{before}{name}.")
        if not inner:
            yield before + name


def tables_in(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from tables_in(part)


def test_every_key_belongs_to_a_feature_or_works_everywhere() -> None:
    keys = set(keys_of(Case))
    featured = {key for feature in FEATURES.values() for key in feature.keys}
    assert keys - featured - EVERYWHERE == set()
    assert (featured | EVERYWHERE) - keys == set()
    assert featured & EVERYWHERE == set()


def test_loads_at_the_bit_are_refused_by_the_key_that_the_case_has() -> None:
    with pytest.raises(InputError) as caught:
        refuse(prepare(CROSSED["bit_loads"].make(True))[0], {UNKNOWN_KEYS, *FEATURES} - {"bit_loads"}, "another")
    assert (caught.value.key, caught.value.value) == ("bit.rock", "a table")


def test_every_feature_has_a_case() -> None:
    assert set(CROSSED) == set(FEATURES)


def test_a_simulation_refuses_what_only_the_steady_solver_has() -> None:
    assert set(FEATURES) ^ OWN == {"helical_force", "overpull", "packer", UNKNOWN_KEYS}


def test_resolved_joints_are_refused_where_contact_at_the_middle_is_left_out() -> None:
    joint = {"length": 10.0, "tool_joint_length": 0.5, "tool_joint_diameter": 0.165}
    parts = [pipe(20, 2), pipe(None, None, joint=joint, joint_segments=4)]
    run, _ = prepare(make_case(components=parts, operations=[rotation(200, 1)]))
    with pytest.raises(InputError, match=r"\[1\].joint_segments = 4: expected .* since the engine leaves out"):
        refuse(run, OWN - {"middle_contact"}, "the engine")


@pytest.mark.slow(seconds=13)
@pytest.mark.parametrize("name", CROSSED)
def test_a_feature_has_its_effect_with_another_contact_method_or_is_refused(
    name: str, own: Callable[[Case], SimulationResult]
) -> None:
    make, column = CROSSED[name]
    case = make(True)
    other = MESHED.get(name, "cylinders")
    method = contact.build(other, case)
    if name not in ASKED:
        with pytest.raises(InputError, match="leaves out") as caught:
            prepare(case, method)
        assert caught.value.key.split("[")[0].split(".")[0] in {key.split(".")[0] for key in FEATURES[name].keys}
        return
    effect = shown(own(case), column) - shown(own(make(False)), column)
    asked = [simulate(case, contact=method), simulate(make(False), contact=contact.build(other, make(False)))]
    assert [result.status for result in asked] == ["completed", "completed"]
    found = shown(asked[0], column) - shown(asked[1], column)
    scatter = abs(shown(asked[1], column) - shown(own(make(False)), column))
    assert scatter < 0.1 * abs(effect), "the case shows its feature too little"
    assert found == pytest.approx(effect, rel=0.1)
