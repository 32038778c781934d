"""The rows of the buffer that a string fills: masses, arms, radii, damping, stiffness."""

from typing import Any

import numpy as np
import pytest

from fctd import Case
from fctd.mechanics import state
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.drillstring import lay_out
from fctd.model.string_in_hole import fill
from fctd.model.wellbore import build_wellbore
from fctd.simulation.preparation import prepare
from tests.cases import make_case, pipe, rotation


def test_filled_rows_by_hand() -> None:
    """From the top: three segments of pipe, a stabiliser that touches at its middle, two collars."""
    case = filled_case(pipe(None, None, segment_length=30.0))
    string = lay_out(case, 112.0)
    collar, blade, top = string.sections
    S = state.new_state(6)
    length = np.array([30, 30, 30, 2, 10, 10])
    fed = fill(S, string, case, build_wellbore(case), given=11.0 * length)
    left = 1 - squeezed(case, np.array([15, 45, 75, 91, 97, 107]))
    sections = [top, top, top, blade, collar, collar]
    expected = {
        state.MASS: [s.mass * m for s, m in zip(sections, length, strict=True)],
        state.WEIGHT: [s.weight * m for s, m in zip(sections, length, strict=True)],
        state.J_AXIAL: [s.axial_inertia * m for s, m in zip(sections, length, strict=True)],
        state.J_TRANSVERSE: [s.mass * m**3 / 12 + s.tilt_inertia * m for s, m in zip(sections, length, strict=True)],
        state.ARM_TOP: length / 2 * left,
        state.ARM_BOTTOM: length / 2 * left,
        state.ARM_CONTACT: [15, 15, 15, 0, 5, 5] * left,
        state.RADIUS: [0.0635, 0.0635, 0.0635, 0.1, 0.0795, 0.0795],
        state.TRIBUTARY: [30, 30, 16, 2, 10, 5],
        state.MUD_AXIAL: 3.0 * length,
        state.MUD_LATERAL: 5.0 * length,
        state.MUD_SPIN: 0.7 * length,
        state.GIVEN_FORCE: 11.0 * length,
    }
    for row, name in ((state.K_AXIAL, "EA"), (state.K_SHEAR, "shear"), (state.K_BEND, "EI"), (state.K_TWIST, "GJ")):
        p, b, c = (getattr(section, name) for section in (top, blade, collar))
        expected[row] = [p / 15, p / 30, p / 30, 1 / (15 / p + 1 / b), 1 / (1 / b + 5 / c), c / 10]
    check_rows(S, expected)
    assert fed == (
        top.mass, 0.0, top.axial_inertia, top.EA, top.GJ, top.EI, top.shear, 3.0, 5.0, 0.7, 0.0,
        pytest.approx(1 - left[0]), 0.0, 0.0,
    )  # fmt: skip
    # Stiffness of a point: every contact counts once.
    case = filled_case(pipe(None, None, segment_length=30.0), stiffness=1e7)
    fill(S, lay_out(case, 112.0), case, build_wellbore(case))
    np.testing.assert_array_equal(state.row(S, state.TRIBUTARY, 6), 1.0)


