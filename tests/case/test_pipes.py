"""Pipe by name: names in their parts, the catalogue, its sources, and what a component takes from it."""

import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.errors import InputError
from fctd.case.pipes import catalogue as tables
from fctd.case.pipes.catalogue import INCH, Pipe, catalogue, pipe_named, sources
from fctd.case.pipes.filling import filled
from fctd.case.pipes.grades import GRADES, grade_of, strength_of
from fctd.case.pipes.names import COLLAR, DRILL_PIPE, PipeName, in_inches, parse
from fctd.case.raw_case import checked
from fctd.case.string import ComponentSpec
from fctd.model.section import section_of

NC50 = "5 in 19.5 S-135 NC50"
JOINT = {"length": 9.5, "tool_joint_length": 0.5, "tool_joint_diameter": 0.16}
PREMIUM = PipeName(5.0, 19.5, None, "S-135", "nc50", 0.8)


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("5 in 19.5 S-135 NC50, premium", PREMIUM),
        ('5" 19.5# S135 NC 50 premium', PREMIUM),
        ("5 inch, 19.50 lb/ft s nc50 PREMIUM", PREMIUM),
        ("5 1/2 21.9 S 5 1/2 FH, class 2", PipeName(5.5, 21.9, None, "S-135", "51/2fh", 0.7)),
        ("9⅝ in 47 ppf N-80 csg", PipeName(9.625, 47.0, "casing", "N-80", "", 1.0)),
        ("6-3/4 x 2-13/16 NC46 drill collar", PipeName(6.75, 2.8125, COLLAR, None, "nc46", 1.0)),
        ("5″ 19,5 S‑135 NC-50, prem", PREMIUM._replace(connection="nc-50")),
        ("5 in 19.5 S NC50, worn 20 %", PREMIUM),
        ("2 7/8 in 6.5 tubing, 12.5 % worn", PipeName(2.875, 6.5, "tubing", None, "", 0.875)),
        ("5 in 49.3 hwdp new", PipeName(5.0, 49.3, "heavy-weight pipe", None, "", 1.0)),
    ],
)
def test_a_name_in_its_parts(text: str, parts: PipeName) -> None:
    assert parse(text) == parts


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("drill pipe", "expected size, weight, grade and connection of a pipe"),
        ("5 in", "expected size, weight, grade"),
        ("", "expected size, weight, grade"),
        (f"{NC50}, class 3", "expected a class of pipe, new, premium, class 2 or a wear such as '10 % worn'"),
        (f"{NC50}, 60 % worn", "expected 0 to 50 % of the wall"),
        (f"{NC50}, -10 % worn", "expected 0 to 50 % of the wall"),
        ("5 in 19.8 S-135", "'5 in 19.5 S-135 NC50'"),
        ("5 in 19.5 S-135 NC38", "'5 in 19.5 S-135 NC50'"),
        (
            "4 1/2 in 12.6",
            "expected one pipe of those that it may be, '4 1/2 in 12.6 casing' or '4 1/2 in 12.6 tubing'",
        ),
        ("5 1/2 21.9 S-135", "'5 1/2 in 21.9 S-135 HT55 7 1/8 x 3 7/8' or '5 1/2 in 21.9 S-135 HT55 7 x 4'"),
        ("7 in 26 L-80 casing, premium", "without a class or wear, which drill pipe alone has"),
        ("6 3/4 x 2 13/16 NC50 collar, 5 % worn", "without a class or wear"),
        (f"{NC50}, 80 %", "expected a pipe of the catalogue"),
        ("5 in 49.3 HWDP", "no heavy-weight pipe"),
        ("9 5/8 in 47 S-135 casing", "'9 5/8 in 47 casing'"),
    ],
)
def test_a_name_that_is_not_known_is_refused_with_the_nearest(text: str, expected: str) -> None:
    with pytest.raises(InputError) as error:
        pipe_named(text)
    assert expected in str(error.value)
    assert error.value.value == text


