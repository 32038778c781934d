"""The chart against the steady solver between its nodes, its inverse, and what the rules of stretches need."""

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.case.load import with_friction
from fctd.monitoring.chart import CASED_STEP, FACTORS, HELD, Chart, fit_of
from fctd.monitoring.stretches import Mode
from fctd.steady.equilibrium import equilibrium
from tests.cases import make_case
from tests.monitoring.made import BLOCK, chart, well

KINDS: dict[Mode, str] = {"rotating": "rotate_off_bottom", "pick_up": "trip_out", "slack_off": "trip_in"}


@pytest.mark.parametrize("mode", list(KINDS))
@pytest.mark.parametrize("factor", [0.05, 0.28, 0.5])
def test_a_reading_gives_back_its_factor_between_nodes(mode: Mode, factor: float) -> None:
    """At 843.2 m, 0.2 m from a node: within 0.003, a sixth of what noise of 4 % of torque makes of it."""
    point = equilibrium(with_friction(well(), {"open": factor}), KINDS[mode], 843.2)
    reading = point.drive_torque if mode == "rotating" else point.weight_indicator
    found = chart().invert(mode, 843.2, reading, 60.0)
    assert found is not None
    assert found.factor == pytest.approx(factor, abs=3e-3)
    assert chart().curve(mode, 843.2, factor, 60.0) == pytest.approx(reading, rel=2e-3)


def test_the_derivatives_are_those_of_the_solver() -> None:
    point = equilibrium(well(), "trip_out", 840.0)
    found = chart().invert("pick_up", 840.0, point.weight_indicator, 0.0)
    assert found is not None
    more = equilibrium(with_friction(well(), {"open": 0.32}), "trip_out", 840.0).weight_indicator
    assert found.per_reading == pytest.approx(0.02 / (more - point.weight_indicator), rel=0.03)


@pytest.mark.parametrize("mode", list(KINDS))
def test_the_derivative_by_the_held_factor_is_taken_at_one_open_factor(mode: Mode) -> None:
    """At 0.2, not at the case's 0.3, from two solves; a rotating string's load is its torque."""
    assert FACTORS[HELD] == 0.2
    sets = [{"open": 0.2, "cased": 0.2}, {"open": 0.2, "cased": 0.2 + CASED_STEP}]
    points = [equilibrium(with_friction(well(), factors), KINDS[mode], 840.0) for factors in sets]
    first, more = (p.surface_torque if mode == "rotating" else p.hookload for p in points)
    assert chart().by_held(mode, 840.0) == pytest.approx((more - first) / CASED_STEP, rel=1e-3)


def test_a_reading_below_a_frictionless_string_has_a_negative_factor() -> None:
    loads = chart().readings("pick_up", 900.0, 0.0)
    found = chart().invert("pick_up", 900.0, loads[0] - 5e3, 0.0)
    assert found is not None
    assert found.factor == pytest.approx(-5e3 * found.per_reading)


def test_above_the_shoe_no_reading_tells_the_open_hole() -> None:
    assert chart().invert("pick_up", 450.0, 4e5, 0.0) is None


def test_shares_of_the_string_are_the_limits_of_slips() -> None:
    turning = equilibrium(well(), "rotate_off_bottom", 960.0).hookload
    assert np.ravel(chart().slips_below(np.array([960.0]))) == pytest.approx(
        [BLOCK + 0.1 * turning, BLOCK + turning / 2]
    )
    assert np.isfinite(chart().slips_below(np.array([-5.0, 1e6]))).all()


def test_the_stretch_at_reversal_and_the_locked_share() -> None:
    """At a node of the coarse chart: (up − down) L / 2 EA; a resting reading of the offset holds no torque."""
    up, down, turning = (equilibrium(well(), kind, 960.0) for kind in ("trip_out", "trip_in", "rotate_off_bottom"))
    stiffness = 206.8e9 * np.pi / 4 * (0.127**2 - 0.1086**2)
    assert chart().reversal(960.0) == pytest.approx((up.hookload - down.hookload) * 960 / 2 / stiffness)
    assert chart().locked_share(960.0, 500.0, 0.0) == 0.0
    assert chart().locked_share(960.0, 500.0 + turning.surface_torque / 2, 0.0) == pytest.approx(0.5)


def test_the_intervals_whose_factor_is_inferred() -> None:
    assert (fit_of(well(), None), fit_of(well(), "cased"), fit_of(make_case(), None)) == ("open", "cased", "all")
    with pytest.raises(InputError, match="kind"):
        Chart(make_case(), "open")
