"""Friction factors by kind of interval: reading, labels, and what is refused."""

from typing import Any

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.case.friction import FrictionSet, Pair, changed, friction_sets, own_label, parse_frictions, table_of
from fctd.case.load import with_friction
from fctd.case.wall import IntervalSpec
from tests.cases import make_case


def intervals(*rows: tuple[float, float, str | None]) -> list[IntervalSpec]:
    """Intervals of lower end [m], factor and kind."""
    keys = [{"to_md": to_md, "diameter": 0.2, "friction": factor, "kind": kind} for to_md, factor, kind in rows]
    return [IntervalSpec.model_validate(row) for row in keys]


@pytest.mark.parametrize(
    ("texts", "labels"),
    [
        (["0.25"], ["0.25"]),
        (["0.1,0.2, 0.3"], ["0.1", "0.2", "0.3"]),
        (["0.1:0.4:0.1"], ["0.1", "0.2", "0.3", "0.4"]),
        (["0.1:0.3:0.15,0.5"], ["0.1", "0.25", "0.3", "0.5"]),
        (["0.2:0.2:0.1"], ["0.2"]),
        (["cased=0.2,open=0.3"], ["cased 0.20, open 0.30"]),
        (["open=0.3 , cased = 0.125"], ["cased 0.125, open 0.30"]),
        (["open=0.3", "0.2", "open=0.30"], ["open 0.30", "0.2"]),
        (["0.3/0.2", "0.1, 0.4 / 0.25", "0.3/0.30"], ["0.3/0.2", "0.1", "0.4/0.25", "0.3"]),
        (["cased=0.2/0.15,open=0.4"], ["cased 0.20/0.15, open 0.40"]),
        ([], []),
    ],
)
def test_options_are_sets_each_once(texts: list[str], labels: list[str]) -> None:
    assert [one.label for one in parse_frictions(texts, "--friction")] == labels


@pytest.mark.parametrize(
    "text",
    [
        "",
        "low",
        "0.1,",
        "cased",
        "cased=",
        "cased=0.2,cased=0.3",
        "cased=0.2,0.3",
        "0.3/",
        "/0.2",
        "0.3/0.2/0.1",
        "open=0.3/x",
    ],
)
def test_what_is_no_option_is_refused(text: str) -> None:
    with pytest.raises(InputError, match=r"--friction = .*expected a factor such as 0\.25, a list of them"):
        parse_frictions([text], "--friction")


@pytest.mark.parametrize("text", ["0.4:0.1:0.1", "0.1:0.4:0", "0:1:0.001"])
def test_a_fan_that_leads_nowhere_is_refused(text: str) -> None:
    with pytest.raises(InputError, match=r"expected a fan FROM:TO:STEP with TO at least FROM, a STEP above 0"):
        parse_frictions([text], "--friction")


@pytest.mark.parametrize("text", ["0,2", "0,25", "0, 3", "0.1,0,2", "0,1"])
def test_a_decimal_comma_is_no_list(text: str) -> None:
    with pytest.raises(InputError, match=r"expected 0\.\d+ with a point, or two factors, 0\.0,\d+: a comma separates"):
        parse_frictions([text], "--friction")
    assert [one.label for one in parse_frictions(["0.0,2", "0,0.3"], "--friction")] == ["0", "2", "0.3"]


def test_a_set_gives_the_factor_of_each_interval() -> None:
    hole = intervals((500, 0.1, "cased"), (900, 0.15, "cased"), (1500, 0.4, "open"))

    def alike(*factors: float) -> tuple[Pair, ...]:
        return tuple(Pair(factor, factor) for factor in factors)

    assert FrictionSet(every=0.2).of(hole) == alike(0.2, 0.2, 0.2)
    assert FrictionSet(cased=0.2, open=0.3).of(hole) == alike(0.2, 0.2, 0.3)
    assert FrictionSet(open=0.3).of(hole) == alike(0.1, 0.15, 0.3)  # what is not asked for stays
    assert FrictionSet(cased=0.0).of(hole) == alike(0.0, 0.0, 0.4)
    pair = Pair(0.4, 0.2)
    assert FrictionSet(open=pair).of(hole) == (*alike(0.1, 0.15), pair)
    changed_hole = changed(hole, FrictionSet(open=pair).of(hole))
    assert [(one.friction, one.rotational_friction) for one in changed_hole] == [(0.1, None), (0.15, None), (0.4, 0.2)]
    assert FrictionSet(cased=0.3).of(changed_hole) == (*alike(0.3, 0.3), pair)
    assert FrictionSet(every=0.3).of(changed_hole) == alike(0.3, 0.3, 0.3)  # one number sets both directions
    assert table_of(changed_hole).tolist() == [[0.1, 0.1], [0.15, 0.15], [0.4, 0.2]]


