"""The laws of friction (``law_names``), and the choice between them at run time.

numba needs a function when it compiles its caller, so the choice is a chain of comparisons, built once from the
table; the code of a law is its index there.
"""

from importlib import import_module
from itertools import groupby
from typing import Any, Final

from fctd.mechanics import law_names
from fctd.mechanics.friction import Law
from fctd.mechanics.jit import inlined


def _law(named: law_names.NamedLaw) -> Law:
    module, name = named.place.split(".")
    found: Law = getattr(import_module(f"{__name__}.{module}"), name)
    return found


LAWS: Final = tuple(map(_law, law_names.LAWS.values()))


def dispatch(functions: Any) -> Any:
    """A function of a law's code and further arguments that calls that law's function, compiled into the caller.

    What several laws share, the first one's or that of neighbours, is compiled once.
    """
    chosen = _without_code(functions[0])
    for function, run in groupby(enumerate(functions), key=lambda numbered: numbered[1]):
        codes = [code for code, _ in run]
        if function is not functions[0]:
            chosen = _with_codes(codes[0], codes[-1], function, chosen)
    return chosen


def _without_code(function: Any) -> Any:
    """The function for whatever code comes: the last choice."""

    @inlined
    def chosen(law, *arguments):
        return function(*arguments)

    return chosen


def _with_codes(first: int, last: int, function: Any, others: Any) -> Any:
    """The function for codes from first to last, else what ``others`` choose."""

    @inlined
    def chosen(law, *arguments):
        if first <= law <= last:
            return function(*arguments)
        return others(law, *arguments)

    return chosen


steady_load: Final = dispatch([law.steady_load for law in LAWS])
shares: Final = dispatch([law.shares for law in LAWS])
