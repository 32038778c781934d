"""What a table knows of itself is JSON, and lasts in Parquet files."""

import json
from pathlib import Path

import pandas as pd
import pytest

from fctd import limits_of, load_case, torque_drag
from fctd.results.attrs import attrs_of

EXAMPLE = Path(__file__).parents[2] / "examples" / "my_well.toml"
ROUGH = {"wellbore.intervals[1].friction": 1.2}


@pytest.mark.slow
def test_a_table_keeps_its_attrs_in_a_parquet_file(tmp_path: Path) -> None:
    case = load_case(EXAMPLE, ROUGH)
    table = torque_drag(case, "trip_in", ["shoe", "1600 m"], speed="100 m/h")
    table.to_parquet(tmp_path / "chart.parquet")
    kept = pd.read_parquet(tmp_path / "chart.parquet")
    pd.testing.assert_frame_equal(kept, table, check_dtype=False)
    assert kept.attrs == table.attrs == json.loads(json.dumps(table.attrs))
    assert table.attrs == attrs_of(case, ["trip_in"], {"speed": 100 / 3600})
    assert [warning["key"] for warning in table.attrs["warnings"]] == ["wellbore.intervals[1].friction"]
    assert limits_of(case, "trip_in", "shoe").attrs["case"] == table.attrs["case"]


def test_a_digest_is_of_what_the_case_says(tmp_path: Path) -> None:
    """The names of files say nothing; a key and a station do."""
    case = load_case(EXAMPLE)
    for file in ("my_well.toml", "my_survey.csv"):
        (tmp_path / file).write_bytes(EXAMPLE.with_name(file).read_bytes())
    assert load_case(tmp_path / "my_well.toml").digest == case.digest != load_case(EXAMPLE, ROUGH).digest
    (tmp_path / "my_survey.csv").write_text((tmp_path / "my_survey.csv").read_text().replace("400,0,0", "401,0,0"))
    assert load_case(tmp_path / "my_well.toml").digest != case.digest
