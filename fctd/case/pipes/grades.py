"""Grades of steel by their names, and a strength that may be written as one: ``S-135``, ``P110``."""

from dataclasses import dataclass
from typing import Annotated, Final

from fctd.case.errors import InputError, nearest
from fctd.case.units import STRESS, Quantity

KSI: Final = 1e3 * 6894.757293168361  # [Pa]
# Least yield strengths [ksi] of drill pipe (API Spec 5DP), and of casing and tubing (API Spec 5CT).
OF_DRILL_PIPE: Final = {"E-75": 75, "X-95": 95, "G-105": 105, "S-135": 135}
OF_CASING: Final = {
    "H-40": 40, "J-55": 55, "K-55": 55, "L-80": 80, "N-80": 80, "C-90": 90, "R-95": 95, "T-95": 95, "C-110": 110,
    "P-110": 110, "Q-125": 125,
}  # fmt: skip
GRADES: Final = OF_DRILL_PIPE | OF_CASING
_BY_SPELLING: Final = {name.replace("-", "").lower(): name for name in GRADES}
# Of drill pipe the letter alone will do.
_LETTERS: Final = {name[0].lower(): name for name in OF_DRILL_PIPE}


def grade_of(word: str) -> str | None:
    """The grade that a word is, "s135" or "S-135", None for another word."""
    return _BY_SPELLING.get("".join(c for c in word.lower() if c.isalnum()))


def drill_pipe_grade_of(word: str) -> str | None:
    """The grade of drill pipe that a word is, where the letter is enough."""
    return grade_of(word) or _LETTERS.get(word.lower())


def strength_of(grade: str) -> float:
    """Least yield strength of a grade [Pa]."""
    return GRADES[grade] * KSI


@dataclass(frozen=True, kw_only=True)
class Strength(Quantity):
    """A stress, or the name of a grade."""

    @property
    def expected(self) -> str:
        return f"{self.noun} such as '135 ksi', or a grade such as 'S-135'"

    def read(self, value: object) -> float:
        if isinstance(value, str):
            if (grade := grade_of(value)) is not None:
                return strength_of(grade)
            if value[:1].isalpha():
                raise InputError(f"a stress, or {nearest(value, GRADES, 'grade')}", value=value)
        return super().read(value)


YieldStrength = Annotated[float, Strength(dimension=STRESS, above=0.0)]
