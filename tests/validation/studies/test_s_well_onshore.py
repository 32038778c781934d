"""The onshore S-well: what fits judges nothing, and rows that are not asked for are not read."""

from pathlib import Path

import pytest

from tests.cases import make_case
from validation.parts.judged_well import ONE_FACTOR, STIFF
from validation.parts.s_well import FIT, FOLDER, JUDGED, KLBF, measured_rows, setup_of


def test_no_depth_both_fits_and_judges() -> None:
    assert max(FIT) < min(JUDGED)
    assert (len(FIT), len(JUDGED)) == (6, 7)


def test_depths_that_are_not_asked_for_are_dropped(tmp_path: Path) -> None:
    (tmp_path / FOLDER).mkdir()
    table = "MD_ft,PickUp_Klbs,Slackoff_Klbs,Rotating_Klbs\n1351,90,80,85\n1604,100,,95\n3056,1e9,1e9,1e9\n"
    (tmp_path / FOLDER / "measured.csv").write_text(table, encoding="utf-8")
    rows = measured_rows(tmp_path, make_case(), (1351, 1604))
    assert [row.id for row in rows] == [
        "1351 ft up", "1351 ft down", "1351 ft rotating", "1604 ft up", "1604 ft rotating"
    ]  # fmt: skip
    assert rows[0].hookload is not None
    assert rows[0].hookload.middle == pytest.approx(90 * KLBF)
    assert rows[0].bit_depth == pytest.approx(411.8, abs=0.05)
    assert {row.day for row in rows} == {"1351 ft", "1604 ft"}


def test_without_torque_a_pair_is_one_factor_for_each_hole() -> None:
    """One factor is then one number for the whole hole."""
    assert "friction.cased.axial" in setup_of(STIFF).unknowns
    assert [name for name in setup_of(ONE_FACTOR).unknowns if name.startswith("friction")] == ["friction"]
    assert setup_of(STIFF).scatter.friction > 0.1
