"""The chart of the page: the traces and axes of the description, packed."""

import json

import numpy as np

from fctd.app.charts import changes_of
from fctd.plots.describe import describe
from fctd.plots.loads import ChartLook
from fctd.plots.traces import layout_of, traces_of
from tests.app.made import unpacked
from tests.plots.made import chart, well


def test_the_figure_is_that_of_the_page_of_a_chart() -> None:
    case, table = well(rig={"block_weight": 3e4}), chart(["trip_out", "trip_in"], [0.2], {"diverged": "trip_in"})
    found = changes_of(table.to_dict("records"), case, "field", ChartLook())
    (_, traces), (_, layout) = found
    described = describe(table, "field", case)
    for drawn, of in zip(traces, traces_of(described), strict=True):
        if isinstance(of["x"], np.ndarray):
            np.testing.assert_allclose(unpacked(drawn["x"]), of["x"], rtol=1e-6)
            np.testing.assert_allclose(unpacked(drawn["y"]), of["y"], rtol=1e-6)
        assert drawn["name"] == of["name"]
    for name, axis in layout_of(described).items():
        if name.startswith(("xaxis", "yaxis")):
            assert layout[name]["range"] == axis["range"]
    json.dumps(found, allow_nan=False)
