"""Drive, driller and rock of a case."""

from typing import Any

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.mechanics.drive import BY_SPEED, STIFF, least_inertia
from fctd.mechanics.rock import DRAG_BIT, GIVEN_LOADS, NOTHING
from fctd.model.drilling import above_bottom, check_weight, driller_of, drive_of, rock_of, torsional_impedance
from fctd.model.drillstring import lay_out
from tests.cases import make_case, pipe


def drills(kind: str = "drill_rotating", **sections: Any) -> Case:
    """A case of one operation that drills from 900 m, with the default rock."""
    turning = {"rpm": 120} if kind == "drill_rotating" else {}
    given: dict[str, Any] = {
        "components": [pipe(None, 30)],
        "operations": [{"kind": kind, "from_md": 900, "to_md": 901, "speed": 0.01, **turning}],
        "bit": {"rock": {}},
    }
    return make_case(**(given | sections))


def test_the_rock_of_a_drag_bit() -> None:
    """By hand, with the radius of the hole, 107.95 mm."""
    rock = rock_of(drills(bit={"rock": {"wear_flat": "2 mm", "contact_strength": "50 MPa", "friction": 0.5}}))
    a = 0.10795
    assert rock.law == DRAG_BIT
    assert rock.worn == pytest.approx(50e6 * a * 2e-3)
    assert rock.advance == pytest.approx(1 / (0.6 * 1e8 * a))
    assert (rock.cutting, rock.rubbing) == pytest.approx((0.5 * a / 0.6, 0.5 * 0.5 * a))


def test_given_loads_and_a_motor() -> None:
    bit = {"weight_on_bit": 5e4, "torque": 2e3, "rock": {"law": "given"}}
    rock = rock_of(drills("drill_sliding", bit=bit | {"motor": {"flow": "2000 L/min", "revolutions_per_liter": 0.06}}))
    assert (rock.law, rock.weight, rock.torque) == (GIVEN_LOADS, 5e4, 2e3)
    assert rock.motor == pytest.approx(2000 * 0.06 * 2 * np.pi / 60)


def test_without_drilling_there_is_no_rock() -> None:
    assert rock_of(make_case(bit={"rock": {}})) == NOTHING


@pytest.mark.parametrize(
    ("sections", "message"),
    [
        ({"bit": {}}, r"bit\.rock is missing: expected a table \[bit\.rock\], since operations\[0\] drills"),
        ({"kind": "drill_sliding"}, r"bit\.motor is missing: expected a table \[bit\.motor\] with its flow"),
        (
            {"bit": {"rock": {"law": "given"}}, "rig": {"autodriller": True}},
            r"rig\.autodriller = true: expected false, where bit\.rock\.law gives the weight",
        ),
    ],
)
def test_what_drilling_lacks(sections: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        rock_of(drills(**sections))


def test_a_bit_cannot_carry_more_than_the_string_weighs() -> None:
    case = drills(bit={"weight_on_bit": "60 kN", "rock": {"law": "given"}}, rig={"block_weight": "10 kN"})
    check_weight(case, 50_001.0)
    with pytest.raises(InputError, match=r'bit\.weight_on_bit = "60000 N": expected less than the weight of string'):
        check_weight(case, 50_000.0)
    check_weight(drills(bit={"weight_on_bit": "60 kN", "rock": {}}), 50_000.0)  # the block's speed decides


def test_drives_by_default() -> None:
    """ζ = I_p √(Gρ) of 5 inch pipe by hand: P is ζ or 100 ζ; an impedance drive hides its inertia but for the least."""
    string = lay_out(drills(), 900.0)
    polar = np.pi / 32 * (0.127**4 - 0.07**4)
    zeta = polar * np.sqrt(206.8e9 / 2.6 * 7850)
    assert torsional_impedance(string.sections[0]) == pytest.approx(zeta)
    assert drive_of(drills(), string, 1e4, 0.0, 1e-3) == STIFF
    soft = drive_of(drills(rig={"drive": "impedance"}), string, 1e4, 0.0, 1e-3)
    assert (soft.proportional, soft.integral, soft.inertia) == pytest.approx((zeta, zeta / 3, 2000.0))
    assert soft.apparent == least_inertia(1e4, 0.0, soft.integral, 1e-3)
    firm = drive_of(drills(rig={"drive": "speed_control"}), string, 1e4, 0.0, 1e-3)
    assert (firm.proportional, firm.integral, firm.apparent) == pytest.approx((100 * zeta, 500 * zeta, 2000.0))


def test_the_autodriller_is_slower_than_the_string() -> None:
    """Both roots of s²/(k) + gain s + integral = 0, k the stiffness of string and rock, are at half of c/4L."""
    case = drills(rig={"autodriller": True}, bit={"weight_on_bit": 5e4, "rock": {}})
    string, rock = lay_out(case, 900.0), rock_of(case)
    driller = driller_of(case, string, rock)
    softness = 885 / string.sections[0].EA + 5e-8  # to the middle of the last segment, and the rock
    slow = np.sqrt(206.8e9 / 7850) / (2 * 4 * 900)
    assert np.roots([softness, driller.gain, driller.integral]).real == pytest.approx([-slow, -slow], rel=1e-6)
    assert driller_of(drills(), string, rock) == BY_SPEED


def test_the_bottom_is_the_deepest_point_before_drilling() -> None:
    moves = [
        {"kind": "trip_in", "from_md": 880, "to_md": 920, "speed": 0.5},
        {"kind": "trip_out", "to_md": 900, "speed": 0.5},
        {"kind": "drill_rotating", "to_md": 930, "speed": 0.01, "rpm": 100},
    ]
    assert above_bottom(drills(operations=moves)) == 40.0
    assert above_bottom(drills()) == 0.0
