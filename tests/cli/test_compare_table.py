"""Charts of several cases on the screen: which depths and torques, and marks of what is not converged."""

import pytest

from fctd.answers.comparison import compare
from fctd.answers.steady import chart
from fctd.cli.compare_table import SCREEN_ROWS, print_comparison
from tests.cases import make_case, pipe

STATIONS = [[0.0, 0, 0], [400, 0, 0], [850, 90, 0], [1200, 90, 0]]


def test_depths_that_all_share_and_the_deepest_of_each(capsys: pytest.CaptureFixture[str]) -> None:
    case = make_case(STATIONS, [pipe(None, None, segment_length=25.0)])
    ranges = [[500.0 + 10 * k for k in range(60)], [505.0, 600.0, 700.0, 800.0]]
    print_comparison(compare([chart(case, "trip_in", of) for of in ranges]), "si", "string")
    seen = capsys.readouterr().out
    loads, torque = seen.partition("test 1: ")[0], "surface torque"
    rows = [line.split() for line in loads.splitlines() if line.strip()[:1].isdigit() or "trip_in" in line]
    assert [row[-3] if len(row) > 2 else row[0] for row in rows] == ["600.0", "700.0", "800.0", "1090.0"]
    assert len(rows) <= SCREEN_ROWS
    assert torque not in seen  # of a string that slides
    assert "test 2: 4 rows: 4 converged" in seen


def test_a_row_that_is_not_converged_has_a_star_and_its_line(capsys: pytest.CaptureFixture[str]) -> None:
    cases = [make_case(STATIONS, [pipe(None, None, segment_length=25.0)]) for _ in range(2)]
    charts = [chart(case, ["trip_in", "rotate_off_bottom"], [900.0, 1000.0], friction=[0.1, 0.2]) for case in cases]
    charts[1].rows.loc[1, ["status", "reason"]] = ["unstable", "it turns over"]
    print_comparison(compare(charts), "field", "string")
    seen = capsys.readouterr()
    assert seen.out.count("*") == 2  # the row, and what the star says
    assert "surface torque, kft·lbf" in seen.out
    assert "test 2, trip_in, friction 0.1: unstable at 3280.84 ft (1 of 2): it turns over" in seen.err
