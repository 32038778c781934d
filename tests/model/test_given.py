"""Tables of a new case from WITSML files: what is filled in, what is left blank, and tools in pieces."""

import math
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd import load_case
from fctd.case.errors import InputError
from fctd.case.pipes.catalogue import pipe_named
from fctd.case.string import ComponentSpec
from fctd.case.systems import System
from fctd.case.witsml.geometry import read_geometry
from fctd.case.witsml.tubular import Bend, Blades, TubularPart, read_tubular
from fctd.model.from_files import Files, with_files
from fctd.model.given.hole import GivenHole, lay_hole
from fctd.model.given.pieces import pieces_of
from fctd.model.given.string import GivenString, lay_string
from fctd.model.given.table import writer
from fctd.model.new_case import Plan, from_survey
from fctd.model.section import section_of
from fctd.model.templates import TEMPLATES
from tests.case.witsml_files import BIT, COLLAR, HOLE, PIPE, Element, component, geometry, section, tubular

DEPTH = 3000.0
STATIONS = np.array([[0.0, 0.0, 0.0], [1000.0, 0.0, 0.0], [2000.0, 0.7, 0.0], [DEPTH, 0.7, 0.0]])
POUND_FOOT = 0.45359237 / 0.3048
NC50 = {"connection": {"typeThread": "NC50"}}
MOTOR = component(
    "motor steerable", 2, 8.2, 6.75, 2.8125,
    stabilizer=[{"lenBlade": (0.6, "m"), "odBladeMx": (8.375, "in"), "distBladeBot": (0.2, "m")}],
    bend=[{"angle": (1.15, "dega"), "distBendBot": (2.0, "m")}],
)  # fmt: skip


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("witsml")


def string_of(folder: Path, *parts: Element, assembly: str = "", depth: float = DEPTH) -> GivenString:
    (folder / "s.xml").write_text(tubular(parts, assembly=assembly), encoding="utf-8")
    return lay_string(read_tubular(folder / "s.xml"), "s.xml", depth, writer("si"))


def hole_of(folder: Path, *sections: Element, bottom: float = DEPTH) -> GivenHole:
    (folder / "h.xml").write_text(geometry(sections, bottom=bottom), encoding="utf-8")
    found = read_geometry(folder / "h.xml")
    return lay_hole(found, "h.xml", TEMPLATES["build-hold"], DEPTH, writer("si"))


def tables(string: GivenString) -> list[dict[str, Any]]:
    """The components as their tables."""
    text = "\n".join("\n".join(block) for block in string.components)
    return list(tomllib.loads(text)["string"]["components"])


def plan_of(folder: Path, parts: list[Element], units: System = "si") -> Plan:
    """The plan of a string and the usual hole."""
    (folder / "s.xml").write_text(tubular(parts), encoding="utf-8")
    (folder / "h.xml").write_text(geometry(), encoding="utf-8")
    plan = from_survey("build-hold", "case", units, "the table", (), STATIONS)
    return with_files(plan, STATIONS, Files(folder / "s.xml", folder / "h.xml"))


# --- pipe of the catalogue -----------------------------------------------------------------------------------------

DRILL_PIPE = component("drill pipe", 1, 3100, 5, 4.276, grade="S-135", **NC50)


@pytest.mark.parametrize(
    ("part", "pipe"),
    [
        (DRILL_PIPE, "5 in 19.5 S-135 NC50"),
        ({**DRILL_PIPE, "grade": "s135", "connection": {"typeThread": "4 1/2 IF"}}, "5 in 19.5 S-135 NC50"),
        ({**DRILL_PIPE, "odMx": (6.625, "in"), "wtPerLen": (23.6, "lbm/ft")}, "5 in 19.5 S-135 NC50"),
        ({**DRILL_PIPE, "classService": "Premium"}, "5 in 19.5 S-135 NC50, premium"),
        ({**DRILL_PIPE, "classService": "class 2", "wtPerLen": (23.6, "lbm/ft")}, "5 in 19.5 S-135 NC50, class 2"),
        ({**COLLAR, "len": (3100, "m"), **NC50}, "6 3/4 x 2 13/16 NC50 collar"),
        (component("casing", 1, 3100, 9.625, 8.681, grade="L80"), "9 5/8 in 47 L-80 casing"),
    ],
)
def test_pipe_is_named_where_all_agrees(part: Element, pipe: str, folder: Path) -> None:
    string = string_of(folder, part)
    (table,) = tables(string)
    assert {key: table[key] for key in table if key != "name"} == {"length": table["length"], "pipe": pipe}
    assert not string.blanks
    found = ComponentSpec.model_validate(table)
    assert found.outer_diameter == pytest.approx(float(part["od"][0]) * 0.0254, abs=1e-4)


