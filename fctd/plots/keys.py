"""Keys of a case in words, with their units, for the axes of pictures."""

from itertools import pairwise
from typing import Final

from fctd.case.key_quantities import unit_of
from fctd.case.raw_case import split_key
from fctd.case.systems import signed

# Names whose words are others than their own.
WORDS: Final = {
    "rpm": "rotation",
    "friction": "friction factor",
    "rotational_friction": "friction factor around the hole",
    "static_friction": "static friction factor",
    "youngs_modulus": "Young's modulus",
    "poisson_ratio": "Poisson's ratio",
    "to_md": "lower end",
    "from_md": "upper end",
}
# Lists of tables, and what an item of each is called.
ITEMS: Final = {"operations": "operation", "components": "component", "intervals": "interval"}
# Tables that a name needs not beside it.
PLAIN: Final = ("wellbore", "string", "rig", "contact", "solver", "record")
KINDS: Final = {"cased": "cased hole", "open": "open hole"}


def in_words(key: str) -> str:
    """A key of a case in words: ``operations[0].rpm`` is "rotation, operation 1"."""
    *tables, last = parts = split_key(key)
    if parts[0] in ("friction", "rotational_friction"):  # of all intervals, or of those of a kind
        return ", ".join([WORDS[parts[0]], *(KINDS.get(str(part), str(part)) for part in parts[1:])])
    text = WORDS.get(str(last), str(last).replace("_", " "))
    before = [part for part in tables if isinstance(part, str) and part not in (*PLAIN, *ITEMS)]
    if before and before[-1] not in text:
        text = f"{before[-1]} {text}"
    items = [
        f"{ITEMS[table]} {at + 1}"
        for table, at in pairwise(parts)
        if isinstance(table, str) and table in ITEMS and isinstance(at, int)
    ]
    return ", ".join([text, *items])


def labelled(key: str, unit: str) -> str:
    """A key in words with a unit of its numbers: the one that they are written with, or of bare numbers the SI unit."""
    written = signed(unit or unit_of(key)).replace("rpm", "rev/min")
    return f"{in_words(key)}, {written}" if written else in_words(key)
