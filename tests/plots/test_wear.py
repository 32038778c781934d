"""The picture of casing wear: its panels, and one curve where both wear factors are one."""

import pandas as pd
import pytest

from fctd.plots.wear import wear_panels
from tests.cases import make_case

ROWS = pd.DataFrame(
    {
        "casing": ["upper", "upper", "lower"], "md_m": [100.0, 200.0, 300.0], "side_force_N": [0.0, 1e3, 2e3],
        "low_groove_m": [0.0, 1e-4, 2e-4], "high_groove_m": [0.0, 5e-4, 1e-3], "burst_Pa": [4e7, 4e7, 5e7],
        "low_burst_Pa": [4e7, 3.8e7, 4.5e7], "high_burst_Pa": [4e7, 3.9e7, 4.9e7],
    }
)  # fmt: skip


@pytest.mark.parametrize("units", ["si", "field"])
def test_the_panels_have_their_units(units: str) -> None:
    of = wear_panels(make_case(), ROWS, units)  # type: ignore[arg-type]  # one of both
    labels = [panel.label.split(", ")[-1] for panel in of.panels]
    assert labels == (["kN", "mm", "bar"] if units == "si" else ["klbf", "in", "psi"])
    groove = of.panels[1].curves
    assert [curve.name for curve in groove] == ["lowest wear factor"] * 2 + ["highest wear factor"] * 2
    assert groove[2].value[-1] == pytest.approx(0.5 if units == "si" else 0.5 / 25.4)
    assert of.depth == f"measured depth, {'m' if units == 'si' else 'ft'}"


def test_of_one_wear_factor_there_is_one_curve() -> None:
    same = ROWS.assign(low_groove_m=ROWS["high_groove_m"])
    names = {curve.name for panel in wear_panels(make_case(), same, "si").panels for curve in panel.curves}
    assert names == {"side force", "highest wear factor", "new"}
