"""Names of files that a case may have."""

from pathlib import Path

from pydantic import TypeAdapter

from fctd.case.file_names import FileName


def test_a_name_is_a_path_also_where_it_is_not_utf_8() -> None:
    read = TypeAdapter(FileName).validate_python
    assert read("survey.csv") == Path("survey.csv")
    assert read("survey\udcff.csv") == Path("survey\udcff.csv")
