"""Apparent factors and their bands."""

from dataclasses import replace

import pandas as pd
import pytest

from fctd import load_case
from fctd.case.errors import InputError
from fctd.model.operations import rates_of_all
from fctd.monitoring.chart import Chart
from fctd.monitoring.friction import TWO_SIDED_95, Uncertainty, apparent, parse_uncertainty
from fctd.monitoring.stretches import OF_KIND, Stretch, by_depth
from fctd.steady.equilibrium import Solver
from tests.monitoring.made import chart, readings, well


def stretch(mode: str, depth: float) -> Stretch:
    return next(s for s in by_depth(readings()) if s.mode == mode and s.bit_depth == depth)


@pytest.mark.parametrize("mode", ["rotating", "pick_up", "slack_off"])
def test_the_factor_of_a_reading(mode: str) -> None:
    """0.3 above the step, 0.45 below it."""
    for depth, factor in ((765.0, 0.3), (890.0, 0.45)):
        assert apparent(stretch(mode, depth), chart(), Uncertainty()).factor == pytest.approx(factor, abs=3e-3)


def test_flow_lightens_the_string_and_leaves_the_factor() -> None:
    mud = {"density": 1250.0, "viscosity": 0.03}
    case, flow = load_case(well(), {"mud": mud}), 0.03
    rates, solver, inverse = rates_of_all(case, list(OF_KIND), flow=flow), Solver(case), Chart(case)
    for kind in OF_KIND:
        point = solver.solve(kind, rates[kind], 900.0)
        row = {
            "bit_depth_m": 900.0, "operation": kind, "weight_indicator_N": point.weight_indicator,
            "drive_torque_N_m": point.drive_torque, "rpm": 60.0, "flow_m3_s": flow,
        }  # fmt: skip
        (one,) = by_depth(pd.DataFrame([row]))
        found = apparent(one, inverse, Uncertainty())
        assert found.lift > 2e3
        assert found.factor == pytest.approx(0.3, abs=5e-3)


def test_strokes_slide_also_where_the_trips_of_the_case_turn() -> None:
    trip = {"kind": "trip_in", "from_md": 800.0, "to_md": 900.0, "speed": 0.3, "rpm": 60.0}
    turned = Chart(load_case(well(), {"operations": [trip]}))
    assert turned.loads("trip_in", 900.0).tolist() == chart().loads("trip_in", 900.0).tolist()


def test_the_band_adds_what_is_held() -> None:
    one = stretch("pick_up", 890.0)
    alone = apparent(one, chart(), Uncertainty())
    per_newton = alone.noise / Uncertainty().hook_load
    assert alone.high - alone.factor == pytest.approx(TWO_SIDED_95 * alone.noise)
    held = apparent(one, chart(), Uncertainty(block_weight=Uncertainty().hook_load))
    assert held.noise == alone.noise
    assert held.high - held.low == pytest.approx(2**0.5 * (alone.high - alone.low))
    assert apparent(one, chart(), Uncertainty(cased=0.05)).high > alone.high
    assert per_newton > 0


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"left_out": "torque locked in"}, "torque locked in"),
        ({"mode": "in_slips"}, "slips"),
        ({"bit_depth": 1200.0}, "outside"),
        ({"bit_depth": 605.0}, "does not depend"),
    ],
)
def test_no_factor_is_inferred(change: dict[str, object], why: str) -> None:
    found = apparent(replace(stretch("pick_up", 890.0), **change), chart(), Uncertainty())  # type: ignore[arg-type]
    assert found.factor != found.factor
    assert why in found.left_out


def test_uncertainties_of_options() -> None:
    found = parse_uncertainty(["torque=5%", "hook_load=2 t", "cased=0.02"], "--uncertainty")
    assert found == Uncertainty(torque=0.05, hook_load=19613.3, cased=0.02)
    for text in ("torque", "twist=5%", "torque=much", "hook_load=2 m"):
        with pytest.raises(InputError, match="--uncertainty"):
            parse_uncertainty([text], "--uncertainty")


def test_a_torque_of_zero_has_noise_and_one_beyond_all_numbers_tells_nothing() -> None:
    """A sensor that is dead, and one that is broken."""
    one = stretch("rotating", 765.0)
    dead = apparent(replace(one, torque=one.torque._replace(median=0.0)), chart(), Uncertainty())
    assert dead.factor < 0
    assert dead.noise > 1e-3
    broken = apparent(replace(one, torque=one.torque._replace(median=1e300)), chart(), Uncertainty())
    assert "check the unit" in broken.left_out


@pytest.mark.parametrize("text", ["torque=0%", "torque=1e-300", "hook_load=0 t"])
def test_every_reading_has_noise(text: str) -> None:
    with pytest.raises(InputError, match="every reading has noise"):
        parse_uncertainty([text], "--uncertainty")
