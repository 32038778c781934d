"""The call: rows from a file or as they are, override sets, and input that cannot be used."""

from pathlib import Path

import pandas as pd
import pytest

import fctd
from fctd.calibration.calibrate import calibrate
from fctd.calibration.setup import Setup
from fctd.case.errors import InputError
from tests.calibration.wells import blank_rows, measured_rows, well

CASE = """
name = "small"
[wellbore]
stations = [[0, 0, 0], [800, 0, 0]]
[[wellbore.intervals]]
to_md = 800
diameter = 0.3
friction = 0.2
[[string.components]]
name = "pipe"
outer_diameter = 0.127
inner_diameter = 0.1
linear_mass = 30.0
segment_length = "100 m"
"""


def test_a_file_of_rows_with_an_override_set(tmp_path: Path) -> None:
    """In a vertical hole the hook load is weight and block: 500 m of 30 and of 60 kg/m."""
    (tmp_path / "small.toml").write_text(CASE, encoding="utf-8")
    hang = 500 * 30 * 9.80665 * 1e-3
    text = "string,bit_depth_m,operation,hookload_kN\n"
    text += f",500,rotate_off_bottom,{hang + 200}\nheavy,500,rotate_off_bottom,{2 * hang + 200}\n"
    (tmp_path / "rows.csv").write_text(text, encoding="utf-8")
    setup = Setup.model_validate({"strings": {"heavy": {"string.components[0].linear_mass": 60.0}}})
    case = fctd.load_case(tmp_path / "small.toml")
    found = fctd.calibrate(case, tmp_path / "rows.csv", ["rig.block_weight"], setup=setup)
    assert found.values["rig.block_weight"] == pytest.approx(200e3, rel=1e-6)  # noqa: PD011
    assert found.residuals["residual"].abs().max() < 1.0
    with pytest.raises(InputError, match=r"strings\.heavy"):
        calibrate(well(), tmp_path / "rows.csv", ["rig.block_weight"], setup=setup)


def test_input_that_cannot_be_used() -> None:
    rows = measured_rows(well(), {"rig.block_weight": 230e3}, blank_rows(well())[-2:-1])
    with pytest.raises(InputError, match="the loss soft_l1"):
        calibrate(well(), rows, ["rig.block_weight"], loss="soft_l2")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="measured = a DataFrame: expected a file of rows, as its to_csv"):
        calibrate(well(), pd.DataFrame({"operation": ["trip_in"]}), ["friction"])  # type: ignore[arg-type]
    with pytest.raises(InputError, match="starts = 0: expected at least 1"):
        calibrate(well(), rows, ["rig.block_weight"], starts=0)
    with pytest.raises(InputError, match="a case"):
        calibrate("well.toml", rows, ["rig.block_weight"])  # type: ignore[arg-type]
