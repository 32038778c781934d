"""Every key of a case's models is drawn, or listed with a reason."""

from collections.abc import Iterator
from typing import Any

from tests.equivalence.draws import draw, written
from tests.equivalence.keys import ABSENT, ABSENT_WORDS, choices_of, keys_of

DRAWS = 800


def test_every_key_of_a_case_is_drawn_or_listed_with_a_reason() -> None:
    """A new key of a case is added to the generator, so that the statements hold with it, or to ``ABSENT``."""
    drawn = {key for index in range(DRAWS) for key in written(draw(5, index).raw)}
    # The readings of a viscometer are keys of their own in a table, and a value of the model.
    drawn = {key.partition(".fann.")[0] + (".fann" if ".fann." in key else "") for key in drawn}
    known = set(keys_of())
    assert known - drawn - ABSENT.keys() == set(), "keys that are neither drawn nor listed"
    assert ABSENT.keys() & drawn == set(), "keys that are drawn, and listed as absent"
    assert (drawn | ABSENT.keys()) - known == set(), "keys that no model has"
    assert all(ABSENT.values())


def test_every_word_of_a_key_is_drawn_or_listed_with_a_reason() -> None:
    """A new law, geometry or way to solve is drawn, or stands in ``ABSENT_WORDS``; defaults need not be written."""
    drawn = {pair for index in range(DRAWS) for pair in words(draw(5, index).raw)}
    known = set(choices_of())
    assert known - drawn - ABSENT_WORDS.keys() == set(), "words that are neither drawn nor listed"
    assert ABSENT_WORDS.keys() & drawn == set(), "words that are drawn, and listed as absent"
    assert ABSENT_WORDS.keys() - known == set(), "words that no model has"


def words(table: Any, key: str = "") -> Iterator[tuple[str, str]]:
    """The dotted keys of nested tables whose values are texts, with these."""
    if isinstance(table, list):
        for item in table:
            yield from words(item, key)
    elif isinstance(table, dict):
        for name, value in table.items():
            yield from words(value, f"{key}.{name}" if key else name)
    elif isinstance(table, str):
        yield key, table
