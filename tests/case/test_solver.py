"""The tables of solver and record: defaults, and steps in words and in units."""

from pathlib import Path

import pytest

from fctd.case.load import load_case


def test_defaults(case_file: Path) -> None:
    case = load_case(case_file)
    assert (case.solver.step, case.solver.joint_damping) == ("auto", 1e-5)
    assert (case.record.interval, case.record.profile_at) == (1.0, ())


@pytest.mark.parametrize(("written", "step"), [("largest", "largest"), ("2 ms", 0.002), (0.001, 0.001)])
def test_a_step_is_a_word_or_a_time(case_file: Path, written: object, step: object) -> None:
    assert load_case(case_file, {"solver.step": written}).solver.step == step
