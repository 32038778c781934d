"""Limits: the largest share of each along a string, by another way, and the bounds of the penetration."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd import equilibrium
from fctd.mechanics.query import WALL_COLUMNS, Walls, walls_in
from fctd.model.drillstring import String, lay_out
from fctd.results.hanging_body import HANGING_COLUMNS, MOMENT
from fctd.results.limits import LIMITS, ROW, SHARE, WORST, find_shares
from fctd.results.notes import Note, limit_notes
from fctd.results.profile import Loads, at_contacts, stress_along, von_mises, von_mises_pressed
from tests.cases import make_case, pipe

PARTS = [pipe(2, 1, outer=0.165, contact_diameter=0.2, contact="point"), pipe(58, 4), pipe(None, 1, outer=0.11)]
STRING = lay_out(make_case(components=PARTS), 100.0)
N = STRING.segments
TENSILE = [limit.code for limit in LIMITS].index("tensile_capacity")


def walls_of(string: String, depths: np.ndarray, hole: float = 0.108) -> Walls:
    """Walls of a hole of a radius [m] beside points that are so deep in it (n,) [m]."""
    rows = np.zeros((string.segments, WALL_COLUMNS))
    rows[:, 1], rows[:, 3] = hole - string.contact_radius() + depths, hole
    rows[:, 6] = np.linspace(10.0, 100.0, string.segments)
    return walls_in(rows)


def hanging_of(string: String, loads: Loads) -> np.ndarray:
    """Bending at the top and at the contact points, of a string whose joints are not known."""
    below = np.append(loads.bending[1:], 0.0)
    rows = np.zeros((string.segments + 1, HANGING_COLUMNS))
    middle = np.where(string.mid_contact(), 0.5 * (loads.bending + below), below)
    rows[:, MOMENT] = np.append(loads.bending[0], middle)
    return rows


def shares_of(
    string: String, loads: Loads, hookload: float, walls: Walls, in_hole: bool = True, excess: np.ndarray | None = None
) -> np.ndarray:
    """The largest shares (limits, WORST) along a string; excess (n + 1,) : of the pressure inside [Pa], else 0."""
    worst = np.empty((len(LIMITS), WORST))
    beyond = find_shares(
        loads.tension, loads.torque, hanging_of(string, loads), loads.bit_tension, loads.bit_torque, float(hookload),
        walls.offset, walls.radius, string.contact_radius(), in_hole, string.mid_contact(), string.component,
        string.table, np.zeros(string.segments + 1) if excess is None else excess, worst,
    )  # fmt: skip
    assert beyond == (worst[:, SHARE] > 1).any()
    return worst


def string_notes(string: String, loads: Loads, hookload: float, walls: Walls, in_hole: bool = True) -> tuple[Note, ...]:
    """The notes on a string beyond its limits."""
    return limit_notes(shares_of(string, loads, hookload, walls, in_hole), string, walls)


@given(
    pull=st.lists(st.floats(-6e6, 6e6), min_size=N, max_size=N), twist=st.floats(-2e5, 2e5), bend=st.floats(0, 3e5),
    depth=st.lists(st.floats(-0.005, 0.03), min_size=N, max_size=N), bit=st.floats(-1e6, 0), hookload=st.floats(0, 9e6),
    in_hole=st.booleans(),
)  # fmt: skip
def test_the_largest_shares_are_those_of_the_profile(
    pull: list[float], twist: float, bend: float, depth: list[float], bit: float, hookload: float, in_hole: bool
) -> None:
    torque, bending = np.zeros(N), np.zeros(N)
    torque[2], bending[3] = twist, bend
    loads = Loads(np.array(pull), torque, bending, np.zeros(N), bit, 0.3 * twist)
    walls, radius = walls_of(STRING, np.array(depth)), STRING.contact_radius()
    worst = shares_of(STRING, loads, hookload, walls, in_hole)
    outer, inner = (np.append(STRING.of(name)[0], STRING.of(name)) for name in ("outer", "inner"))
    bent = hanging_of(STRING, loads)[:, MOMENT]
    stress = von_mises(*at_contacts(STRING, loads), bent, outer, inner) / 931e6
    deep = np.append(0.0, np.array(depth) / np.clip(0.25 * (0.108 - radius), 0.002, 0.01))
    pulled = np.append(hookload / (931e6 * np.pi * (0.055**2 - 0.035**2)), np.zeros(N))
    of = {"penetration": deep if in_hole else 0 * deep, "yield": stress, "tensile_capacity": pulled}
    for k, shares in ((k, of[limit.code]) for k, limit in enumerate(LIMITS) if limit.code in of):
        assert worst[k, SHARE] == pytest.approx(max(shares.max(), 0.0), rel=1e-9, abs=1e-12)
        assert shares[int(worst[k, ROW])] == pytest.approx(worst[k, SHARE], rel=1e-9, abs=1e-12)
    found = string_notes(STRING, loads, hookload, walls, in_hole)
    assert [note.code for note in found] == [LIMITS[k].code for k in range(len(LIMITS)) if worst[k, SHARE] > 1]
    assert [note.excess for note in found] == [share for share in worst[:, SHARE] if share > 1]


@given(
    tension=st.floats(-3e6, 3e6), twist=st.floats(-5e4, 5e4), bend=st.floats(0, 1e5), excess=st.floats(-9e7, 9e7),
)  # fmt: skip
def test_stress_under_pressure_is_the_largest_of_both_walls(
    tension: float, twist: float, bend: float, excess: float
) -> None:
    """By the principal stresses at each wall on both sides of the bend, from the pressures on both sides of the wall.

    A pressure outside is taken from all of them; the pipe's share of true tension is T + p_i A_i − p_o A_o.
    """
    b, a, outside = 0.0635, 0.0543, 4e7
    inside = outside + excess
    steel, second = np.pi * (b * b - a * a), np.pi / 4 * (b**4 - a**4)
    true = tension + inside * np.pi * a * a - outside * np.pi * b * b
    worst = 0.0
    for r in (a, b):
        mean, varied = (inside * a * a - outside * b * b) / (b * b - a * a), (inside - outside) * a * a * b * b
        varied /= (b * b - a * a) * r * r
        for side in (1, -1):
            tensor = np.diag([mean - varied, mean + varied, true / steel + side * bend * r / second])
            tensor[1, 2] = tensor[2, 1] = twist * r / (2 * second)
            x, y, z = np.linalg.eigvalsh(tensor)
            worst = max(worst, np.sqrt(0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2)))
    assert von_mises_pressed(tension, twist, bend, b, a, excess) == pytest.approx(worst, rel=1e-9, abs=1.0)
    # Without a difference it is the stress of equal pressures.
    same = von_mises(tension, twist, bend, b, a)
    assert von_mises_pressed(tension, twist, bend, b, a, 0.0) == pytest.approx(same, rel=1e-9, abs=1e-3)


def test_pressures_count_where_they_are() -> None:
    """The share of the strength is that of the stress there; the hook load is compared where pressures are equal."""
    loads, walls = Loads(*np.full((3, N), 1e5), np.zeros(N)), walls_of(STRING, np.full(N, -0.01))
    excess = np.zeros(N + 1)
    excess[3], excess[0] = -5e7, 2e7
    worst = shares_of(STRING, loads, 1e6, walls, excess=excess)
    share = {limit.code: row for limit, row in zip(LIMITS, worst, strict=True)}
    section = STRING.sections[STRING.component[2]]
    assert share["collapse"][[SHARE, ROW]] == pytest.approx([5e7 / section.collapse, 3])
    assert share["burst"][[SHARE, ROW]] == pytest.approx([2e7 / STRING.sections[-1].burst, 0])
    assert share["tensile_capacity"][SHARE] == 0
    stress = stress_along(STRING, *at_contacts(STRING, loads), hanging_of(STRING, loads)[:, MOMENT], excess)
    strengths = np.append(STRING.of("yield_strength")[0], STRING.of("yield_strength"))
    assert share["yield"][SHARE] == pytest.approx((stress / strengths).max(), rel=1e-12)


@pytest.mark.parametrize("length", [28.6046511627907, 19.7, 13.3, 31.1])
def test_the_hook_load_counts_at_the_table_where_both_columns_begin_without_pressure(length: float) -> None:
    """Fluids that differ have one pressure at the depth 0, which segments add up to but for rounding."""
    interval = {"to_md": 1000.0, "diameter": 0.2159, "friction": 0.2}
    case = make_case(
        components=[pipe(None, None, segment_length=length)],
        mud={"density": 1466.0, "float": True, "inside": [{"density": 1030.0}]},
        wellbore={"intervals": [interval], "geometry": "arcs"},
    )
    point = equilibrium(case, "trip_in", 984.0)
    steel = np.pi / 4 * (0.127**2 - 0.07**2)
    assert point.shares[TENSILE, SHARE] == pytest.approx(point.hookload / (931e6 * steel), rel=1e-12)


def test_a_part_bends_at_its_upper_end_as_the_part_above() -> None:
    """Pull falls and bending grows down the string: both of one place, whether or not a part begins there."""
    several = lay_out(make_case(components=[pipe(20.0, 1, contact="sleeve")] * N), 20.0 * N)
    whole = lay_out(make_case(components=[pipe(20.0 * N, N)]), 20.0 * N)
    loads = Loads(np.linspace(2e6, 1e5, N), np.zeros(N), np.linspace(1e3, 4e4, N), np.zeros(N), 0.0, 0.0)
    one, other = (
        shares_of(of, loads, 2e6, walls_of(of, np.full(N, -0.01)))[:, SHARE] for of in (whole, several)
    )  # fmt: skip
    np.testing.assert_allclose(other, one, rtol=1e-12)


def test_a_component_that_is_written_as_several_has_the_stress_of_one() -> None:
    """The upper end of a weaker part is a place of its own; that of an equal part is none."""
    stations = [[0, 0, 0], [300, 0, 0], [700, 60, 40], [1000, 60, 40]]
    whole, several = [pipe(1000.0, 50)], [pipe(20.0, 1, contact="sleeve")] * 50
    one, other = (equilibrium(make_case(stations, parts), "trip_out", 1000.0) for parts in (whole, several))
    np.testing.assert_allclose(other.shares[:, SHARE], one.shares[:, SHARE], rtol=1e-9)


def test_loads_that_are_no_numbers_are_beyond_no_limit() -> None:
    loads, walls = Loads(*np.full((4, N), np.nan)), walls_of(STRING, np.full(N, np.nan))
    assert not shares_of(STRING, loads, np.nan, walls)[:, SHARE].any()


@pytest.mark.parametrize(("hole", "most"), [(0.108, 0.01), (0.0835, 0.005), (0.065, 0.002)])
def test_a_note_on_what_is_deeper_than_a_quarter_of_the_clearance(hole: float, most: float) -> None:
    """Of pipe of 127 mm, from 2 to 10 mm; without loads."""
    string, none = lay_out(make_case(components=[pipe(None, 3)]), 100.0), np.zeros(3)
    for depth, expected in ((0.99 * most, 0), (1.001 * most, 1)):
        walls = walls_of(string, np.array([-0.001, depth, -0.001]), hole)
        found = string_notes(string, Loads(none, none, none, none), 0.0, walls)
        assert [(note.code, note.place) for note in found] == [("penetration", 55.0)] * expected
