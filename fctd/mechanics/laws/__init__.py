"""The laws of friction, one import line each, and the choice between them at run time.

numba needs a function when it compiles its caller, so the choice is a chain of comparisons, built once from the
table; the code of a law is its index there.
"""

from itertools import groupby
from typing import Any, Final

from fctd.mechanics.friction import Law
from fctd.mechanics.jit import inlined
from fctd.mechanics.laws.coulomb import LAW as COULOMB  # noqa: F401 (the table collects the laws imported here)
from fctd.mechanics.laws.paper import LAW as PAPER  # noqa: F401
from fctd.mechanics.laws.sticking import KARNOPP, STRIBECK  # noqa: F401

LAWS: Final = tuple(law for law in list(globals().values()) if isinstance(law, Law))
CODES: Final = {law.name: code for code, law in enumerate(LAWS)}
NAMES: Final = tuple(CODES)


def chain(functions: Any) -> Any:
    """A function of a law's code and further arguments that calls that law's function, compiled into the caller.

    What several laws share, the first one's or that of neighbours, is compiled once.
    """
    chosen = _only(functions[0])
    for function, run in groupby(enumerate(functions), key=lambda numbered: numbered[1]):
        codes = [code for code, _ in run]
        if function is not functions[0]:
            chosen = _either(codes[0], codes[-1], function, chosen)
    return chosen


def _only(function: Any) -> Any:
    @inlined
    def chosen(law, *arguments):
        return function(*arguments)

    return chosen


def _either(first: int, last: int, function: Any, others: Any) -> Any:
    @inlined
    def chosen(law, *arguments):
        if first <= law <= last:
            return function(*arguments)
        return others(law, *arguments)

    return chosen


steady_load: Final = chain([law.steady_load for law in LAWS])
shares: Final = chain([law.shares for law in LAWS])