@pytest.mark.parametrize(
    ("kinds", "expected"),
    [
        (
            ("cased", None),
            'wellbore.intervals[1].kind is missing: expected "cased" or "open", since friction is given by',
        ),
        (("open", "open"), 'friction = {"cased": 0.2}: expected factors of kinds that the intervals have, open'),
    ],
)
def test_a_kind_must_be_there(kinds: tuple[str, str | None], expected: str) -> None:
    hole = intervals((500, 0.1, kinds[0]), (900, 0.15, kinds[1]))
    with pytest.raises(InputError) as caught:
        FrictionSet(cased=0.2).of(hole)
    assert expected in str(caught.value)


@pytest.mark.parametrize(
    ("value", "labels"),
    [
        (0.2, ["0.2"]),
        (np.array([0.1, 0.2]), ["0.1", "0.2"]),
        (np.float64(0.2), ["0.2"]),
        ({"cased": 0.2, "open": 0.3}, ["cased 0.20, open 0.30"]),
        ([0.2, {"open": 0.3}, FrictionSet(cased=0.1)], ["0.2", "open 0.30", "cased 0.10"]),
        ("0.3/0.2", ["0.3/0.2"]),
        (["0.3/0.2", {"open": "0.4/0.1"}, Pair(0.25, 0.25)], ["0.3/0.2", "open 0.40/0.10", "0.25"]),
    ],
)
def test_python_takes_numbers_and_tables(value: Any, labels: list[str]) -> None:
    assert [one.label for one in friction_sets(value)] == labels


@pytest.mark.parametrize(
    "value", ["0.2", "0.3/low", "0.3/-0.1", [], {}, [[0.1, 0.2]], {"casing": 0.2}, {"open": -0.1}, None, [True]]
)
def test_python_refuses_others(value: Any) -> None:
    with pytest.raises(InputError) as caught:
        friction_sets(value)
    assert caught.value.key == "friction"
    if isinstance(value, str) and "/" in value:
        assert caught.value.value == value


@pytest.mark.parametrize(
    ("rows", "label"),
    [
        ([(900, 0.2, None)], "0.2"),
        ([(500, 0.2, None), (900, 0.2, None)], "0.2"),
        ([(1500, 0.2, None), (3000, 0.3, None)], "case's own: 0.2 down to 1500 m, 0.3 below"),
        (
            [(500, 0.2, None), (800, 0.2, None), (1500, 0.25, None), (3000, 0.3, None)],
            "case's own: 0.2 down to 800 m, 0.25 down to 1500 m, 0.3 below",
        ),
        ([(k, 0.1 + k / 100, None) for k in range(1, 7)], "case's own: 0.11 to 0.16"),
    ],
)
def test_the_label_of_the_case_as_it_stands(rows: list[tuple[float, float, str | None]], label: str) -> None:
    assert own_label(intervals(*rows)) == label


def test_a_case_with_other_friction_has_its_static_factors_scaled_along() -> None:
    rows = [
        {"to_md": 500.0, "diameter": 0.2159, "friction": 0.2, "static_friction": 0.3, "kind": "cased"},
        {"to_md": 1000.0, "diameter": 0.2159, "friction": 0.25, "kind": "open"},
    ]
    case = make_case(wellbore={"intervals": rows}, contact={"friction_law": "karnopp"})
    found = with_friction(case, {"cased": 0.4, "open": "0.3/0.1"}).wellbore.intervals
    assert [(i.friction, i.friction_around, i.static_friction) for i in found] == [
        (0.4, 0.4, pytest.approx(0.6)),
        (0.3, 0.1, None),
    ]
    assert with_friction(case, None) is case
    with pytest.raises(InputError, match=r"^friction = "):
        with_friction(case, -1.0)
