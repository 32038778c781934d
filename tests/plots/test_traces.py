"""Traces: what plotly draws is what the description says, and texts from outside are no HTML."""

import numpy as np
import pandas as pd

from fctd.plots.describe import describe
from fctd.plots.loads import ChartLook
from fctd.plots.palette import LOOKS
from fctd.plots.traces import LONGEST, Trace, layout_of, traces_of
from tests.plots.made import DEPTHS, chart, locked_chart, well

CASE = well(rig={"block_weight": 3e4})
THREE = ["trip_out", "rotate_off_bottom", "trip_in"]


def lines(traces: list[Trace]) -> list[Trace]:
    """The curves among the traces."""
    return [trace for trace in traces if trace["mode"] == "lines+markers" and trace["x"][0] is not None]


def test_curves_axes_and_spans_are_those_of_the_description() -> None:
    table = locked_chart()
    described = describe(table, "field", CASE, ChartLook("string"))
    layout = layout_of(described)
    panels = described.groups[0].panels
    for k, panel, trace in zip(("", "2"), panels, lines(traces_of(described)), strict=True):
        assert layout[f"xaxis{k}"]["range"] == [panel.limits.low, panel.limits.high]
        assert layout[f"xaxis{k}"]["title"]["text"] == panel.label
        assert layout[f"yaxis{k}"]["range"] == [described.depth.lower, described.depth.upper]
        np.testing.assert_array_equal(trace["x"], panel.curves[0].line)
        np.testing.assert_array_equal(trace["y"], panel.curves[0].depth)
    assert {"slack-off is spent", "shoe 4921 ft"} == {note["text"] for note in layout["annotations"]}
    (span,) = [shape for shape in layout["shapes"] if shape["type"] == "rect"]
    assert (span["x0"], span["x1"]) == (panels[0].limits.low, panels[0].spent)


def test_rows_beyond_the_axis_and_those_that_no_push_moves_stand_at_its_edge() -> None:
    described = describe(locked_chart(), "si", CASE, ChartLook("string"))
    by_name = {(trace["name"], trace.get("xaxis")): trace for trace in traces_of(described)}
    low = described.groups[0].panels[0].limits.low
    cut, stuck = by_name["beyond the axis", "x"], by_name["no push suffices", "x"]
    assert (set(cut["x"]), list(cut["y"]), set(cut["customdata"])) == ({low}, [1650.0, 1700.0, 1750.0], {-5e4})
    assert (set(stuck["x"]), len(stuck["y"])) == ({low}, 5)
    assert {("sinusoidal buckling", "x"), ("helical buckling", "x")} < set(by_name)


def test_the_legend_has_operations_and_factors_once() -> None:
    described = describe(chart(THREE, [0.1, 0.2, 0.3]))
    named = [trace["name"] for trace in traces_of(described) if trace.get("showlegend", True)]
    assert named == ["picking up", "rotating off bottom", "slacking off", "μ 0.1", "μ 0.2", "μ 0.3"]
    curves = lines(traces_of(described))
    assert {trace["legendgroup"] for trace in curves} == set(named[:3])
    assert len({(trace["line"]["color"], trace["line"]["dash"]) for trace in curves}) == 9


def test_every_row_is_a_point_and_few_have_markers() -> None:
    table = chart(["trip_in"], [0.2], {"under_resolved": "trip_in"})
    line, _ = lines(traces_of(describe(table)))
    assert len(line["x"]) == len(DEPTHS)
    flagged = table["status"] == "under_resolved"
    seen = np.array(line["marker"]["color"]) == LOOKS["trip_in"][0]
    assert seen[flagged].all()
    assert {*seen[~flagged]} == {True, False}


def test_reasons_are_texts_of_a_bounded_length() -> None:
    table = chart(["trip_in", "trip_out"], [0.2], {"diverged": "trip_in"})
    table.loc[table["status"] == "diverged", "reason"] = "deep in the wall <script> $x$ " + "y" * 500
    lost = next(trace for trace in traces_of(describe(table)) if trace["name"] == "no loads")
    assert list(lost["y"]) == list(table.loc[table["hookload_N"].isna(), "bit_depth_m"])
    (text,) = set(lost["text"])
    assert text.replace("<br>", "").startswith("diverged: deep in the wall &lt;script&gt; &#36;x&#36; yyy")
    assert len(text.replace("<br>", "")) < 1.2 * LONGEST


def test_measured_points_have_their_ranges() -> None:
    values = {"hookload_N": 3e5, "hookload_low_N": 2e5, "hookload_high_N": 5e5}
    torques = {f"surface_torque{end}_N_m": [np.nan] for end in ("", "_low", "_high")}
    place = {"operation": ["trip_in"], "bit_depth_m": [1500.0]}
    measured = pd.DataFrame(place | {name: [value] for name, value in values.items()} | torques)
    found = traces_of(describe(chart(["trip_out", "trip_in"], [0.2]), look=ChartLook(measured=measured)))
    (point,) = [trace for trace in found if trace["name"] == "measured, slacking off"]
    assert point["showlegend"]
    ends = [point["error_x"][side].tolist() for side in ("array", "arrayminus")]
    assert (point["x"].tolist(), *ends) == ([300.0], [200.0], [100.0])
