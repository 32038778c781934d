"""Charts of several cases as one object: names, tables, what differs."""

from pathlib import Path
from typing import Any

import pytest

from fctd.answers.comparison import Comparison, compare, names_of
from fctd.answers.steady import Chart, chart
from fctd.case.errors import InputError
from fctd.case.load import Case
from tests.cases import make_case


def charts(*densities: float) -> list[Chart]:
    return [chart(make_case(mud={"density": density}), "trip_out", [500.0, 900.0]) for density in densities]


def test_every_row_is_that_of_its_own_chart() -> None:
    of = charts(1000.0, 1300.0)
    found = compare(of, "field")
    for name, one in zip(("test 1", "test 2"), of, strict=True):
        rows = found.rows[found.rows["case"] == name].drop(columns="case").reset_index(drop=True)
        assert rows.equals(one.rows)
    assert list(found.table.columns[:2]) == ["case", "operation"]
    assert "hookload_klbf" in found.table
    assert found.sentences == ["mud.density: 8.3454 ppg (test 1), 10.849 ppg (test 2)"]
    assert "10.849 ppg" in found._repr_html_()
    assert repr(found) == "Comparison(test 1, test 2: 1 keys differ)"


def test_names_may_be_given_and_one_chart_is_refused() -> None:
    assert list(compare(dict(zip("ab", charts(1000.0, 1000.0), strict=True))).charts) == ["a", "b"]
    with pytest.raises(InputError, match="2 charts or more"):
        compare(charts(1000.0))


@pytest.mark.parametrize(
    ("cases", "names"),
    [
        ([("a", "x"), ("b", "x")], ["a", "b"]),
        ([("a", "x"), ("a", "y")], ["a (x)", "a (y)"]),
        ([("a", "x"), ("a", "x"), ("b", "z")], ["a 1", "a 2", "b"]),
        ([("a", "x"), ("a", "x"), ("a", "y")], ["a (x) 1", "a (x) 2", "a (y)"]),
        ([("a", "x"), ("a", "x"), ("a 1", "y")], ["a 2", "a 3", "a 1"]),
    ],
)
def test_names_that_collide_are_told_apart(cases: list[tuple[str, str]], names: list[str]) -> None:
    assert names_of([named(*of) for of in cases]) == names


def named(name: str, file: str) -> Case:
    update: dict[str, Any] = {"name": name, "file": Path(f"{file}.toml")}
    return make_case().model_copy(update=update)


def test_it_draws_itself() -> None:
    figure = Comparison(dict(zip("ab", charts(1000.0, 1300.0), strict=True))).plot().figure
    assert figure.texts[1].get_text() == "mud.density: 1000 kg/m³ (a), 1300 kg/m³ (b)"
