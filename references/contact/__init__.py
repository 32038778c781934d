"""The interface of contact methods, and the registry of all of them.

A method is built for the hole of a case and queried with points.  All methods share one signature, so that the
engine's loop and the studies can swap them; the settings of a method are its ``Options``.
"""

import importlib
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from typing import Any, ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from fctd.case.errors import InputError, Table, explain, nearest
from fctd.case.load import Case
from fctd.model.wellbore import Contacts
from references.packages import absent

Array = NDArray[np.float64]

METHODS: dict[str, str] = {
    "cylinders": "references.contact.own:Cylinders",
    "arcs": "references.contact.own:Arcs",
    "for_loop": "references.contact.own:ForLoop",
    "fcl": "references.contact.fcl:Fcl",
    "coal": "references.contact.coal:Coal",
    "bullet": "references.contact.bullet:Bullet",
    "mujoco": "references.contact.mujoco:MuJoCo",
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


def method_class(name: str) -> type[ContactMethod]:
    """The class registered under a name; InputError with the nearest name for another."""
    found: type[ContactMethod] = registered(METHODS, name, "contact method", "contact")
    return found


def registered(registry: Mapping[str, str], name: str, noun: str, key: str) -> Any:
    """What a registry calls "module:attribute"; InputError with the nearest name for one that it does not have."""
    if name not in registry:
        raise InputError(nearest(name, registry, noun), key=key, value=name)
    module, _, attribute = registry[name].partition(":")
    return getattr(importlib.import_module(module), attribute)


def build(name: str, case: Case, **options: Any) -> ContactMethod:
    """Contact method ``name`` for the hole of ``case``.

    options : keys of the method's ``Options``, quantities as in a case file.  Raises InputError for an unknown
    name, a bad option or a package that is not installed.
    """
    method = method_class(name)
    return method(case, options_of(method.Options, name, options))


def options_of(table: type[Table], name: str, options: Mapping[str, Any]) -> Table:
    """Validated options of what is registered under a name; InputError for a bad one."""
    try:
        return table.model_validate(options)
    except ValidationError as failure:
        raise explain(failure, options, ()).at(name) from None


def need(module: str, method: type[ContactMethod]) -> Any:
    """Import the package of a method; InputError naming it when it is not installed."""
    return import_optional(module, method.distribution, method.name)


def import_optional(module: str, distribution: str, wanted_for: str, key: str = "contact") -> Any:
    """Import a module of an optional package; InputError naming the package when it is not installed."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name is None or error.name.partition(".")[0] != module.partition(".")[0]:
            raise
        raise InputError(f"package {absent(distribution)}", key=key, value=wanted_for) from None


def installed_version(name: str) -> str | None:
    """Version of the package that brings a method, None where it is not installed."""
    return version_of(method_class(name).distribution)


def version_of(distribution: str) -> str | None:
    """Version of a package, None where it is not installed."""
    try:
        return version(distribution)
    except PackageNotFoundError:
        return None