@pytest.mark.parametrize(
    "change",
    [
        {"grade": "G-105"},
        {"grade": ""},
        {"connection": {"typeThread": "NC46"}},
        {"connection": []},
        {"id": (4.27, "in")},
        {"odMx": (6.5, "in")},
        {"wtPerLen": (22.6, "lbm/ft")},
        {"classService": "class 3"},
        {"typeMaterial": "titanium"},
    ],
)
def test_pipe_is_not_named_where_something_differs(change: dict[str, Any], folder: Path) -> None:
    (table,) = tables(string_of(folder, {**DRILL_PIPE, **change}))
    assert "pipe" not in table
    assert "outer_diameter" in table


def test_pipe_of_the_same_body_is_proposed(folder: Path) -> None:
    block = "\n".join(string_of(folder, {**DRILL_PIPE, "grade": ""}).components[0])
    assert "# Or write pipe = '5 in 19.5 S-135 NC50' in place of all lines from outer_diameter on." in block
    assert pipe_named("5 in 19.5 S-135 NC50").inner == pytest.approx(4.276 * 0.0254)


# --- blanks and doubts ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("part", "key", "found"),
    [
        ({**PIPE, "len": ""}, "length", "has no len"),
        ({**PIPE, "len": (0, "m")}, "length", "len is 0"),
        ({**PIPE, "len": (200, "m")}, "length", "the string has 200 m in all, and the hole 3000 m"),
        ({**PIPE, "od": ""}, "outer_diameter", "has no od"),
        ({**PIPE, "id": (0, "in")}, "inner_diameter", "id is 0"),
        ({**PIPE, "id": (5, "in")}, "inner_diameter", "id is 127 mm, od 127 mm"),
        ({**PIPE, "od": (5, "mm")}, "outer_diameter", "od is 5 mm, thinner than any pipe: see its uom"),
        ({**PIPE, "wtPerLen": ""}, "linear_mass", "has no wtPerLen"),
        ({**PIPE, "wtPerLen": (19.5, "kg/m")}, "linear_mass", "wtPerLen is 19.5 kg/m, its body alone has 26.7"),
        ({**PIPE, "odMx": ""}, "contact_diameter", "has no odMx, and no od of a connection"),
        ({**PIPE, "odMx": (4.5, "in")}, "contact_diameter", "odMx is 114.3 mm, od 127 mm"),
        ({**PIPE, "odMx": "", "connection": {"od": (4.5, "in")}}, "contact_diameter", "od of a connection is 114.3"),
        ({**BIT, "bitRecord": {"diaBit": (8, "in")}}, "outer_diameter", "od is 215.9 mm, diaBit 203.2 mm"),
        ({**PIPE, "typeMaterial": "aluminum"}, "density", 'typeMaterial is "aluminum"'),
        (component("casing", 3, 3100, 7, 6.2, odMx=(7.656, "in")), "linear_mass", "has no wtPerLen"),
    ],
)
def test_what_is_missing_or_absurd_is_left_blank_and_named(part: Element, key: str, found: str, folder: Path) -> None:
    part = {**part, "len": part["len"] if part is PIPE or part["len"] != (2900, "m") else (3000, "m")}
    string = string_of(folder, part, depth=0.2 if part["od"] == BIT["od"] else DEPTH)
    blank = string.blanks[0]
    assert blank.key == f"string.components[0].{key}"
    assert f's.xml: component 1, "{part["typeTubularComp"]}"' in blank.found
    assert found in blank.found
    assert tables(string)[0][key] == ""


