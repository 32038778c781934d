"""The waves within the long segment: frequencies, statics, energy, and what a long segment has without them."""

from typing import Any

import numpy as np
import pytest

from fctd import Case, simulate
from fctd.mechanics import state, topdrive, waves
from fctd.mechanics.stability import stable_step, stiffest_mode
from fctd.mechanics.topdrive import PerMetre
from fctd.model.drillstring import lay_out
from fctd.model.string_in_hole import fill
from fctd.model.wellbore import build_wellbore
from tests.cases import make_case, pipe, rotation, trip
from validation.parts.long_string import chain, chain_frequencies

Array = np.ndarray[Any, np.dtype[np.float64]]
STEEL = PerMetre(
    mass=30.0, weight=250.0, axial_inertia=0.1, EA=8e8, GJ=3e6, EI=4e6, shear=1.5e8,
    mud_axial=0.0, mud_lateral=0.0, mud_spin=0.0, beside=10.0,
)  # fmt: skip
VERTICAL = [[0, 0, 0], [1500, 0, 0]]


def hanging(components: list[dict[str, Any]], operation: dict[str, Any], **changes: Any) -> Case:
    changes = {"mud": {"density": 1000.0, "viscosity": 0}} | changes
    return make_case(VERTICAL, components, [operation], **changes)


@pytest.mark.parametrize(("length", "worst"), [(400.0, 0.5), (900.0, 0.7)])
def test_the_lowest_frequencies_are_those_of_a_continuous_rod(length: float, worst: float) -> None:
    """Odd quarters of a wave in a rod that is held above and free below: (2k − 1) c/4L, along it and in torsion [%]."""
    components = [pipe(1200 - length, round((1200 - length) / 10)), pipe(None, 1)]
    case = hanging(components, trip(1200.0, 1201.0))
    section = lay_out(case, 1200.0)
    for found, stiffness, inertia in zip(chain_frequencies(case), ("EA", "GJ"), ("mass", "axial_inertia"), strict=True):
        speed = np.sqrt(section.of(stiffness)[0] / section.of(inertia)[0])
        exact = (2 * np.arange(4) + 1) * speed / (4 * 1200)
        np.testing.assert_allclose(found, exact, rtol=worst / 100)


def test_masses_and_springs_by_hand() -> None:
    """Of 1000 m above 10 m: 2mL/(kπ)² and 2EA/L a wave, and what odd ones leave at an end; none of 40 m."""
    S = state.new_state(1)
    topdrive.put_long_segment(S, 1000.0, STEEL)
    for k in range(1, 5):
        along, around = (state.WAVES + kind + waves.EACH * (k - 1) for kind in (0, waves.TORSION))
        assert S[along + waves.INERTIA] == pytest.approx(2 * 30 * 1000 / (k * np.pi) ** 2)
        assert S[along + waves.SPRING] == pytest.approx(2 * 8e8 / 1000)
        assert S[around + waves.INERTIA] == pytest.approx(2 * 0.1 * 1000 / (k * np.pi) ** 2)
        assert S[around + waves.SPRING] == pytest.approx(2 * 3e6 / 1000)
    left = 0.5 - 4 / np.pi**2 * (1 + 1 / 9)
    assert S[state.MASS + 1] == pytest.approx(left * 30000)
    assert S[state.J_AXIAL + 1] == pytest.approx(left * 100)
    assert S[state.MASS + 1] + S[state.ADDED_MASS + 1] == pytest.approx(15000)  # sideways
    assert S[state.WEIGHT + 1] == 250 * 500
    # All of it moves as one: a wave that both ends move goes twice as far.
    odd = S[state.WAVES + waves.INERTIA] + S[state.WAVES + 2 * waves.EACH + waves.INERTIA]
    assert S[state.MASS + 1] * 2 + 4 * odd == pytest.approx(30000)
    topdrive.put_long_segment(S, 40.0, STEEL)
    assert S[state.MASS + 1] == 600
    assert not S[state.WAVES : state.WAVES + 2 * waves.TORSION].any()


def test_no_length_of_the_segment_is_stiffer_than_the_shortest() -> None:
    """The step that is stable where the long segment is short is stable at any length; along the string and around."""
    n, case = 21, hanging([pipe(200, 20), pipe(None, 1)], trip(260.0, 1200.0))
    for shortest in (10.5, 60.0, 300.0):
        S = state.new_state(n)
        fed = fill(S, lay_out(case, 200.0 + shortest), case, build_wellbore(case))
        limit = stable_step(stiffest_mode(S, n, 0.0), 0.0, 0.0)
        for length in np.geomspace(shortest, 1000.0, 60):
            topdrive.put_long_segment(S, length, fed)
            for spring, inertia, kind in (
                (state.K_AXIAL, state.MASS, 0), (state.K_TWIST, state.J_AXIAL, waves.TORSION)
            ):  # fmt: skip
                matrix, m = chain(S, n, spring, inertia, kind)
                assert np.sqrt(np.linalg.eigvalsh(matrix / np.sqrt(np.outer(m, m)))[-1]) * limit <= 2.0


def test_the_drive_stands_the_stiffest_length() -> None:
    """Springs of joint and waves together, at any length of the segment above 10 m."""
    S, turned = state.new_state(1), []
    for length in [10 * waves.STIFFEST, *np.geomspace(40.0, 2000.0, 400)]:
        topdrive.put_long_segment(S, length, STEEL)
        turned.append(S[state.K_TWIST + 1] + waves.stiffness_in_torsion(S))
    assert max(turned) == turned[0]


def test_an_impedance_drive_turns_a_long_segment_steadily() -> None:
    case = hanging([pipe(200, 20), pipe(None, 1)], rotation(270.0, 12.0, 90, ramp=2.0), rig={"drive": "impedance"})
    result = simulate(case)
    assert result.run["energy_error"] < 2e-3
    assert result.history["top_rpm"].iloc[-1] == pytest.approx(90, rel=0.02)


@pytest.mark.parametrize("operation", [trip(700.0, 730.0, 0.8, 2.0), trip(730.0, 700.0, 0.8, 2.0),
                                       rotation(730.0, 15.0, 60, ramp=2.0)])  # fmt: skip
def test_the_ledger_closes_while_waves_run_and_pipe_is_fed(operation: dict[str, Any]) -> None:
    """Hung in vertical hole, where nothing but a start moves it: the energy of the waves is a part of it."""
    result = simulate(hanging([pipe(200, 20), pipe(None, 1)], operation))
    last = result.energy.iloc[-1]
    assert abs(last["residual_J"]) < 2e-3 * (abs(last["kinetic_J"]) + abs(last["strain_J"]) + last["lost_joints_J"])


def test_a_start_turns_as_the_string_cut_into_short_segments_does() -> None:
    """Torque of a quick start, over its span: within 2 %; half the inertia at the end alone is ten times as far off."""
    torques = []
    for vertical in ({"segments": 1}, {"segment_length": 10.0}):
        components = [pipe(300, 30), pipe(None, None) | vertical]
        case = hanging(components, rotation(900.0, 4.0, 60, ramp=1.0), record={"interval": 0.05})
        torques.append(simulate(case).history["surface_torque_N_m"].to_numpy())
    long, cut = torques
    assert np.abs(long - cut).max() < 0.02 * np.ptp(cut)
