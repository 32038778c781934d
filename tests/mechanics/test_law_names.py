"""The names of the laws of friction are those of a case file."""

from typing import get_args

from fctd.case import wall
from fctd.mechanics.law_names import CODES, LAWS, NAMES, STICKING


def test_a_case_file_takes_every_law() -> None:
    assert get_args(wall.FrictionLaw) == NAMES == tuple(LAWS)


def test_codes_are_places_and_laws_that_stick_are_among_them() -> None:
    assert list(CODES.values()) == list(range(len(NAMES)))
    assert set(STICKING) < set(NAMES)