@pytest.mark.parametrize(
    ("parts", "assembly", "doubt"),
    [
        ([PIPE], "drilling", 'no component is a bit, and typeTubularAssy is "drilling": the case does not drill'),
        (
            [component("tubing", 1, 3100, 7, 6.2)], "directional drilling",
            'component 1 is "tubing" of 3100 m, and typeTubularAssy is "directional drilling": check both',
        ),
        (
            [{**PIPE, "lenJointAv": (40.1, "m"), "numJointStand": 3}], "",
            "lenJointAv 40.1 m, numJointStand 3, is that of a stand and not of a joint",
        ),
        ([{**PIPE, "wtPerLen": (19.5, "lbm/ft")}], "", "wtPerLen is the nominal weight, 19.5 lb/ft"),
        ([{**PIPE, "sequence": 1}, {**BIT, "sequence": 2}], "", "its last component is the bit"),
        ([{**PIPE, "typeTubularComp": "unknown"}], "", "is taken for a tool"),
        ([{**MOTOR, "bend": {"angle": (1.15, "dega")}}], "", "its bend of 1.15 deg is left out"),
        ([component("stabilizer", 1, 9, 6.75, 2.8125, odMx=(8.375, "in"))], "", "touches with 212.725 mm along all"),
        ([{**PIPE, "sequence": 1, "len": (9000, "m")}, {**PIPE, "sequence": 2}], "", "have 9000 m, and the hole"),
    ],
)  # fmt: skip
def test_what_is_doubtful_is_named(parts: list[Element], assembly: str, doubt: str, folder: Path) -> None:
    assert any(doubt in one for one in string_of(folder, *parts, assembly=assembly).doubts)


@pytest.mark.parametrize(
    ("sections", "keys", "found"),
    [
        ([section("open hole", 0, 3000, "")], ["diameter"], "section 1, idSection is missing, from 0 m to 3000 m"),
        ([section("casing", 0, 3000, 10, odSection=(9.625, "in"))], ["diameter"], "is 254 mm, and odSection 244.475"),
        ([section("open hole", 0, 3000, 0.5)], ["diameter"], "is 12.7 mm, which no hole has"),
        ([section("casing", 40, 3000, 8.681)], ["kind", "diameter"], "has no section, from 0 m to 40 m"),
        ([section("unknown", 0, 3000, 8.5)], ["kind"], 'section 1 has no typeHoleCasing or "unknown"'),
        (
            [section("casing", 0, 1500, 8.535), section("open hole", 1500, 3000, 7)], ["diameter"],
            "section 2, idSection is 177.8 mm, the outer diameter of 7 in pipe, and the hole has 216.789 mm above it",
        ),
    ],
)  # fmt: skip
def test_a_hole_without_its_diameter_is_left_blank(
    sections: list[Element], keys: list[str], found: str, folder: Path
) -> None:
    hole = hole_of(folder, *sections)
    assert [blank.key.split(".")[-1] for blank in hole.blanks] == keys
    assert found in hole.blanks[0].found


def test_a_friction_factor_of_0_is_none(folder: Path) -> None:
    hole = hole_of(
        folder, section("casing", 0, 1500, 8.681, factFric=0), section("open hole", 1500, 3000, 8.5, factFric=0.4)
    )
    lines = [next(line for line in block if line.startswith("friction")) for block in hole.intervals]
    assert lines[0].split() == ["friction", "=", "0.20", "#", "assumed,", "factFric", "is", "0"]
    assert lines[1] == "friction = 0.4"


def test_a_long_description_is_cut(folder: Path) -> None:
    (table,) = tables(string_of(folder, {**DRILL_PIPE, "description": "of the rig's own stock " * 50}))
    assert table["name"].startswith("drill pipe: of the rig's own")
    assert len(table["name"]) <= 80


def test_a_slim_hole_is_one(folder: Path) -> None:
    """Of 6 1/8 in, or of 7 in where the casing has room for no more."""
    for bore, inner in ((8.681, 6.125), (7.025, 7)):
        sections = section("casing", 0, 1500, bore), section("open hole", 1500, 3000, inner)
        assert not hole_of(folder, *sections).blanks


@pytest.mark.parametrize(
    ("sections", "bottom", "doubt"),
    [
        ([section("casing", 0, 2000, 8.681)], 2000, "its sections end at 2000 m, the survey at 3000 m"),
        (HOLE, 3100, "its sections end at 3000 m, and its mdBottom is 3100 m"),
        ([*HOLE, section("liner", 1400, 2000, 6.2)], 3000, "from 1400 m to 1500 m it also has section 2"),
    ],
)
def test_a_doubtful_hole_is_named(sections: list[Element], bottom: float, doubt: str, folder: Path) -> None:
    assert any(one.startswith(doubt) for one in hole_of(folder, *sections, bottom=bottom).doubts)


