"""The picture of a run: the numbers of the history in the units of its axes."""

from dataclasses import replace
from functools import cache
from typing import Literal

import numpy as np
import pytest

from fctd import plots, simulate
from fctd.results.tables import SimulationResult
from tests.cases import make_case, pipe, rotation, trip
from tests.plots.made import FOOT, LBF, legend_of, texts_that_overlap


@cache
def result() -> SimulationResult:
    return simulate(
        make_case(
            [[0, 0, 0], [300, 0, 0], [1000, 60, 0]],
            [pipe(500, 10), pipe(None, 1)],
            [trip(700, 701), rotation(701, 4, ramp=1)],
            record={"interval": 0.5},
        )
    )


@pytest.mark.slow
def test_the_history_is_drawn_in_the_units_of_the_axes() -> None:
    history = result().history
    for units, newton, metre in (("si", 1e3, 1.0), ("field", 1e3 * LBF, FOOT)):
        hookload, torque, rotation_, depth, string, _ = plots.run_figure(result(), units).axes  # type: ignore[arg-type]
        np.testing.assert_allclose(hookload.lines[0].get_ydata() * newton, history["hookload_N"], rtol=1e-9)
        np.testing.assert_allclose(depth.lines[0].get_ydata() * metre, history["bit_depth_m"], rtol=1e-9)
        np.testing.assert_allclose(rotation_.lines[1].get_ydata(), history["top_rpm"])
        np.testing.assert_allclose(rotation_.lines[0].get_ydata(), history["bit_rpm"])
        assert max(string.get_ylim()) * metre == pytest.approx(result().segments["md_m"].max())
        assert torque.get_ylabel().endswith("kN·m" if units == "si" else "kft·lbf")


@pytest.mark.parametrize("map_of", ["contact_force_N", "effective_tension_N"])
def test_the_map_has_the_string_at_its_records(map_of: str) -> None:
    figure = plots.run_figure(result(), map_of=map_of)  # type: ignore[arg-type]
    cells = figure.axes[4].collections[0].get_array()
    assert cells.shape[1] == len(result().history)
    if map_of == "effective_tension_N":
        # The uppermost cell of the last record is the tension near the top; the string hangs freely there.
        last = result().segments.groupby("time_s").get_group(result().history["time_s"].iloc[-1])
        assert cells[0, -1] == pytest.approx(last["effective_tension_N"].iloc[0] / 1e3, rel=1e-6)
    assert not texts_that_overlap(figure)


@cache
def drilled() -> SimulationResult:
    """Drilling far down, so that the labels of depth are long."""
    operation = {"kind": "drill_rotating", "from_md": 9999, "to_md": 9999.05, "speed": 0.01, "rpm": 120, "ramp_time": 1}
    return simulate(
        make_case(
            [[0, 0, 0], [3000, 0, 0], [5000, 40, 0], [10100, 40, 0]],
            [pipe(500, 5), pipe(None, 40)],
            [operation],
            bit={"weight_on_bit": 5e4, "rock": {}},
            rig={"feed": "stands", "stand_length": 500.0, "derrick_height": 600.0},
            record={"interval": 0.5},
        )
    )


@pytest.mark.slow
@pytest.mark.parametrize("units", ["si", "field"])
def test_a_run_that_drills_shows_its_weight_on_bit(units: Literal["si", "field"]) -> None:
    figure = plots.run_figure(drilled(), units)
    (_, on_bit, *_), (block, _) = figure.axes[:5], figure.axes[-2:]
    newton = 1e3 if units == "si" else 1e3 * LBF
    history = drilled().history
    np.testing.assert_allclose(on_bit.lines[0].get_ydata() * newton, history["weight_on_bit_N"], rtol=1e-9, atol=1e-6)
    assert on_bit.get_ylabel() == ("weight on bit\nkN" if units == "si" else "weight on bit\nklbf")
    assert "block" in legend_of(figure)
    np.testing.assert_allclose(
        block.lines[0].get_ydata() * (1.0 if units == "si" else FOOT), history["block_position_m"], rtol=1e-9
    )
    assert not texts_that_overlap(figure)


def test_a_trace_that_is_flat_but_for_rounding_looks_flat() -> None:
    still = replace(result(), history=result().history.copy())
    noise = 1e-6 * np.resize([1.0, -1.0], len(still.history))
    for column in ("surface_torque_N_m", "surface_torque_min_N_m", "surface_torque_max_N_m", "bit_rpm", "top_rpm"):
        still.history[column] = noise
    for column in ("hookload_N", "hookload_min_N", "hookload_max_N"):
        still.history[column] = 1e6 + noise
    still.history["bit_depth_m"] = 700 + noise
    for ax in plots.run_figure(still).axes[:4]:
        assert max(np.ptp(line.get_ydata()) for line in ax.lines) < 1e-3 * np.ptp(ax.get_ylim())


def test_a_result_without_records_has_no_picture() -> None:
    from fctd.simulation.simulate import Simulation

    with pytest.raises(ValueError, match="records"):
        plots.run_figure(Simulation(result().case).result())
