"""The tables of a case: defaults, alternatives, and every rule that a value can break."""

import json
from pathlib import Path
from typing import Any

import pytest

from fctd.case.errors import MISSING
from fctd.case.load import load_case
from tests.case.test_load import refusal
from tests.rules import COMBINED, RULES


def test_defaults(case_file: Path) -> None:
    case = load_case(case_file)
    hole, pipe = case.wellbore, case.string.components[1]
    assert (hole.survey_method, hole.geometry, hole.overlap) == ("minimum_curvature", "cylinders", 0.2)
    assert (hole.chord_tolerance, hole.cylinder_length) == (0.002, None)
    assert (hole.stiffness, hole.stiffness_per_length) == (1e7, None)
    assert (pipe.length, pipe.contact_diameter, pipe.density) == (None, 0.102, 7850.0)
    assert (pipe.youngs_modulus, pipe.poisson_ratio, pipe.bending_stiffness) == (206.8e9, 0.3, None)
    assert (case.mud.density, case.mud.viscosity, case.mud.lateral_damping) == (0.0, None, None)
    assert case.mud.unsteady == 0.0
    assert (case.rig.block_weight, case.rig.sheave_efficiency, case.rig.torque_offset) == (0.0, 1.0, 0.0)
    assert (case.contact.friction_law, case.contact.damping) == ("coulomb", 1e5)
    assert case.contact.helical_force == "none"
    assert (case.solver.step, case.solver.joint_damping) == ("auto", 1e-5)
    assert (case.record.interval, case.record.profile_at) == (1.0, ())


def test_alternatives_replace_their_default(case_file: Path) -> None:
    hole = load_case(
        case_file,
        {"wellbore.cylinder_length": "2 m", "wellbore.stiffness_per_length": "1e6 N/m/m"},
    ).wellbore
    assert (hole.chord_tolerance, hole.cylinder_length) == (None, 2.0)
    assert (hole.stiffness, hole.stiffness_per_length) == (None, 1e6)


def check(path: Path, overrides: dict[str, Any], key: str, value: object, expected: str) -> None:
    """The overrides are refused by a message with file, key, value and what was expected."""
    error = refusal(path, overrides)
    assert (error.file, error.key, error.value) == (path, key, value)
    shown = f"{key} is missing: " if value is MISSING else f"{key} = {json.dumps(value)}: "
    first = str(error).splitlines()[0]
    assert first.startswith(f"{path}: {shown}expected ")
    assert expected in first


@pytest.mark.parametrize(("key", "value", "expected"), RULES)
def test_rule(case_file: Path, key: str, value: object, expected: str) -> None:
    """One key set to a wrong value, or deleted where the value is None."""
    check(case_file, {key: value}, key, MISSING if value is None else value, expected)


@pytest.mark.parametrize(("overrides", "key", "value", "expected"), COMBINED)
def test_combined_rule(case_file: Path, overrides: dict[str, Any], key: str, value: object, expected: str) -> None:
    """Keys that do not go together, and wrong items inside lists."""
    check(case_file, overrides, key, value, expected)
