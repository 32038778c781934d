"""The calibrated case file: units and comments stay, the values are those of the fit."""

from pathlib import Path

import pytest

import fctd
from fctd.calibration.calibrated_file import write_calibrated
from tests.calibration.test_calibrate import CASE

WRITTEN = CASE.replace("friction = 0.2", "friction = 0.2  # guessed") + '[rig]\nblock_weight = "20 t"\n'


def test_values_are_written_in_the_units_of_the_file(tmp_path: Path) -> None:
    (tmp_path / "small.toml").write_text(WRITTEN, encoding="utf-8")
    (tmp_path / "rows.csv").write_text(
        "bit_depth_m,operation,rpm,hookload_t,torque_kN_m\n,in_slips,,25,\n,tare,60,,2\n", encoding="utf-8"
    )
    changes = {"mud.density": "1.1 sg"}
    case = fctd.load_case(tmp_path / "small.toml", changes)
    fits = ["rig.block_weight", "rig.torque_offset", "friction", "mass.pipe"]
    priors = ["friction=0.25+-0.01", "mass.pipe=33+-1"]
    found = fctd.calibrate(case, tmp_path / "rows.csv", fits, priors=priors, starts=1)
    out = tmp_path / "new.toml"
    files = write_calibrated(found, tmp_path / "small.toml", changes, out)
    assert [path.name for path in files] == ["new.toml", "new.fit.json"]
    text = out.read_text(encoding="utf-8")
    for line in ('block_weight = "25 t"', 'torque_offset = "2000 N*m"', "friction = 0.25", 'linear_mass = "33 kg/m"'):
        assert line in text
    assert "guessed" not in text
    assert 'density = "1.1 sg"' in text
    again = fctd.load_case(out)
    assert again.rig.block_weight == pytest.approx(found.values["rig.block_weight"])
    assert fctd.predict(again, tmp_path / "rows.csv")["predicted"].iloc[0] == pytest.approx(25e3 * 9.80665)
    # Its posterior would hold the values of before.
    out.write_text(text.replace('block_weight = "25 t"', 'block_weight = "30 t"'), encoding="utf-8")
    with pytest.raises(fctd.InputError, match=r'new.toml: rig.block_weight = "30 t": expected 245166 N, as new.fit'):
        fctd.predict(fctd.load_case(out), tmp_path / "rows.csv")
    fctd.predict(fctd.load_case(out), tmp_path / "rows.csv", tmp_path / "new.fit.json")