def test_the_numbers_of_the_lines_are_those_of_the_blanks(folder: Path) -> None:
    plan = plan_of(folder, [{**PIPE, "odMx": "", "wtPerLen": "", "description": 'x = ""'}])
    lines = plan.text().splitlines()
    assert [lines[number - 1].split(" ")[0] for number, _ in plan.blanks] == [
        "length", "linear_mass", "contact_diameter",
    ]  # fmt: skip
    assert all(blank.key.endswith(lines[number - 1].split(" ")[0]) for number, blank in plan.blanks)
    assert max(map(len, lines)) <= 110


# --- tools in pieces -----------------------------------------------------------------------------------------------


def test_a_motor_touches_with_its_sleeve_and_is_bent_where_it_is(folder: Path) -> None:
    motor = tables(string_of(folder, MOTOR, depth=8.0))
    assert [table["length"] for table in motor] == ["0.2 m", "0.6 m", "1.2 m", "6.2 m"]
    assert [table.get("contact_diameter") for table in motor] == [None, "212.725 mm", None, None]
    assert [table.get("bend") for table in motor] == [None, None, "1.15 deg", None]
    assert motor[1]["name"] == "motor steerable: piece 2"


def test_a_short_stabiliser_is_one_piece(folder: Path) -> None:
    blades = {"lenBlade": (0.4, "m"), "odBladeMx": (8.375, "in"), "distBladeBot": (0.5, "m")}
    (table,) = tables(string_of(folder, component("stabilizer", 1, 1.5, 6.75, 2.8125, stabilizer=blades), depth=1.5))
    assert table["contact_diameter"] == "212.725 mm"


@given(
    st.lists(st.tuples(st.floats(0.0, 9.0), st.floats(0.05, 1.0)), max_size=3),
    st.lists(st.floats(0.05, 10.0), max_size=2),
    st.floats(9.5, 10.0),
)
def test_pieces_are_as_long_as_the_tool_and_keep_blades_and_bends(
    blades: list[tuple[float, float]], bends: list[float], length: float
) -> None:
    tool = TubularPart(
        1, "motor", None, "", length, 0.17, 0.07, None, None, None, None, None, "", "", frozenset(), "", None, None,
        tuple(Bend(0.02, at) for at in bends), tuple(Blades(0.2, *one) for one in blades), (), None,
    )  # fmt: skip
    pieces = pieces_of(tool)
    assert math.fsum(piece.length or 0 for piece in pieces) == pytest.approx(length, rel=1e-12)
    assert all((piece.length or 0) > 0 for piece in pieces)
    if len(pieces) > 1:
        bladed = math.fsum(piece.length or 0 for piece in pieces if piece.blades)
        covered = np.zeros(100_000, dtype=bool)
        for bottom, long in blades:
            covered[round(bottom * 1e4) : round((bottom + long) * 1e4)] = True
        assert bladed == pytest.approx(covered.sum() * 1e-4, abs=0.05)
        assert sum(len(piece.bends) for piece in pieces) >= len({round(at, 1) for at in bends}) - 1


# --- a string and its case -----------------------------------------------------------------------------------------


@st.composite
def strings(draw: st.DrawFn) -> list[Element]:
    """Components that lack nothing, from the bit up, the uppermost long enough."""
    count = draw(st.integers(1, 5))
    parts: list[Element] = []
    for k in range(count):
        kind = draw(
            st.sampled_from(["drill pipe", "heavy weight drill pipe", "drill collar", "jar", "casing", "motor"])
        )
        outer = draw(st.floats(3.0, 7.0))
        inner = outer * draw(st.floats(0.2, 0.85))
        body = 0.25 * math.pi * (outer**2 - inner**2) * 0.0254**2 * 7850
        length = draw(st.floats(0.5, 300.0)) if k < count - 1 else draw(st.floats(3000.0, 5000.0))
        of_length = draw(st.sampled_from([("m", 1.0), ("ft", 0.3048)]))
        of_size = draw(st.sampled_from([("in", 1.0), ("mm", 25.4), ("m", 0.0254)]))
        of_mass = draw(st.sampled_from([("kg/m", 1.0), ("lbm/ft", 1 / POUND_FOOT)]))
        parts.append({
            "typeTubularComp": kind, "sequence": k + 1,
            "description": draw(st.text(max_size=9).filter(str.isprintable)),
            "id": (repr(inner * of_size[1]), of_size[0]), "od": (repr(outer * of_size[1]), of_size[0]),
            "odMx": (repr(outer * draw(st.floats(1.0, 1.15)) * of_size[1]), of_size[0]),
            "len": (repr(length / of_length[1]), of_length[0]),
            "wtPerLen": (repr(body * draw(st.floats(0.9, 1.4)) * of_mass[1]), of_mass[0]),
        })  # fmt: skip
    return draw(st.permutations(parts))


