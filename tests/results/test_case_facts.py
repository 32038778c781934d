"""Facts of a case, a row each, in both systems of units."""

from fctd.case.load import load_case
from fctd.model.summary import summarise
from fctd.results.case_facts import fitting_facts, flow_curves, load_facts, path_facts, string_table
from fctd.results.shown_tables import Table
from tests.cases import make_case, pipe


def texts(table: Table) -> list[list[str]]:
    return [[cell.text for cell in row] for row in table.rows]


def test_path_and_loads() -> None:
    summary = summarise(make_case([[0, 0, 0], [300, 0, 0], [600, 30, 0]], mud={"density": 1200.0}))
    assert texts(path_facts(summary, "si"))[0] == ["total depth, measured", "600.0", "m (3 stations)"]
    assert texts(path_facts(summary, "field"))[4] == ["greatest dog-leg", "3.05", "°/100 ft from 984 to 1969 ft"]
    assert texts(load_facts(summary, "field"))[0] == ["mud density", "10.01", "ppg"]


def test_fittings_and_swivels() -> None:
    fitted = pipe(400, None, centralisers={"every": 12, "diameter": "8 in"})
    case = make_case(components=[{**fitted, "name": "a\n"}, {**pipe(None, 20), "name": "b"}])
    assert texts(fitting_facts(case, "si")) == [["centralisers", "203.2", "mm, every 12 m of a\\n"]]


def test_flow_curves() -> None:
    (curve, rule) = texts(flow_curves(load_case("examples/pumped_well.toml").mud, "si"))
    assert curve == ["flow curve of the mud", "2.04", "Pa yield stress, consistency 0.345 Pa·sⁿ, index 0.637"]
    assert rule[:2] == ["by RP 13D's rule", "-1.0"]


def test_a_string_too_short_for_its_hole_says_where_the_bit_is() -> None:
    whole, short = (summarise(make_case(components=[pipe(length, 20)])) for length in (1000, 800))
    assert string_table(whole, "si").heads[0].words == "string, the bit at the bottom"
    assert string_table(short, "field").heads[0].words == "string, the bit at 2624.7 ft"
