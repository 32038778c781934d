"""The laws of friction by their names in a case file, one line each; nothing is compiled here."""

from typing import Final, NamedTuple


class NamedLaw(NamedTuple):
    """A law by its place in the sources.

    place : module of ``laws/`` and name of the ``friction.Law`` there.  keys : of an interval of the hole, beside its
    kinetic friction, that the law uses; every other law refuses them.
    """

    place: str
    keys: tuple[str, ...] = ()


# The code of a law is its place here.
LAWS: Final = {
    "coulomb": NamedLaw("coulomb.LAW"),
    "paper": NamedLaw("paper.LAW"),
    "karnopp": NamedLaw("sticking.KARNOPP", ("static_friction", "overbalance")),
    "stribeck": NamedLaw("sticking.STRIBECK", ("static_friction", "overbalance", "decay_speed")),
}
NAMES: Final = tuple(LAWS)
CODES: Final = {name: code for code, name in enumerate(LAWS)}
# The laws with a static factor.
STICKING: Final = tuple(name for name, law in LAWS.items() if "static_friction" in law.keys)
