"""Unknowns: names, bounds, priors, and what they change in a case."""

from typing import Any

import pytest

from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import (
    NO_GRADIENT,
    Prior,
    Unknown,
    find_unknowns,
    intervals_of,
    parse_fits,
    refuse_overridden,
    with_values,
)
from fctd.case.errors import InputError
from fctd.model.section import section_of
from tests.calibration.wells import well


def one(text: str, *priors: str, **setup: Any) -> Unknown:
    return find_unknowns(parse_fits([text], priors), Setup.model_validate(setup), [well()])[0]


def test_defaults_come_from_the_case() -> None:
    open_hole = one("friction.open")
    assert (open_hole.start, open_hole.low, open_hole.high, open_hole.prior) == (0.3, 0.0, 0.8, None)
    assert open_hole.changes_string
    assert one("friction").start == pytest.approx(0.25)  # the mean of both intervals
    assert one("friction[0]").start == 0.2
    assert one("rig.block_weight").start == 250e3
    assert not one("rig.block_weight").changes_string
    assert one("mud.density").start == 1200.0
    mass = section_of(well().string.components[0], 0.0).mass
    collars = one("mass.collars")
    assert (collars.start, collars.low, collars.high) == pytest.approx((mass, 0.3 * mass, 3.0 * mass))


def test_a_gradient_has_a_prior_of_none_unless_it_is_given_another() -> None:
    factor, gradient = parse_fits(["friction.open", "friction.open.gradient"], []), "friction.open.gradient"
    assert find_unknowns(factor, Setup(), [well()])[1].prior == NO_GRADIENT
    given = parse_fits(["friction.open", gradient], [f"{gradient}=0.2+-0.1"])
    assert find_unknowns(given, Setup(), [well()])[1].prior == Prior(0.2, 0.1)


def test_bounds_and_priors_of_the_command_line() -> None:
    found = one("friction.open = 0.1:0.5", "friction.open=0.25+-0.05")
    assert (found.low, found.high, found.start, found.prior) == (0.1, 0.5, 0.25, Prior(0.25, 0.05))
    found = one("rig.block_weight=200 kN:30 t")
    assert (found.low, found.high) == pytest.approx((200e3, 294199.5))  # 30 t × 9.80665 m/s²


def test_the_command_line_comes_before_the_setup() -> None:
    setup = {"unknowns": {"friction.open": {"bounds": [0.2, 0.4], "start": 0.22}}}
    found = find_unknowns(parse_fits(["friction.open=0.1:0.6"]), Setup.model_validate(setup), [well()])
    assert [(u.name, u.low, u.high, u.start) for u in found] == [("friction.open", 0.1, 0.6, 0.22)]


def test_a_source_with_a_prior_has_a_bias() -> None:
    setup = Setup.model_validate({"sources": {"DDR": {"torque_bias": {"mean": 100.0, "sd": 300.0}}}})
    found = find_unknowns(parse_fits(["friction"]), setup, [well()])
    assert [u.name for u in found] == ["friction", "bias.torque.DDR"]
    assert found[1].prior == Prior(100.0, 300.0)
    assert not found[1].changes_string


@pytest.mark.parametrize(
    ("fits", "priors", "expected"),
    [
        ([], [], "at least one unknown"),
        (["frction.open"], [], "friction.open"),
        (["friction[2]"], [], "friction of intervals that the case has"),
        (["mass.casing"], [], "a component of a string \\(collars, drill pipe\\)"),
        (["friction=0.1"], [], "NAME=LOW:HIGH"),
        (["friction=0.5:0.1"], [], "two bounds that rise"),
        (["friction=-0.1:0.1"], [], "at least 0"),
        (["rig.block_weight=1 m:2 m"], [], "a force"),
        (["friction"], ["friction=0.2"], r"NAME=MEAN\+-SD"),
        (["friction"], ["friction=0.2+-0"], "above 0"),
        (["friction=0.1:0.3"], ["friction=0.5+-0.1"], "a mean within the bounds"),
        (["friction", "friction.open"], [], "one friction factor for an interval"),
        (["friction[1]", "friction.open"], [], "one friction factor for an interval"),
    ],
)
def test_wrong_unknowns_are_named(fits: list[str], priors: list[str], expected: str) -> None:
    with pytest.raises(InputError, match=expected):
        find_unknowns(parse_fits(fits, priors), Setup(), [well()])


def test_values_change_the_case_where_they_belong() -> None:
    case = with_values(
        well(), {"friction.open": 0.4, "rig.torque_offset": 700.0, "mass.collars": 90.0, "mud.density": 1300.0,
                 "bias.torque.DDR": 50.0},
    )  # fmt: skip
    assert [interval.friction for interval in case.wellbore.intervals] == [0.2, 0.4]
    assert (case.rig.torque_offset, case.rig.block_weight, case.mud.density) == (700.0, 250e3, 1300.0)
    assert [part.linear_mass for part in case.string.components] == [90.0, None]
    assert [intervals_of(name, case) for name in ("friction", "friction.cased", "friction[1]", "mass.x")] == [
        [0, 1], [0], [1], [],
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("friction.open", "wellbore.intervals[1].friction"),
        ("friction.open", "friction"),
        ("friction.open", "wellbore"),
        ("rig.block_weight", "rig.block_weight"),
        ("rig.block_weight", "rig"),
        ("mass.collars", "string.components[0].linear_mass"),
    ],
)
def test_an_override_of_an_unknown_is_refused(name: str, key: str) -> None:
    with pytest.raises(InputError, match=f"it has {name} with its band"):
        refuse_overridden([name], well(), {"bit.torque": 1.0, key: 1.0})


def test_an_override_beside_the_unknowns_stays() -> None:
    others = {"wellbore.intervals[0].friction": 0.1, "rig.block_weights": 1.0, "mud.density": 1.0, "friction.cased": 1}
    refuse_overridden(["friction.open", "rig.block_weight", "mass.collars", "bias.torque.DDR"], well(), others)


@pytest.mark.parametrize(
    ("told", "expected"),
    [
        ({"friction.opne": {}}, 'unknowns = "friction.opne": expected the unknown friction.open'),
        ({"friction.open": {"bounds": [0.6, 0.1]}}, "unknowns.friction.open.bounds = "),
        ({"friction.open": {"prior": {"mean": 0.25, "sd": 0}}}, "unknowns.friction.open.prior.sd = "),
    ],
)
def test_a_wrong_value_of_the_setup_is_not_that_of_an_option(told: dict[str, object], expected: str) -> None:
    setup = Setup.model_validate({"unknowns": told})
    with pytest.raises(InputError, match=f"^{expected}"):
        find_unknowns(parse_fits(["friction.open"]), setup, [well()])
