"""Strings and holes of WITSML: what is read of them in which order, and what is refused."""

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fctd.case.errors import InputError
from fctd.case.witsml.geometry import Geometry, Section, read_geometry
from fctd.case.witsml.tubular import Tubular, read_tubular
from tests.case.witsml_files import (
    BIT,
    COLLAR,
    DAMAGED,
    HOLE,
    PIPE,
    STRING,
    component,
    geometry,
    objects,
    section,
    tubular,
)  # fmt: skip

READERS = {"string": read_tubular, "hole": read_geometry}


def read(folder: Path, text: str, name: str | None = None) -> Tubular:
    (folder / "t.xml").write_text(text, encoding="utf-8")
    return read_tubular(folder / "t.xml", name)


def read_hole(folder: Path, text: str, name: str | None = None) -> Geometry:
    (folder / "g.xml").write_text(text, encoding="utf-8")
    return read_geometry(folder / "g.xml", name)


@pytest.mark.parametrize(
    "namespace", ["http://www.witsml.org/schemas/1series", "http://www.witsml.org/schemas/131", ""]
)
def test_a_string_of_each_version(namespace: str, tmp_path: Path) -> None:
    string = read(tmp_path, tubular(namespace=namespace))
    assert (string.name, string.wellbore, string.assembly) == ("BHA 1", "B", "drilling")
    assert [part.kind for part in string.parts] == ["bit", "collar", "drill pipe"]
    assert [part.length for part in string.parts] == [0.3, 120, 2900]
    assert string.parts[2].outer == pytest.approx(5 * 0.0254, abs=1e-12)
    assert string.parts[2].touching == pytest.approx(6.625 * 0.0254)


@pytest.mark.parametrize(
    ("element", "uom", "number", "value"),
    [
        ("od", "m", "0.1397", 0.1397), ("od", "mm", "139.7", 0.1397), ("od", "in", "5.5", 0.1397),
        ("od", "in/32", "176", 0.1397), ("od", "cm", "1.397e1", 0.1397), ("len", "ftUS", "1000", 1000 * 1200 / 3937),
        ("len", "ft", "1000", 304.8), ("wtPerLen", "lbm/ft", "21.9", 21.9 * 0.45359237 / 0.3048),
        ("tensYield", "psi", "135000", 135e3 * 6894.757293168361), ("tensYield", "MPa", "931", 931e6),
    ],
)  # fmt: skip
def test_units_of_uom(element: str, uom: str, number: str, value: float, tmp_path: Path) -> None:
    part = {**PIPE, element: (number, uom)}
    read_part = read(tmp_path, tubular([part])).parts[0]
    found = {
        "od": read_part.outer, "len": read_part.length, "wtPerLen": read_part.mass, "tensYield": read_part.strength,
    }  # fmt: skip
    assert found[element] == pytest.approx(value, rel=1e-12)


def test_components_come_in_the_order_in_which_they_entered_the_hole(tmp_path: Path) -> None:
    for parts in ([PIPE, BIT, COLLAR], STRING):
        string = read(tmp_path, tubular(parts))
        assert [part.kind for part in string.parts] == ["bit", "collar", "drill pipe"]
        assert not string.reversed
    without = [{key: value for key, value in part.items() if key != "sequence"} for part in (COLLAR, PIPE)]
    assert [part.kind for part in read(tmp_path, tubular(without)).parts] == ["collar", "drill pipe"]


def test_a_bit_that_is_last_is_at_the_lower_end(tmp_path: Path) -> None:
    numbered = [{**part, "sequence": k} for k, part in enumerate((PIPE, COLLAR, BIT), start=1)]
    string = read(tmp_path, tubular(numbered))
    assert string.reversed
    assert [part.kind for part in string.parts] == ["bit", "collar", "drill pipe"]
    assert [part.number for part in string.parts] == [3, 2, 1]


def test_nulls_and_empty_elements_are_absent_and_zeros_are_kept(tmp_path: Path) -> None:
    part = component("drill pipe", 1, "-999.25", "", 0)
    (read_part,) = read(tmp_path, tubular([part])).parts
    assert (read_part.length, read_part.outer, read_part.inner, read_part.mass) == (None, None, 0.0, None)


