"""Every key of a case's models is drawn, or listed with a reason."""

from tests.equivalence.draws import draw, written
from tests.equivalence.keys import ABSENT, keys_of

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
