"""Pressures of flow and of trips, whose eccentricity may be that of the string where it lies."""

from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import ParamSpec, TypeVar

from fctd.case.load import Case
from fctd.hydraulics import pressures, surge
from fctd.steady.equilibrium import lie_along

Asked = ParamSpec("Asked")
Found = TypeVar("Found")
STRING = "string"


def _lying(compute: Callable[Asked, Found]) -> Callable[Asked, Found]:
    """A function of a room that finds no strings; "string", as argument or of the case, is where the string lies."""
    form = signature(compute)

    @wraps(compute)
    def asked(*args: Asked.args, **kwargs: Asked.kwargs) -> Found:
        bound = form.bind(*args, **kwargs).arguments
        case, given = bound.get("case"), bound.get("eccentricity")
        if given is None and isinstance(case, Case):
            given = case.mud.eccentricity
        if isinstance(given, str) and given == STRING:
            bound["eccentricity"] = lie_along
            return compute(**bound)  # type: ignore[call-arg]
        return compute(*args, **kwargs)

    return asked


hydraulics_of = _lying(pressures.hydraulics_of)
surge_pressures = _lying(surge.surge_pressures)
fastest_trips = _lying(surge.fastest_trips)
