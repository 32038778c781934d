"""A string laid out once for all operations and frictions of a depth."""

from typing import Any

import numpy as np
import pandas as pd
import pytest

from fctd import torque_drag
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.model.drillstring import lay_out
from fctd.model.operations import SteadyRates, steady_rates
from fctd.model.string_in_hole import fill
from fctd.model.wellbore import build_wellbore
from fctd.steady import equilibrium
from fctd.steady.equilibrium import Solver
from fctd.steady.laid_string import LaidString
from tests.cases import make_case, pipe

KINDS = ["trip_in", "back_ream", "drill_sliding"]
FRICTIONS = [{"cased": 0.1, "open": 0.2}, {"cased": 0.3, "open": 0.5}]
DEPTHS = [50.0, 430.0, 700.0, 900.0]


def bent_case(**more: Any) -> Case:
    """Two sizes of hole, a bent housing and a stabiliser."""
    intervals = [
        {"to_md": 600, "diameter": 0.3, "friction": 0.1, "kind": "cased"},
        {"to_md": 900, "diameter": 0.2159, "friction": 0.3, "kind": "open"},
    ]
    components = [
        pipe(20.0, 2, bend="1 deg"),
        pipe(1.0, 1, outer=0.2),
        pipe(100.0, 5, outer=0.16),
        pipe(None, None, segment_length=20.0),
    ]
    return make_case(
        [[0, 0, 0], [300, 0, 0], [600, 50, 0], [900, 95, 0]], components,
        wellbore={"intervals": intervals, "stiffness_per_length": 1e6}, bit={"weight_on_bit": 2e5, "torque": 3e3},
        mud={"density": 1200.0, "axial_damping": 2.0}, **more,
    )  # fmt: skip


@pytest.mark.parametrize("force", ["none", "analytic"])
def test_a_row_of_a_chart_is_that_row_alone_to_the_last_bit(force: str) -> None:
    """Although the rows of a depth share its layout, and the analytic force of the helix changes a row's mud."""
    case = bent_case(contact={"helical_force": force})
    chart = torque_drag(case, KINDS, DEPTHS, FRICTIONS)
    assert set(chart["buckling"]) >= {"none", "helical"}
    alone = [torque_drag(case, kind, [depth], friction) for kind in KINDS for friction in FRICTIONS for depth in DEPTHS]
    pd.testing.assert_frame_equal(chart, pd.concat(alone, ignore_index=True), check_exact=True)


def test_the_string_is_laid_out_once_a_depth(monkeypatch: pytest.MonkeyPatch) -> None:
    depths: list[float] = []

    def counted(case: Case, bit_depth: float) -> Any:
        depths.append(bit_depth)
        return lay_out(case, bit_depth)

    monkeypatch.setattr(equilibrium, "lay_out", counted)
    torque_drag(bent_case(), KINDS, DEPTHS, FRICTIONS)
    assert sorted(depths) == sorted(DEPTHS)  # threads take them in any order


def test_it_fills_a_buffer_with_the_string_of_its_case() -> None:
    case = bent_case()
    string = lay_out(case, 700.0)
    laid = LaidString(case, build_wellbore(case), string)
    S, filled = state.new_state(string.segments), state.new_state(string.segments)
    assert laid.put(S) == fill(filled, string, case, build_wellbore(case))
    assert np.array_equal(state.columns(S), state.columns(filled))
    assert laid.is_bent
    assert np.array_equal(laid.pipe.radius, string.contact_radius())
    assert laid.top_axis.tolist() == [0.0, 0.0, 1.0]


@pytest.mark.parametrize("inclination", [0, 40])
@pytest.mark.parametrize("kind", ["trip_in", "trip_out", "rotate_off_bottom"])
def test_hook_weight_and_mud_balance(kind: str, inclination: float) -> None:
    """Without friction the hook bears the weight along the hole less the lift, to 1e-9 of the weight."""
    case = make_case(
        [[0, inclination, 0], [1000, inclination, 0]], [pipe(None, None, segment_length=30.0)],
        wellbore={"intervals": [{"to_md": 1000, "diameter": 0.2159, "friction": 0.0}]},
        mud={"density": 1200.0, "fann": {600: 60, 300: 40}}, bit={"nozzles": [0.01, 0.01, 0.01]},
    )  # fmt: skip
    solver = Solver(case)
    laid = solver.lay_out(900.0)
    weight = float(laid.string.weight @ laid.string.length)
    point = solver.solve_string(kind, steady_rates(case, kind, flow=0.03), laid)
    still = solver.solve_string(kind, steady_rates(case, kind, flow=0.0), laid.at_rest)
    assert point.lift > 0.01 * weight
    off = 3e-9 if inclination else 1e-9  # the wall gives way a little less under a string that is lifted
    assert point.hookload + point.lift == pytest.approx(still.hookload, abs=off * weight)
    assert still.hookload == pytest.approx(weight * np.cos(np.radians(inclination)), rel=1e-6)


def test_mud_at_rest_leaves_a_string_as_it_is() -> None:
    case = make_case(mud={"density": 1200.0, "viscosity": 0.03})
    laid = Solver(case).lay_out(400.0)
    assert laid.in_flow(SteadyRates(0.0, 5.0)) is laid
    assert laid.at_rest.in_flow(SteadyRates(0.3, 0.0, 0.02)).circuit is None
    moving = laid.in_flow(SteadyRates(0.3, 0.0))
    assert moving is laid.in_flow(SteadyRates(0.3, 1.0))
    assert moving.in_flow(SteadyRates(0.5, 0.0)) is moving
    given = make_case(mud={"density": 1200.0, "viscosity": 0.03, "axial_damping": 3.0})
    assert not Solver(given).lay_out(400.0).in_flow(SteadyRates(0.3, 0.0)).given.any()


def test_friction_of_the_flow_is_in_pressures_and_stretch() -> None:
    mud = {"density": 1200.0, "viscosity": 0.03}
    laid = Solver(make_case(mud=mud, bit={"nozzles": [0.01]})).lay_out(400.0)
    pumped = laid.in_flow(SteadyRates(0.0, 0.0, 0.02))
    assert pumped.circuit is not None
    assert not laid.excess.any()
    assert pumped.excess[0] == pytest.approx(pumped.circuit.inside[0])
    assert pumped.excess[-1] == pytest.approx(pumped.circuit.bit_drop)
    assert (pumped.squeeze < laid.squeeze).all()  # at one effective tension
