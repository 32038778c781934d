"""Notes on meshes: segments and cylinders that miss a bend, each bound from both sides."""

import json
import math
from typing import Any

import pytest

from fctd import Case, equilibrium
from fctd.model.drillstring import lay_out
from fctd.results import mesh_notes
from fctd.results.notes import as_metadata, codes_of
from tests.cases import make_case, pipe

BEND: list[list[float]] = [[0, 0, 0], [300, 0, 0], [637.5, 90, 0], [900, 90, 0]]  # 8°/30 m


@pytest.mark.parametrize(("length", "is_noted"), [(8.2, False), (8.4, True), (20.0, True)])
def test_a_segment_that_misses_its_bend_is_noted(length: float, is_noted: bool) -> None:
    """κh²/8 against four clearances of 10 mm in 8°/30 m: h is 8.29 m, and 4.15 m at one."""
    part = pipe(None, None, outer=0.2, inner=0.18, name="casing", segment_length=length)
    hole = {"intervals": [{"to_md": 900, "diameter": 0.22, "friction": 0.2}], "geometry": "arcs"}
    case = make_case(BEND, [part], wellbore=hole)
    string = lay_out(case, 900.0)
    note = mesh_notes.sagitta(case, string)
    assert (note is not None) == is_noted
    if note is None:
        return
    curvature = math.radians(8) / 30
    assert note.excess == pytest.approx(curvature * string.length.max() ** 2 / 8 / (4 * 0.01))
    # All that bend over 30 m are equally far off but for rounding: the first of them.
    middle = string.bit_depth - 0.5 * (string.above_bit[1:] + string.above_bit[:-1])
    assert note.place == middle[middle > 300 + 15].min()
    assert 'of component "casing" miss the bend at' in note.text
    assert "where the clearance is 10 mm; segments of at most 4.1 m would follow it" in note.text
    assert "where the clearance is 0.394 in" in note.told("field")
    assert "sagitta" in codes_of(equilibrium(case, "rotate_off_bottom", 900.0).notes)
    json.dumps(as_metadata([note]))


def test_a_segment_length_that_the_note_names_raises_none() -> None:
    lengths: list[dict[str, Any]] = [{"segment_length": 11.0}, {}]
    for of in lengths:
        case = make_case(BEND, [pipe(None, None, **of)], wellbore={"geometry": "arcs"})
        assert mesh_notes.sagitta(case, lay_out(case, 900.0)) is None


def stabilised(**hole: Any) -> Case:
    """A stabiliser 15 m above the bit, with a clearance of 1.6 mm."""
    parts = [
        pipe(9.0, 3, outer=0.165, name="collar below"),
        pipe(1.5, 3, outer=0.216 - 2 * 1.6e-3, name="stabiliser"),
        pipe(39.0, 13, outer=0.165, name="collar"),
        pipe(None, None),
    ]
    return make_case(BEND, parts, wellbore={"intervals": [{"to_md": 900, "diameter": 0.216, "friction": 0.2}], **hole})


def side_forces(case: Case) -> list[float]:
    """Largest contact force [N] of the lowest 15 m, at three depths of the bit."""
    found = []
    for md in (520.0, 521.0, 600.0):
        profile = equilibrium(case, "trip_out", md).profile
        found.append(float(profile.contact_force_N[profile.md_m > md - 15].max()))
    return found


@pytest.mark.parametrize(
    ("tolerance", "is_noted", "least", "most"),
    [(0.01, True, 0.05, 0.15), (2e-3, True, 0.015, 0.05), (1e-3, False, 0.0, 0.015), (3e-4, False, 0.0, 0.005)],
)
def test_cylinders_that_miss_a_bend_by_more_than_the_clearance_are_noted(
    tolerance: float, is_noted: bool, least: float, most: float
) -> None:
    """The note comes where side forces differ by per cents from those in arcs, as its guide says."""
    case = stabilised(chord_tolerance=tolerance, overlap=0.02)
    off = [of / arc - 1 for of, arc in zip(side_forces(case), side_forces(stabilised(geometry="arcs")), strict=True)]
    assert least <= max(map(abs, off)) <= most
    note = mesh_notes.chord(case, lay_out(case, 600.0))
    assert (note is not None) == is_noted
    assert ("chord" in codes_of(equilibrium(case, "rotate_off_bottom", 600.0).notes)) == is_noted
    if note is not None:
        length = 337.5 / math.ceil(337.5 / math.sqrt(8 * tolerance * 30 / math.radians(8)))
        miss = math.radians(8) / 30 * length**2 / 8
        assert note.excess == pytest.approx(miss / 1.6e-3, rel=1e-6)
        assert f"cylinders of {length:.3g} m miss the bend at" in note.text
        assert 'component "stabiliser" has a clearance of 1.6 mm' in note.text


def test_long_cylinders_are_noted_where_the_hole_bends_and_wide_clearances_are_not() -> None:
    """κℓ²/8 in 8°/30 m is 58 mm at 10 m and 9.3 mm at 4 m, beside a clearance of 44.5 mm; arcs miss by nothing."""
    notes = {}
    for length in (10.0, 4.0):
        case = make_case(BEND, [pipe(None, None)], wellbore={"cylinder_length": length})
        notes[length] = mesh_notes.chord(case, lay_out(case, 900.0))
        assert mesh_notes.chord(case, lay_out(case, 290.0)) is None
    assert notes[4.0] is None
    assert notes[10.0] is not None
    assert "no cylinder_length" in notes[10.0].remedy
    advised = make_case(BEND, [pipe(None, None)], wellbore={"chord_tolerance": 0.01})
    assert mesh_notes.chord(advised, lay_out(advised, 900.0)) is None
    assert 300 < (notes[10.0].place or 0.0) < 637.5
    assert mesh_notes.chord(stabilised(geometry="arcs"), lay_out(stabilised(geometry="arcs"), 600.0)) is None
