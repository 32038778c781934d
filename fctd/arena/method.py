"""What a contact method is: a class that is built for the hole of a case, and answers queries of points."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar, Protocol

from fctd.arrays import Array, Contacts
from fctd.case.errors import Table
from fctd.case.load import Case
from fctd.case.raw_case import checked

Settings = Sequence[Mapping[str, Any]]  # options that belong together, a mapping for each setting


class ContactMethod(Protocol):
    """A way to find where points of given radius touch the wall.

    name : under which it is registered.  distribution : the package that provides it.  does : one line for users.
    gives_clearance : whether a penetration below 0 is the true clearance; otherwise it is −inf, and normal and
    md are nan.  Options : a pydantic model of its settings; the ``examples`` of an option are the values that studies
    try, from coarse to fine.  A class may have ``settings`` of the type Settings instead.
    """

    name: str
    distribution: ClassVar[str]
    does: ClassVar[str]
    gives_clearance: bool
    Options: ClassVar[type[Table]]

    def __init__(self, case: Case, options: Any) -> None:
        """Prepare the method for the hole of ``case``; InputError where the hole or an option is not possible."""

    def query(self, points: Array, radii: Array) -> Contacts:
        """Contacts of points (n, 3) [m] with contact radii (n,) [m].

        A clear point has a penetration of at most 0.  A normal is a unit vector from the axis to the wall, md the
        measured depth.
        """

    @property
    def pieces(self) -> int:
        """Number of cylinders, arcs or triangles that represent the hole."""

    def error_bound(self, curvature: float) -> tuple[float, float]:
        """Largest errors in a bend of this curvature [1/m], from the geometry alone.

        Returns the error of penetration [m] and that of the normal's direction [rad] where the wall is in its place.
        A wall that is aside by the first turns the normal by that over the distance of the point from the axis; judges
        add this turn.
        """


def settings_of(method: type[ContactMethod]) -> Iterator[dict[str, Any]]:
    """Options that a comparison tries, from coarse to fine: the settings of a method, else the examples of each option;
    the defaults where it gives none."""
    fields = method.Options.model_fields
    examples = [{key: value} for key, field in fields.items() for value in field.examples or ()]
    yield from map(dict, getattr(method, "settings", ()) or examples or [{}])


def built(method: type[ContactMethod], case: Case, options: Mapping[str, Any]) -> ContactMethod:
    """A method for the hole of a case; InputError for a bad option."""
    return method(case, checked(method.Options, options))
