"""The tables of the wall: static factors, mud cake and the wall's law, each with every rule that a value can break."""

from pathlib import Path
from typing import Any

import pytest

from fctd.case.errors import InputError
from fctd.case.load import Case, load_case
from tests.cases import make_case

STATIC = {"static_friction": 0.4}
CAKE = {"friction": 0.1}


def case_of(interval: dict[str, Any], law: str = "karnopp", **more: Any) -> Case:
    """A case with one interval of friction 0.2, and further keys of it."""
    contact = {"friction_law": law, **more.pop("contact", {})}
    intervals = [{"to_md": 1000, "diameter": 0.2159, "friction": 0.2, **interval}]
    return make_case(wellbore={"intervals": intervals}, contact=contact, **more)


def test_without_a_static_factor_it_is_the_kinetic_one() -> None:
    assert case_of({}).wellbore.intervals[0].static_excess == 0
    assert case_of(STATIC).wellbore.intervals[0].static_excess == pytest.approx(1.0)
    assert case_of({"friction": 0.0, "static_friction": 0.0}).wellbore.intervals[0].static_excess == 0


def test_defaults() -> None:
    contact = make_case().contact
    assert (contact.friction_law, contact.damping, contact.helical_force) == ("coulomb", 1e5, "none")


def test_the_wall_is_linear_unless_the_case_says_otherwise() -> None:
    assert case_of({}).contact.wall_law[0] == 1.0
    assert case_of({}, contact={"law": "power"}).contact.wall_law == (1.5, 0.001)
    assert case_of({}, contact={"law": "power", "exponent": 2, "reference_penetration": "2 mm"}).contact.wall_law == (
        2.0,
        0.002,
    )


@pytest.mark.parametrize(("interval", "more", "message"), [
    ({"static_friction": 0.1}, {}, r"intervals\[0\]\.static_friction.*at least the kinetic factor, 0\.2"),
    ({"friction": 0, "static_friction": 0.1}, {}, r"intervals\[0\]\.friction.*above 0 beside a static one"),
    (STATIC, {"law": "coulomb"}, r'contact\.friction_law = "coulomb".*"karnopp" or "stribeck" beside'),
    ({"overbalance": "5 MPa"}, {"law": "paper", "mud": {"cake": CAKE}}, r'friction_law = "paper".*overbalance'),
    (STATIC | {"decay_speed": 0.1}, {}, r'contact\.friction_law = "karnopp".*"stribeck" beside .*decay_speed'),
    (STATIC, {"law": "stribeck"}, r"intervals\[0\]\.decay_speed is missing.*a speed beside static_friction"),
    ({"overbalance": "5 MPa"}, {}, r"mud\.cake is missing.*friction of the cake"),
    ({"overbalance": "5 MPa"}, {"mud": {"cake": CAKE | {"thickness": "11 cm"}}}, r"mud\.cake\.thickness = \"0\.11 m\""),
    ({"overbalance": 5e6}, {"mud": {"cake": CAKE}, "contact": {"law": "power"}}, r'contact\.law = "power".*"linear"'),
    ({}, {"contact": {"exponent": 2.0}}, r'contact\.law = "linear".*"power" beside exponent'),
    ({}, {"contact": {"law": "power", "exponent": 0.5}}, r"contact\.exponent.*an exponent at least 1 and at most 5"),
])  # fmt: skip
def test_a_rule_that_is_broken_is_named(tmp_path: Path, interval, more, message) -> None:
    keys = {"contact.friction_law": more.get("law", "karnopp")}
    keys |= {f"wellbore.intervals[0].{key}": value for key, value in interval.items()}
    keys |= {f"contact.{key}": value for key, value in more.get("contact", {}).items()}
    keys |= {f"mud.{key}": value for key, value in more.get("mud", {}).items()}
    file = tmp_path / "case.toml"
    file.write_text(WELL)
    with pytest.raises(InputError, match=message):
        load_case(file, keys)


WELL = """
name = "well"
[wellbore]
stations = [[0, 0, 0], [1000, 0, 0]]
[[wellbore.intervals]]
to_md = 1000
diameter = 0.2159
friction = 0.2
[string]
[[string.components]]
name = "pipe"
outer_diameter = 0.127
inner_diameter = 0.1086
"""


def test_another_kinetic_factor_scales_the_static_one(tmp_path: Path) -> None:
    file = tmp_path / "case.toml"
    file.write_text(WELL.replace("friction = 0.2", 'friction = 0.2\nstatic_friction = 0.3\nkind = "open"'))
    sticking = {"contact.friction_law": "karnopp"}
    for value in (0.4, {"open": 0.4}):
        (interval,) = load_case(file, sticking | {"friction": value}).wellbore.intervals
        assert (interval.friction, interval.static_friction) == pytest.approx((0.4, 0.6))


CASED = {"to_md": 1000, "casing": "9 5/8 in 47 N-80", "friction": 0.2}


def cased(**more: Any) -> Any:
    """The interval of a hole that is cased."""
    interval = {key: value for key, value in (CASED | more).items() if value is not None}
    return make_case(wellbore={"intervals": [interval]}).wellbore.intervals[0]


def test_casing_gives_what_is_left_out() -> None:
    interval = cased()
    assert interval.diameter == pytest.approx(8.681 * 0.0254)
    assert interval.wall == pytest.approx(0.472 * 0.0254)
    assert interval.yield_strength == pytest.approx(80e3 * 6894.757, rel=1e-6)
    assert interval.kind == "cased"
    assert cased(casing="9-5/8 47# casing", yield_strength="N-80").yield_strength == interval.yield_strength
    assert cased(diameter="8.525 in").wall == pytest.approx(0.55 * 0.0254)


@pytest.mark.parametrize(("keys", "message"), [
    ({"casing": "9 5/8 in 48 N-80"}, r"intervals\[0\]\.casing.*a pipe of the catalogue, .*'9 5/8 in 47 casing'"),
    ({"casing": "5 in 19.5 S-135 NC50 drill pipe"}, r"intervals\[0\]\.casing.*casing, such as '9 5/8 in 47 N-80'"),
    ({"casing": "9 5/8 in 47"}, r"intervals\[0\]\.casing.*with its grade"),
    ({"casing": 9.625}, r"intervals\[0\]\.casing = 9\.625.*in quotes"),
    ({"kind": "open"}, r'intervals\[0\]\.kind = "open".*"cased" beside casing'),
    ({"diameter": "9 5/8 in"}, r"intervals\[0\]\.outer_diameter.*more than the diameter inside"),
    ({"casing": None, "diameter": 0.22, "outer_diameter": 0.2445}, r"intervals\[0\]\.yield_strength is missing"),
    ({"casing": None, "diameter": 0.22, "yield_strength": "N-80"}, r"intervals\[0\]\.outer_diameter is missing"),
])  # fmt: skip
def test_wrong_casing(keys: dict[str, Any], message: str) -> None:
    interval = {key: value for key, value in (CASED | keys).items() if value is not None}
    hole = {"stations": [[0, 0, 0], [1000, 0, 0]], "intervals": [interval]}
    string = {"components": [{"name": "pipe", "outer_diameter": 0.127, "inner_diameter": 0.1}]}
    with pytest.raises(InputError, match=message):
        load_case({"name": "x", "wellbore": hole, "string": string})
