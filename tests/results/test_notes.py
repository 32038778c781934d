"""Notes: each bound from both sides, and nothing on sound strings."""

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as pq
import pytest

from fctd import Case, equilibrium, simulate, torque_drag
from fctd.case.units import conversion
from fctd.model.drillstring import lay_out
from fctd.model.wellbore import build_wellbore
from fctd.results import notes
from fctd.results.buckling import Buckling
from fctd.results.profile import Loads
from fctd.steady.steady_string import Equilibrium
from tests.cases import make_case, pipe, trip
from tests.results.test_limits import string_notes


def bend(quarters: int) -> list[list[float]]:
    """Stations of a hole that bends by 8°/30 m: from vertical to level, then a number of quarters of a circle."""
    turns = [[937.5 + 337.5 * k, 90.0, 90.0 * k] for k in range(quarters + 1)]
    return [[0, 0, 0], [600, 0, 0], *turns, [turns[-1][0] + 300, 90, turns[-1][2]]]


CASING = {"name": "casing", "outer_diameter": 0.2445, "inner_diameter": 0.2224, "segment_length": 12.0}


def casing(quarters: int = 2, friction: float = 0.5, **more: Any) -> Case:
    """9⅝ in casing in 12¼ in hole."""
    stations = bend(quarters)
    intervals = [{"to_md": stations[-1][0], "diameter": 0.3112, "friction": friction}]
    return make_case(stations, [CASING | more], wellbore={"intervals": intervals}, mud={"density": 1200})


def found(point: Equilibrium) -> dict[str, notes.Note]:
    return {note.code: note for note in point.notes}


def deepest(point: Equilibrium) -> tuple[float, float]:
    """Largest penetration [m] and the clearance there."""
    profile = point.profile.iloc[1:]
    clearance = profile["clearance_m"].to_numpy()
    penetration = np.hypot(profile["offset_high_m"], profile["offset_right_m"]).to_numpy() - clearance
    return float(penetration.max()), float(clearance[penetration.argmax()])


def test_casing_pulled_through_a_very_long_bend_has_notes() -> None:
    """μ 0.5 in 540° of bend: a balance of 11 MN, deep in the wall, beyond yield and the capacity of the top pipe."""
    point = equilibrium(casing(5, yield_strength="110 ksi"), "trip_out", 2875.0)
    assert point.status == "converged"
    assert point.hookload > 1e7
    codes = found(point)
    assert list(codes) == ["penetration", "yield", "tensile_capacity"]
    assert notes.codes_of(point.notes) == "penetration, yield, tensile_capacity"
    penetration, clearance = deepest(point)
    deep, wide = f"{1e3 * penetration:.3g} mm deep in the wall", f"where the clearance is {1e3 * clearance:.3g} mm"
    assert codes["penetration"].text.endswith(f" m is {deep}, {wide}")
    assert 600 < (codes["penetration"].place or 0) < 800
    stress = point.profile["von_mises_Pa"].max() / 1e6
    assert codes["yield"].text.endswith(f" m is {stress:.0f} MPa, the yield strength 758 MPa")
    assert f"the hook load is {point.hookload / 1e3:.0f} kN" in codes["tensile_capacity"].text
    assert all(note.remedy == notes.MEANINGS[note.code].remedy for note in point.notes)
    assert equilibrium(casing(5, 0.1), "trip_out", 2875.0).notes == ()


def test_a_string_deeper_in_the_wall_than_the_hole_is_wide_has_diverged() -> None:
    """Another quarter of bend: 200 mm of penetration in a 311 mm hole with 245 mm pipe."""
    point = equilibrium(casing(6, 0.53), "trip_out", 3200.0)
    assert (point.status, point.notes) == ("diverged", ())
    assert "deeper in the wall than the hole's radius" in point.message


