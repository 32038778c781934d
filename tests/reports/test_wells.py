"""The page of measured wells: every judged reading, and what has not been run."""

from dataclasses import replace

import numpy as np
import pytest

from reports.figures import volve_f4
from tests.reports import synthetic
from tests.reports.pages import BLANK, finished, missing, words_of


def page(tmp_path):
    return words_of((tmp_path / "out" / "wells.html").read_text(encoding="utf-8"))


@pytest.mark.slow
def test_readings_are_judged_by_well_and_a_well_without_torques_is_named(render, tmp_path):
    """They have their range, their bands, and in or out."""
    run, tables = finished("volve_f4")
    weights = {name: table.assign(well="S-well") for name, table in tables.items() if name in {"widths"}}
    weights |= {name: tables[name].query("unit == 'kN'").assign(well="S-well") for name in ("judged", "scores")}
    other = replace(BLANK, study="s_well_onshore", tables=tuple(weights))
    _, problems = render((run, tables), (other, weights), studies=["volve_f4", "s_well_onshore"])
    text = page(tmp_path)
    assert [problem for problem in problems if problem.startswith("volve_f4")] == []
    assert not missing(
        text,
        "Volve F-4, split A",
        "F4-07 weight up kN 1460 1420 to 1480: in 1421 to 1481: in 1422 to 1482: in",
        "F4-06 torque kN·m 6.5 to 7.5 13.0 to 25.0: out",
        "of the two strings the stiff one is better",
        "1 (0.5 to 1)",
        "F4-06 Volve F-4, split A 6.5 to 7.5 19 164 no no",
        "An onshore S-well has no recorded torque.",
    )
    assert (tmp_path / "out" / "figures" / "volve_f4-judged.svg").exists()


def test_the_chart_of_a_well_has_its_torques_and_each_reading_in_the_middle_of_its_range():
    tables = synthetic.STUDIES["volve_f4"]()
    torque, weight = volve_f4.chart(tables).axes
    curve, *markers = (line.get_xdata() for line in torque.lines)
    np.testing.assert_allclose(curve, np.arange(1.5, 8.0, 0.6))
    assert np.concatenate(markers).tolist() == [7.5]
    assert {1225.0, 1500.0} <= {x for line in weight.lines for x in line.get_xdata()}


def test_a_study_that_has_not_been_run_is_named_with_its_command(render, tmp_path):
    skipped = replace(BLANK, study="s_well_onshore", status="skipped", message="the public data folder is missing")
    render((skipped, {}), studies=["volve_f4"])
    text = page(tmp_path)
    assert not missing(
        text,
        "The study volve_f4 has not been run: python -m validation volve_f4.",
        "The study forge_16a has not been run: python -m validation forge_16a.",
        "The study s_well_onshore was skipped: the public data folder is missing.",
    )
