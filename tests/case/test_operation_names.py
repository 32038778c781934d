"""Names of operations: one reader for what a case, an option and a sheet have."""

from typing import Any

import pytest

from fctd.case.errors import InputError
from fctd.case.load import make_case
from fctd.case.operation_names import kind_named, kinds_of, names_of, read_kind, split_names
from fctd.case.operations import KINDS
from tests.cases import pipe, trip


@pytest.mark.parametrize(
    ("names", "kind"),
    [
        ("pick-up, Pick Up, pickup, PICK_UP, PU, P/U, picking up, trip_out, Trip Out", "trip_out"),
        ("slack-off, Slackoff, SO, s/o, slacking off, trip-in", "trip_in"),
        ("rotating, ROT, rotating off bottom, rotate_off_bottom", "rotate_off_bottom"),
    ],
)
def test_the_words_of_drillers(names: str, kind: str) -> None:
    assert {kind_named(name) for name in names.split(", ")} == {kind}


def test_each_name_is_of_one_kind() -> None:
    assert {name: kind_named(name) for kind in KINDS for name in names_of(kind)} == {
        name: kind for kind in KINDS for name in names_of(kind)
    }


def test_the_words_of_legends_may_have_a_comma() -> None:
    text = "PU, Drilling, Rotating,drilling,sliding , rotating"
    assert kinds_of(split_names(text)) == ["trip_out", "drill_rotating", "drill_sliding", "rotate_off_bottom"]


@pytest.mark.parametrize(
    ("name", "near"),
    [("pickups", "the kind pick-up"), ("dance", "pick-up, slack-off"), (3, "SO"), ("Drilling", "drill_rotating or")],
)
def test_refused(name: object, near: str) -> None:
    with pytest.raises(InputError, match=near):
        read_kind(name)
    with pytest.raises(InputError, match=r'operation = "dance": expected one of the kinds'):
        kinds_of(["PU", "dance"])


def test_a_case_takes_them() -> None:
    """What is wrong in such an operation is told by its place in the file."""
    hole = {"stations": [[0, 0, 0], [1000, 0, 0]], "intervals": [{"to_md": 1000, "diameter": 0.2159, "friction": 0.2}]}
    down = {**trip(100.0, 110.0), "kind": "Slack-off"}
    raw: dict[str, Any] = {"name": "names", "wellbore": hole, "string": {"components": [pipe(1000, 20)]}}
    raw["operations"] = [down, {"kind": "PU", "to_md": 105.0, "speed": 0.2}]
    case = make_case(raw, None)
    assert [(one.kind, one.start_md) for one in case.operations] == [("trip_in", 100.0), ("trip_out", 110.0)]
    with pytest.raises(InputError, match=r"operations\[0\].speed = -1: expected a speed above 0"):
        make_case({**raw, "operations": [{**down, "speed": -1}]}, None)