@pytest.mark.parametrize("kind", ["trip_out", "rotate_off_bottom"])
def test_stress_is_that_of_the_profile(kind: str) -> None:
    """A yield strength just above the largest stress gives no note; one just below gives a note with the depth."""
    profile = equilibrium(casing(), kind, 1750.0).profile
    worst = profile.loc[profile["von_mises_Pa"].idxmax()]
    above, below = (
        found(equilibrium(casing(yield_strength=share * worst["von_mises_Pa"]), kind, 1750.0))
        for share in (1.001, 0.999)
    )
    assert "yield" not in above
    assert below["yield"].place == worst["md_m"]
    assert below["yield"].excess == pytest.approx(1 / 0.999)


def test_stress_is_set_against_the_steel_where_it_is() -> None:
    """A weak pipe far down, less stressed than the strong one above it: its upper end decides."""

    def string(weak: float) -> Case:
        parts = [pipe(300, 10, yield_strength=weak), pipe(None, None, segment_length=30.0)]
        return make_case(components=parts)

    profile = equilibrium(string(931e6), "trip_out", 1000.0).profile
    stress = profile["von_mises_Pa"][profile["md_m"] > 699].max()
    assert stress < 0.5 * profile["von_mises_Pa"].max()
    assert equilibrium(string(1.01 * stress), "trip_out", 1000.0).notes == ()
    (note,) = equilibrium(string(0.99 * stress), "trip_out", 1000.0).notes
    assert note.code == "yield"
    assert 700 < (note.place or 0) < 702


def test_hook_load_against_the_uppermost_pipe() -> None:
    """Buoyed weight of 1000 m over the steel's area, both by hand: 7850·g·1000 Pa."""
    stress = 7850 * 9.80665 * 1000
    assert (
        equilibrium(make_case(components=[pipe(1000, 40, yield_strength=1.02 * stress)]), "trip_out", 1000.0).notes
        == ()
    )
    weak = make_case(components=[pipe(1000, 40, yield_strength=0.98 * stress)])
    assert list(found(equilibrium(weak, "trip_out", 1000.0))) == ["yield", "tensile_capacity"]


@pytest.mark.parametrize(("hole", "limit"), [(0.311, 10e-3), (0.15, 2.875e-3), (0.13, 2e-3)])
def test_penetration_is_set_against_the_clearance(hole: float, limit: float) -> None:
    """10 mm in a wide hole, a quarter of the clearance in a narrow one, but 2 mm at least: a wall of any stiffness."""

    def pressed(stiffness: float) -> Equilibrium:
        stations = [[0, 0, 0], [300, 0, 0], [600, 60, 0], [900, 60, 0]]
        wall = {"intervals": [{"to_md": 900, "diameter": hole, "friction": 0.2}], "stiffness": stiffness}
        return equilibrium(
            make_case(stations, [pipe(None, None, segment_length=20.0)], wellbore=wall), "trip_out", 850.0
        )

    stiffness = 1e6
    for _ in range(6):  # the load on the deepest point hardly depends on the stiffness
        stiffness *= deepest(pressed(stiffness))[0] / limit
    held, given = pressed(1.05 * stiffness), pressed(stiffness / 1.05)
    assert deepest(held)[0] < limit < deepest(given)[0]
    told = [[note.code for note in point.notes] for point in (held, given)]
    assert [[code for code in codes if code not in ("sagitta", "chord")] for codes in told] == [
        [], ["penetration"],
    ]  # fmt: skip


def test_without_a_wall_there_is_no_penetration_note() -> None:
    case = make_case([[0, 0, 0], [900, 60, 0]], [pipe(None, None, segment_length=20.0)], contact={"enabled": False})
    assert equilibrium(case, "trip_out", 800.0).notes == ()


def test_a_chart_has_the_codes_of_every_row() -> None:
    chart = torque_drag(casing(yield_strength=140e6), ["trip_out", "rotate_off_bottom"], [1000.0, 1400.0, 1800.0])
    assert chart["notes"].tolist() == ["none", "yield", "yield, tensile_capacity", "none", "none", "yield"]
    assert list(notes.meanings_of(chart["notes"])) == ["yield", "tensile_capacity"]
    assert notes.meanings_of(["none"]) == {}


