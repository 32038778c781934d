"""Strings that the tests of views show."""

from functools import cache

import numpy as np

from fctd.case.load import Case
from fctd.view.strings import Strings, of_chart
from tests.cases import make_case, pipe

STATIONS = [[0.0, 0, 30], [100, 0, 30], [550, 90, 60], [900, 90, 60]]
KINDS = ["trip_out", "trip_in"]
DEPTHS = np.linspace(400.0, 880.0, 7)


def case() -> Case:
    """A well with a shoe at 300 m, collars below pipe, and a name that is no HTML."""
    intervals = [
        {"to_md": 300.0, "diameter": 0.2445, "friction": 0.2, "kind": "cased"},
        {"to_md": 900.0, "diameter": 0.2159, "friction": 0.25, "kind": "open"},
    ]
    parts = [pipe(100, 10, 0.16), pipe(None, None, segment_length=20.0)]
    made = make_case(STATIONS, parts, wellbore={"intervals": intervals})
    return made.model_copy(update={"name": "<a href='https://example.org'>well</a> & $x$"})


@cache
def strings() -> Strings:
    """Two operations at seven depths."""
    return of_chart(case(), KINDS, list(DEPTHS))
