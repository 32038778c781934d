"""The tables of drilling: defaults, and values that no rig, rock or motor has."""

from typing import Any

import pytest
from pydantic import ValidationError

from fctd.case.drilling import BitSpec, DriveSpec, MotorSpec, RockSpec
from fctd.case.errors import InputError, Table


def test_the_default_bit_is_a_drag_bit_without_weakening() -> None:
    rock = RockSpec()
    assert (rock.law, rock.weakening, rock.radius) == ("drag_bit", 0.0, None)
    assert DriveSpec().proportional is None


def test_quantities_with_their_units() -> None:
    drive = DriveSpec(inertia="2000 kg*m^2", proportional="0.4 kN*m*s")  # type: ignore[arg-type]
    assert (drive.inertia, drive.proportional) == pytest.approx((2000.0, 400.0))
    assert MotorSpec(flow="1800 L/min", revolutions_per_liter=0.06).flow == pytest.approx(0.03)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("table", "given"),
    [
        (RockSpec, {"law": "roller_cone"}),
        (RockSpec, {"specific_energy": 0.0}),
        (RockSpec, {"force_ratio": -0.6}),
        (RockSpec, {"wear_flat": "-1 mm"}),
        (RockSpec, {"weakening_rpm": 0}),
        (DriveSpec, {"inertia": "-1 kg*m^2"}),
        (DriveSpec, {"compensation": 1.5}),
        (DriveSpec, {"torque_limit": 0}),
        (MotorSpec, {"flow": 0, "revolutions_per_liter": 0.06}),
        (MotorSpec, {"revolutions_per_liter": 0.06}),
        (BitSpec, {"nozzles": "12/32 in"}),
        (BitSpec, {"nozzles": ["12/32 in"], "flow_area": "0.33 in^2"}),
        (BitSpec, {"end": "shut"}),
    ],
)
def test_what_is_refused(table: type[Table], given: dict[str, Any]) -> None:
    with pytest.raises((ValidationError, InputError)):
        table(**given)


def test_nozzles_have_their_area() -> None:
    """Three of 12/32 in have 0.3313 in²."""
    bit = BitSpec(nozzles=["12/32 in"] * 3)  # type: ignore[arg-type]
    assert bit.nozzle_area == pytest.approx(0.33134 * 0.0254**2, rel=1e-4)
    assert BitSpec(flow_area="0.33134 in^2").nozzle_area == pytest.approx(bit.nozzle_area, rel=1e-4)  # type: ignore[arg-type]
    assert BitSpec().nozzle_area == 0


@pytest.mark.parametrize(
    ("table", "given", "hint"),
    [
        (BitSpec, {"nozzles": [12, 12, 12]}, "12 looks like '12/32 in' or '12 mm'"),
        (BitSpec, {"flow_area": 0.33}, "0.33 looks like '0.33 in\\^2'"),
        (MotorSpec, {"flow": 600, "revolutions_per_liter": 0.06}, "600 looks like '600 gpm' or '600 L/min'"),
        (MotorSpec, {"flow": 30, "revolutions_per_liter": 0.06}, "30 looks like '30 L/s'"),
    ],
)
def test_numbers_in_another_unit_are_told(table: type[Table], given: dict[str, Any], hint: str) -> None:
    with pytest.raises((ValidationError, InputError), match=hint):
        table(**given)
