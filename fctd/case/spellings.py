"""Quantities as people write them: numbers with fractions and commas, units in the field's spellings.

Only text of a narrow shape reaches pint, whose parser evaluates arithmetic: to it "8 1/2 in" is 0.1 m, "1,2 m" is 12 m,
and "10**10**10 m" never returns.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from decimal import Decimal
from functools import cache
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from fctd.case.common_units import COMMON
from fctd.case.errors import InputError

if TYPE_CHECKING:
    from pint import UnitRegistry

# Characters of word processors and drawings, in plain ones.
_PLAIN: Final = str.maketrans(
    {
        **{"½": " 1/2", "¼": " 1/4", "¾": " 3/4", "⅛": " 1/8", "⅜": " 3/8", "⅝": " 5/8", "⅞": " 7/8", "⁄": "/"},
        **{"·": "*", "⋅": "*", "∙": "*", "²": "^2", "³": "^3", "−": "-", "–": "-", "‑": "-"},
        **{"″": '"', "”": '"', "′": "'", "’": "'", "º": "°", "˚": "°", "\u00a0": " ", "\u202f": " ", "\u2009": " "},
    }
)
_LONGEST: Final = 80  # characters of a quantity
_FACTOR = r"(?:[^\W\d_]+\.?|°[CF]?|''|[\"'])(?:(?:\^|\*\*)?-?[1-9])?"
_UNIT = rf"(?P<unit>{_FACTOR}(?:\s*[*/.\-\s]\s*{_FACTOR})*)"
_DECIMAL = re.compile(rf"\s*(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*{_UNIT}\s*")
# Inches have halves to sixty-fourths: 8 1/2, 9-5/8, 3/4.
_FRACTION = re.compile(
    rf"\s*(?:(?P<whole>\d+)(?:\s+|\s*-\s*))?(?P<top>\d+)\s*/\s*(?P<bottom>2|4|8|16|32|64)\s*{_UNIT}\s*"
)
# Digits in groups, or with a decimal comma.
_GROUPED = re.compile(rf"\s*(?P<number>[+-]?\d+(?:[ ,.']\d+)+)\s*{_UNIT}\s*")
# Viscometers read in pounds on a hundred square feet.
_HUNDREDS: Final = re.compile(r"/\s*\(?\s*100\s*(?:ft\s*\^?2|sq\.?\s*ft)\s*\)?", re.IGNORECASE)
_BLANKS: Final = re.compile(r"\s")
_SEPARATORS: Final = re.compile("[ ,']")
_THOUSANDS: Final = re.compile(r"[+-]?\d{1,3}([ ,'])\d{3}(?:\1\d{3})*(?:\.\d+)?")

# Spellings that pint does not know, or knows as something else, in lower case without blanks.
_WORDS: Final[Mapping[str, str]] = {
    '"': "inch", "''": "inch", "'": "foot", "°": "degree", "deg.": "degree", "in.": "inch", "ft.": "foot",
    "lbm": "pound", "lbs": "pound", "klbs": "kilopound", "klbm": "kilopound", "kip": "klbf", "kips": "klbf",
    "te": "tonne", "tonneforce": "tonne_force", "tonnesforce": "tonne_force", "metricton": "tonne",
    "metrictons": "tonne", "kdan": "kilodecanewton", "mins": "minute", "kft": "kilofoot",
    "sg": "specific_gravity", "s.g.": "specific_gravity", "s.g": "specific_gravity", "ppf": "(pound/foot)",
    "pcf": "(pound/foot**3)", "ppg": "(pound/gallon)", "fpm": "(foot/minute)", "fph": "(foot/hour)",
    "nm": "(N*m)", "knm": "(kN*m)", "dan": "daN", "danm": "(daN*m)", "kdanm": "(kilodecanewton*m)",
    **dict.fromkeys(("ftlb", "ftlbs", "ftlbf"), "(foot*lbf)"),
    **dict.fromkeys(("kftlb", "kftlbs", "kftlbf"), "(kilofoot*lbf)"),
}  # fmt: skip
# Words that stand for several units: what each reading is called, and how to write it without doubt.
_AMBIGUOUS: Final[Mapping[str, tuple[tuple[str, str, str], ...]]] = {
    word: readings
    for words, readings in (
        (
            ("ton", "tons", "tonf", "tonsf"),
            (("metric tons", "1", "t"), ("short tons", "2", "klb"), ("long tons", "2.24", "klb")),
        ),
        (("mlb", "mlbs", "mlbf"), (("thousands of pounds", "1", "klb"), ("millions of pounds", "1000", "klb"))),
        (("mph",), (("metres per hour", "1", "m/h"), ("miles per hour", "1", "mile/h"))),
    )
    for word in words
}


# Units that people write with prefixes beside kilo.
_PREFIXED: Final = ("meter", "second", "gram", "newton", "pascal", "bar", "liter", "watt", "joule", "poise")


class Written(NamedTuple):
    """A quantity as it is written: its number, and its unit as text."""

    number: Decimal
    unit: str


def split(text: str) -> Written | None:
    """Number and unit of "12.5 m", "8 1/2 in" or "9-5/8in"; None for a text of another shape.

    Raises InputError, which lists the readings, for a number with a comma, a blank or an apostrophe among its digits,
    and for a unit of several meanings.
    """
    if len(text) > _LONGEST:
        return None
    plain = _HUNDREDS.sub("/hsqft", text.translate(_PLAIN))
    found = _DECIMAL.fullmatch(plain)
    if found is not None:
        return _without_doubt(Decimal(found["number"]), found["unit"])
    found = _FRACTION.fullmatch(plain)
    if found is not None:
        if int(found["top"]) >= int(found["bottom"]):  # 85/8 is 8 5/8 without its blank
            return None
        number = Decimal(found["whole"] or 0) + Decimal(found["top"]) / Decimal(found["bottom"])
        return _without_doubt(number, found["unit"])
    found = _GROUPED.fullmatch(plain)
    if found is not None:
        raise InputError(_readings_of_digits(found["number"], found["unit"]))
    return None


def _readings_of_digits(number: str, unit: str) -> str:
    """The plain ways to write a number with commas, blanks or apostrophes among its digits."""
    whole, thousands = _SEPARATORS.sub("", number), _THOUSANDS.fullmatch(number) is not None
    commas = number.count(",")
    if thousands and (commas != 1 or "." in number):
        return f"'{whole} {unit}' (without separators between thousands)"
    if commas != 1:
        return f"a number with one decimal point and its unit, such as '12.5 {unit}'"
    point = _SEPARATORS.sub("", number.replace(".", "").replace(",", "#")).replace("#", ".")
    if thousands:
        return f"'{whole} {unit}' or '{point} {unit}' (a comma may separate thousands or decimals)"
    return f"'{point} {unit}' (with a decimal point)"


def _without_doubt(number: Decimal, unit: str) -> Written:
    """The quantity, or InputError for a unit of several meanings."""
    for word in re.findall(r"[^\W\d_]+", unit):
        if word.lower() in _AMBIGUOUS and _whole(unit) is None:
            readings = [
                f"'{float(number * Decimal(times)):.10g} {unit.replace(word, plain)}' ({name})"
                for name, times, plain in _AMBIGUOUS[word.lower()]
            ]
            raise InputError(f"{', '.join(readings[:-1])} or {readings[-1]}")
    return Written(number, unit)


def factor(
    unit: str, target: str, words: Mapping[str, str], gravity: int = 0, *, listed: bool = False, back: bool = False
) -> float:
    """How many `target` units one `unit`, as it is written, is.

    words : spellings of this dimension, in lower case, in pint's words.  gravity : 1 where a mass stands for its
    weight, −1 where a weight stands for its mass, else 0.  listed : whether only these words are units.  back : how
    many of the unit one target unit is.  Raises ValueError for a unit that is unknown or of another dimension.
    """
    plain = unit if listed else _HUNDREDS.sub("/hsqft", unit)
    known_words = [words.get(_BLANKS.sub("", unit).lower(), "")] if listed else _in_pints_words(plain, words)
    for known in filter(None, known_words):
        for expression in (known, *([f"({known})*standard_gravity**{gravity}"] if gravity else [])):
            try:
                return conversion(target, expression) if back else conversion(expression, target)
            except ValueError:
                pass
    raise ValueError(f"{unit!r} cannot be converted to {target!r}")


def _in_pints_words(unit: str, words: Mapping[str, str]) -> list[str]:
    """The unit as pint reads it: literally, and then with the spellings of the field and in any case of letters."""
    whole = _whole(unit)
    if whole is not None:
        return [whole]
    parts = re.findall(rf"({_FACTOR})\s*([*/.\-]?)", unit)
    literal, spelled = "", ""
    for text, sign in parts:
        shape = re.fullmatch(r"(.*?)\.?(?:(?:\^|\*\*)?(-?[1-9]))?", text)
        assert shape is not None  # a factor is a word and perhaps an exponent
        word, power = shape[1], f"**{shape[2]}" if shape[2] else ""
        after = "/" if sign == "/" else "*"
        literal += word + power + after
        spelled += _WORDS.get(word.lower()) or words.get(word.lower(), word)
        spelled += power + after
    return list(dict.fromkeys([literal[:-1], spelled[:-1]]))


def _whole(unit: str) -> str | None:
    """A unit that is a spelling of its own as a whole, such as "tonne-force", in pint's words."""
    joined = _BLANKS.sub("", unit).lower()
    return _WORDS.get(joined) or _WORDS.get(joined.replace("-", ""))


