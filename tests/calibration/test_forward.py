"""Readings of rows: the engine's own answers, the rig's constants, and derivatives against differences."""

from dataclasses import replace

import numpy as np
import pytest

from fctd.calibration.forward import Forward
from fctd.calibration.rows import Range, Row
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import find_unknowns, parse_fits, with_values
from fctd.model.operations import SteadyRates
from fctd.steady.equilibrium import equilibrium
from tests.calibration.wells import TRUTH, TURN, blank_rows, well
from tests.cases import make_case, pipe

ALL = [*TRUTH, "rig.guide_friction", "mass.collars", "mud.density", "bias.hookload.DDR", "bias.torque.DDR"]
SETUP = Setup.model_validate({"sources": {"DDR": {"reading": "peak"}}})


def forward_of(rows: list[Row], names: list[str], setup: Setup = SETUP) -> Forward:
    return Forward(rows, {"": well()}, find_unknowns(parse_fits(names), setup, [well()]), setup)


def test_readings_are_those_of_the_engine() -> None:
    case = well(rig={"block_weight": 230e3, "sheave_efficiency": 0.97, "torque_offset": 800.0, "torque_per_rpm": 8.0})
    rows = blank_rows(case)[:3]
    forward = forward_of(rows, ["rig.block_weight", "rig.sheave_efficiency", "rig.torque_offset", "rig.torque_per_rpm"])
    found = forward.evaluate(np.array([230e3, 0.97, 800.0, 8.0]))
    for reading, value in zip(forward.readings, found.value, strict=True):
        row = rows[reading.row]
        point = equilibrium(case, row.operation, row.bit_depth, rpm=row.rates.spin / TURN or None)
        expected = point.weight_indicator if reading.load == "hookload" else point.drive_torque
        assert value == pytest.approx(expected, rel=1e-9)


def test_a_mass_is_that_of_resolved_joints() -> None:
    """Tool joints and bodies weigh together what the unknown says."""
    joint = {"length": 10.0, "tool_joint_length": 0.5, "tool_joint_diameter": 0.165}
    parts = [pipe(100, 4, name="collars"), pipe(None, None, joint=joint, joint_segments=2, name="drill pipe")]
    case = make_case(components=parts, rig={"block_weight": 250e3})
    (row,) = [one for one in blank_rows(case) if one.operation == "trip_in" and one.bit_depth == 700]
    names = ["mass.drill pipe"]
    forward = Forward([row], {"": case}, find_unknowns(parse_fits(names), Setup(), [case]), Setup())
    assert forward.length_in_hole("mass.drill pipe", row) == pytest.approx(600.0)
    found = forward.evaluate(np.array([40.0]))
    k = [reading.load for reading in forward.readings].index("hookload")
    assert found.slopes[k, 0] == pytest.approx(600 * 9.80665, rel=1e-3)
    heavier = forward.evaluate(np.array([41.0])).value[k] - found.value[k]
    assert heavier == pytest.approx(600 * 9.80665, rel=1e-3)


def test_in_slips_the_block_hangs_alone_and_a_tare_turns_the_free_drive() -> None:
    rows = [replace(row, source="DDR") for row in blank_rows(well())[-2:]]
    forward = forward_of(rows, ALL)
    values = np.array([u.start for u in forward.unknowns])
    values[forward.names.index("rig.torque_offset")] = 800.0
    values[forward.names.index("rig.torque_per_rpm")] = 8.0
    values[-2:] = 5e3, 50.0
    # At rest a peak has no bias of the hook load.
    assert forward.evaluate(values).value == pytest.approx([250e3, 250e3, 800.0 + 8.0 * 60 + 50.0])


def test_a_peak_carries_its_bias_in_the_direction_of_motion() -> None:
    rows = [replace(row, source="DDR") for row in blank_rows(well())[:3]]
    forward = forward_of(rows, ["bias.hookload.DDR"])
    by_bias = forward.evaluate(np.zeros(1)).slopes[::2, 0]
    assert by_bias.tolist() == [1.0, -1.0, 0.0]  # up, down, rotating
    median = forward_of(rows, ["bias.hookload.DDR"], Setup())
    assert median.evaluate(np.zeros(1)).slopes[::2, 0].tolist() == [1.0, 1.0, 1.0]


def test_derivatives_equal_central_differences_of_full_solves() -> None:
    rows = [replace(row, source="DDR") for row in (*blank_rows(well())[-5:-2], blank_rows(well())[-1])]
    forward = forward_of(rows, ALL)
    values = np.array([u.start for u in forward.unknowns])
    values[forward.names.index("rig.sheave_efficiency")] = 0.96
    slopes = forward.evaluate(values).slopes
    for k, unknown in enumerate(forward.unknowns):
        ends = []
        for side in (1, -1):
            moved = values.copy()
            moved[k] += side * 1e-3 * unknown.size
            ends.append(forward.evaluate(moved).value)
        expected = (ends[0] - ends[1]) / (2e-3 * unknown.size)
        # Readings of other loads than the unknown's own do not change beyond the solver's tolerance.
        assert slopes[:, k] == pytest.approx(expected, rel=2e-4, abs=1e-4 * np.abs(expected).max()), unknown.name


