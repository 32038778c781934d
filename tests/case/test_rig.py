"""The tables of mud and rig: defaults, the viscosity of motion that changes, and the push of the block."""

from pathlib import Path

from fctd.case.load import load_case
from fctd.case.rig import UNSTEADY, MudSpec, RigSpec


def test_defaults(case_file: Path) -> None:
    case = load_case(case_file)
    assert (case.mud.density, case.mud.viscosity, case.mud.lateral_damping) == (0.0, None, None)
    assert (case.rig.block_weight, case.rig.sheave_efficiency, case.rig.torque_offset) == (0.0, 1.0, 0.0)


def test_motion_that_changes_takes_mud_along_unless_its_viscosity_is_0() -> None:
    found = [MudSpec(density=1200.0, viscosity=viscosity).unsteady for viscosity in (None, 0.05, 0.0)]
    assert found == [UNSTEADY, 0.05, 0.0]
    assert MudSpec().unsteady == 0.0


def test_guides_hold_back_part_of_the_push() -> None:
    assert RigSpec(block_weight=3e5, guide_friction=1e4).push == 2.9e5
