"""Rows that are left out by rule."""

from dataclasses import replace

import numpy as np
import pytest

from fctd.calibration.rules import left_out_by_rule, stretch_at_reversal
from fctd.model.section import section_of
from tests.calibration.wells import blank_rows, well
from tests.cases import make_case, pipe


def test_the_stretch_of_a_level_string_in_closed_form() -> None:
    """At s from the bit the tension is μws up and −μws down: ΔL = μwL²/EA, to one segment of 80."""
    case = make_case(
        [[0, 90, 0], [400, 90, 0]], [pipe(400, 80)],
        wellbore={"geometry": "arcs", "stiffness_per_length": 1e6}, rig={"block_weight": 1e6},
    )  # fmt: skip
    section = section_of(case.string.components[0], 0.0)
    assert stretch_at_reversal(case, 400.0) == pytest.approx(0.2 * section.weight * 400**2 / section.EA, rel=1 / 79)


def test_short_strokes_and_locked_torque_are_left_out() -> None:
    row = blank_rows(well())[0]
    stretch = stretch_at_reversal(well(), row.bit_depth)
    assert stretch > 0
    rows = [
        row, replace(row, stroke=3.01 * stretch), replace(row, stroke=2.99 * stretch),
        replace(row, locked_torque=1500.0), replace(blank_rows(well())[2], stroke=0.01),
    ]  # fmt: skip
    found = left_out_by_rule(rows, {"": well()})
    assert set(found) == {2, 3}
    assert "shorter than 3 times the string's stretch" in found[2]
    assert "1.5 kN·m locked" in found[3]
    assert np.isfinite(stretch)
