"""Runs of strings whose friction differs along and around the hole: against the steady string, and at rest."""

from typing import Any

import numpy as np
import pytest

from fctd import Case, equilibrium, simulate
from fctd.mechanics import state
from fctd.mechanics.moving_string import STILL
from fctd.simulation.preparation import prepare
from fctd.simulation.settling import settle
from fctd.simulation.simulate import Simulation
from references.soft_string.integration import soft_string
from tests.cases import make_case, pipe, rotation, trip

BUILD = [[0, 0, 0], [100, 0, 0], [400, 60, 0], [700, 60, 0]]
MUD = {"density": 1200.0, "lateral_damping": 1e3}


def sliding_and_turning(along: float, around: float, law: str = "coulomb", **more: Any) -> Case:
    """5 in pipe that is reamed back through a build, slowly; the ends of its segments touch everywhere."""
    hole = {"to_md": 700, "diameter": 0.2159, "friction": along, "rotational_friction": around} | more
    components = [pipe(None, None, inner=0.1086, segment_length=10.0, contact_diameter=0.21)]
    back = [{"kind": "back_ream", "from_md": 651.0, "to_md": 649.0, "speed": 0.1, "rpm": 15.0, "ramp_time": 2.0}]
    return make_case(
        BUILD, components, back, wellbore={"intervals": [hole], "geometry": "arcs"}, mud=MUD,
        contact={"friction_law": law}, record={"interval": 0.05},
    )  # fmt: skip


def late(case: Case) -> tuple[float, float, float]:
    """Bit depth [m], hook load [N] and torque [N m] of a run, means of its last ten steady seconds.

    These are 40 axial periods and 13 of torsion.
    """
    result = simulate(case)
    assert result.status == "completed", result.message
    time = result.history["time_s"]
    rows = result.history[(time > 8.0) & (time <= 18.0)].mean(numeric_only=True)
    return float(rows["bit_depth_m"]), float(rows["hookload_N"]), float(rows["surface_torque_N_m"])


def drag(case: Case, hookload: float, depth: float) -> float:
    """What a hook load exceeds that of the string without friction by [N]."""
    smooth = [
        one.model_copy(update={"friction": 0.0, "rotational_friction": None, "static_friction": None})
        for one in case.wellbore.intervals
    ]
    free = case.model_copy(update={"wellbore": case.wellbore.model_copy(update={"intervals": tuple(smooth)})})
    return hookload - equilibrium(free, "trip_out", depth).hookload


@pytest.mark.slow(seconds=20)
@pytest.mark.parametrize(
    ("law", "along", "around", "more"),
    [
        ("coulomb", 0.4, 0.15, {}), ("coulomb", 0.15, 0.4, {}), ("coulomb", 0.3, 0.03, {}), ("coulomb", 0.3, 0.0, {}),
        ("karnopp", 0.4, 0.15, {"static_friction": 0.6}), ("paper", 0.3, 0.15, {}),
        ("stribeck", 0.3, 0.15, {"static_friction": 0.35, "decay_speed": 1e-3}),
    ],
)  # fmt: skip
def test_a_string_that_slides_and_turns_is_the_steady_one(law, along, around, more) -> None:
    """Within 0.5 %, as a mean over whole periods; a soft string has less clearance and no stiffness."""
    case = sliding_and_turning(along, around, law, **more)
    depth, hookload, torque = late(case)
    point = equilibrium(case, "back_ream", depth)
    assert point.status == "converged"
    of = drag(case, point.hookload, depth)
    assert of > 2e3
    assert drag(case, hookload, depth) == pytest.approx(of, rel=5e-3)
    assert torque == pytest.approx(point.surface_torque, rel=5e-3, abs=1.0)
    if law in ("coulomb", "paper"):
        soft = soft_string(case, "back_ream", depth)
        assert drag(case, soft.hookload, depth) == pytest.approx(of, rel=0.03)
        assert soft.surface_torque == pytest.approx(point.surface_torque, rel=0.03, abs=1.0)


