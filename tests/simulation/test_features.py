"""Each feature of a case has its effect with another contact method, or is refused; no key of a case is forgotten."""

from collections.abc import Iterator
from typing import Any, get_args

import pytest
from pydantic import BaseModel

from fctd import Case, InputError, simulate
from fctd.results.tables import SimulationResult
from fctd.simulation.features import ASKED, FEATURES, OWN
from fctd.simulation.preparation import prepare
from references import contact
from tests.simulation.features import CROSSED

# Keys that work in the same way whatever moves the string: what is laid out, read or kept.
EVERYWHERE = {
    "name", "file", "wellbore.columns.header", "wellbore.columns.unit", "wellbore.sheet", "wellbore.survey_smoothing",
    "wellbore.tortuosity.amplitude", "wellbore.tortuosity.wavelength", "wellbore.tortuosity.seed",
    "wellbore.survey_method", "wellbore.geometry", "wellbore.cylinder_length", "wellbore.chord_tolerance",
    "wellbore.overlap", "wellbore.stiffness", "wellbore.stiffness_per_length",
    "wellbore.intervals.to_md", "wellbore.intervals.diameter", "wellbore.intervals.kind", "wellbore.intervals.name",
    "string.top_md",
    *(
        f"string.components.{key}" for key in (
            "name", "length", "outer_diameter", "inner_diameter", "contact_diameter", "segments", "segment_length",
            "linear_mass", "youngs_modulus", "poisson_ratio", "density", "yield_strength", "axial_stiffness",
            "bending_stiffness", "torsional_stiffness", "shear_stiffness",
        )
    ),
    "mud.density", "rig.block_weight", "rig.guide_friction", "rig.sheave_efficiency", "rig.torque_offset",
    "rig.torque_per_rpm", "contact.damping", "solver.step", "solver.shape_damping", "solver.buckling",
    "solver.resolve_work", "record.interval", "record.profile_at",
    *(f"operations.{key}" for key in ("ramp_time", "from_md", "to_md", "rpm", "at_md", "duration")),
}  # fmt: skip


# No key of a case gives loads yet; tests/mechanics/test_given_loads.py has their effect with another contact method.
GIVEN = {"given_loads"}


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


def test_every_feature_has_a_case() -> None:
    assert set(CROSSED) | GIVEN == set(FEATURES)


def test_a_simulation_refuses_what_only_the_steady_solver_has() -> None:
    assert set(FEATURES) - OWN == {"helical_force"}


@pytest.mark.parametrize("name", CROSSED)
def test_a_feature_has_its_effect_with_another_contact_method_or_is_refused(name: str) -> None:
    make, column = CROSSED[name]
    case = make(True)
    method = contact.build("cylinders", case)
    if name not in ASKED:
        with pytest.raises(InputError, match="leaves out") as caught:
            prepare(case, method)
        assert caught.value.key.split("[")[0].split(".")[0] in {key.split(".")[0] for key in FEATURES[name].keys}
        return
    effect = shown(simulate(case), column) - shown(simulate(make(False)), column)
    asked = [simulate(make(on), contact=contact.build("cylinders", make(on))) for on in (True, False)]
    assert [result.status for result in asked] == ["completed", "completed"]
    found = shown(asked[0], column) - shown(asked[1], column)
    scatter = abs(shown(asked[1], column) - shown(simulate(make(False)), column))
    assert scatter < 0.1 * abs(effect), "the case shows its feature too little"
    assert found == pytest.approx(effect, rel=0.1)


def shown(result: SimulationResult, column: str) -> float:
    """The mean of a column of the history, or of the energies."""
    table = result.history if column in result.history else result.energy
    return float(table[column].mean())
