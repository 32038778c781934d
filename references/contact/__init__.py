"""The interface of contact methods, and the registry of all of them.

A method is built for the hole of a case and queried with points.  All methods share one signature, so that the
engine's loop and the studies can swap them; the settings of a method are its ``Options``.
"""

from typing import Any, ClassVar, Protocol

from fctd.arrays import Array
from fctd.case.errors import Table
from fctd.case.load import Case
from fctd.model.wellbore import Contacts
from references.registry import Registry

METHODS: dict[str, str] = {
    "cylinders": "references.contact.own:Cylinders",
    "arcs": "references.contact.own:Arcs",
    "for_loop": "references.contact.own:ForLoop",
    "axis_frame": "references.contact.axis_frame:AxisFrame",
    "sdf": "references.contact.sdf:Sdf",
    "fcl": "references.contact.fcl:Fcl",
    "coal": "references.contact.coal:Coal",
    "bullet": "references.contact.bullet:Bullet",
    "mujoco": "references.contact.mujoco:MuJoCo",
    "libigl": "references.contact.libigl:LibIgl",
    "trimesh": "references.contact.trimesh:TriMesh",
}


class ContactMethod(Protocol):
    """A way to find where points of given radius touch the wall.

    name : its key in METHODS.  distribution : the package that provides it.  does : one line for users.
    gives_clearance : whether a penetration below 0 is the true clearance; otherwise it is −inf, and normal and
    md are nan.
    """

    name: str
    distribution: ClassVar[str]
    does: ClassVar[str]
    gives_clearance: bool
    Options: ClassVar[type[Table]]

    def __init__(self, case: Case, options: Any) -> None:
        """Prepare the method for the hole of ``case``; InputError where the hole or an option is not possible."""

    def query(self, points: Array, radii: Array) -> Contacts:
        """Contacts of points (n, 3) [m] with contact radii (n,) [m]; see ``fctd.model.wellbore.Contacts``."""

    @property
    def pieces(self) -> int:
        """Number of cylinders, arcs or triangles that represent the hole."""

    def error_bound(self, curvature: float) -> tuple[float, float]:
        """Largest error of penetration [m] and of the normal's direction [rad] in a bend of this curvature
        [1/m], from the geometry alone."""


REGISTRY: Registry[ContactMethod] = Registry(
    METHODS, ("references.rivals", "METHODS"), "fctd_references.contact_methods", "contact method", "contact"
)
method_class = REGISTRY.find
installed_version = REGISTRY.installed_version
need = REGISTRY.need


def build(name: str, case: Case, **options: Any) -> ContactMethod:
    """Contact method ``name`` for the hole of ``case``.

    options : keys of the method's ``Options``, quantities as in a case file.  Raises InputError for an unknown
    name, a bad option or a package that is not installed.
    """
    return method_class(name)(case, REGISTRY.options(name, options))
