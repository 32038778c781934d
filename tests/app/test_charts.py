"""The chart of the page: a place for every trace, texts that are no HTML, axes that show the loads."""

import numpy as np

from fctd.app import charts
from fctd.case.operations import KINDS
from tests.app.test_well import of, unpacked
from tests.view.made import case

ROW = {
    "operation": "trip_in", "bit_depth_m": 500.0, "hookload_N": 1e5, "surface_torque_N_m": 0.0, "status": "converged",
    "buckling": "none", "reason": "none",
}  # fmt: skip


def test_every_trace_has_its_place() -> None:
    data = charts.skeleton(case(), [400.0, 800.0], "field")["data"]
    places = {
        **{charts.place_of(name, column): name for name in charts.ALL for column in charts.COLUMNS},
        **{charts.place_of("line", column, kind): KINDS[kind].label for kind in KINDS for column in charts.COLUMNS},
        **{
            charts.place_of("measured", column, kind): f"measured, {KINDS[kind].label}"
            for kind in KINDS
            for column in charts.COLUMNS
        },
        **{charts.place_of("limit", column, kind): KINDS[kind].label for kind in KINDS for column in charts.COLUMNS},
    }
    assert places == {k: trace["name"] for k, trace in enumerate(data)}


def test_reasons_are_text_and_rows_without_loads_stand_at_the_edge() -> None:
    reason = "<a href='https://example.org'>x</a> $x$ " + "y" * 500
    lost = ROW | {"hookload_N": np.nan, "surface_torque_N_m": np.nan, "status": "max_iterations", "reason": reason}
    buckled = ROW | {"buckling": "helical", "bit_depth_m": 600.0, "hookload_N": 1.2e5}
    found = charts.changes_of([ROW, buckled, lost], ["trip_in"], case(), "si", None)
    k = charts.place_of("no loads", "hookload_N")
    (text,) = of(found, "data", k, "text")
    assert "<a" not in text
    assert "$" not in text
    assert "&lt;a href=" in text
    assert len(text) < 300
    low, high = of(found, "layout", "xaxis", "range")
    assert low < 100 < 120 < high
    assert low < unpacked(of(found, "data", k, "x"))[0] < low + 0.05 * (high - low)
    assert of(found, "data", charts.place_of("buckled", "hookload_N"), "marker", "color") == [charts.BUCKLED["helical"]]
    assert of(found, "data", charts.place_of("line", "hookload_N", "trip_in"), "showlegend")
    assert not of(found, "data", charts.place_of("line", "hookload_N", "trip_out"), "showlegend")


def test_axes_without_loads_and_with_one_load_have_a_length() -> None:
    lost = ROW | {"hookload_N": np.nan, "surface_torque_N_m": np.nan}
    for rows in ([lost], [ROW]):
        found = charts.changes_of(rows, ["trip_in"], case(), "si", None)
        for axis in ("xaxis", "xaxis2"):
            low, high = of(found, "layout", axis, "range")
            assert high - low > 1e-3
