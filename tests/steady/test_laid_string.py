"""A string laid out once for all operations and frictions of a depth."""

from typing import Any

import numpy as np
import pandas as pd
import pytest

from fctd import torque_drag
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.model.drillstring import lay_out
from fctd.model.string_in_hole import fill
from fctd.model.wellbore import build_wellbore
from fctd.steady import equilibrium
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
    assert np.array_equal(S, filled)
    assert laid.is_bent
    assert np.array_equal(laid.pipe.radius, string.contact_radius())
    assert laid.top_axis.tolist() == [0.0, 0.0, 1.0]
