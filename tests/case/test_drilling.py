"""The tables of drilling: defaults, and values that no rig, rock or motor has."""

from typing import Any

import pytest
from pydantic import ValidationError

from fctd.case.drilling import DriveSpec, MotorSpec, RockSpec
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
    ],
)
def test_what_is_refused(table: type[Table], given: dict[str, Any]) -> None:
    with pytest.raises((ValidationError, InputError)):
        table(**given)