SOFT = {"stiffness": 5e5, "intervals": [{"to_md": 1000, "diameter": 0.2159, "friction": 0.2}]}


def test_a_run_keeps_the_worst_of_each_note(tmp_path: Path) -> None:
    """Tripping pipe into a soft bend, with weak steel: the notes of the run are in its message and in its files."""
    stations = [[0, 0, 0], [500, 0, 0], [650, 30, 0], [1000, 30, 0]]
    parts = [pipe(None, None, segment_length=20.0, yield_strength=45e6)]
    mud = {"density": 1000, "viscosity": 0}
    result = simulate(make_case(stations, parts, [trip(640, 700, speed=1.0)], wellbore=SOFT, mud=mud))
    assert result.status == "completed"
    codes = {note.code: note for note in result.notes}
    assert {"penetration", "yield"} <= codes.keys()
    assert len(codes) == len(result.notes)
    # The largest penetration was at a seam between cylinders, ten metres before the end.
    assert "with the bit at 687 m" in codes["penetration"].text
    assert "with the bit at 700 m" in codes["yield"].text
    for note in result.notes:
        assert str(note) in result.message
    result.save(tmp_path)
    kept = json.loads(pq.read_schema(tmp_path / "profile.parquet").metadata[b"notes"])
    assert notes.from_metadata(kept) == result.notes


def test_the_worst_of_each_code_in_the_order_of_the_table() -> None:
    mild, bad = (notes.Note("yield", "text", "remedy", excess=excess) for excess in (2.0, 3.0))
    deep = notes.Note("penetration", "text", "remedy", 7.0, 1.5)
    assert notes.worst([mild, bad, deep, mild]) == (deep, bad)
    assert notes.worst([]) == ()
    assert notes.from_metadata(notes.as_metadata([deep, bad])) == (deep, bad)


@pytest.mark.parametrize("joint", [0, 1, 7])
def test_torque_alone_makes_steel_yield(joint: int) -> None:
    """√3 T r/J, against the pipe that the joint belongs to: the uppermost one is thinner than the others."""
    case = make_case(components=[pipe(950, 19), pipe(None, 1, outer=0.11)])
    string, hole = lay_out(case, 1000.0), build_wellbore(case)
    walls = hole.walls(hole.at(np.linspace(50.0, 1000.0, 20))[0])
    outer = 0.055 if joint < 2 else 0.0635

    def codes(share: float) -> list[tuple[str, float | None]]:
        torque = np.zeros(20)
        polar = np.pi / 2 * (outer**4 - 0.035**4)
        torque[joint] = share * string.sections[0].yield_strength * polar / (np.sqrt(3) * outer)
        loads = Loads(np.zeros(20), torque, np.zeros(20), np.zeros(20))
        found = string_notes(string, loads, 0.0, walls)
        return [(note.code, note.place) for note in found]

    assert codes(0.999) == []
    place = 50.0 * joint
    assert codes(1.001) == [("yield", pytest.approx(place))]


def test_the_hook_load_that_the_uppermost_pipe_takes() -> None:
    case = make_case(components=[pipe(950, 19), pipe(None, 1, outer=0.11)])
    string, hole = lay_out(case, 1000.0), build_wellbore(case)
    walls = hole.walls(hole.at(np.linspace(50.0, 1000.0, 20))[0])
    capacity = string.sections[0].yield_strength * np.pi / 4 * (0.11**2 - 0.07**2)

    def pulled(share: float) -> tuple[notes.Note, ...]:
        loads = Loads(*(np.zeros(20) for _ in range(4)))
        return string_notes(string, loads, share * capacity, walls)

    assert pulled(0.999) == ()
    (note,) = pulled(2.0)
    assert (note.code, note.place, note.excess) == ("tensile_capacity", 0.0, pytest.approx(2.0))
    assert note.text == (
        f"the hook load is {2 * capacity / 1e3:.0f} kN, the uppermost pipe yields at {capacity / 1e3:.0f} kN"
    )