@cache
def _registry() -> UnitRegistry[Any]:
    """The unit registry; built on first use, since importing pint takes half a second."""
    from pint import UnitRegistry

    registry: UnitRegistry[Any] = UnitRegistry()
    registry.define("specific_gravity = 1000 kilogram / meter ** 3")
    registry.define("hsqft = 100 foot ** 2")
    registry.define("gpm = gallon / minute")
    registry.define("tonne_force = 1000 kilogram_force")
    registry.define("kilodecanewton = 10 kilonewton")
    registry.define("usft = survey_foot")  # to pint a micro-foot
    registry.define("mt = tonne")  # of the field; to pint a thousandth of it
    return registry


@cache
def conversion(unit: str, target: str) -> float:
    """How many `target` units one `unit` is, both in pint's words, e.g. conversion("ft", "m") = 0.3048.

    Raises ValueError for a unit that is unknown or of another dimension.
    """
    if unit == target:
        return 1.0
    common = COMMON.get(target, {}).get(unit)
    return by_registry(unit, target) if common is None else common


def by_registry(unit: str, target: str) -> float:
    """The same for any unit; takes half a second the first time."""
    registry = _registry()
    for word in re.findall(r"[^\W\d_]+", unit):
        for prefix, base, _ in registry.parse_unit_name(word)[:1]:
            if prefix not in ("", "kilo") and base not in _PREFIXED:  # a milli-foot is a slip
                raise ValueError(f"{word!r} is no unit")
    try:
        ratio = registry.Quantity(1.0, unit).to(target).magnitude
    except Exception as error:  # pint's parser also raises assertion and token errors
        raise ValueError(f"{unit!r} cannot be converted to {target!r}") from error
    return float(f"{ratio:.15g}")  # pint multiplies floats: its foot is 0.30479999999999996 m
