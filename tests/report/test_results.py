"""Sections of results: their numbers are those of the answers, in the units asked for."""

from collections.abc import Callable

import pytest

from fctd.case.load import load_case
from fctd.plots.loads import ChartLook
from fctd.report import results
from fctd.report.answers import Answers, Asked, answer
from fctd.report.parts import Picture, Report, Text
from fctd.results.columns import LOADS
from fctd.results.shown_tables import NONE, Table
from fctd.results.unit_systems import System, shown
from tests.report.conftest import KINDS, WELL


def tables(report: Report, section: str) -> dict[str, Table]:
    (found,) = (one for one in report.sections if one.title == section)
    return {part.title: part for part in found.parts if isinstance(part, Table)}


def column(table: Table, head: str) -> list[float | None]:
    return [row[[*map(str, table.heads)].index(head)].number for row in table.rows]


@pytest.mark.parametrize(("units", "force", "depth"), [("si", "kN", "m"), ("field", "klbf", "ft")])
def test_numbers_are_those_of_the_answers(
    units: System, force: str, depth: str, answers: Answers, made: Callable[[System], Report]
) -> None:
    kilo, metre = shown("hookload_N", units).factor, shown("bit_depth_m", units).factor
    chart = tables(made(units), "Torque and drag")["Loads over bit depth"]
    for name, of, factor in (("hook load", "hookload_N", kilo), ("weight indicator", "weight_indicator_N", kilo)):
        assert column(chart, f"{name} ({force})") == pytest.approx(answers.chart[of].to_numpy() * factor)
    assert column(chart, f"bit depth ({depth})") == pytest.approx(answers.chart["bit_depth_m"].to_numpy() * metre)
    assert answers.margins is not None
    pulled = answers.margins[answers.margins["margin"] == "overpull"]
    table = tables(made(units), "Margins")["Pull on a stuck bit"]
    assert column(table, f"left ({force})") == pytest.approx(pulled["hookload_left_N"].to_numpy() * kilo)
    loads = next(iter(tables(made(units), "Profiles").values()))
    for k, load in enumerate(LOADS):
        expected = [load.value(point) * shown(load.name, units).factor for point in answers.points]
        assert [cell.number for cell in loads.rows[k][2:]] == pytest.approx(expected)
    profile = tables(made(units), "Profiles in numbers")["Profile, picking up"]
    expected = answers.points[0].profile["effective_tension_N"].to_numpy() * kilo
    assert column(profile, f"effective tension ({force})") == pytest.approx(expected)


def test_a_picture_names_its_limits_and_the_table_has_them(answers: Answers) -> None:
    section = results.loads(answers, ChartLook(margins=answers.lines), "si")
    captions = [part.caption for part in section.parts if isinstance(part, Picture)]
    assert captions == ["Loads over bit depth with limits"]


def test_rows_that_are_not_converged_are_notes_with_their_depths_and_remedies() -> None:
    case = load_case(WELL, {"friction": 0.9, "rig.block_weight": "0 N", "rig.hoist_capacity": "300 kN"})
    found = answer(case, Asked(KINDS, [800.0, 900.0, 1000.0], limits=False))
    (table,) = results.notes(found, "field").parts
    assert isinstance(table, Table)
    rows = [[cell.text for cell in row] for row in table.rows]
    (hoist,) = (row for row in rows if row[2] == "hoist")
    assert hoist[0] == "picking up"
    assert hoist[3] == "2625 to 3281 (3 of 3)"
    assert "the hoist cannot lift the string: lower friction" in hoist[4]
    assert results.notes(answer(load_case(WELL), Asked(["trip_in"], [500.0], limits=False)), "si").parts == (
        Text("All rows are converged, and none has a note."),
    )


def test_mud_that_is_not_computed_is_a_note() -> None:
    found = answer(load_case(WELL, {"mud.fann": None}), Asked(["trip_in"], [500.0], limits=False))
    (table,) = results.notes(found, "si").parts
    assert isinstance(table, Table)
    assert [cell.text for cell in table.rows[0]][:4] == ["hydraulics", NONE, "not computed", NONE]
