"""Friction that is linear in depth: pieces of intervals, the choice by days left out, and the file."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import fctd
from fctd.calibration.calibrate import calibrate
from fctd.calibration.calibrated_file import write_calibrated
from fctd.calibration.gradient import PIECES, in_pieces, multipliers
from fctd.calibration.rows import Row
from fctd.calibration.unknowns import with_values
from fctd.case.errors import InputError
from fctd.model.operations import steady_rates
from tests.calibration.wells import measured_rows, well

CASE = well()
NAMES = ("friction.cased", "friction.open", "friction.open.gradient", "rig.block_weight")
TRUE = {"friction.cased": 0.2, "friction.open": 0.3, "rig.block_weight": 230e3}


def rows_at(gradient: float) -> list[Row]:
    """Up and down at eight depths, a day each, with friction that grows with depth in the open hole."""
    rows = [
        Row(f"{kind} {depth:g}", "", depth, kind, steady_rates(CASE, kind), day=f"{depth:g}")
        for depth in np.linspace(800.0, 1500.0, 8).tolist() for kind in ("trip_out", "trip_in")
    ]  # fmt: skip
    made = with_values(in_pieces(CASE, NAMES), {"friction.open": 0.3, "friction.open.gradient": gradient})
    truth = TRUE if not gradient else {"friction.cased": 0.2, "rig.block_weight": 230e3}
    found = measured_rows(made, truth, rows, 2)
    return [replace(row, torque=None) for row in found]


def test_an_interval_in_pieces_has_the_same_hole() -> None:
    cut = in_pieces(CASE, NAMES).wellbore.intervals
    assert [interval.kind for interval in cut] == ["cased", *["open"] * PIECES]
    assert np.diff([interval.to_md for interval in cut]) == pytest.approx(600.0 / PIECES)
    assert {interval.diameter for interval in cut[1:]} == {0.2159}
    assert in_pieces(in_pieces(CASE, NAMES), NAMES).wellbore.intervals == cut
    assert in_pieces(CASE, ["friction.open"]) is CASE


def test_the_factor_is_linear_in_depth() -> None:
    case = in_pieces(CASE, NAMES)
    values = {"friction.open": 0.3, "friction.open.gradient": 0.5}
    factors = [interval.friction for interval in with_values(case, values).wellbore.intervals]
    assert factors[0] == 0.2
    assert factors[1:] == pytest.approx(np.linspace(0.3 * 0.55, 0.3 * 1.45, PIECES))
    assert with_values(with_values(case, values), values) == with_values(case, values)
    assert multipliers(CASE, {"friction.open.gradient": 0.5}) == [1.0, 1.0]


@pytest.mark.slow
def test_days_left_out_choose() -> None:
    found = calibrate(CASE, rows_at(0.8), NAMES, starts=1)
    assert found.scores["linear in depth"] > found.scores["constant"]
    table = found.table.set_index("name")
    assert table.loc["friction.open.gradient", "low"] < 0.8
    assert table.loc["friction.open.gradient", "low"] > 0.1
    flat = calibrate(CASE, rows_at(0.0), NAMES, starts=1)
    assert flat.scores["constant"] > flat.scores["linear in depth"]
    assert "friction.open.gradient" not in flat.values
    assert len(flat.case.wellbore.intervals) == 2


def test_a_gradient_needs_its_factor_and_its_kind() -> None:
    with pytest.raises(InputError, match=r"also friction\.open, which a gradient needs"):
        calibrate(CASE, rows_at(0.0), ["friction.open.gradient"])
    with pytest.raises(InputError, match=r"expected the unknown friction\.cased\.gradient"):
        calibrate(well(), rows_at(0.0), ["friction.lined.gradient", "friction.open"])


@pytest.mark.slow
def test_a_case_with_a_gradient_is_written_and_predicts(tmp_path: Path) -> None:
    file = tmp_path / "well.toml"
    file.write_text(
        'name = "well"\n[wellbore]\nstations = [[0, 0, 0], [300, 0, 0], [700, 60, 0], [1500, 60, 0]]\n'
        'geometry = "arcs"\n[[wellbore.intervals]]\nto_md = "900 m"\ndiameter = 0.2205\nfriction = 0.2\n'
        'kind = "cased"\n'
        '[[wellbore.intervals]]\nto_md = "1500 m"\ndiameter = 0.2159\nfriction = 0.3  # guessed\nkind = "open"\n'
        '[[string.components]]\nname = "pipe"\nouter_diameter = 0.127\ninner_diameter = 0.1086\nsegment_length = 50\n',
        encoding="utf-8",
    )
    case = fctd.load_case(file)
    fits = ["friction.open", "friction.open.gradient"]
    priors = ["friction.open=0.3+-0.05", "friction.open.gradient=0.5+-0.1"]
    rows = [replace(row, day="") for row in rows_at(0.8)]
    found = calibrate(case, rows, fits, priors=priors, starts=1, loss="linear", refuse=False)
    out = tmp_path / "new.toml"
    write_calibrated(found, file, {}, out)
    again = fctd.load_case(out)
    assert [i.to_md for i in again.wellbore.intervals] == pytest.approx(
        [i.to_md for i in found.case.wellbore.intervals]
    )
    assert [i.friction for i in again.wellbore.intervals] == pytest.approx(
        [i.friction for i in found.case.wellbore.intervals], rel=1e-5
    )
    assert 'to_md = "960 m"' in out.read_text(encoding="utf-8")
    bands = fctd.predict(again, rows[:2])
    assert bands["predicted"].tolist() == pytest.approx(found.fit.evaluation.value[:4].tolist(), rel=1e-6)
