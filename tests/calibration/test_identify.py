"""What rows cannot tell apart: known pairs by name, priors that hold them, and sets without a flag."""

import numpy as np
import pytest

from fctd.calibration.calibrate import calibrate
from fctd.calibration.forward import Forward
from fctd.calibration.identify import covariance_of, information, refuse, undetermined
from fctd.calibration.rows import Range
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import find_unknowns, parse_fits
from fctd.case.errors import InputError
from tests.calibration.wells import TRUTH, exact_rows, well

CASE = well()
UP, DOWN, TURN = 6, 7, 8  # at 1500 m
SLIPS, TARE = 9, 10


def flagged(rows: list[int], names: list[str], *priors: str) -> list[tuple[str, ...]]:
    forward = Forward(
        [exact_rows()[k] for k in rows], {"": CASE}, find_unknowns(parse_fits(names, priors), Setup(), [CASE]), Setup()
    )
    at = np.array([unknown.start for unknown in forward.unknowns])
    return [found.names for found in undetermined(forward, forward.evaluate(at), range(len(rows)))]


@pytest.mark.parametrize(
    ("rows", "pair", "others", "prior"),
    [
        ([UP, DOWN, TURN], ("rig.sheave_efficiency", "rig.guide_friction"), ["friction"], "rig.guide_friction=0+-1e3"),
        ([2], ("friction.cased", "rig.torque_offset"), [], "rig.torque_offset=0+-100"),
        ([UP, DOWN, TURN], ("rig.block_weight", "mass.collars"), ["friction"], "rig.block_weight=230e3+-1e4"),
        ([TARE], ("rig.torque_offset", "rig.torque_per_rpm"), [], "rig.torque_per_rpm=8+-1"),
    ],
)
def test_a_pair_is_named_unless_a_prior_holds_it(
    rows: list[int], pair: tuple[str, str], others: list[str], prior: str
) -> None:
    assert flagged(rows, [*pair, *others]) == [pair]
    assert flagged(rows, [*pair, *others], prior) == []


def test_rows_that_separate_a_pair_lift_its_flag() -> None:
    assert flagged([UP, DOWN, TURN, SLIPS], ["rig.block_weight", "mass.collars", "friction"]) == []
    assert flagged([2, TARE], ["friction.cased", "rig.torque_offset"]) == []
    assert flagged(list(range(len(exact_rows()))), list(TRUTH)) == []


def test_an_unknown_without_effect_is_named_alone() -> None:
    assert flagged([0, 1, 2], ["friction.cased", "friction.open"]) == [("friction.open",)]  # the bit is in the casing


def test_the_calibration_refuses_before_it_fits_unless_told_otherwise() -> None:
    rows, names = [exact_rows()[TARE]], ["rig.torque_offset", "rig.torque_per_rpm"]
    with pytest.raises(
        InputError, match=r"fit = .*cannot be told apart: they need rotating rows or tares at different"
    ):
        calibrate(CASE, rows, names)
    found = calibrate(CASE, rows, names, refuse=False, starts=1)
    assert [one.names for one in found.undetermined] == [tuple(names)]
    refuse([])


def test_the_covariance_in_closed_form() -> None:
    """Two readings of one value: half the variance; no reading: a standard deviation of a million sizes."""
    C = covariance_of(np.array([[0.5, 0.0], [0.5, 0.0]]), np.array([2.0, 3.0]))
    assert pytest.approx(np.diag([2.0, (3e6) ** 2])) == C


def test_a_range_informs_as_a_uniform_distribution_does() -> None:
    row = exact_rows()[SLIPS]
    wide = [row.__class__(**{**row.__dict__, "hookload": Range(200e3, 200e3 + 10e3 * np.sqrt(36))})]
    forward = Forward(wide, {"": CASE}, find_unknowns(parse_fits(["rig.block_weight"]), Setup(), [CASE]), Setup())
    J = information(forward, forward.evaluate(np.array([2e5])), [0])
    assert pytest.approx(np.array([[1 / (10e3 * 2)]])) == J  # √(1 + 36/12) times the noise
