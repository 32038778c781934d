"""Sliders: what they change, within their ends."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.app.case_text import SourceCase
from fctd.app.sliders import changes, rates_at, sliders_of
from fctd.case.errors import InputError
from fctd.case.operations import KINDS
from fctd.model.operations import rad_per_s, steady_rates
from tests.app.made import TEXT, source
from tests.cases import make_case, pipe


@pytest.fixture(scope="module")
def read(tmp_path_factory: pytest.TempPathFactory) -> SourceCase:
    return SourceCase(source(), tmp_path_factory.mktemp("well"))


def test_sliders_begin_at_the_case(read: SourceCase) -> None:
    found = {slider.name: slider for slider in sliders_of(read.case, "si")}
    assert list(found) == ["friction_cased", "friction_open", "mud", "wob", "bit_torque", "rpm", "segment"]
    assert [found[name].value for name in list(found)[:6]] == [0.2, 0.25, 1200, 30, 0, 90]
    assert found["segment"].value == pytest.approx((10 * 10 + 780) / (10 + 31), rel=0.01)
    field = {slider.name: slider for slider in sliders_of(read.case, "field")}
    assert field["mud"].value == pytest.approx(1200 * 0.0083454, rel=1e-4)  # 1 kg/m^3 in lb/gal
    assert field["wob"].unit == "klbf"
    assert changes(read.case, read.raw, list(field.values()), {"wob": 10})["bit.weight_on_bit"] == pytest.approx(
        44482.2
    )


def test_one_factor_for_intervals_without_kinds() -> None:
    (first, *_) = sliders_of(make_case(components=[pipe(None, None, segment_length=20.0)]), "si")
    assert (first.name, first.label) == ("friction_None", "friction")


def test_a_pair_of_factors_has_two_sliders(tmp_path: Path) -> None:
    text = TEXT.replace("friction = 0.25", "friction = 0.25\nrotational_friction = 0.15")
    read = SourceCase(source(text), tmp_path)
    sliders = sliders_of(read.case, "si")
    shown = {slider.name: (slider.label, slider.value) for slider in sliders[:3]}
    assert shown == {
        "friction_cased": ("friction, cased", 0.2), "friction_open": ("friction along, open hole", 0.25),
        "rotational_open": ("friction around, open hole", 0.15),
    }  # fmt: skip
    found = changes(read.case, read.raw, sliders, {"friction_open": 0.5, "rotational_open": 0.1})
    case = read.changed(found)
    assert [(one.friction, one.friction_around) for one in case.wellbore.intervals] == [(0.2, 0.2), (0.5, 0.1)]
    assert case.wellbore.intervals[1].static_friction == pytest.approx(0.6)


def test_every_slider_changes_its_keys(read: SourceCase) -> None:
    sliders = sliders_of(read.case, "si")
    values = {"friction_open": 0.5, "mud": 1500, "wob": 60, "bit_torque": 3, "rpm": 120, "segment": 12}
    found = changes(read.case, read.raw, sliders, values | {"unknown": 1})
    case = read.changed(found)
    assert [interval.friction for interval in case.wellbore.intervals] == [0.2, 0.5]
    assert case.wellbore.intervals[1].static_friction == pytest.approx(0.6)  # scales along
    assert (case.mud.density, case.bit.weight_on_bit, case.bit.torque) == (1500, 60e3, 3e3)
    assert case.operations[0].rpm == 120
    assert [part.segment_length for part in case.string.components] == [12, 12]
    assert SourceCase(source(read.text(found)), read.folder).case.model_dump() == case.model_dump()
    turned = rates_at(case, 120, 0.03)
    for kind in ("rotate_off_bottom", "drill_rotating", "back_ream"):
        assert steady_rates(turned, kind).spin == pytest.approx(rad_per_s(120))
    assert steady_rates(turned, "trip_in").spin == 0
    assert steady_rates(turned, "back_ream").speed == pytest.approx(-0.1)  # the kind's own
    assert {steady_rates(turned, kind).flow for kind in ("back_ream", "trip_in", "drill_sliding")} == {0.03}
    pumped = read.changed({"operations[0].flow": "1800 L/min"})
    slower = rates_at(pumped, 30)  # a rotation that is moved leaves the flows as they were
    assert all(steady_rates(slower, kind).flow == steady_rates(pumped, kind).flow for kind in KINDS)


def test_flow_has_a_slider_where_the_case_says_how_its_mud_flows(read: SourceCase) -> None:
    viscous = read.changed({"mud.viscosity": 0.03, "operations[0].flow": "1800 L/min"})
    sliders = sliders_of(viscous, "si")
    (flow,) = (slider for slider in sliders if slider.name == "flow")
    assert (flow.value, flow.unit) == (1800, "L/min")
    assert changes(viscous, read.raw, sliders, {"flow": 2400})["operations[0].flow"] == pytest.approx(0.04)


def test_resolved_joints_keep_their_segments() -> None:
    joint = {"length": 10.0, "tool_joint_length": 0.5, "tool_joint_diameter": 0.165}
    part = pipe(None, None, joint=joint, joint_segments=4)
    case = make_case(components=[pipe(100, 5), part], operations=[])
    found = changes(case, {}, sliders_of(case, "si"), {"segment": 12})
    assert found == {"string.components[0].segments": None, "string.components[0].segment_length": 12}
    by_name = {slider.name: slider.value for slider in sliders_of(case, "si")}
    assert by_name["segment"] == pytest.approx(20.0)
    alone = {slider.name: slider.value for slider in sliders_of(make_case(components=[part]), "si")}
    assert alone["segment"] == pytest.approx(2.0)


@given(
    st.floats() | st.integers() | st.text(max_size=3) | st.none() | st.booleans() | st.lists(st.floats(), max_size=2)
)
def test_no_value_beyond_the_ends_passes(value: object) -> None:
    slider = sliders_of(make_case(components=[pipe(None, None, segment_length=20.0)]), "si")[0]
    inside = isinstance(value, int | float) and not isinstance(value, bool) and 0 <= value <= slider.high
    if inside:
        assert slider.check(value) == value
    else:
        with pytest.raises(InputError, match=r"a number from 0 to 0\.6"):
            slider.check(value)


def test_a_case_beyond_the_usual_ends_is_within_its_own(tmp_path: Path) -> None:
    text = TEXT.replace("friction = 0.25", "friction = 0.55").replace('"1200 kg/m^3"', '"100 kg/m^3"')
    case = SourceCase(source(text.replace("static_friction = 0.3", "static_friction = 0.6")), tmp_path).case
    found = {slider.name: slider for slider in sliders_of(case, "si")}
    assert found["friction_open"].high >= 0.8
    assert found["mud"].low == 100
