"""Mud that flows past a laid-out string: balances of forces and pressures, and loads known in closed form."""

from typing import Any

import numpy as np
import pytest

from fctd import Case, build_wellbore
from fctd.case.errors import InputError
from fctd.hydraulics.channel import Channel, channel_of
from fctd.hydraulics.circuit import Circuit, circulate, flows
from fctd.hydraulics.closed_forms import LAMINAR
from fctd.model.drillstring import lay_out
from tests.cases import make_case, pipe

INCH, GPM, PPG, PSI, FOOT = 0.0254, 3.785411784e-3 / 60, 119.826427, 6894.757, 0.3048
FANN = {600: 60, 300: 40, 6: 8, 3: 6}


def vertical(depth: float, hole: float, components: list[dict[str, Any]], **sections: Any) -> Case:
    intervals = {"intervals": [{"to_md": depth + 100, "diameter": hole, "friction": 0.2}]}
    return make_case([[0, 0, 0], [depth + 100, 0, 0]], components, wellbore=intervals, **sections)


def channel(case: Case, depth: float, eccentricity: float = 0.0) -> Channel:
    return channel_of(case, lay_out(case, depth), build_wellbore(case), eccentricity)


def drill_pipe(**sections: Any) -> Case:
    parts = [pipe(None, None, outer=5 * INCH, inner=4.276 * INCH, segment_length=100.0)]
    return vertical(10_000 * FOOT, 8.5 * INCH, parts, **({"mud": {"density": 12 * PPG, "fann": FANN}} | sections))


def casing(**bit: Any) -> Case:
    parts = [pipe(None, None, outer=10.75 * INCH, inner=9.85 * INCH, segment_length=100.0)]
    return vertical(2000.0, 14.75 * INCH, parts, mud={"density": 1000.0, "viscosity": 0.037}, bit=bit)


def test_the_lift_of_mud_that_is_pumped_past_drill_pipe() -> None:
    """235.3 psi and 36.2 kN by the exact flow (``references.hydraulics``); RP 13D is within 1 and 2 %."""
    found = circulate(channel(drill_pipe(), 10_000 * FOOT), 400 * GPM)
    assert found.outside[-1] / PSI == pytest.approx(235.3, rel=0.01)
    assert found.lift == pytest.approx(36.2e3, rel=0.02)
    assert (found.annulus.regime == LAMINAR).all()


def test_a_closed_casing_is_pushed_back_by_what_it_displaces() -> None:
    speed = 110 * FOOT / 60
    closed = circulate(channel(casing(end="closed"), 2000.0), 0.0, speed)
    assert closed.lift == pytest.approx(25.6e3, rel=5e-3)
    open_, floated = (circulate(channel(casing(end=end), 2000.0), 0.0, speed) for end in ("open", "float"))
    assert floated.lift == closed.lift > open_.lift > 0
    # A float lets mud out: pulled, it is an open end.
    pulled = [circulate(channel(casing(end=end), 2000.0), 0.0, -speed) for end in ("open", "float")]
    assert pulled[0].lift == pulled[1].lift == pytest.approx(-open_.lift, rel=1e-9)


def test_flow_inside_a_pipe_changes_no_effective_tension() -> None:
    mud = {"density": 1200.0, "outside": [{"density": 1200.0, "viscosity": 0.0}], "fann": FANN}
    found = circulate(channel(drill_pipe(mud=mud), 3000.0), 0.03)
    assert found.inside[0] > 1e6
    assert found.lift == 0


