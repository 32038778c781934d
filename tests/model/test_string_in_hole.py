"""Strings and runs that just fit, and those that are refused."""

from contextlib import nullcontext

import numpy as np
import pytest
from pydantic import ValidationError

from fctd import equilibrium, load_case
from fctd.case.errors import InputError
from fctd.mechanics.state import MAX_SEGMENTS
from fctd.model.drillstring import SHORTEST_LONG_SEGMENT, lay_out
from fctd.model.string_in_hole import check_fit
from fctd.model.wellbore import build_wellbore
from fctd.simulation.preparation import prepare
from tests.cases import make_case, pipe, rotation, trip


@pytest.mark.parametrize(
    ("case", "pattern"),
    [
        (
            {"components": [pipe(1000, 20, contact_diameter=0.23)]},
            r"string\.components\[0\]\.contact_diameter = .230 mm.*at most the hole's 215\.9 mm",
        ),
        (
            {"components": [pipe(500, 20)]},
            r"string\.components.*500 m of string.*reach from the bit at 1000 m",
        ),
        (
            {"components": [pipe(999.5, 20)]},
            r"string\.components.*999\.5 m of string.*reach from the bit at 1000 m",
        ),
        (
            {"components": [pipe(1000, MAX_SEGMENTS + 1)]},
            rf"string\.components.*{MAX_SEGMENTS + 1} segments.*at most {MAX_SEGMENTS}",
        ),
        (
            {"components": [pipe(500, MAX_SEGMENTS), pipe(None, 1000)]},
            rf"string\.components.*{MAX_SEGMENTS + 1000} segments.*at most {MAX_SEGMENTS}",
        ),
        (
            {"components": [pipe(1000, None, segment_length=1e-7)]},
            rf"string\.components.*1e\+10 segments.*at most {MAX_SEGMENTS}",
        ),
        (
            {"components": [pipe(990.5, 20), pipe(None, 1)]},
            r"string\.components\[1\].*9\.5 m of it at the top.*at least 10 m",
        ),
        (
            {"components": [pipe(9e-4, 1), pipe(None, 20)]},
            r"string\.components\[0\].*0.0009 m of it in one segment.*segments of at least 0.001 m",
        ),
        (
            {"components": [pipe(995, 20), pipe(None, 1)]},
            r"string\.components\[1\].*5 m of it at the top.*at least 10 m",
        ),
        (
            {
                "stations": [[0, 0, 0], [300, 0, 0], [1000, 60, 0]],
                "components": [pipe(500, 20), pipe(None, 1)],
            },
            r"string\.components\[1\].*500 m at the top.*within 1 deg of vertical",
        ),
        ({"solver": {"step": 0.1}}, r"solver\.step.*0\.1 s.*at most the stable step"),
        ({"operations": []}, r"operations.*at least one operation"),
        (
            {
                "stations": [[0, 0, 0], [100, 0, 0], [1000, 60, 0]],
                "components": [pipe(1000, 20)], "operations": [trip(600, 900)], "rig": {"feed": "long_segment"},
            },
            r"string\.components\[0\].*within 1 deg of vertical",
        ),
        # A long segment is of one component, and no more than there is.
        *(
            (
                {"components": components, "operations": [operation], "rig": {"feed": "long_segment"}},
                r"string\.components\[\d\]\.length.*to reach a bit depth of 900 m",
            )
            for components, operation in [
                ([pipe(700, 28)], trip(600, 900)),
                ([pipe(100, 10, outer=0.159), pipe(500, 20), pipe(1000, 40)], trip(590, 900)),
            ]
        ),
        # An operation that is over before it begins.
        *(
            ({"operations": [operation]}, r"operations\[0\].* s\": expected an operation that lasts at least 1 ms")
            for operation in (rotation(1000, 1e-10), trip(1000, 1000 - 1e-9), trip(1000, 1000 - 1e-12, speed=10.0))
        ),
        # What would run for hours.
        *(
            ({"operations": [rotation(1000, 60)], **sections}, pattern)
            for sections, pattern in [
                ({"record": {"profile_at": [5000]}}, r"record\.profile_at\[0\].*5000 m.*1000 to 1000 m"),
                ({"record": {"interval": 1e-9}}, r"record\.interval.*at most 200000 records"),
                ({"record": {"profile_at": [1e3] * 100_000}}, r"profile_at.*100000 depths.*at most \d+ profiles"),
                ({"wellbore": {"stiffness": 1e20}}, r"solver\.step.*at most 4\.2e\+10 steps of 20 segments"),
                ({"solver": {"step": 1e-12}}, r"solver\.step.*1e-12 s for 60 s.*at most 4\.2e\+10 steps"),
                ({"wellbore": {"cylinder_length": 1e-6, "overlap": 0}}, r"wellbore\.cylinder_length.*cylinders"),
            ]
        ),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused(case: dict, pattern: str) -> None:
    with pytest.raises(InputError, match=pattern):
        prepare(make_case(**{"operations": [rotation(1000, 1)], **case}))


def test_what_just_fits_is_laid_out() -> None:
    """As many segments as the buffer holds, a long segment of 10 m, a fed one of 10 m, pipe as wide as its hole."""
    assert lay_out(make_case(components=[pipe(1000, MAX_SEGMENTS)]), 1000.0).segments == MAX_SEGMENTS
    longer = pipe(None, None, segment_length=1000 / (MAX_SEGMENTS + 0.4))
    assert lay_out(make_case(components=[longer]), 1000.0).segments == MAX_SEGMENTS
    assert lay_out(make_case(components=[pipe(990, 20), pipe(None, 1)]), 1000.0).length[0] == SHORTEST_LONG_SEGMENT
    fed = lay_out(make_case(components=[pipe(None, None, segment_length=10.0)]), 100.0, 200.0)
    np.testing.assert_allclose(fed.length, np.full(10, 10.0))
    narrow = [{"to_md": 99.5, "diameter": 0.1, "friction": 0.2}, {"to_md": 1000, "diameter": 0.3, "friction": 0.2}]
    for case in (
        make_case(components=[pipe(None, 20, contact_diameter=0.2159)]),
        # A long segment hangs in the vertical part alone; the hole may be narrow above the top of the string.
        make_case([[0, 0, 0], [300, 0, 0], [1000, 60, 0]], [pipe(900, 36), pipe(None, 1)]),
        make_case(components=[pipe(None, 20)], top_md=100.0, wellbore={"intervals": narrow}),
    ):
        check_fit(lay_out(case, 1000.0), build_wellbore(case), 1000.0)


@pytest.mark.parametrize(("inclination", "fits"), [(0.99, True), (1.01, False)])
def test_a_long_segment_hangs_within_a_degree_of_vertical(inclination: float, fits: bool) -> None:
    case = make_case([[0, inclination, 0], [1000, inclination, 0]], [pipe(900, 36), pipe(None, 1)])
    with nullcontext() if fits else pytest.raises(InputError, match=r"of up to 1\.01 deg.*within 1 deg of vertical"):
        check_fit(lay_out(case, 1000.0), build_wellbore(case), 1000.0)


def test_a_casing_by_name_is_told_of_by_its_name() -> None:
    """Its interval has no diameter to quote."""
    hole = {
        "stations": [[0, 0, 0], [1000, 0, 0]],
        "intervals": [{"to_md": 1000, "casing": "9 5/8 in 47 N-80 casing", "friction": 0.2}],
    }
    wide = [pipe(1000, 20, contact_diameter=0.23)]
    case = load_case({"name": "test", "wellbore": hole, "string": {"components": wide}})
    with pytest.raises(InputError, match=r'mm \(wellbore\.intervals\[0\]\.casing = "9 5/8 in 47 N-80 casing"\)$'):
        equilibrium(case, "trip_in", 900.0)


@pytest.mark.parametrize(("depth", "fits"), [(850.0, True), (900.0, True), (900.1, False), (1000.0, False)])
def test_wide_pipe_fits_where_the_hole_is_wide(depth: float, fits: bool) -> None:
    """400 m of pipe below 250 mm of it, in 320 mm of hole to 500 m and 215.9 mm below."""
    intervals = [
        {"to_md": 500, "diameter": 0.32, "friction": 0.2},
        {"to_md": 1000, "diameter": 0.2159, "friction": 0.2},
    ]
    components = [pipe(400, 10), pipe(None, None, outer=0.25, segment_length=20.0)]
    case = make_case(components=components, wellbore={"intervals": intervals})
    hole, string = build_wellbore(case), lay_out(case, depth)
    refused = pytest.raises(InputError, match=r"components\[1\]\.contact_diameter.*250 mm.*at most the hole's 215\.9")
    with nullcontext() if fits else refused:
        check_fit(string, hole, depth)
    # The same depth reached by feeding.
    fed = case.model_copy(update={"operations": make_case(operations=[trip(840, depth)]).operations})
    with nullcontext() if fits else refused:
        prepare(fed)


def test_a_wide_bottom_stands_below_a_narrow_hole() -> None:
    intervals = [{"to_md": 500, "diameter": 0.2, "friction": 0.2}, {"to_md": 1000, "diameter": 0.3, "friction": 0.2}]
    case = make_case(components=[pipe(300, 10, outer=0.25), pipe(None, 20)], wellbore={"intervals": intervals})
    hole = build_wellbore(case)
    for depth in (1000.0, 800.0):
        check_fit(lay_out(case, depth), hole, depth)
    with pytest.raises(InputError, match=r"components\[0\]\.contact_diameter.*at most the hole's 200 mm"):
        check_fit(lay_out(case, 799.0), hole, 799.0)


@pytest.mark.parametrize(("narrow_to", "bit"), [(0.5, 900.0), (1000.0, 0.9)])
def test_the_first_metre_counts(narrow_to: float, bit: float) -> None:
    """The check includes a narrow interval at the surface, and a string that has just entered the hole."""
    intervals = [
        {"to_md": narrow_to, "diameter": 0.1, "friction": 0.2},
        {"to_md": 2000, "diameter": 0.3, "friction": 0},
    ]
    case = make_case(components=[pipe(None, 4)], wellbore={"intervals": intervals})
    with pytest.raises(InputError, match=r"contact_diameter.*127 mm.*at most the hole's 100 mm"):
        check_fit(lay_out(case, bit), build_wellbore(case), bit)


def test_a_trip_feeds_to_the_end_of_its_component() -> None:
    case = make_case(components=[pipe(300, 12), pipe(500, 20)], top_md=100.0)
    assert lay_out(case, 850.0, 900.0).long_segment
    with pytest.raises(InputError, match=r"components\[1\]\.length.*depth of 900 m.*depth of 900\.1 m"):
        lay_out(case, 850.0, 900.1)


def test_a_bit_at_the_top_of_the_string_is_refused() -> None:
    for depth in (100.0, 90.0):
        with pytest.raises(InputError, match=rf"string\.top_md.*100 m.*less than the bit depth, {depth:g} m"):
            lay_out(make_case(top_md=100.0), depth)


@pytest.mark.slow
def test_cost_counts_the_steps_of_every_segment() -> None:
    """A number of steps that is accepted for twenty segments is refused for five thousand."""
    schedule, solver = [rotation(1000, 3600)], {"step": 2e-6}
    prepare(make_case(operations=schedule, solver=solver))
    with pytest.raises(InputError, match=r"solver\.step.*at most 2e\+08 steps of 5000 segments"):
        prepare(make_case(components=[pipe(1000, 5000)], operations=schedule, solver=solver))


def test_mud_must_be_lighter_than_the_string() -> None:
    with pytest.raises(ValidationError, match="a density below the string's, 7850"):
        make_case(mud={"density": 7850})