def test_filled_rows_below_a_long_segment_by_hand() -> None:
    """The pipe is one segment of 90 m: its springs have its whole length, its end half its weight and no arm below.

    Along it and in turning, its end has the mass of two of the longest segments below, 20 m, and its waves the rest.
    """
    case = filled_case(pipe(None, 1))
    string = lay_out(case, 112.0)
    collar, blade, top = string.sections
    left = 1 - squeezed(case, np.array([45, 91, 97, 107]))
    S = state.new_state(4)
    fed = fill(S, string, case, build_wellbore(case), given=11.0 * string.length)
    expected = {
        state.MASS: [top.mass * 20, blade.mass * 2, collar.mass * 10, collar.mass * 10],
        state.WEIGHT: [top.weight * 45, blade.weight * 2, collar.weight * 10, collar.weight * 10],
        state.J_AXIAL: [top.axial_inertia * 20, blade.axial_inertia * 2, *[collar.axial_inertia * 10] * 2],
        state.J_TRANSVERSE: [
            top.mass * 45 * 90**2 / 3,
            blade.mass * 8 / 12 + blade.tilt_inertia * 2,
            *[collar.mass * 1000 / 12 + collar.tilt_inertia * 10] * 2,
        ],
        state.ARM_TOP: [90, 1, 5, 5] * left,
        state.ARM_BOTTOM: [0, 1, 5, 5] * left,
        state.ARM_CONTACT: [0, 0, 5, 5] * left,
        state.RADIUS: [0.0635, 0.1, 0.0795, 0.0795],
        state.TRIBUTARY: [1, 2, 10, 5],
        state.MUD_AXIAL: [135, 6, 30, 30],
        state.MUD_LATERAL: [225, 10, 50, 50],
        state.MUD_SPIN: [31.5, 1.4, 7, 7],
        state.GIVEN_FORCE: [495, 22, 110, 110],
    }
    for row, name in ((state.K_AXIAL, "EA"), (state.K_SHEAR, "shear"), (state.K_BEND, "EI"), (state.K_TWIST, "GJ")):
        p, b, c = (getattr(section, name) for section in (top, blade, collar))
        expected[row] = [p / 90, b, 1 / (1 / b + 5 / c), c / 10]
    check_rows(S, expected)
    assert fed == (
        top.mass, top.weight, top.axial_inertia, top.EA, top.GJ, top.EI, top.shear, 3.0, 5.0, 0.7, 0.0,
        pytest.approx(1 - left[0]), 10.0, 11.0,
    )  # fmt: skip


def squeezed(case: Case, depth: np.ndarray) -> np.ndarray:
    """(1 − 2ν) p/E of steel with ν = 0.3 at depths (n,) [m] of the vertical hole."""
    return 0.4 * case.mud.density * GRAVITY * depth / 206.8e9


def filled_case(top: dict[str, Any], **stiffness: float) -> Case:
    """20 m of collars, a stabiliser of 2 m and a component above them, in damping mud."""
    mud = {"density": 1200, "axial_damping": 3.0, "lateral_damping": 5.0, "rotational_damping": 0.7}
    components = [pipe(20, 2, outer=0.159), pipe(2, 1, outer=0.2), top]
    return make_case(components=components, mud=mud, wellbore=stiffness or {"stiffness_per_length": 1e6})


def check_rows(S: np.ndarray, expected: dict[int, Any]) -> None:
    """Rows of the buffer, and the inverses of masses and inertias."""
    for inverse, of in (
        (state.INVERSE_MASS, state.MASS),
        (state.INVERSE_JT, state.J_TRANSVERSE),
        (state.INVERSE_JA, state.J_AXIAL),
    ):
        expected[inverse] = 1 / np.asarray(expected[of])
    for row, values in expected.items():
        np.testing.assert_allclose(state.row(S, row, len(values)), values, rtol=1e-12)


def test_tributary_length_for_stiffness_per_metre() -> None:
    case = make_case(
        components=[pipe(100, 10, outer=0.159), pipe(900, 30)],
        wellbore={"stiffness_per_length": 1e6},
        operations=[rotation(1000, 1)],
    )
    run, _ = prepare(case)
    tributary = state.row(run.S, state.TRIBUTARY, run.segments)
    np.testing.assert_allclose(tributary[[0, 28, 29, 30, -1]], [30, 30, 20, 10, 5])


def test_inertia_of_a_segment_by_hand() -> None:
    """A rigid hollow cylinder: m (L²/12 + (a² + b²)/4) across, m (a² + b²)/2 along."""
    run, _ = prepare(make_case(components=[pipe(1000, 500)], operations=[rotation(1000, 1)]))
    mass = 7850 * 8.819236e-3 * 2
    square = 0.0635**2 + 0.035**2
    for row, inverse, expected in (
        (state.MASS, state.INVERSE_MASS, mass),
        (state.J_TRANSVERSE, state.INVERSE_JT, mass * (4 / 12 + square / 4)),
        (state.J_AXIAL, state.INVERSE_JA, mass * square / 2),
    ):
        np.testing.assert_allclose(state.row(run.S, row, 500), expected, rtol=1e-6)
        np.testing.assert_allclose(state.row(run.S, inverse, 500), 1 / expected, rtol=1e-6)