@given(st.text(max_size=60))
def test_any_text_is_a_pipe_or_an_error(text: str) -> None:
    try:
        pipe = pipe_named(text)
    except InputError as error:
        assert error.value == text  # noqa: PT017 (most texts are refused)
    else:
        assert pipe_named(pipe.name) == pipe


@pytest.mark.parametrize("pipe", catalogue(), ids=lambda pipe: pipe.name)
def test_every_pipe_is_found_by_its_name(pipe: Pipe) -> None:
    assert pipe_named(pipe.name) == pipe
    if pipe.kind == DRILL_PIPE:
        assert pipe_named(f"{pipe.name}, class 2").name == f"{pipe.name}, class 2"


def test_geometry_weighs_what_its_name_says() -> None:
    """A mistyped bore would be off: plain steel weighs 0.86 to 1.01 of the nominal weight."""
    for pipe in catalogue():
        assert 0 < pipe.inner < pipe.outer
        if pipe.kind != COLLAR:
            plain = 7850 * math.pi / 4 * (pipe.outer**2 - pipe.inner**2) * 0.3048 / 0.45359237
            assert 0.86 < plain / pipe.second < 1.02, pipe.name
        if pipe.joint is not None:
            assert pipe.outer < pipe.joint.outer
            assert pipe.joint.inner < pipe.inner
        if pipe.coupling is not None:
            assert 1.05 < pipe.coupling / pipe.outer < 1.2


def test_every_row_has_a_page_and_every_page_a_row() -> None:
    used = {key for pipe in catalogue() for key in pipe.sources}
    used |= {key for row in tables.table("connections") for key in row["sources"].split()}
    assert used == set(sources())
    for source in sources().values():
        assert source.title
        assert source.address.startswith("http")
        assert source.opened.count("-") == 2


def test_grades() -> None:
    assert [grade_of(word) for word in ("S-135", "s135", "P 110", "n80", "S-136", "s")] == [
        "S-135", "S-135", "P-110", "N-80", None, None,
    ]  # fmt: skip
    assert strength_of("S-135") == pytest.approx(930.8e6, rel=1e-4)
    assert {name for name in GRADES if grade_of(name) != name} == set()


def component(**keys: Any) -> ComponentSpec:
    return checked(ComponentSpec, keys)


def test_a_component_takes_from_its_pipe_what_it_does_not_say() -> None:
    new = component(pipe=NC50)
    assert (new.name, new.outer_diameter, new.inner_diameter) == (NC50, 0.127, 0.1086104)
    assert new.contact_diameter == pytest.approx(6.625 * INCH)
    assert new.linear_mass == pytest.approx(23.52 * 0.45359237 / 0.3048)
    assert new.joint is not None
    assert (new.joint.length, new.joint.tool_joint_length) == pytest.approx((31.7 * 0.3048, 21 * INCH))
    own = component(pipe=NC50, name="mine", outer_diameter="4.9 in", linear_mass="22 lb/ft", yield_strength="G105")
    assert (own.name, own.outer_diameter) == ("mine", 4.9 * INCH)
    assert own.linear_mass == pytest.approx(32.74, rel=1e-3)
    assert own.yield_strength == strength_of("G-105")


def test_one_key_of_the_joint_may_be_given() -> None:
    longer = component(pipe=NC50, joint={"length": "45 ft"}).joint
    assert longer is not None
    assert (longer.length, longer.tool_joint_length) == pytest.approx((45 * 0.3048, 21 * INCH))


def test_other_tool_joints_touch_and_weigh_as_they_are() -> None:
    """What the catalogue says of its own tool joints does not stand beside others; its own joint written out does."""
    wide = component(pipe=NC50, joint={"tool_joint_diameter": "9 in"})
    assert (wide.contact_diameter, wide.linear_mass) == (9 * INCH, None)
    alone = component(name="x", outer_diameter=0.127, inner_diameter=0.1086104, joint=wide.joint)
    assert section_of(wide, 0.0).weight == pytest.approx(section_of(alone, 0.0).weight)
    own = component(pipe=NC50)
    assert own.joint is not None
    assert component(pipe=NC50, joint=own.joint.model_dump()) == own
    assert component(pipe=NC50, joint={"length": "45 ft"}, linear_mass=30.0).linear_mass == 30.0