def test_jets_and_narrower_bores_thrust_by_the_momentum_that_they_give() -> None:
    """In all ρQ (v_n − v_i), v_i in the uppermost bore."""
    parts = [
        pipe(200, 2, outer=0.17, inner=0.07), pipe(300, 3, outer=0.13, inner=0.1),
        pipe(None, None, outer=0.13, inner=0.11, segment_length=100.0),
    ]  # fmt: skip
    mud = {"density": 1200.0, "viscosity": 0.0}
    case = vertical(1000.0, 0.3, parts, mud=mud, bit={"nozzles": [0.01, 0.01]})
    speeds = [0.03 / (0.25 * np.pi * d**2) for d in (0.11, 0.1, 0.07)] + [0.03 / (0.5 * np.pi * 0.01**2)]
    found = circulate(channel(case, 1000.0), 0.03)
    assert found.lift == pytest.approx(1200 * 0.03 * (speeds[-1] - speeds[0]), rel=1e-12)
    assert -found.given[-1] == pytest.approx(1200 * 0.03 * (speeds[-1] - speeds[2]), rel=1e-12)
    assert found.bit_drop == pytest.approx(0.5 * 1200 * speeds[-1] ** 2 / 0.95**2, rel=1e-12)


@pytest.mark.parametrize("speed", [1e-3, 0.3, 2.0, -0.3, -2.0])
@pytest.mark.parametrize("nozzles", [[], [0.008, 0.008, 0.008]])
@pytest.mark.parametrize("mud", [{"viscosity": 0.05}, {"fann": FANN}, {"viscosity": 0.002}])
def test_an_open_bore_and_the_annulus_have_one_pressure_at_the_bit(
    mud: dict[str, Any], nozzles: list[float], speed: float
) -> None:
    parts = [pipe(150, 3, outer=0.17, inner=0.07), pipe(None, None, inner=0.1086, segment_length=50.0)]
    case = vertical(1500.0, 0.2159, parts, mud={"density": 1200.0} | mud, bit={"nozzles": nozzles})
    of = channel(case, 1500.0)
    found = circulate(of, 0.0, speed)
    assert abs(found.inside[0]) < 1e-9 * abs(found.outside[-1])  # both columns begin without friction
    more, less = (
        float(of.outside(through, speed).gradient @ of.wet + of.inside(through).sum() + of.bit_drop(through))
        for through in (found.bore_flow + 1e-5 * sign * abs(speed) for sign in (1, -1))
    )
    assert less < 0 < more
    assert found.bore_flow * speed < 0
    assert found.outside[-1] * speed > 0


def test_an_eccentric_pipe_has_less_friction_and_a_smaller_lift() -> None:
    found = [circulate(channel(drill_pipe(), 3000.0, e), 0.025) for e in (0.0, 0.3, 0.6, 0.95)]
    for of in ([one.outside[-1] for one in found], [one.lift for one in found]):
        assert (np.diff(of) < 0).all()
        assert of[-1] > 0.3 * of[0]


def test_nothing_flows_where_nothing_is_pumped_or_moves() -> None:
    case = drill_pipe()
    assert not flows(case, 0.0, 0.0)
    assert flows(case, 0.0, 0.3)
    assert not flows(drill_pipe(mud={"density": 1200.0}), 0.0, 0.3)
    still = circulate(channel(case, 3000.0), 0.0)
    assert not np.any([still.given, still.inside[1:], still.outside[1:]])


def test_nothing_is_pumped_through_a_closed_end() -> None:
    with pytest.raises(InputError, match=r'bit\.end = "closed": expected "open" or "float" with a flow'):
        circulate(channel(casing(end="closed"), 2000.0), 0.02)


def test_pressures_between_the_ends_of_segments_lie_on_straight_lines() -> None:
    found: Circuit = circulate(channel(drill_pipe(), 3000.0), 0.025)
    inside, outside = found.pressures(np.array([3000.0, 1234.5, 0.0]))
    assert outside == pytest.approx(found.outside[-1] * np.array([0.0, 1 - 1234.5 / 3000, 1.0]))
    assert inside[-1] == pytest.approx(outside[-1])  # without nozzles


def test_an_open_bore_without_friction_beside_mud_that_resists() -> None:
    """A string that is lowered sends mud up a bore that resists nothing: the pressures there have no friction."""
    mud = {"density": 1200.0, "outside": [{"to_md": 500.0, "density": 1200.0}, {"density": 1200.0, "viscosity": 0.02}]}
    with np.errstate(all="raise"):
        found = circulate(channel(drill_pipe(mud=mud), 10_000 * FOOT), 0.0, 0.5)
    assert np.isfinite(found.inside).all()
