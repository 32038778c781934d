"""Names of files that a case may have."""

from pathlib import Path

import pytest
from pydantic import TypeAdapter

from fctd.case.errors import InputError
from fctd.case.file_names import FileName
from fctd.case.load import load_case


def test_a_name_is_a_path_also_where_it_is_not_utf_8() -> None:
    read = TypeAdapter(FileName).validate_python
    assert read("survey.csv") == Path("survey.csv")
    assert read("survey\udcff.csv") == Path("survey\udcff.csv")


def test_a_backslash_that_stands_for_another_sign_is_explained(case_file: Path) -> None:
    with pytest.raises(InputError, match=r"that exists, looked for .*: a backslash in double quotes"):
        load_case(case_file, {"wellbore.stations": None, "wellbore.survey": "D:\temp\new.csv"})
