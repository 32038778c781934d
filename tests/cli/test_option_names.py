"""Refusals of the commands: options by their names, quantities in the units asked for."""

from typing import Literal
from unittest.mock import Mock

import pytest

from fctd.case.errors import InputError
from fctd.case.message import quantity
from fctd.cli.option_names import naming_options


def refusal(error: InputError, units: Literal["si", "field"] = "si") -> str:
    """What a command says that raises an error; its library's ``bit_depth`` is the option ``--depths``."""
    with pytest.raises(InputError) as caught:
        naming_options(Mock(side_effect=error), {"bit_depth": "--depths"})(units=units)
    return str(caught.value)


def test_an_argument_is_named_as_the_option_without_the_case() -> None:
    error = InputError("a speed above 0", key="speed", value=-1.0, file="well.toml")
    assert refusal(error) == "--speed = -1.0: expected a speed above 0"


def test_a_key_of_the_case_keeps_its_file() -> None:
    error = InputError("at least one", key="operations[0].speed", value=0, file="well.toml")
    assert refusal(error) == "well.toml: operations[0].speed = 0: expected at least one"


@pytest.mark.parametrize(("units", "shown", "limit"), [("si", "1000 m", "900 m"), ("field", "3281 ft", "2953 ft")])
def test_depths_come_in_the_units_asked_for(units: Literal["si", "field"], shown: str, limit: str) -> None:
    error = InputError(
        f"a depth within {quantity(900, 'm')}", key="bit_depth", value=quantity(1000, "m"), file="well.toml"
    )
    assert refusal(error, units) == f'well.toml: --depths = "{shown}": expected a depth within {limit}'


def test_the_users_own_words_stay_and_further_problems_are_kept() -> None:
    other = InputError(f"at most {quantity(5, 'm')}", key="wellbore.overlap", value="9 m")
    error = InputError(f"at most {quantity(10, 'm')} (such as '2 m')", key="string.top_md", value="12 m", more=[other])
    assert refusal(error, "field").splitlines() == [
        "string.top_md = \"12 m\": expected at most 32.8 ft (such as '2 m')",
        'wellbore.overlap = "9 m": expected at most 16.4 ft',
    ]
