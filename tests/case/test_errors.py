"""Input errors: their text, their order, and the keys they name."""

import pickle
from functools import reduce
from pathlib import Path
from typing import Any

import pytest

from fctd.case.errors import Computed, InputError, known_keys, nearest, show
from tests.case.test_load import refusal


def test_the_message_of_the_documentation(case_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(case_file.parent)
    error = refusal(Path("well.toml"), {"string.components[0].length": "-2 m"})
    assert str(error) == 'well.toml: string.components[0].length = "-2 m": expected a length above 0'


def test_several_problems_stand_on_lines_of_their_own(case_file: Path) -> None:
    error = refusal(case_file, {"mud.density": "-1 ppg", "rig.sheave_efficiency": 2})
    assert [line.split(": ")[1] for line in str(error).splitlines()] == [
        'mud.density = "-1 ppg"',
        "rig.sheave_efficiency = 2",
    ]


def test_what_follows_from_a_problem_is_not_reported(case_file: Path) -> None:
    """The next start is filled in from a bad end, and contact_diameter from a bad outer_diameter."""
    overrides = {"operations[0].to_md": "far", "string.components[0].outer_diameter": "wide"}
    assert len(str(refusal(case_file, overrides)).splitlines()) == 2


def test_how_deep_tables_lie_in_each_other_does_not_depend_on_python() -> None:
    """json refuses some hundred levels or many thousands."""
    deep: object = 1
    for _ in range(300):
        deep = {"a": deep}
    assert show(deep) == "a table"
    assert show([deep]) == "a list"
    assert show({"a": {"b": [1]}}) == '{"a": {"b": [1]}}'


def test_what_the_program_computed_stands_without_quotes() -> None:
    error = InputError("enough", key="string.components", value=Computed("930 m of string"))
    assert str(error) == "string.components = 930 m of string: expected enough"


def test_an_error_survives_pickling(case_file: Path) -> None:
    error = refusal(case_file, {"mud.density": "-1 ppg", "rig.sheave_efficiency": 2, "name": None})
    assert str(pickle.loads(pickle.dumps(error))) == str(error)


def test_an_error_moves_up_with_what_it_carries() -> None:
    other = InputError("a depth", key="to_md", value=3)
    error = InputError("a speed", key="speed", more=[other]).at("operations[1]").in_file("well.toml")
    assert str(error) == (
        "well.toml: operations[1].speed is missing: expected a speed\n"
        "well.toml: operations[1].to_md = 3: expected a depth"
    )
    assert str(error.in_file("other.toml")) == str(error)


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        ("x" * 200, '"' + "x" * 76 + "..."),
        (Path("x" * 200), '"' + "x" * 200 + '"'),
        (0.1 + 0.2, "0.30000000000000004"),
        (10**5000, "a long number"),
        (reduce(lambda inner, _: {"a": inner}, range(5000), dict[str, Any]()), "a table"),
        (reduce(lambda inner, _: [inner], range(5000), list[Any]()), "a list"),
    ],
    ids=["text", "path", "number", "long number", "table", "list"],
)
def test_long_values_are_cut_and_paths_are_whole(value: object, shown: str) -> None:
    assert show(value) == shown


@pytest.mark.parametrize(
    ("given", "choices", "what", "expected"),
    [
        ("trip_inn", ["trip_in", "back_ream"], "kind", "the kind trip_in"),
        ("dance", ["trip_in", "back_ream"], "kind", "one of the kinds trip_in, back_ream"),
        ("dance", ["torque"], "quantity", "one of the quantities torque"),
        ("dance", ["mud"], "key", "one of the keys mud"),
    ],
)
def test_the_nearest_choice_or_all_of_them(given: str, choices: list[str], what: str, expected: str) -> None:
    assert nearest(given, choices, what) == expected


@pytest.mark.parametrize(
    ("key", "expected"),
    [
        ("WOB", "bit.weight_on_bit"),
        ("mud-weight", "mud.density"),
        ("density", "mud.density"),
        ("od", "outer_diameter"),
        ("pin", ""),
    ],
)
def test_the_words_of_drillers_for_keys(key: str, expected: str) -> None:
    with pytest.raises(InputError) as refused:
        known_keys({key: 1}, ["outer_diameter", "length"])
    assert refused.value.expected == (f"the key {expected}" if expected else "one of the keys outer_diameter, length")
    with pytest.raises(InputError, match="the key density"):
        known_keys({"weight": 1}, ["density", "cake"])
