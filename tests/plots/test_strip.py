"""The strip of states: where each string is buckled, and its status, over depth."""

from matplotlib.colors import to_hex

from fctd import plots
from fctd.plots.palette import BUCKLED
from fctd.plots.strip import HATCHES, STUCK
from fctd.results.status import SteadyStatus
from tests.plots.made import chart, labels_of, locked_chart, well


def test_lanes_change_half_way_between_rows() -> None:
    """Snaking from 1,200 m, a helix from 1,400 m, locked up from 1,500 m, no push from 1,800 m; rows of 50 m."""
    strip = plots.chart_figure(locked_chart(), "si", well()).axes[2]
    found = [
        (to_hex(bar.get_facecolor()), bar.get_hatch() or "", bar.get_y(), bar.get_y() + bar.get_height())
        for bar in strip.patches
    ]
    assert found == [
        ("#ffffff", "", 1000, 1175),
        (BUCKLED["sinusoidal"], "", 1175, 1375),
        (BUCKLED["helical"], "", 1375, 1475),
        (BUCKLED["helical"], HATCHES["locked_up"], 1475, 1775),
        (STUCK, "", 1775, 2000),
    ]


def test_lanes_carry_the_numbers_of_the_curves() -> None:
    figure = plots.chart_figure(chart(["trip_out", "trip_in"], [0.2], {"under_resolved": "trip_in"}))
    left, _, strip = figure.axes
    assert set(labels_of(left)) == {"picking up", "1: slacking off"}
    assert list(strip.get_xticks()) == [1]


def test_every_status_with_loads_has_a_hatch_of_its_own() -> None:
    assert set(HATCHES) == {str(status) for status in SteadyStatus if status.has_loads}
    assert len(set(HATCHES.values())) == len(HATCHES)
