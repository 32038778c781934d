"""The kinds of operation: what a class says of its kind agrees with what its file may say."""

import pytest

from fctd.case.errors import InputError
from fctd.case.operations import KINDS
from tests.cases import make_case

ROTATION = {"rpm": 60}
MOVES = [kind for kind, model in KINDS.items() if model.direction != 0]


def written(kind: str, first: float, last: float) -> dict[str, object]:
    """A move of a kind between two depths [m], as a case file has it."""
    rotation = ROTATION if KINDS[kind].turns else {}
    return {"kind": kind, "from_md": first, "to_md": last, "speed": 0.1, **rotation}


def test_the_kinds_stand_in_the_order_of_the_guides() -> None:
    assert list(KINDS) == [
        "trip_in", "trip_out", "rotate_off_bottom", "back_ream", "ream_in", "drill_rotating", "drill_sliding",
    ]  # fmt: skip


@pytest.mark.parametrize("kind", MOVES)
def test_a_move_goes_its_own_way_alone(kind: str) -> None:
    down = KINDS[kind].direction > 0
    right, wrong = ((500.0, 600.0), (600.0, 500.0)) if down else ((600.0, 500.0), (500.0, 600.0))
    (operation,) = make_case(operations=[written(kind, *right)]).operations
    assert (operation.start_md, operation.end_md) == right
    with pytest.raises((InputError, ValueError), match="below" if down else "above"):
        make_case(operations=[written(kind, *wrong)])


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_said_of_a_kind_does_not_contradict_itself(kind: str) -> None:
    model = KINDS[kind]
    assert model.label
    assert (model.default_speed > 0) == (model.direction != 0)
    assert model.may_turn or not model.turns
    assert (model.default_rpm > 0) == model.turns
    assert model.on_bottom == kind.startswith("drill")


def test_a_rotation_stays_where_it_is_and_speeds_up_in_ten_seconds() -> None:
    rotation = {"kind": "rotate_off_bottom", "at_md": 500.0, "duration": 60.0, "rpm": 60.0}
    (operation,) = make_case(operations=[rotation]).operations
    assert (operation.start_md, operation.end_md, operation.speed, operation.ramp_time) == (500.0, 500.0, 0.0, 10.0)
