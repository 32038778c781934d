"""The table of the string: defaults, and what a component is by its length."""

from pathlib import Path

import pytest

from fctd.case.load import load_case
from fctd.case.string import ComponentSpec


def test_defaults(case_file: Path) -> None:
    pipe = load_case(case_file).string.components[1]
    assert (pipe.length, pipe.contact_diameter, pipe.density) == (None, 0.102, 7850.0)
    assert (pipe.youngs_modulus, pipe.poisson_ratio, pipe.bending_stiffness) == (206.8e9, 0.3, None)


@pytest.mark.parametrize(("length", "contact"), [(2.5, "point"), (2.6, "sleeve"), (None, "sleeve")])
def test_a_component_of_twelve_diameters_is_a_point(length: float | None, contact: str) -> None:
    part = ComponentSpec(name="sub", length=length, outer_diameter=0.165, inner_diameter=0.07, contact_diameter=0.21)
    assert part.contact == contact
    assert part.cut_by_default
    assert not part.long_segment
    assert part.model_copy(update={"segments": 1}).long_segment == (length is None)


def test_a_tool_has_a_pressure_drop_at_a_flow() -> None:
    """Its density is that of water where the case gives none."""
    tool = {"name": "motor", "outer_diameter": "6.75 in", "inner_diameter": "2 in"}
    found = ComponentSpec(**tool, pressure_drop="500 psi", at_flow="600 gpm")  # type: ignore[arg-type]
    assert (found.pressure_drop, found.at_flow) == pytest.approx((500 * 6894.757, 600 * 6.30902e-5), rel=1e-5)
    assert found.at_density == 1000.0
    for missing, given in (("at_flow", {"pressure_drop": "500 psi"}), ("pressure_drop", {"at_flow": "600 gpm"})):
        with pytest.raises(ValueError, match=f"{missing} is missing: expected pressure_drop and at_flow together"):
            ComponentSpec(**tool, **given)  # type: ignore[arg-type]
