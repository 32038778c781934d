"""The part of a string above the rotary table: weight, mud and energy of bodies that pass it."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fctd.arrays import Array
from fctd.mechanics import derrick, state
from fctd.mechanics.topdrive import GRAVITY
from tests.bodies import AXIS, place, put
from tests.compiled import kept

part_immersed = kept(derrick.part_immersed)
TILT = Rotation.from_rotvec([0.3, -0.2, 0.5])
LENGTH, MASS, BUOYANCY = 10.0, 400.0, 600.0


def hung(*heights: float) -> Array:
    """Bodies of 10 m with their middles at heights below the table [m], under a vertical axis."""
    n = len(heights)
    S = state.new_state(n)
    put(S, 0, AXIS, [0.0, 0.0, 1.0])
    for j, z in enumerate(heights, start=1):
        place(S, j, Rotation.identity(), [0.0, 0.0, z])
    for row, value in (
        (state.ARM_TOP, 0.5 * LENGTH), (state.ARM_BOTTOM, 0.5 * LENGTH), (state.MASS, MASS),
        (state.BUOYANCY, BUOYANCY), (state.IN_MUD_AXIAL, 2.0), (state.IN_MUD_LATERAL, 6.0), (state.IN_MUD_SPIN, 0.5),
        (state.IMMERSED, 1.0), (state.WEIGHT, MASS * GRAVITY - BUOYANCY),
    ):  # fmt: skip
        state.row(S, row, n)[:] = value
    return S


def test_a_body_loses_buoyancy_and_mud_with_the_share_of_it_above_the_table() -> None:
    S = hung(-12.0, -2.0, 8.0, 18.0)
    S[state.MUD_AXIAL + 4] = 99.0  # below the first body that is wholly in mud nothing is touched
    derrick.put_immersed(S, 4)
    for row, expected in {
        state.IMMERSED: [0.0, 0.3, 1.0, 1.0],
        state.WEIGHT: MASS * GRAVITY - BUOYANCY * np.array([0, 0.3, 1, 1]),
        state.MUD_AXIAL: [0.0, 0.6, 2.0, 99.0],
        state.MUD_LATERAL: [0.0, 1.8, 6.0],
        state.MUD_SPIN: [0.0, 0.15, 0.5],
    }.items():
        np.testing.assert_allclose(state.row(S, row, len(expected)), expected)


def test_a_body_under_a_tilted_axis_passes_the_table_within_its_vertical_extent() -> None:
    S = hung(-2.0)
    put(S, 0, AXIS, [0.8, 0.0, 0.6])
    derrick.put_immersed(S, 1)
    assert S[state.IMMERSED + 1] == pytest.approx(0.5 - 2.0 / 6.0)


@pytest.mark.parametrize("height", [-7.0, -3.0, 0.5, 4.0, 9.0])
def test_weight_is_the_slope_of_the_energy(height: float) -> None:
    """A central difference of -W z + B h s (1 - s) over 2 mm, exact for a polynomial of second degree."""

    def energy(z: float) -> float:
        S = hung(z)
        derrick.put_immersed(S, 1)
        return float(part_immersed(S, 1)) - S[state.WEIGHT + 1] * z

    S = hung(height)
    derrick.put_immersed(S, 1)
    assert (energy(height - 1e-3) - energy(height + 1e-3)) / 2e-3 == pytest.approx(S[state.WEIGHT + 1], rel=1e-9)


def test_the_springs_of_a_joint_are_read_along_its_axis() -> None:
    S = state.new_state(2)
    axis = TILT.apply([0, 0, 1])
    for j, (distance, twist) in enumerate(((0.0, 0.0), (10.001, 0.2)), start=1):
        place(S, j, TILT * Rotation.from_rotvec([0, 0, twist]), distance * axis)
        S[state.ARM_TOP + j] = S[state.ARM_BOTTOM + j] = 5.0
    S[state.K_AXIAL + 2], S[state.K_SHEAR + 2] = 8e7, 1e7
    x, y, z, twist = derrick.read_joint(S, 2)
    np.testing.assert_allclose([x, y, z], -8e4 * axis, rtol=1e-9, atol=1e-4)
    assert twist == pytest.approx(0.2, rel=1e-12)
