"""The steady solver near the bit and along the string: assemblies against beam theory, and stretch."""

import math
from typing import Any

import numpy as np
import pytest

import fctd
from fctd import Case
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.section import section_of
from tests.cases import make_case, pipe
from validation.studies import beam_in_hole

BIT = beam_in_hole.support(0.5)  # 0.25 m long, as wide as the hole


@pytest.mark.parametrize("cut", [1, 2, 3])
@pytest.mark.parametrize("segment", [0.5, 0.26, 0.25, 0.125])
def test_the_side_force_on_a_bit_does_not_depend_on_the_segments_above_it(segment: float, cut: int) -> None:
    """A pendulum, without zero slope at its bit: L⁴ = 24 EI r/w, H = wL/2 (Lubinski & Woods 1953)."""
    section, clearance = beam_in_hole.SECTION, 0.5 * (beam_in_hole.HOLE - beam_in_hole.COLLAR["outer_diameter"])
    length = (24 * section.EI * clearance / section.weight) ** 0.25
    point = beam_in_hole.solve([BIT | {"segments": cut}, beam_in_hole.part(59.75, segment)], 60.0)
    side = float(point.profile["contact_force_N"].iloc[-1])
    assert side == pytest.approx(0.5 * section.weight * length, rel=0.005)


@pytest.mark.parametrize("segment", [0.3, 0.26, 0.25, 0.2, 0.1])
def test_the_side_force_of_a_bent_housing_does_not_depend_on_the_segments(segment: float) -> None:
    """A cantilever bent 2 m above its free end, which the wall moves back: H = 3EI βa/L³."""
    angle, length, above = np.radians(0.5), 8.0, 2.0
    bent = beam_in_hole.part(above - 0.25, segment, bend=angle, toolface=np.pi / 2)
    bit = beam_in_hole.solve([BIT, bent, beam_in_hole.part(length - above, segment)], length).profile.iloc[-1]
    side = float(bit["contact_force_N"] * np.sin(np.radians(bit["contact_angle_deg"])))
    assert side == pytest.approx(3 * beam_in_hole.SECTION.EI * angle * above / length**3, rel=0.01)


def test_the_side_force_on_a_bit_with_segments_by_default() -> None:
    """The pendulum again, whose segments of 10 m at the bit gave 9 % more."""
    section, clearance = beam_in_hole.SECTION, 0.5 * (beam_in_hole.HOLE - beam_in_hole.COLLAR["outer_diameter"])
    length = (24 * section.EI * clearance / section.weight) ** 0.25
    point = beam_in_hole.solve([BIT, beam_in_hole.COLLAR | {"length": 59.75}], 60.0)
    side = float(point.profile["contact_force_N"].iloc[-1])
    assert side == pytest.approx(0.5 * section.weight * length, rel=0.02)


@pytest.mark.parametrize(("density", "stretch"), [(0.0, 2.2801), (1400.0, 1.7108), (2000.0, 1.4668)])
@pytest.mark.parametrize(
    "components", [[pipe(None, None, inner=0.10861)], [pipe(500, 10, inner=0.10861), pipe(None, 1, inner=0.10861)]]
)
def test_stretch_is_that_of_weight_and_pressure(
    density: float, stretch: float, components: list[dict[str, Any]]
) -> None:
    """wL²/2EA − (1 − 2ν) ∫p/E over 3,500 m of 5 in pipe: the mud squeezes the steel on all sides."""
    length = 3500.0
    case = make_case([[0, 0, 0], [3600, 0, 0]], components, mud={"density": density}, wellbore={"geometry": "arcs"})
    part = section_of(case.string.components[0], density)
    exact = part.weight * length**2 / (2 * part.EA) - 0.4 * density * GRAVITY * length**2 / 2 / 206.8e9
    found = float(fctd.equilibrium(case, "rotate_off_bottom", length).profile["md_m"].iloc[-1]) - length
    assert exact == pytest.approx(stretch, abs=1e-4)
    assert found == pytest.approx(exact, rel=1e-4)


def motor_case(collars: float, **motor: Any) -> Case:
    """A bent motor of 27 ft at full gauge below collars in segments of a length [m], in a build."""
    tool = pipe(None, None, outer=0.1715, inner=0.0714)
    parts = [
        tool | {"length": 8.23, "contact_diameter": 0.2127, "bend": math.radians(1.15)} | motor,
        tool | {"length": 82.3, "segment_length": collars},
        pipe(None, None, contact_diameter=0.168, segment_length=10.0),
    ]
    interval = {"to_md": 1300.0, "diameter": 0.2159, "friction": 0.3}
    hole = {"geometry": "arcs", "stiffness": None, "stiffness_per_length": 1e7, "intervals": [interval]}
    stations = [[0, 0, 0], [400, 0, 0], [800, 60, 0], [1300, 60, 0]]
    return make_case(stations, parts, mud={"density": 1200.0}, wellbore=hole)


def torque_of(case: Case) -> float:
    return fctd.equilibrium(case, "rotate_off_bottom", 1300.0, rpm=60.0).surface_torque


def test_a_motor_of_one_segment_does_not_feel_the_length_of_its_neighbours() -> None:
    """Collars in segments a little longer than the motor had taken the wall from its upper end."""
    torques = [torque_of(motor_case(82.3 / count, segments=1)) for count in (9, 10, 11)]
    assert max(torques) < 1.001 * min(torques)


def test_the_torque_of_a_motor_converges_with_its_segments() -> None:
    coarse, fine, finest = (torque_of(motor_case(2.0, segments=count)) for count in (4, 8, 16))
    assert abs(finest / fine - 1) < 0.01
    assert abs(finest - fine) < abs(fine - coarse)


def test_the_torque_that_holds_a_bend_is_nothing_on_the_mean_of_a_turn() -> None:
    """Over a turn the drive puts in what wall, mud and bit take; at each toolface a note says what the bend has.

    Nearly: the wall also rubs on what the bend moves across the hole, which a string at one toolface does not do.
    """
    case = motor_case(2.0, segments=4, segment_length=None)
    case = case.model_copy(update={"bit": case.bit.model_copy(update={"torque": 500.0})})
    case = case.model_copy(update={"mud": case.mud.model_copy(update={"rotational_damping": 0.05})})
    motor, *others = case.string.components
    found, lost = [], []
    for toolface in np.arange(8) * 0.25 * np.pi:
        parts = (motor.model_copy(update={"toolface": float(toolface)}), *others)
        of = case.model_copy(update={"string": case.string.model_copy(update={"components": parts})})
        point = fctd.equilibrium(of, "drill_rotating", 1300.0, rpm=60.0)
        mud = 0.05 * 2 * np.pi * 1300.0
        found.append(point.surface_torque)
        lost.append(point.sum_r_ft + 500.0 + mud)
        note = next((note for note in point.notes if note.code == "bent"), None)
        assert (note is not None) == (abs(found[-1] / lost[-1] - 1) > 0.01)
        if note is not None:
            assert f"take {lost[-1] / 1e3:.3g} kN·m" in str(note)
    swing = max(found) - min(found)
    assert swing > 500.0
    assert np.mean(found) == pytest.approx(np.mean(lost), abs=0.15 * swing)
    assert "bent" not in [note.code for note in fctd.equilibrium(case, "trip_out", 1300.0).notes]