def test_equal_factors_are_the_run_with_one() -> None:
    """To the bit: a pair of equal factors is one factor."""
    one, two = sliding_and_turning(0.25, 0.25), sliding_and_turning(0.25, 0.2)
    intervals = tuple(part.model_copy(update={"rotational_friction": None}) for part in one.wellbore.intervals)
    same = one.model_copy(update={"wellbore": one.wellbore.model_copy(update={"intervals": intervals})})
    short = [{"kind": "back_ream", "from_md": 650.0, "to_md": 649.8, "speed": 0.1, "rpm": 15.0, "ramp_time": 0.5}]
    histories = []
    for case in (one, same, two):
        ops = Case.model_validate(case.model_dump(exclude_defaults=True) | {"operations": short}).operations
        histories.append(simulate(case.model_copy(update={"operations": ops})).history)
    assert histories[0].equals(histories[1])
    assert not histories[0].equals(histories[2])
    points = [equilibrium(case, "back_ream", 650.0) for case in (one, same, two)]
    assert points[0].profile.equals(points[1].profile)
    assert not points[0].profile.equals(points[2].profile)


@pytest.mark.slow
@pytest.mark.parametrize("law", ["coulomb", "karnopp"])
def test_a_string_in_the_slips_keeps_its_load(law: str) -> None:
    """It slid into a winding hole with three times the friction along that it has around."""
    winding = [[float(md), 70.0 + 3 * (-1) ** k, 4.0 * (k % 3)] for k, md in enumerate(range(500, 1500, 100))]
    hole = {"to_md": 1400, "diameter": 0.2159, "friction": 0.3, "rotational_friction": 0.1}
    simulation = Simulation(make_case(
        [[0, 0, 0], [200, 0, 0], *winding], [pipe(None, None, inner=0.1086, segment_length=28.5)],
        [trip(1277.5, 1317.5, speed=0.5)], wellbore={"geometry": "arcs", "intervals": [hole]}, mud={"density": 1200.0},
        contact={"friction_law": law}, rig={"feed": "stands", "connection_time": 60.0},
    ))  # fmt: skip
    loads = []
    for record in simulation:
        if record["in_slips"]:
            loads.append(record["hookload_N"])
        elif loads:
            break
    assert len(loads) > 55
    assert np.ptp(loads[10:]) < 200


def test_a_string_at_rest_holds_a_torque_at_its_bit_within_the_ellipse() -> None:
    """Pipe that lies in an incline, held at its top: the bit does not slide under 0.9 of its own friction around, and
    does under more than that of all points."""
    hole = {"to_md": 300, "diameter": 0.2159, "friction": 0.5, "rotational_friction": 0.2}
    case = make_case(
        [[0, 60, 0], [300, 60, 0]], [pipe(100, 10, inner=0.1086)], wellbore={"intervals": [hole], "geometry": "arcs"},
        top_md=50.0, operations=[rotation(150, 1.0)], mud=MUD, contact={"friction_law": "karnopp"},
    )  # fmt: skip
    run, _ = prepare(case)
    settle(run)
    n = run.segments
    normal = state.row(run.S, state.K_WALL, n) * np.maximum(
        np.sqrt(sum(state.row(run.S, axis, n) ** 2 for axis in (state.PX, state.PY, state.PZ)))
        - state.row(run.S, state.HOLE, n) + state.row(run.S, state.RADIUS, n), 0.0,
    )  # fmt: skip
    holds = 0.2 * float(state.row(run.S, state.RADIUS, n)[-1]) * normal
    assert (holds[-3:] > 0).all()

    def pushed(torque: float, seconds: float) -> tuple[float, float, float]:
        """Of the bit under a torque [N m]: energy that friction takes [J], share of the steps in which it sticks, and
        its spin at the end [rad/s]."""
        before, stuck, steps = float(run.S[state.LOST_FRICTION + n]), 0.0, round(seconds / run.step)
        for _ in range(steps):
            run.S[state.WZ + n] += run.step * torque * run.S[state.INVERSE_JA + n]
            run.advance(STILL, run.step)
            stuck += run.S[state.STUCK + n]
        return float(run.S[state.LOST_FRICTION + n]) - before, stuck / steps, float(run.S[state.WZ + n])

    pushed(0.0, 0.2)
    taken, stuck, _ = pushed(0.9 * holds[-1], 1.0)  # the bit rolls a little up the wall, and does not slide
    assert stuck == 1
    assert abs(taken) < 1e-3  # the mud brakes the body after its point has been stopped
    taken, stuck, spin = pushed(2 * holds.sum(), 2.0)  # more than the whole string holds
    assert stuck < 0.99
    assert taken > 0.1
    assert spin == pytest.approx(0.0, abs=1e-3)  # the string is wound up, and its top holds the rest
