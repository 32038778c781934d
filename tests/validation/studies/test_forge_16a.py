"""The well of FORGE: what fits judges nothing, strings from lists that contradict themselves, and frozen mixtures."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from fctd.calibration.quadrature import Mixture
from fctd.calibration.rows import Range
from fctd.model.operations import rad_per_s
from tests.cases import make_case
from validation.parts import forge_16a as split
from validation.parts.forge_16a_fits import MODELS, base_setup, chosen, read_frozen, setup_of, together
from validation.parts.forge_16a_rows import TORQUE, pumps, report_rows
from validation.parts.forge_16a_strings import (
    FOLDER,
    FOOT,
    GRAVITY,
    HEAVY_PIPE,
    INCH,
    POUND_FOOT,
    POUND_FORCE,
    STEEL,
    Assembly,
    assembly_of,
)  # fmt: skip
from validation.parts.judged_well import ONE_FACTOR, STIFF

READINGS = "date,bit_md_ft,bha,rot_lbf,pu_lbf,so_lbf,torque_ftlbf\n"


def test_no_row_both_fits_and_judges() -> None:
    assert not set(split.FIT) & {*split.JUDGED, *split.APART}
    assert not set(split.JUDGED) & set(split.APART)
    assert set(split.TARE) <= set(split.FIT)


def test_the_frozen_values_are_of_the_rows_that_fit() -> None:
    fits = read_frozen()
    assert set(MODELS) <= set(fits)
    for name in MODELS:
        assert {row.split()[0] for row in fits[name].rows} == set(split.FIT)


def test_priors_of_friction_and_scatter_are_those_of_another_well() -> None:
    found = base_setup()
    prior = found.unknowns["friction.cased.axial"].prior
    assert prior is not None
    assert 0.1 < float(prior.mean) < 0.4
    assert found.scatter.hookload > 3e3


def report(length: float = 100.0, air: str = "", mud: str = "", density: str = "9.0") -> "pd.Series[str]":
    return pd.Series({"hole_in": "8.75", "bha_length_ft": f"{length:g}", "mw_ppg": density, "bha_air_lbf": air,
                      "bha_mud_lbf": mud})  # fmt: skip


def listed(*rows: tuple[str, str, str, float]) -> pd.DataFrame:
    return pd.DataFrame(rows, columns=["component", "od_in", "id_in", "length_ft"])


COLLARS = ("Drill Collar-collars", "6.5", "3", 100.0)
WEIGHT = 0.25 * np.pi * INCH**2 * (6.5**2 - 3**2) * STEEL * GRAVITY * 100.0 * FOOT  # [N]


def test_masses_follow_from_dimensions_where_nothing_is_printed() -> None:
    found = assembly_of("7000", report(), listed(COLLARS), None)
    assert found.weight == pytest.approx(WEIGHT)
    assert found.linear_mass[0] == pytest.approx(WEIGHT / GRAVITY / (100.0 * FOOT))
    assert found.remarks == ("no weight printed",)


def printed(factor: float, before: Assembly | None = None, length: float = 100.0) -> Assembly:
    """Collars with a printed weight of 8,000 lbf in air, and in mud the share that buoyancy leaves times a factor."""
    left = 1 - 9.0 * 119.826427316897 / STEEL
    row = report(length, "8000", f"{8000 * left * factor:.1f}")
    return assembly_of("7000", row, listed((*COLLARS[:3], length)), before)


def test_a_printed_weight_counts_where_its_ratio_is_that_of_buoyancy() -> None:
    air = 8000 * POUND_FORCE
    good, bad = printed(1.009), printed(1.011)
    assert abs(good.weight - air) < 0.3 * abs(WEIGHT - air)
    assert abs(bad.weight - air) > 0.7 * abs(WEIGHT - air)
    assert good.sd < bad.sd
    assert any("buoyancy" in remark for remark in bad.remarks)


def test_a_weight_that_was_carried_over_from_another_assembly_does_not_count() -> None:
    before = printed(1.0, length=110.0)
    assert any("report before" in remark for remark in printed(1.0, before).remarks)
    assert not any("report before" in remark for remark in printed(1.0, printed(1.0)).remarks)
    assert printed(1.0, before).sd > printed(1.0).sd


def test_weights_below_a_thousand_are_thousands_of_pounds() -> None:
    assert assembly_of("7000", report(air="72", mud="62"), listed(COLLARS), None).air == pytest.approx(
        72e3 * POUND_FORCE
    )


def test_what_a_list_lacks_is_heavy_weight_pipe_and_said() -> None:
    found = assembly_of("7000", report(400.0), listed(COLLARS), None)
    collars, pipe = found.parts
    assert (collars.kind, pipe.kind) == ("collars", "heavy-weight pipe")
    assert pipe.length == pytest.approx(300.0 * FOOT)
    assert pipe.mass == pytest.approx(HEAVY_PIPE[3] * POUND_FOOT * 300.0 * FOOT)
    assert any("list of 100 ft for 400 ft" in remark for remark in found.remarks)


def test_blades_are_no_body_and_touch_no_wider_than_the_hole() -> None:
    found = assembly_of("7000", report(), listed(("Stabilizer-blades", "8.81", "", 100.0)), None)
    (part,) = found.parts
    assert part.outer == pytest.approx(6.5 * INCH)
    assert part.contact == pytest.approx(8.625 * INCH)
    assert {"stabilizer of 8.81 in, wider than the hole", "no bore of stabilizer"} <= set(found.remarks)


def data(tmp_path: Path, *lines: str) -> Path:
    (tmp_path / FOLDER).mkdir()
    (tmp_path / FOLDER / "observations.csv").write_text(READINGS + "\n".join(lines) + "\n", encoding="utf-8")
    return tmp_path


def test_a_report_is_two_strokes_and_a_rotation_whose_torque_may_be_on_bottom(tmp_path: Path) -> None:
    folder = data(tmp_path, "d1,1000.0,x,200000,220000,180000,3000", "d2,2000,x,1,1,1,1")
    up, down, turning = report_rows(folder, {"1000": make_case()}, ["1000"])
    assert [row.operation for row in (up, down, turning)] == ["trip_out", "trip_in", "rotate_off_bottom"]
    assert up.hookload == Range(220e3 * POUND_FORCE, 220e3 * POUND_FORCE)
    assert turning.torque == Range(3000 * TORQUE, 3000 * TORQUE)
    assert (turning.torque_read, up.torque_read, up.day) == ("unknown", "off_bottom", "d1")
    assert turning.rates.spin == pytest.approx(rad_per_s(split.RPM))


def test_rows_with_and_without_pumps_are_recorded(tmp_path: Path) -> None:
    found = pumps(data(tmp_path, "d,5300,(pumps ON),,210000,160000,", "d,5300,(pumps OFF),,230000,175000,"))
    assert found["pumps"].tolist() == ["on", "off"]
    assert found["difference_klbf"].tolist() == [50.0, 55.0]


def test_nodes_that_are_put_together_keep_the_moments() -> None:
    rng = np.random.default_rng(5)
    many, k = 300, 3
    weight, half = rng.uniform(0.1, 1.0, many), rng.normal(size=(many, k, k))
    whole = Mixture(weight / weight.sum(), rng.uniform(size=(many, 2)), rng.normal(size=(many, k)), half @ half.mT)
    few = together(whole)
    assert len(few.weight) <= 64
    assert few.centre == pytest.approx(whole.centre, abs=1e-12)
    assert few.spread == pytest.approx(whole.spread, rel=1e-12, abs=1e-12)
    assert few.weight @ few.deviations**2 == pytest.approx(whole.weight @ whole.deviations**2)


def test_one_factor_has_no_pairs_and_depth_is_a_choice_by_score() -> None:
    names = set(setup_of({}, [], MODELS[ONE_FACTOR]).unknowns)
    assert {"friction.cased", "friction.open"} <= names
    assert not any(name.endswith((".axial", ".rotational", ".gradient")) for name in names)
    fits = read_frozen()
    assert fits[chosen(fits, STIFF)].score == max(one.score for name, one in fits.items() if name.startswith(STIFF))
