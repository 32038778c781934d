"""Sentences of the program in units of the field: the quantities in them, and nothing else."""

import copy
import json
import pickle

import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.case.input_warnings import InputWarning
from fctd.case.message import Message, frame_of, joined, kept, quantity, restored, span, within
from fctd.case.systems import told
from fctd.results.unit_systems import in_field_units

USERS = "pipe, 29 kg/m, 9 m"  # a name


@pytest.mark.parametrize(
    ("message", "si", "field"),
    [
        (Message(f"a hole of {quantity(900, 'm')}"), "a hole of 900 m", "a hole of 2953 ft"),
        (
            Message(f"between {span(540, 1500, 'm', between=' and ')}"),
            "between 540 and 1500 m",
            "between 1772 and 4921 ft",
        ),
        (
            Message(f"{quantity(3598.2, 'm', '.0f')} deep"),
            "3598 m deep",
            "11805 ft deep",
        ),  # of the value, not of its text
        (Message(f"a dog-leg of {quantity(3.61, '°/30 m')}"), "a dog-leg of 3.61°/30 m", "a dog-leg of 3.67°/100 ft"),
        (
            Message(f"{quantity(955, 'MPa')}, {quantity(7850, 'kg/m^3')}"),
            "955 MPa, 7850 kg/m^3",
            "138.5 ksi, 65.51 ppg",
        ),
        (Message(f"{quantity(-2000, 'L/min')} of flow"), "-2000 L/min of flow", "-528.3 gpm of flow"),
        (Message(f"{quantity(400, 'N·m')} and {quantity(9, 'K')}"), "400 N·m and 9 K", "295 ft·lbf and 16.2 °F"),
        (
            Message(f"{quantity(0.05, 'm/s')} and {quantity(1e7, 'N/m')}"),
            "0.05 m/s and 1e+07 N/m",
            "9.84 ft/min and 685218 lbf/ft",
        ),
        (Message(f"{USERS} is too long"), f"{USERS} is too long", f"{USERS} is too long"),
        (Message("12 m, as a file has it"), "12 m, as a file has it", "12 m, as a file has it"),
        (Message(""), "", ""),
    ],
)
def test_a_sentence_in_both_systems(message: Message, si: str, field: str) -> None:
    """900 m / 0.3048 m = 2952.8 ft, and so on; a user's text has no quantities."""
    assert message == told(message, "si") == si
    assert told(message, "field") == field


@pytest.mark.parametrize("name", [USERS, "⟦1¦m¦1⟧", "⟦", "{}", "%s", "a\nb"])
def test_a_user_s_text_is_never_changed(name: str) -> None:
    """Not even one that looks like the mark of a quantity, which a file may hold."""
    message = Message(f"{within(name)}: {quantity(30.48, 'm')}")
    assert message.endswith(": 30.48 m")
    assert told(message, "field").endswith(": 100 ft")
    assert told(message, "field").startswith(name)


def test_sentences_in_sentences_keep_their_quantities() -> None:
    inner = Message(f"a hole of {quantity(30.48, 'm')}")
    for outer in (Message(f"it has {within(inner)}"), joined([Message("it has"), inner], " "), Message(within(inner))):
        assert str(outer).endswith("a hole of 30.48 m")
        assert told(outer, "field").endswith("a hole of 100 ft")


@pytest.mark.parametrize("copied", [copy.deepcopy, copy.copy, lambda of: pickle.loads(pickle.dumps(of))])
def test_copies_keep_their_quantities(copied) -> None:
    assert told(copied(Message(f"a hole of {quantity(30.48, 'm')}")), "field") == "a hole of 100 ft"


def test_what_json_keeps_is_the_sentence_again() -> None:
    for text in (Message(f"a hole of {span(3.048, 30.48, 'm')}"), Message(USERS), USERS, ""):
        again = restored(json.loads(json.dumps(kept(text))))
        assert again == text
        assert told(again, "field") == told(text, "field")


def test_a_table_in_field_units_has_its_sentences_in_them() -> None:
    rows = [{"reason": Message(f"segments of {quantity(30.48, 'm')}"), "name": USERS}, {"reason": "none", "name": "x"}]
    table = in_field_units(frame_of(rows))
    assert table["reason"].tolist() == ["segments of 100 ft", "none"]
    assert table["name"].tolist() == [USERS, "x"]
    assert frame_of(rows).to_csv(index=False) == pd.DataFrame(rows).to_csv(index=False)


def test_refusals_and_warnings_are_sentences() -> None:
    error = InputError(f"at most {quantity(30.48, 'm')}", key="string", value=USERS)
    assert str(error) == f'string = "{USERS}": expected at most 30.48 m'
    assert told(error.message, "field") == f'string = "{USERS}": expected at most 100 ft'
    assert told(pickle.loads(pickle.dumps(error.expected)), "field") == "at most 100 ft"
    warning = InputWarning("code", "mud", f"{USERS} of {quantity(30.48, 'm')}", "check it")
    assert warning.told("field") == f"mud: {USERS} of 100 ft: check it"
