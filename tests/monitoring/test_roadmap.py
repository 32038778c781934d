"""The roadmap: readings of a known friction lie on the curve of that factor, and those outside are told."""

from functools import cache

import numpy as np
import pandas as pd
import pytest

from fctd import equilibrium, load_case, torque_drag
from fctd.case.friction import FrictionSet
from fctd.model.operations import weight_indicator
from fctd.monitoring.friction import Apparent
from fctd.monitoring.monitor import Monitor
from fctd.monitoring.roadmap import FAN, LOADS, Roadmap, roadmap
from fctd.monitoring.stretches import OF_KIND
from fctd.monitoring.synthetic import steady_readings
from tests.monitoring.made import chart, readings, series, shared_chart, well

DEPTHS = [700.0, 900.0]


@cache
def road() -> Roadmap:
    return roadmap(chart(), DEPTHS, [FrictionSet(open=0.2), FrictionSet(open=0.3)])


@pytest.fixture
def watch(monkeypatch: pytest.MonkeyPatch) -> Monitor:
    monkeypatch.setattr("fctd.monitoring.monitor.Chart", shared_chart)
    return Monitor(well())


def found(watch: Monitor, table: pd.DataFrame) -> list[Apparent]:
    watch.feed(table)
    watch.finish()
    return watch.found


def test_readings_of_a_factor_lie_on_its_curve(watch: Monitor) -> None:
    """The well has 0.3 in open hole; its rig has a block and an offset of the torque."""
    points = road().points(found(watch, steady_readings(well(), DEPTHS)))
    curve = road().rows[road().rows["friction_label"] == "open 0.30"]
    both = points.merge(curve, on=["operation", "bit_depth_m"], suffixes=("", "_curve"))
    assert len(both) == len(points) == 6
    for load in LOADS[:2]:
        np.testing.assert_allclose(both[load], both[f"{load}_curve"], rtol=1e-9)
    turning = both["operation"] == "rotate_off_bottom"
    np.testing.assert_allclose(both["surface_torque_N_m"], both["surface_torque_N_m_curve"].where(turning), rtol=1e-9)


@pytest.mark.slow
def test_readings_with_pumps_on_lie_on_the_curve_of_mud_at_rest() -> None:
    """The flow lifts each load by more than 2 kN, and sheaves of 0.97 show it by more or less than that."""
    mud, rig = {"density": 1250.0, "viscosity": 0.03}, {"block_weight": 2e5, "sheave_efficiency": 0.97}
    case = load_case(well(), {"mud": mud, "rig": rig})
    watch = Monitor(case)
    rows = []
    for kind in OF_KIND:
        point = equilibrium(case, kind, 900.0, flow=0.03)
        rows.append(
            {
                "bit_depth_m": 900.0, "operation": kind, "weight_indicator_N": point.weight_indicator,
                "drive_torque_N_m": point.drive_torque, "rpm": 60.0 if point.rates.spin else 0.0, "flow_m3_s": 0.03,
            }
        )  # fmt: skip
    of = found(watch, pd.DataFrame(rows))
    drawn = roadmap(watch.chart, [800.0, 900.0], [FrictionSet(open=0.3)])
    both = drawn.points(of).merge(drawn.rows, on=["operation", "bit_depth_m"], suffixes=("", "_curve"))
    assert len(both) == 3
    pumped = pd.DataFrame(rows)["weight_indicator_N"].to_numpy()
    assert (both["weight_indicator_N"].to_numpy() > pumped + 2e3).all()
    for load in LOADS[:2]:
        np.testing.assert_allclose(both[load], both[f"{load}_curve"], rtol=1e-9)
    turning = both["operation"] == "rotate_off_bottom"
    np.testing.assert_allclose(both["surface_torque_N_m"], both["surface_torque_N_m_curve"].where(turning), rtol=1e-9)
    assert [reading.factor for reading in of] == pytest.approx([0.3] * 3, abs=5e-3)
    assert "3 readings with the pumps on, drawn as with mud at rest" in drawn.told(of)


def test_the_curves_are_those_of_a_chart_with_mud_at_rest() -> None:
    own = torque_drag(well(), ["rotate_off_bottom", "trip_out", "trip_in"], DEPTHS, {"open": 0.3}, flow=0.0)
    rows = road().rows[road().rows["friction_label"] == "open 0.30"].reset_index(drop=True)
    pd.testing.assert_frame_equal(rows, own)


def test_without_factors_the_fan_is_that_of_the_inferred_hole() -> None:
    labels = list(dict.fromkeys(roadmap(chart(), DEPTHS[:1]).rows["friction_label"]))
    assert labels == [f"open {factor:.2f}" for factor in FAN]


def test_ranges_are_quartiles_and_slips_are_no_points(watch: Monitor) -> None:
    points = road().points(found(watch, series().head(450)))
    assert (watch.table()["mode"] == "in_slips").any()
    assert (points["weight_indicator_low_N"] < points["weight_indicator_N"]).all()
    assert (points["weight_indicator_N"] < points["weight_indicator_high_N"]).all()
    gauge = weight_indicator(well().rig, 0, points["hookload_high_N"])
    np.testing.assert_allclose(gauge, points["weight_indicator_high_N"])


def test_what_lies_outside_is_told(watch: Monitor) -> None:
    assert road().told([]) == ["no steady reading in the hole of the case yet"]
    assert road().points([]).empty
    table = steady_readings(well(), [650.0, 800.0])
    deeper = table.assign(bit_depth_m=table["bit_depth_m"] + 300)  # to 950 and 1,100 m
    of = found(watch, pd.concat([table, deeper], ignore_index=True))
    first, outside, deep = road().told(of)
    assert first.startswith("9 readings; the last one: slacking off at 950.0 m, weight indicator ")
    assert outside == "6 readings outside the depths of the curves, 700.0 to 900.0 m"
    assert deep == "3 readings not drawn: deeper than the hole of the case, 1000.0 m"
    assert road().points(of)["bit_depth_m"].max() == 950.0


def test_limits_come_where_they_are_asked_for() -> None:
    margins = roadmap(chart(), [900.0], [FrictionSet(open=0.3)], limits=True).margins
    assert margins is not None
    assert set(margins["operation"]) == {"rotate_off_bottom", "trip_out", "trip_in"}
    assert road().margins is None


def test_the_last_reading_names_its_factor(watch: Monitor) -> None:
    row = readings()[:1].assign(bit_depth_m=750.0, weight_indicator_N=np.nan)
    (first,) = road().told(found(watch, row))
    assert first.startswith("1 reading; the last one: rotating off bottom at 750.0 m, drive torque ")
    assert "friction factor of open hole" in first
