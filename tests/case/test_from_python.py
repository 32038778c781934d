"""Cases from Python: dicts, arrays and tables of pandas are what a case file would be."""

import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.case.from_python import as_written, stations_of
from fctd.case.load import load_case

EXAMPLES = Path(__file__).parents[2] / "examples"
FEET = pd.DataFrame({"Well": "A-1", "Measured Depth (ft)": [0.0, 1000.1, 3000.0], "Incl": [0, 1.5, 40], "Azi Grid": 30})


def tables() -> dict[str, Any]:
    """Those of the example well, with its survey as a path from here."""
    raw = tomllib.loads((EXAMPLES / "my_well.toml").read_text(encoding="utf-8"))
    return raw | {"wellbore": raw["wellbore"] | {"survey": EXAMPLES / "my_survey.csv"}}


def test_a_dict_is_the_case_of_its_file() -> None:
    from_file, from_dict = load_case(EXAMPLES / "my_well.toml"), load_case(tables(), {"name": "my well"})
    assert from_dict.file is None
    assert from_dict.model_copy(update={"file": from_file.file}) == from_file


def test_names_of_files_in_a_dict_begin_in_the_current_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    raw = tables()
    raw["wellbore"]["survey"] = "my_survey.csv"
    monkeypatch.chdir(EXAMPLES)
    assert load_case(raw).wellbore.survey == EXAMPLES / "my_survey.csv"


def test_tables_of_pandas_are_stations_and_lists_of_tables() -> None:
    raw, survey = tables(), pd.read_csv(EXAMPLES / "my_survey.csv")
    expected = load_case(raw)
    raw["wellbore"] = {**raw["wellbore"], "survey": None, "stations": survey}
    raw["wellbore"]["intervals"] = pd.DataFrame(raw["wellbore"]["intervals"])
    raw["string"]["components"] = pd.DataFrame(raw["string"]["components"])  # cells of some are empty
    found = load_case(raw, {"mud.density": np.float64(1250.0), "solver.step": None})
    assert (found.wellbore.trajectory == expected.wellbore.trajectory).all()
    assert found.wellbore.intervals == expected.wellbore.intervals
    assert found.string == expected.string
    shorter = load_case(raw, {"wellbore.stations": FEET, "operations": None})
    assert shorter.depths[1] == pytest.approx(914.4, rel=1e-14)


def test_columns_are_named_as_in_survey_files() -> None:
    np.testing.assert_allclose(stations_of(FEET), [[0, 0, 30], [304.83048, 1.5, 30], [914.4, 40, 30]], rtol=1e-14)


@pytest.mark.parametrize(
    ("frame", "message"),
    [
        (FEET.rename(columns={"Measured Depth (ft)": "MD"}), 'expected a header with its unit, such as "MD (m)"'),
        (FEET.drop(columns="Incl"), "column inc_deg is missing: expected it among the headers"),
        (FEET.assign(Incl=[0, np.nan, 1]), 'row 2, Incl = "nan": expected a finite number'),
    ],
)
def test_a_table_that_is_no_survey_is_refused(frame: pd.DataFrame, message: str) -> None:
    with pytest.raises(InputError) as caught:
        load_case(EXAMPLES / "my_well.toml", {"wellbore.survey": None, "wellbore.stations": frame})
    assert message in str(caught.value)
    assert "wellbore.stations" in str(caught.value)
    assert "--columns" not in str(caught.value)  # a remedy of the command line


def test_values_are_copies() -> None:
    given = {"a": [1, {"b": np.arange(3)}], "c": pd.Series([1.5])}
    found = as_written(given)
    assert found == {"a": [1, {"b": [0, 1, 2]}], "c": [1.5]}
    found["a"].append(2)
    assert len(given["a"]) == 2


@pytest.mark.parametrize("source", [None, 3, FEET])
def test_what_is_neither_path_nor_dict_is_refused(source: Any) -> None:
    with pytest.raises(InputError, match="expected the path of a case file, a dict of its tables, or a case"):
        load_case(source)