def test_one_of_several_is_chosen_by_name_or_uid(tmp_path: Path) -> None:
    several = objects(
        "tubular", [("A", "B1", {"tubularComponent": BIT}), ("B", "B1", {"tubularComponent": PIPE}), ("C", "B1", {})]
    )
    assert read(tmp_path, several, "B").parts[0].kind == "drill pipe"
    assert read(tmp_path, several, "u1").parts[0].kind == "bit"
    listed = '"A (uid u1)" of "B1", "B (uid u2)" of "B1"'
    with pytest.raises(InputError) as which:
        read(tmp_path, several)
    assert str(which.value) == (
        f"{tmp_path}/t.xml: string_name is missing: expected the name of one tubular of the 2 in the file "
        f"(for init: --string-name): {listed}"
    )
    with pytest.raises(InputError) as other:
        read(tmp_path, several, "D")
    assert f'string_name = "D": expected the name or the uid of a tubular of the file: {listed}' in str(other.value)
    namesakes = objects("wbGeometry", [(name, "B1", {"wbGeometrySection": HOLE}) for name in "AA"])
    with pytest.raises(InputError, match='hole_name = "A": expected the uid of one wbGeometry of the 2 in the file'):
        read_hole(tmp_path, namesakes, "A")
    assert len(read_hole(tmp_path, namesakes, "u2").sections) == 2


@pytest.mark.parametrize(("kind", "text", "message"), [row[1:] for row in DAMAGED], ids=[row[0] for row in DAMAGED])
def test_a_damaged_file_gets_one_message(kind: str, text: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "w.xml").write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as refused:
        READERS[kind](tmp_path / "w.xml")
    assert str(refused.value).startswith(f"{tmp_path}/w.xml: {message}")
    assert "\n" not in str(refused.value)


@settings(max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.data())
def test_any_damage_is_read_or_refused(tmp_path: Path, data: st.DataObject) -> None:
    kind = data.draw(st.sampled_from(list(READERS)))
    text = tubular() if kind == "string" else geometry()
    start = data.draw(st.integers(0, len(text)))
    end = data.draw(st.integers(start, min(len(text), start + 60)))
    text = text[:start] + data.draw(st.text(max_size=8).filter(lambda one: one.isprintable())) + text[end:]
    (tmp_path / "w.xml").write_text(text, encoding="utf-8")
    try:
        READERS[kind](tmp_path / "w.xml")
    except InputError as error:
        assert error.file is not None  # noqa: PT017 (most texts are refused)


def test_sections_are_read_from_the_surface_down(tmp_path: Path) -> None:
    hole = read_hole(tmp_path, geometry([*HOLE, section("liner", 1400, 2000, 6.2, factFric=0.15)], bottom=2999))
    assert hole.bottom == 2999
    found = [(one.top, one.bottom, one.section and one.section.type, len(one.others)) for one in hole.intervals]
    assert found == [
        (0, 1400, "casing", 0), (1400, 1500, "liner", 1), (1500, 2000, "liner", 1), (2000, 3000, "open hole", 0),
    ]  # fmt: skip
    assert [one.section and one.section.friction for one in hole.intervals] == [None, 0.15, 0.15, None]
    assert [one.section and one.section.kind for one in hole.intervals] == ["cased", "cased", "cased", "open"]


def test_a_gap_of_a_rounding_is_none(tmp_path: Path) -> None:
    hole = read_hole(tmp_path, geometry([section("casing", 25, 1500, 8.681), section("open hole", 1500.4, 3000, 8.5)]))
    assert [(one.top, one.bottom, one.section is None) for one in hole.intervals] == [
        (0, 25, True), (25, 1500, False), (1500, 3000, False),
    ]  # fmt: skip


SECTIONS = st.lists(
    st.builds(
        lambda top, length, inner: Section(1, "casing", float(top), float(top + length), inner, None, None),
        st.integers(0, 50), st.integers(2, 40), st.none() | st.floats(0.1, 0.5),
    ),
    min_size=1, max_size=6,
)  # fmt: skip


@given(SECTIONS, st.integers(0, 89))
def test_a_string_meets_the_narrowest_section_at_every_depth(sections: list[Section], metre: int) -> None:
    """Sections at whole metres, looked at half a metre below one; one without a diameter may be the narrowest."""
    depth = metre + 0.5
    intervals = Geometry("", "", tuple(sections), None).intervals
    here = [one for one in sections if one.top < depth < one.bottom]
    found = [one for one in intervals if one.top < depth < one.bottom]
    assert [one.bottom for one in intervals[:-1]] == [one.top for one in intervals[1:]]
    assert (intervals[0].top, intervals[-1].bottom) == (0, max(one.bottom for one in sections))
    if not here:
        assert not found or found[0].section is None
        return
    (interval,) = found
    assert interval.section is not None
    assert (interval.section.inner or 0) == min(one.inner or 0 for one in here)
