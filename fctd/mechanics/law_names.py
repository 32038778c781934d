"""The laws of friction by their names in a case file, one line each; nothing is compiled here.

A name stands for a ``friction.Law`` of a module in ``laws/``; the code of a law is its place.
"""

from typing import Final

LAWS: Final = {
    "coulomb": "coulomb.LAW",
    "paper": "paper.LAW",
    "karnopp": "sticking.KARNOPP",
    "stribeck": "sticking.STRIBECK",
}
NAMES: Final = tuple(LAWS)
CODES: Final = {name: code for code, name in enumerate(LAWS)}
# The laws with a static factor.
STICKING: Final = tuple(name for name, place in LAWS.items() if place.startswith("sticking."))