def test_a_string_without_loads_has_a_reason_and_no_numbers() -> None:
    """A wall so soft that the string lies deeper in it than the hole's radius."""
    soft = make_case([[0, 90, 0], [200, 90, 0]], [pipe(None, None, segment_length=20.0)], wellbore={"stiffness": 1e3})
    row = Row("down", "", 200.0, "trip_in", SteadyRates(0.3, 0.0))
    forward = Forward([row], {"": soft}, find_unknowns(parse_fits(["friction"]), SETUP, [soft]), SETUP)
    found = forward.evaluate(np.array([0.2]))
    assert found.reasons[0].startswith("locked_up: slack-off is spent")
    assert np.isnan(found.value).all()


def test_loads_of_a_string_that_is_not_converged_carry_a_doubt() -> None:
    """At a friction of 1 a level string must be pushed with more than the block weighs."""
    level = make_case([[0, 90, 0], [200, 90, 0]], [pipe(None, None, segment_length=20.0)])
    row = Row("down", "", 200.0, "trip_in", SteadyRates(0.3, 0.0))
    forward = Forward([row], {"": level}, find_unknowns(parse_fits(["friction=0:2"]), SETUP, [level]), SETUP)
    found = forward.evaluate(np.array([1.0]))
    assert found.doubts[0].startswith("locked_up: ")
    assert np.isfinite(found.value).all()


def test_constants_of_the_rig_solve_nothing_again() -> None:
    forward = forward_of(blank_rows(well())[:1], ["friction", "rig.block_weight"])
    first = forward.evaluate(np.array([0.2, 250e3]))
    kept = dict(forward._kept)
    second = forward.evaluate(np.array([0.2, 260e3]))
    assert forward._kept == kept
    assert second.value[0] - first.value[0] == pytest.approx(10e3)


def test_a_bit_on_bottom_adds_to_torque_and_noise() -> None:
    off = blank_rows(well())[-1]
    rows = [off, replace(off, id="on", torque_read="on_bottom", torque=Range(5e3, 5e3))]
    setup = Setup.model_validate({"sources": {"": {"torque_resolution": "1 kN*m"}}, "bit_torque": {"mean": 4e3}})
    unknowns = find_unknowns(parse_fits(["rig.torque_offset"]), setup, [well()])
    forward = Forward(rows, {"": well()}, unknowns, setup)
    value = forward.evaluate(np.array([800.0])).value
    assert value[3] - value[1] == 4e3
    assert forward.readings[3].noise == pytest.approx(np.hypot(500.0, 2e3))
    assert forward.readings[3].range == (4.5e3, 5.5e3)


def test_some_rows_are_solved_alone() -> None:
    rows = blank_rows(well())
    names = ["friction.cased", "friction.open", "rig.sheave_efficiency"]
    forward = Forward(rows, {"": well()}, find_unknowns(parse_fits(names), Setup(), [well()]), Setup())
    values = np.array([0.2, 0.3, 0.95])
    part, whole = forward.of_rows([1, 4]).evaluate(values), forward.evaluate(values)
    assert np.array_equal(part.value, whole.value[[2, 3, 8, 9]])
    assert np.array_equal(part.slopes, whole.slopes[[2, 3, 8, 9]])
    gains = forward.gains(values)
    assert gains[:4] == pytest.approx([0.95, 0.0, 1 / 0.95, 0.0])


def test_fluids_by_depth_stay_beside_an_unknown_density() -> None:
    """Air inside a floated string, outside which the mud is of the density that is fitted."""
    case = well(mud={"density": 1200.0, "inside": [{"density": 0.0}], "float": True})
    rows, names = blank_rows(case)[:3], ["mud.density", "mass.collars"]
    forward = Forward(rows, {"": case}, find_unknowns(parse_fits(names), SETUP, [case]), SETUP)
    found = forward.evaluate(np.array([1300.0, 90.0]))
    changed = with_values(case, {"mud.density": 1300.0, "mass.collars": 90.0})
    for reading, value in zip(forward.readings, found.value, strict=True):
        row = rows[reading.row]
        point = equilibrium(changed, row.operation, row.bit_depth, rpm=row.rates.spin / TURN or None)
        expected = point.weight_indicator if reading.load == "hookload" else point.drive_torque
        assert value == pytest.approx(expected, rel=1e-9, abs=1e-3)
    # The mud lifts what the string encloses: a heavier one takes weight off, mass adds it.
    lifted, heavier = found.slopes[0]
    assert lifted < 0 < heavier
