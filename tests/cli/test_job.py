"""What commands on a case share: rows of a long table, numbers of a screen, a file whatever the screen does."""

from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.load import load_case
from fctd.cli import job
from fctd.cli.job import Job, rows_of
from fctd.results.shown_tables import short
from tests.commands import Command


@given(st.integers(1, 60), st.integers(1, 20), st.sets(st.integers(0, 59), max_size=3))
def test_rows_of_a_long_table_are_evenly_spread_and_end_with_its_last(count: int, most: int, also: set[int]) -> None:
    table = pd.DataFrame({"md_m": np.arange(count)})
    also = {row for row in also if row < count}
    shown = [row["md_m"] for row in rows_of(table, most, also)]
    assert shown == sorted(set(shown))
    assert shown[-1] == count - 1
    assert also <= set(shown)
    assert len(set(shown) - also) <= most
    assert shown == list(range(count)) or len(shown) >= min(most, count)
    assert [row["md_m"] for row in rows_of(table)] == list(range(count))


@pytest.mark.parametrize(
    ("value", "text"), [(np.nan, ""), (1234.5, "1234"), (-0.0, "0"), (12.3456, "12.35"), (0.00012345, "0.0001234")]
)
def test_a_number_of_a_screen_has_four_digits(value: float, text: str) -> None:
    assert short(value, none="").text == text


def test_a_table_is_written_where_the_screen_is_closed(case_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = case_file.with_name("rows.csv")
    made = Job(case_file, [], units="si", strict=False, quiet=True, out=out)
    made.warn()
    monkeypatch.setattr(job, "screen", Mock(print=Mock(side_effect=BrokenPipeError)))
    with pytest.raises(BrokenPipeError):
        made.end({"--out": pd.DataFrame({"md_m": [1.0]})}, Mock())
    assert out.read_text().splitlines() == ["md_m", "1.0"]


def test_each_file_is_refused_under_its_option(case_file: Path, cli: Command) -> None:
    assert "--trips = " in cli("surge", case_file, "--trips", case_file.with_name("a.png"), code=2).err
    assert "--parts = " in cli("hydraulics", case_file, "--parts", case_file.with_name("a.doc"), code=2).err


def test_warnings_of_several_cases_name_their_cases(case_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cases = {name: load_case(case_file, {"mud.density": of}) for name, of in (("a", 0), ("b", 3000), ("c", 3000))}
    made = Job(cases, units="si", strict=False, quiet=True)
    made.warn()
    (density,) = [text for text in made.told if "3000" in text]
    assert density.endswith("(b and c)")
    assert capsys.readouterr().err.count("mud of 3000") == 1  # of one file
