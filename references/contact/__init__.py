"""The interface of contact methods, and the registry of all of them.

A method is built for the hole of a case and queried with points.  All methods share one signature, so that the
engine's loop and the studies can swap them; the settings of a method are its ``Options``.
"""

from typing import Any

from fctd.arena.method import ContactMethod as ContactMethod
from fctd.case.load import Case
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
