"""The engine against closed forms of beams, shafts and waves: each would fail if a stiffness were 2 % off."""

import numpy as np
import pytest

from fctd import simulate
from fctd.mechanics import state
from fctd.model.operations import rad_per_s
from fctd.model.section import section_of
from fctd.simulation.preparation import prepare
from fctd.simulation.settling import settle
from references.soft_string.integration import soft_string
from tests.cases import make_case, pipe, rotation, trip

HORIZONTAL = [[0, 90, 0], [2000, 90, 0]]


def test_cantilever_converges_to_the_timoshenko_beam() -> None:
    """A pipe clamped in the top drive and hanging free sideways: wL⁴/8EI + wL²/2κGA, at second order."""
    length, errors = 8.0, []
    for segments in (5, 10, 20):
        case = make_case(
            HORIZONTAL, [pipe(length, segments)], [rotation(length, 1)], contact={"enabled": False}
        )  # fmt: skip
        run, _ = prepare(case)
        settle(run, tolerance=1e-9)
        section = section_of(case.string.components[0], 0.0)
        exact = section.weight * (length**4 / (8 * section.EI) + length**2 / (2 * section.shear))
        n = run.segments
        tip = run.S[state.Z + n] + run.S[state.ARM_BOTTOM + n] * run.S[state.AZ + n]
        errors.append(tip / exact - 1)
    assert errors[-1] == pytest.approx(0, abs=3e-3)
    assert np.all(np.log2(np.abs(np.array(errors[:-1]) / errors[1:])) > 1.8), errors


def test_twist_of_a_string_turning_in_mud() -> None:
    """Rotating in mud alone the torque falls linearly to the bit, and the bit lags by c ω L²/2GJ."""
    case = make_case(operations=[rotation(1000, 60, ramp=40)], mud={"rotational_damping": 0.8})
    run, phases = prepare(case)
    settle(run)
    for motion, _ in phases:
        run.advance(motion, motion.duration)
    section = section_of(case.string.components[0], 0.0)
    rate = rad_per_s(60)
    quaternions = np.stack(
        [run.S[q : q + run.segments + 1] for q in (state.QW, state.QX, state.QY, state.QZ)], axis=1
    )  # fmt: skip
    turned = np.unwrap(2 * np.arctan2(quaternions[:, 3], quaternions[:, 0]))
    # The last body's middle is half a segment above the bit.
    reach = 1000 - 0.5 * run.string.length[-1]
    lag = 0.8 * rate * (1000 * reach - 0.5 * reach**2) / section.GJ
    assert turned[0] - turned[-1] == pytest.approx(lag, rel=5e-3)


@pytest.mark.parametrize(("kind", "speed"), [("axial", 5133.0), ("torsional", 3183.2)])
def test_free_vibration_has_the_frequency_of_a_bar(kind: str, speed: float) -> None:
    """A bar held at the top, plucked in its first mode: period 4L/c with c = √(E/ρ) or √(G/ρ)."""
    case = make_case(
        components=[pipe(1000, 40)], operations=[rotation(1000, 10)],
        contact={"enabled": False}, solver={"joint_damping": 0},
    )  # fmt: skip
    run, phases = prepare(case)
    settle(run)
    n = run.segments
    shape = np.sin(np.pi / 2 * (np.arange(n) + 0.5) / n)
    row = state.VZ if kind == "axial" else state.WZ
    state.row(run.S, row, n)[:] += 0.1 * shape
    quarter = 1000 / speed
    still = phases[0].motion._replace(spin_to=0.0)
    history = []
    for _ in range(800):
        run.advance(still, quarter / 20)
        history.append(float(state.row(run.S, row, n) @ shape))
    spectrum = np.fft.rfft(np.array(history) * np.hanning(800), 2**16)
    found = np.argmax(np.abs(spectrum)[50:]) + 50
    period = 2**16 / found * quarter / 20
    assert period == pytest.approx(4 * quarter, rel=3e-3)


def test_weight_on_the_wall_presses_it_by_its_stiffness() -> None:
    """A horizontal string: every inner point carries w Δz, pressed in by w Δz/K beyond the clearance."""
    case = make_case(HORIZONTAL, [pipe(500, 50)], [rotation(500, 1)], wellbore={"stiffness": 1e6})
    run, _ = prepare(case)
    settle(run)
    weight = section_of(case.string.components[0], 0.0).weight * 10
    sag = (run.S[state.Z + 2 : state.Z + 40] + run.S[state.Z + 3 : state.Z + 41]) / 2
    assert sag.mean() == pytest.approx(0.10795 - 0.0635 + weight / 1e6, rel=1e-3)


def test_bending_moment_in_a_build_is_EI_over_R() -> None:  # noqa: N802
    """Rotating deep in a long bend the string follows it: M = EI/R."""
    stations = [[0, 0, 0], [300, 0, 0], [1200, 90, 0], [1500, 90, 0]]
    result = simulate(make_case(stations, [pipe(1200, 120)], [rotation(1200, 20)]))
    section = section_of(result.case.string.components[0], 0.0)
    inside = result.profile[(result.profile.md_m > 900) & (result.profile.md_m < 1100)]
    assert inside.bending_moment_N_m.mean() == pytest.approx(section.EI * np.radians(90) / 900, rel=5e-3)


def test_a_string_turning_clockwise_climbs_to_the_right_and_its_offset_says_so() -> None:
    """Looking downhole the string's underside moves left, so the wall pushes it right: law ``coulomb`` lets it
    rest at 180° − atan μ, and a positive offset is to the right."""
    result = simulate(make_case(HORIZONTAL, [pipe(500, 50)], [rotation(500, 30)], mud={"lateral_damping": 50.0}))
    inner = result.profile.iloc[5:-5]
    clearance = 0.10795 - 0.0635
    np.testing.assert_allclose(inner.offset_right_m / clearance, np.sin(np.arctan(0.2)), rtol=0.02)
    np.testing.assert_allclose(inner.offset_high_m / clearance, -np.cos(np.arctan(0.2)), rtol=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("operation", ["trip_out", "trip_in", "rotate_off_bottom"])
@pytest.mark.parametrize("law", ["coulomb", "paper"])
def test_a_pipe_in_a_gentle_well_is_a_soft_string(operation: str, law: str) -> None:
    """Little clearance and curvature: hook load and torque within 1 % of Johancsik's."""
    stations = [[0, 0, 0], [300, 0, 0], [900, 60, 0], [1500, 60, 0]]
    schedules = {
        "trip_out": trip(1204, 1198, ramp=5),
        "trip_in": trip(1196, 1202, ramp=5),
        "rotate_off_bottom": rotation(1200, 30, ramp=10),
    }
    case = make_case(
        stations, [pipe(None, None, segment_length=20.0)], [schedules[operation]], contact={"friction_law": law},
        wellbore={"geometry": "arcs", "intervals": [{"to_md": 1500, "diameter": 0.17, "friction": 0.3}]},
    )  # fmt: skip
    result = simulate(case)
    late = result.history[result.history.time_s > result.history.time_s.max() - 15].mean(numeric_only=True)
    soft = soft_string(case, operation, float(late.bit_depth_m))
    assert late.hookload_N == pytest.approx(soft.hookload, rel=0.01)
    if operation == "rotate_off_bottom":
        assert late.sum_r_ft_N_m == pytest.approx(soft.surface_torque, rel=0.01)
