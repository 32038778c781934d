"""Pictures of flow: their curves are the columns of the tables in the units of the axes."""

from functools import cache
from pathlib import Path

import pandas as pd
import pytest

from fctd.case.load import Case, load_case
from fctd.hydraulics.pressures import circulation, hydraulics_of
from fctd.hydraulics.surge import fastest_trips, surge_pressures
from fctd.plots.flow import losses_panels, surge_panels

ROOT = Path(__file__).parents[2]

DEPTHS = [1000.0, 2000.0, 3000.0]


@cache
def case() -> Case:
    return load_case(ROOT / "examples" / "pumped_well.toml")


def test_losses_over_depths() -> None:
    table = hydraulics_of(case(), [0.02, 0.03], DEPTHS)
    panels = losses_panels(table, circulation(case(), 0.03, 3000.0), "si")
    slow, fast = (curve for curve in panels.panels[0].curves if curve.name == "standpipe")
    first = table[table["flow_m3_s"] == 0.02]
    assert slow.value == pytest.approx(first["standpipe_Pa"].to_numpy() / 1e5)
    assert slow.depth.tolist() == DEPTHS
    dashes = {curve.name: curve.dash for curve in panels.panels[1].curves if not len(curve.depth)}
    assert dashes == {"1200 L/min": slow.dash, "1800 L/min": fast.dash}
    assert slow.dash != fast.dash
    assert {"pore", "fracture"} < {curve.name for curve in panels.panels[1].curves}


def test_losses_along_the_string_at_one_depth() -> None:
    """From the standpipe less the surface lines to what is lost in the annulus."""
    one = circulation(case(), 0.03, 3000.0)
    panels = losses_panels(pd.DataFrame([one.summary()]), one, "field")
    inside, outside = panels.panels[0].curves
    assert inside.value[0] == pytest.approx((one.standpipe - one.surface) / 6894.757, rel=1e-6)
    assert inside.value[-1] - outside.value[-1] == pytest.approx(one.circuit.bit_drop / 6894.757, rel=1e-6)
    assert panels.depth == "measured depth, ft"


def test_surges_and_fastest_trips() -> None:
    surges = surge_pressures(case(), [0.5], DEPTHS, "trip_in", ["open", "closed"])
    fastest = fastest_trips(case(), DEPTHS, "trip_in", ["open", "closed"])
    surge, fast = surge_panels(case(), surges, fastest, "si").panels
    assert [curve.name for curve in surge.curves] == ["trip_in, open end, 0.5 m/s", "trip_in, closed end, 0.5 m/s"]
    closed = surges[surges["end"] == "closed"]["surge_Pa"].to_numpy() / 1e5
    assert surge.curves[1].value == pytest.approx(closed)
    assert fast.curves[0].value.tolist() == fastest[fastest["end"] == "open"]["fastest_m_s"].tolist()
    assert len(surge_panels(case(), surges, None, "si").panels) == 1