@settings(max_examples=60)
@given(strings(), st.sampled_from(["si", "field"]))
def test_any_whole_string_is_that_of_its_case(folder_of_all: Path, parts: list[Element], units: System) -> None:
    """Lengths, diameters and mass, whatever the units of the file and of the case."""
    plan = plan_of(folder_of_all, parts, units)
    assert plan.blanks == []
    raw = tomllib.loads(plan.text())
    raw["wellbore"] |= {"survey": None, "stations": (STATIONS * [1, 180 / np.pi, 1]).tolist()}
    case = load_case(raw)
    read = read_tubular(folder_of_all / "s.xml").parts
    assert len(case.string.components) == len(read)
    for found, part in zip(case.string.components, read, strict=True):
        assert found.length == pytest.approx(part.length, rel=1e-8)
        assert found.outer_diameter == pytest.approx(part.outer, rel=1e-8)
        assert found.inner_diameter == pytest.approx(part.inner, rel=1e-8)
        assert found.contact_diameter == pytest.approx(part.touching, rel=1e-8)
        assert section_of(found, 0.0).mass == pytest.approx(part.mass, rel=1e-8)


@pytest.fixture(scope="module")
def folder_of_all(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One folder for all examples of Hypothesis."""
    return tmp_path_factory.mktemp("any")


def spoilt(value: Any) -> st.SearchStrategy[Any]:
    """An element as it is, or absent, empty, null, 0, or tiny or huge for what it is."""
    if not isinstance(value, tuple):
        return st.just(value)
    number, unit = value
    wrong = ["", ("", unit), ("-999.25", unit), (0, unit), (0.011 * float(number), unit), (1.3 * float(number), unit)]
    return st.sampled_from([value, value, value, *wrong])


@st.composite
def spoilt_strings(draw: st.DrawFn) -> list[Element]:
    """Strings of which elements are missing or absurd."""
    parts = [BIT, MOTOR, COLLAR, PIPE, DRILL_PIPE, component("casing", 5, 900, 9.625, 8.681, grade="L80")]
    found = [
        {key: draw(spoilt(value)) for key, value in part.items()} | {"sequence": k + 1}
        for k, part in enumerate(draw(st.lists(st.sampled_from(parts), min_size=1, max_size=4)))
    ]
    return [part | {"description": draw(st.sampled_from(["", 'a "b" \\', "x\u0085y"]))} for part in found]


@st.composite
def spoilt_holes(draw: st.DrawFn) -> list[Element]:
    """Holes with gaps, overlaps, and diameters that are missing or absurd."""
    found = []
    for _ in range(draw(st.integers(1, 4))):
        top = draw(st.integers(0, 2000))
        kind = draw(st.sampled_from(["casing", "open hole", "unknown", "riser"]))
        inner = draw(st.sampled_from(["", 0, 0.5, 7, 8.5, 12.25, 99]))
        found.append(section(kind, top, top + draw(st.integers(1, 1500)), inner, odSection=(9.625, "in")))
    return found


@pytest.mark.slow
@settings(max_examples=100)
@given(spoilt_strings(), spoilt_holes(), st.sampled_from(["si", "field"]))
def test_a_case_lacks_what_it_says_and_nothing_else(
    folder_of_all: Path, parts: list[Element], sections: list[Element], units: System
) -> None:
    (folder_of_all / "s.xml").write_text(tubular(parts), encoding="utf-8")
    (folder_of_all / "h.xml").write_text(geometry(sections), encoding="utf-8")
    plan = from_survey("build-hold", "case", units, "the table", (), STATIONS)
    plan = with_files(plan, STATIONS, Files(folder_of_all / "s.xml", folder_of_all / "h.xml"))
    raw = tomllib.loads(plan.text())
    raw["wellbore"] |= {"survey": None, "stations": (STATIONS * [1, 180 / np.pi, 1]).tolist()}
    lacking = {blank.key for _, blank in plan.blanks}
    assert len(lacking) == len(plan.given.blanks)
    try:
        load_case(raw)
    except InputError as error:
        assert {one.key for one in (error, *error.more)} == lacking  # noqa: PT017 (most lack something)
    else:
        assert lacking == set()
