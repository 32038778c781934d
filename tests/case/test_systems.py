"""The kinds of quantities: units that people may type, exact factors, and no unit beside the table."""

import re
from pathlib import Path

import pytest

from fctd.case.systems import ACROSS, DENSITY, FORCE, KINDS, LENGTH, SYSTEMS, TORQUE, Kind, kind_with

ROOT = Path(__file__).parents[2] / "fctd"


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: f"{kind.dimension.noun}, {kind.units[0]}")
def test_a_kind_is_shown_in_units_of_its_dimension(kind: Kind) -> None:
    for system in SYSTEMS:
        factor, label = kind.shown(system)
        assert factor * kind.si(system) == pytest.approx(1.0, rel=1e-13)
        assert not set("*^") & set(label)


def test_units_of_the_field_are_exact() -> None:
    """By definition (NIST SP 811, appendix B.8): the foot, the inch, the pound-force, and the gallon of 231 in³."""
    assert [kind.si("field") for kind in (LENGTH, ACROSS)] == [0.3048, 0.0254]
    assert FORCE.si("field") == 4448.2216152605
    assert TORQUE.si("field") == pytest.approx(304.8 * 4.4482216152605, rel=1e-14)
    assert DENSITY.si("field") == pytest.approx(0.45359237 / (231 * 0.0254**3), rel=1e-14)


def test_a_number_without_a_unit_is_no_load() -> None:
    kinds = (LENGTH, ACROSS, DENSITY, FORCE, TORQUE)
    assert [kind.bare_unit("field") for kind in kinds] == ["ft", "in", "ppg", None, None]


def test_a_unit_of_a_case_becomes_that_of_the_field() -> None:
    found = [kind_with(unit) for unit in ("cm", "t", "daN*m", "sg", "L/s", "psi", "rpm")]
    units = ["in", "klbf", "ft*lbf", "ppg", "gpm", None, None]
    assert [None if kind is None else kind.unit("field") for kind in found] == units


def test_no_other_module_pairs_units_of_both_systems() -> None:
    """But lists of the units that people may type."""
    pair = re.compile(r'"(?:kN|m|mm|kN\*m|kg/m\^3|L/min|MPa|bar)"[:,] "(?:klbf|ft|in|kft\*lbf|ppg|gpm|ksi|psi)"')
    allowed = {"case/systems.py", "case/units.py", "case/surveys/form.py"}
    found = {str(path.relative_to(ROOT)) for path in ROOT.rglob("*.py") if pair.search(path.read_text())}
    assert found <= allowed