@pytest.mark.parametrize("used", ["premium", "class 2", "15 % worn"])
def test_a_class_lowers_strength_alone(used: str) -> None:
    """Mass, diameters, stiffness and what hangs in mud are those of new pipe."""
    new, worn = (section_of(component(pipe=name), 1200.0) for name in (NC50, f"{NC50}, {used}"))
    changed = {key for key in new._fields if getattr(new, key) != getattr(worn, key)}
    assert changed == {"worn_outer", "burst", "collapse"}


@pytest.mark.parametrize(("measured", "wall"), [(4.95, 0.8), (4.8, 0.262 / 0.362)])
def test_a_measured_diameter_is_that_of_the_pipe_and_its_wall_at_most_what_bears(measured: float, wall: float) -> None:
    """Of 5 in by 4.276 in: the class leaves 80 % of 0.362 in, 4.8 in outside leave 72.4 %."""
    part = component(pipe=f"{NC50}, premium", outer_diameter=f"{measured} in", linear_mass="22 lb/ft")
    of = section_of(part, 1200.0)
    assert (of.outer, of.mass) == pytest.approx((0.5 * measured * INCH, 22 * 0.45359237 / 0.3048))
    assert of.worn_outer - of.inner == pytest.approx(wall * 0.362 * INCH)
    bears = 2 * 135 * 6.894757e6 * wall * 0.362 / 5.0  # Barlow, with the nominal diameter
    assert of.burst == pytest.approx(bears, rel=1e-6)


def test_a_stored_component_is_read_as_it_was() -> None:
    """All keys are written; those of the pipe are not filled in again."""
    for changes in ({}, {"yield_strength": 931e6}, {"contact_diameter": 0.17}):
        given = component(pipe=NC50, **changes)
        assert checked(ComponentSpec, given.model_dump(mode="json", exclude_none=True)) == given


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"pipe": 5}, "pipe = 5: expected the name of a pipe in quotes"),
        ({"pipe": "9 5/8 47 casing"}, "its grade, such as 'N-80', or yield_strength"),
        ({"pipe": f"{NC50}, class 5"}, 'pipe = "5 in 19.5 S-135 NC50, class 5": expected a class'),
        ({"pipe": NC50, "inner_diameter": "6 in"}, 'inner_diameter = "6 in": expected a diameter below outer_diameter'),
        ({"pipe": NC50, "yield_strength": "S-136"}, "expected a stress, or the grade S-135"),
        ({"name": "x", "inner_diameter": 0.05}, "outer_diameter is missing"),
        (
            {"pipe": NC50, "joint": {**JOINT, "length": 31.5}},
            "joint.length = 31.5: expected a length above 0 and at most 20 m (31.5 looks like '31.5 ft')",
        ),
        ({"pipe": NC50, "joint": {**JOINT, "tool_joint_length": 21}}, "at most a quarter of a joint of 9.5 m"),
        ({"pipe": NC50, "joint": {**JOINT, "tool_joint_diameter": "5 in"}}, "expected more than outer_diameter"),
        ({"pipe": NC50, "joint": JOINT, "contact_diameter": "6 in"}, "expected at least joint.tool_joint_diameter"),
        ({"pipe": NC50, "joint": {**JOINT, "tool_joint_inner": 0.2}}, "expected a diameter below tool_joint_diameter"),
    ],
)
def test_a_wrong_component_is_refused(keys: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError) as error:
        component(**keys)
    assert message in str(error.value)


def test_a_component_without_a_pipe_is_not_touched() -> None:
    raw = {"name": "x", "outer_diameter": 0.1}
    assert filled(raw) is raw


@pytest.mark.parametrize(("size", "words"), [(5.0, "5"), (9.625, "9 5/8"), (2.8125, "2 13/16"), (6.65, "6.65")])
def test_sizes_in_inches(size: float, words: str) -> None:
    assert in_inches(size) == words
