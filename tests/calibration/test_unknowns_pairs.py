"""Friction along and around the hole as two unknowns: weights show one, torques the other."""

from dataclasses import replace
from pathlib import Path

import pytest

import fctd
from fctd.calibration.calibrate import calibrate
from fctd.calibration.calibrated_file import write_calibrated
from fctd.calibration.rows import Row
from fctd.calibration.unknowns import with_values
from fctd.case.errors import InputError
from tests.calibration.wells import blank_rows, measured_rows, well

CASE = well()
TRUE = {
    "friction.cased": 0.18, "friction.open.axial": 0.35, "friction.open.rotational": 0.2, "rig.block_weight": 230e3,
    "rig.torque_offset": 800.0,
}  # fmt: skip
WRITTEN = """name = "well"
[wellbore]
stations = [[0, 0, 0], [300, 0, 0], [700, 60, 0], [1500, 60, 0]]
geometry = "arcs"
[[wellbore.intervals]]
to_md = 900
diameter = 0.2205
friction = 0.2
kind = "cased"
[[wellbore.intervals]]
to_md = 1500
diameter = 0.2159
friction = 0.3
kind = "open"
[[string.components]]
name = "pipe"
outer_diameter = 0.127
inner_diameter = 0.1086
segment_length = 50
[rig]
block_weight = "250 kN"
"""


def rows(case: fctd.Case = CASE, days: bool = False) -> list[Row]:
    found = measured_rows(case, TRUE, blank_rows(case), None)
    return [
        replace(row, torque=row.torque if row.rates.spin else None, day=f"{row.bit_depth:g} m" if days else "")
        for row in found
    ]


def test_values_go_to_their_keys() -> None:
    one, two = with_values(CASE, TRUE).wellbore.intervals
    assert (one.friction, one.rotational_friction) == (0.18, None)
    assert (two.friction, two.rotational_friction) == (0.35, 0.2)
    alone = with_values(CASE, {"friction.open.rotational": 0.1}).wellbore.intervals[1]
    assert (alone.friction, alone.rotational_friction) == (0.3, 0.1)


@pytest.mark.slow
@pytest.mark.parametrize("days", [False, True])
def test_both_factors_are_found(days: bool) -> None:
    found = calibrate(CASE, rows(days=days), [*TRUE], starts=1)
    for name, value in TRUE.items():
        assert found.values[name] == pytest.approx(value, rel=0.15 if days else 1e-3)  # with days, priors draw
    table = found.factors.set_index(["hole", "motion"])
    assert len(table) == 4
    assert table.loc[("open hole", "sliding"), "unknown"] == "friction.open.axial"
    assert table.loc[("open hole", "rotating"), "unknown"] == "friction.open.rotational"


def test_overlaps_and_pairs_are_refused() -> None:
    with pytest.raises(InputError, match=r"one friction factor for an interval, friction or friction\.open\.axial"):
        calibrate(CASE, rows(), ["friction", "friction.open.axial"])
    for given, lacking in (
        ([], ""),
        (["friction.open.axial"], ".rotational"),
        (["friction.open.rotational"], ".axial"),
    ):
        with pytest.raises(InputError, match=rf"also friction\.open{lacking}, which a gradient needs"):
            calibrate(CASE, rows(), [*given, "friction.open.gradient"])
    pair = with_values(CASE, TRUE)
    with pytest.raises(InputError, match=r"friction\.open\.axial and friction\.open\.rotational, since the case has a"):
        calibrate(pair, rows(), ["friction.open"])


def test_a_pair_is_written_and_predicts(tmp_path: Path) -> None:
    file, out = tmp_path / "well.toml", tmp_path / "new.toml"
    file.write_text(WRITTEN, encoding="utf-8")
    case = fctd.load_case(file)
    found = calibrate(case, rows(case), [*TRUE], starts=1, loss="linear")
    write_calibrated(found, file, {}, out)
    again = fctd.load_case(out)
    assert again.wellbore.intervals[1].friction == pytest.approx(0.35, rel=1e-3)
    assert again.wellbore.intervals[1].rotational_friction == pytest.approx(0.2, rel=1e-3)
    bands = fctd.predict(again, rows(case))
    assert bands["predicted"].tolist() == pytest.approx(found.fit.evaluation.value.tolist(), rel=1e-6)


@pytest.mark.parametrize("name", ["friction.open.axial", "friction.open.rotational", "friction[1].axial"])
def test_the_written_case_is_the_fitted_one_where_one_direction_alone_is_fitted(name: str, tmp_path: Path) -> None:
    (tmp_path / "well.toml").write_text(WRITTEN, encoding="utf-8")
    case = fctd.load_case(tmp_path / "well.toml")
    found = calibrate(case, rows(case), [name], starts=1, scatter=False)
    write_calibrated(found, tmp_path / "well.toml", {}, tmp_path / "new.toml")
    written, fitted = fctd.load_case(tmp_path / "new.toml").wellbore.intervals[1], found.case.wellbore.intervals[1]
    assert written.friction == pytest.approx(fitted.friction, rel=1e-5)
    assert written.friction_around == pytest.approx(fitted.friction_around, rel=1e-5)
    assert written.friction != written.friction_around
