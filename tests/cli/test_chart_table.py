"""A chart on the screen: how many rows it shows, and lines for runs of rows."""

from typing import Any

import pytest

from fctd.cli.chart_table import SCREEN_ROWS, print_chart
from fctd.steady.torque_drag import chart_rows
from tests.cases import make_case, pipe


def rows(**changes: Any) -> list[dict[str, Any]]:
    case = make_case([[0, 0, 0], [400, 0, 0], [850, 90, 0], [1200, 90, 0]], [pipe(None, None, segment_length=25.0)])
    found = chart_rows(case, ["trip_in"], [600.0 + 10 * k for k in range(60)])
    return [row | changes if k in (10, 11, 30) else row for k, row in enumerate(found)]


def test_runs_of_rows_have_a_line_each(capsys: pytest.CaptureFixture[str]) -> None:
    print_chart(rows(status="max_iterations", reason="no steady shape"), "si", "string")
    seen = capsys.readouterr()
    assert "trip_in: max_iterations at 700 to 710 m (2 of 60): no steady shape" in seen.err
    assert "trip_in: max_iterations at 900 m (1 of 60)" in seen.err
    assert (
        f"60 rows: 57 converged, 3 max_iterations; {SCREEN_ROWS} of them above, all of them in a file by --out"
        in seen.out
    )


def test_notes_come_with_their_remedy(capsys: pytest.CaptureFixture[str]) -> None:
    print_chart(rows(notes="yield"), "field", "string")
    line = next(line for line in capsys.readouterr().err.splitlines() if "note yield at 2296.59 to" in line)
    assert "yield strength" in line


def test_the_load_is_named_and_has_the_block_where_that_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    of = rows(weight_indicator_N=123456.0)[30:31]
    for load, heading, value in (("string", "hook load", of[0]["hookload_N"]), ("indicator", "indicator", 123456.0)):
        print_chart(of, "si", load)  # type: ignore[arg-type]
        seen = capsys.readouterr().out
        assert heading in seen
        assert f" {value / 1e3:.1f} " in seen
        assert ("block included" in seen) == (load == "indicator")