def test_a_note_as_text() -> None:
    note = notes.Note("yield", "text", "remedy", 3.0)
    assert str(note) == "text: remedy"
    assert replace(note, place=None).place is None
    assert conversion("ksi", "Pa") * 135 == pytest.approx(931e6, rel=1e-3)  # the default: S-135


def test_a_buckled_string_on_long_segments_is_noted_at_its_upper_end() -> None:
    """Segments of 10 m where 2.5 m would do are four times too long; short ones are no note."""
    buckled = Buckling("helical", 540.0, 1500.0, longest=10.0, segment_length=2.5, excess=3.0)
    note = notes.under_resolved(buckled)
    assert note is not None
    assert (note.code, note.place, note.excess) == ("buckling", 540.0, 4.0)
    assert "helical from 540 to 1500 m, where segments of 10 m cannot bend that way" in note.text
    assert "segments of at most 2.5 m would" in note.text
    assert notes.under_resolved(replace(buckled, longest=0.0)) is None


@pytest.mark.parametrize(("share", "codes"), [(1.02, []), (0.98, ["hoist", "drive"])])
def test_a_rig_that_is_too_weak_is_noted(share: float, codes: list[str]) -> None:
    """The limits at 2 % more and less than what the row needs: block and string, torque and offset."""
    needs: dict[str, Any] = {"block_weight": 200e3, "torque_offset": 500.0}
    given = {"mud": {"rotational_damping": 2.0}}
    free = equilibrium(make_case(rig=needs, **given), "rotate_off_bottom", 900.0, rpm=60)
    assert free.weight_indicator > free.hookload + 199e3
    limits = {"hoist_capacity": share * free.weight_indicator, "largest_torque": share * free.drive_torque}
    point = equilibrium(make_case(rig=needs | limits, **given), "rotate_off_bottom", 900.0, rpm=60)
    assert [note.code for note in point.notes] == codes
    assert point.hookload == free.hookload


@pytest.mark.parametrize(("length", "codes"), [(16.5, []), (10.0, ["slips"])])
def test_slips_that_crush_the_uppermost_pipe_are_noted(length: float, codes: list[str]) -> None:
    """5 in S-135 premium: 403,000 lbf in slips of 16.5 in; the string weighs 390,000.  A moving row has no note."""
    weak = pipe(None, None, segment_length=100.0, outer=4.8552 * 0.0254, inner=4.276 * 0.0254, yield_strength=930.8e6)
    heavy = weak | {"linear_mass": 390e3 * 4.4482216 / 9.80665 / 900}
    case = make_case(components=[heavy], rig={"slip_length": f"{length} in"})
    assert [note.code for note in equilibrium(case, "rotate_off_bottom", 900.0, rpm=60).notes] == codes
    assert equilibrium(case, "trip_out", 900.0).notes == ()


def test_a_string_that_hangs_in_crushing_slips_is_noted_in_a_run() -> None:
    """While a stand is added."""
    weak = pipe(None, None, segment_length=28.5, yield_strength=60e6)
    hung = make_case(
        components=[weak], operations=[trip(900, 930, speed=1.0)],
        rig={"feed": "stands", "slip_length": 0.1, "connection_time": 1.0},
    )  # fmt: skip
    assert "slips" in {note.code for note in simulate(hung).notes}


def test_loads_that_rounding_moves_are_worth_a_note_from_a_hundredth_of_the_weight_on() -> None:
    assert notes.several_balances(-5e3, (), 100e3) is None
    assert notes.several_balances(-5e3, (-5.9e3, -5e3), 100e3) is None
    note = notes.several_balances(-5e3, (-7e3, -4e3), 100e3)
    assert note is not None
    assert "is -7 to -4 kN, 3 % of the string's weight apart" in note.text
    assert note.excess == pytest.approx(3.0)


def test_a_draw_without_a_balance_is_worth_a_note_too() -> None:
    note = notes.several_balances(-5e3, (math.nan, -5e3), 100e3)
    assert note is not None
    assert note.text.endswith("1 of 2 draws have no balance")
    assert note.excess == 1.0
