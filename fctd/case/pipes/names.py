"""The name of a pipe, as it is sold, in its parts: "5 in 19.5 S-135 NC50, premium"."""

import re
from fractions import Fraction
from typing import Final, NamedTuple

from fctd.case.errors import InputError
from fctd.case.pipes.grades import drill_pipe_grade_of, grade_of

DRILL_PIPE, HEAVY, COLLAR, CASING, TUBING = "drill pipe", "heavy-weight pipe", "collar", "casing", "tubing"
# Spellings, the longest first.
_KINDS: Final = {
    "heavy-weight drill pipe": HEAVY, "heavy weight drill pipe": HEAVY, "heavyweight drill pipe": HEAVY,
    "heavy-weight pipe": HEAVY, "heavy weight pipe": HEAVY, "heavy-weight": HEAVY, "hwdp": HEAVY,
    "drill collars": COLLAR, "drill collar": COLLAR, "collars": COLLAR, "collar": COLLAR, "dc": COLLAR,
    "drill pipe": DRILL_PIPE, "drillpipe": DRILL_PIPE, "dp": DRILL_PIPE,
    "casing": CASING, "csg": CASING, "tubing": TUBING, "tbg": TUBING,
}  # fmt: skip
# Share of the wall that is left in the classes of used pipe (API RP 7G).
CLASSES: Final = {"new": 1.0, "premium": 0.8, "class 2": 0.7}
_SHORT: Final = re.compile(r"(?<!\S)prem\.?(?!\S)")
MOST_WEAR: Final = 0.5  # of the wall
_NUMBER = r"\d+(?:(?:\s+|\s*-\s*)\d+/\d+|\.\d+)?|\d+/\d+|\.\d+"
_NAME: Final = re.compile(
    rf"\s*(?P<size>{_NUMBER})\s*(?:inch|in\.?|\"|”)?\s*(?:x|×|,)?\s*"
    rf"(?P<second>{_NUMBER})\s*(?:lbs?/ft|lbf/ft|ppf|#|inch|in\.?|\"|”)?(?P<rest>(?:[\s,].*)?)",
    re.IGNORECASE | re.DOTALL,
)
_WORN: Final = re.compile(
    r"(?:worn|wear)\s*(?P<percent>-?\d+(?:\.\d+)?)\s*%|(?<![\d.-])(?P<other>-?\d+(?:\.\d+)?)\s*%\s*(?:worn|wear)"
)
_FRACTIONS: Final = str.maketrans(
    {"½": " 1/2", "¼": " 1/4", "¾": " 3/4", "⅛": " 1/8", "⅜": " 3/8", "⅝": " 5/8", "⅞": " 7/8", "⁄": "/"}
    | {"–": "-", "‑": "-", "″": '"', "”": '"'}
)
EXAMPLE: Final = "'5 in 19.5 S-135 NC50, premium'"


class PipeName(NamedTuple):
    """Parts of a name: size [in]; second : nominal weight [lb/ft], of a collar its bore [in].

    kind, grade : None where the name has none; connection : in lower case without blanks, maybe empty; wall_share : of
    the nominal wall that is left.
    """

    size: float
    second: float
    kind: str | None
    grade: str | None
    connection: str
    wall_share: float


def parse(text: str) -> PipeName:
    """The parts of a name; raises InputError for a text that is none."""
    plain = re.sub(r"(?<=\d),(?=\d)", ".", text.translate(_FRACTIONS))  # a decimal comma
    found = _NAME.fullmatch(plain)
    if found is None:
        raise InputError(f"size, weight, grade and connection of a pipe, such as {EXAMPLE}", value=text)
    rest, wall_share = class_of(found["rest"].lower().replace(",", " "), text)
    kind = None
    for spelling, of in _KINDS.items():
        if re.search(rf"(?<!\S){spelling}(?!\S)", rest):
            rest, kind = rest.replace(spelling, " ", 1), of
            break
    grade, words = None, []
    for word in rest.split():
        known = grade_of(word) or (drill_pipe_grade_of(word) if kind in (None, DRILL_PIPE) else None)
        if known is not None and grade is None:
            grade = known
        else:
            words.append(word)
    return PipeName(_inches(found["size"]), _inches(found["second"]), kind, grade, "".join(words), wall_share)


def class_of(rest: str, text: str) -> tuple[str, float]:
    """The name without its class, and the share of the wall that the class has."""
    rest = _SHORT.sub("premium", rest)
    if (worn := _WORN.search(rest)) is not None:
        wear = float(worn["percent"] or worn["other"]) / 100
        if not 0 <= wear <= MOST_WEAR:
            raise InputError(f"0 to {100 * MOST_WEAR:g} % of the wall worn off", value=text)
        return rest.replace(worn[0], " "), 1 - wear
    if (numbered := re.search(r"class\s+(\w+)", rest)) is not None and numbered[0] not in CLASSES:
        names = [*CLASSES, "a wear such as '10 % worn'"]
        raise InputError(f"a class of pipe, {', '.join(names[:-1])} or {names[-1]}", value=text)
    for name, share in CLASSES.items():
        if re.search(rf"(?<!\S){name}(?!\S)", rest):
            return rest.replace(name, " ", 1), share
    return rest, 1.0


def _inches(text: str) -> float:
    """A number with a fraction, "8 1/2", "9-5/8", or with decimals."""
    return float(sum(Fraction(part) for part in re.split(r"\s+|(?<=\d)-(?=\d)|\s-\s", text.strip())))


def in_inches(value: float) -> str:
    """A size as it is written, in eighths or sixteenths where it is such a number: 5 1/2, else in decimals."""
    sixteenths = Fraction(value).limit_denominator(16)
    if abs(float(sixteenths) - value) > 1e-9:
        return f"{value:g}"
    whole, part = divmod(sixteenths, 1)
    return " ".join(str(x) for x in (whole, part) if x) or "0"
