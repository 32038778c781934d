"""Notes on the hook load of a run: each bound from both sides."""

import pytest

from fctd.results.run_notes import brakes_turning, flutters, pushes


@pytest.mark.parametrize(
    ("mean", "least", "block", "excess"),
    [
        (20e3, -40e3, 0.0, None),  # a wave passes the top: less than a tenth of the weight of 500 kN
        (20e3, -60e3, 0.0, 3.0),  # 10 kN beyond that, twice a hundredth of the weight
        (-4e3, -4e3, 0.0, None),  # within a hundredth of the weight
        (-15e3, -16e3, 0.0, 3.0),
        (-95e3, -140e3, 90e3, None),  # the block weighs as much
        (-185e3, -190e3, 90e3, 2.0),
    ],
)
def test_a_string_pushed_beyond_the_weight_of_the_block(
    mean: float, least: float, block: float, excess: float | None
) -> None:
    note = pushes(mean, least, block, 500e3)
    if excess is None:
        assert note is None
        return
    assert note is not None
    assert (note.code, note.excess) == ("push", pytest.approx(excess))
    assert f"falls to {least / 1e3:.3g} kN in a step and is {mean / 1e3:.3g} kN on the mean" in note.text
    assert f"can push with {block / 1e3:.3g} kN" in note.text


@pytest.mark.parametrize(
    ("amplitude", "frequency", "axial", "noted"),
    [
        (20e3, 15.0, 0.6, True),
        (9.9e3, 15.0, 0.6, False),  # below a fiftieth of the weight
        (20e3, 8.9, 0.6, False),  # slower than half the frequency of a segment on the wall
        (20e3, 15.0, 5.1, False),  # a low axial frequency of a short string
    ],
)
def test_a_hook_load_that_flutters(amplitude: float, frequency: float, axial: float, noted: bool) -> None:
    note = flutters(amplitude, frequency, 18.0, axial, 500e3)
    assert (note is not None) == noted
    if note is not None:
        assert (note.code, note.excess) == ("flutter", pytest.approx(2.0))
        assert "±20 kN at some 15 Hz" in note.text


def test_joint_damping_that_brakes_a_turning_string() -> None:
    assert brakes_turning(9.9, -1000.0) is None
    note = brakes_turning(50.0, -1000.0)
    assert note is not None
    assert (note.code, note.excess) == ("joint_damping", pytest.approx(5.0))
    assert "takes 50 N m of the torque of the turning string, 5 % of it" in note.text
    assert brakes_turning(0.0, 0.0) is None
