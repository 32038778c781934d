"""Registries of what may not be installed: a name stands for "module:class", imported when it is asked for."""

import importlib
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from typing import Any, ClassVar, Generic, Protocol, TypeVar

from fctd.case.errors import InputError, Table, nearest
from fctd.case.raw_case import checked

# The first Python that pybullet has no wheels for.
NO_PYBULLET = (3, 12)


class Registered(Protocol):
    """What a class in a registry gives: the package that brings it, and its options."""

    distribution: ClassVar[str]
    Options: ClassVar[type[Table]]


T = TypeVar("T", bound=Registered)


@dataclass(frozen=True)
class Registry(Generic[T]):
    """Names of classes, "module:class" each.

    noun : what messages call an entry.  key : the key of messages under which a name is given.
    """

    entries: Mapping[str, str]
    noun: str
    key: str

    def find(self, name: str) -> type[T]:
        """The class registered under a name; InputError with the nearest name for an unknown one."""
        if name not in self.entries:
            raise InputError(nearest(name, self.entries, self.noun), key=self.key, value=name)
        module, _, attribute = self.entries[name].partition(":")
        found: type[T] = getattr(importlib.import_module(module), attribute)
        return found

    def options(self, name: str, given: Mapping[str, Any]) -> Table:
        """Validated options of an entry; InputError for a bad one."""
        model = self.find(name).Options
        try:
            return checked(model, given)
        except InputError as error:
            raise error.at(name) from None

    def installed_version(self, name: str) -> str | None:
        """Version of the package that brings an entry, None where it is not installed."""
        return version_of(self.find(name).distribution)

    def need(self, module: str, name: str) -> Any:
        """Import a module of the package that brings an entry; InputError where it is not installed."""
        return import_optional(module, self.find(name).distribution, name, self.key)


def import_optional(module: str, distribution: str, wanted_for: str, key: str) -> Any:
    """Import a module of an optional package; InputError naming the package where it is not installed."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name is None or error.name.partition(".")[0] != module.partition(".")[0]:
            raise
        raise InputError(f"package {absent(distribution)}", key=key, value=wanted_for) from None


def version_of(distribution: str) -> str | None:
    """Version of a package, None where it is not installed."""
    try:
        return version(distribution)
    except PackageNotFoundError:
        return None


def absent(distribution: str) -> str:
    """That a package is not installed, and how to have it."""
    if distribution == "pybullet" and sys.version_info >= NO_PYBULLET:
        how = "it has no wheels for Python 3.12 and later: run on Python 3.11, or build it by 'make bullet'"
    else:
        how = "it is part of the extra 'suite'"
    return f"{distribution}, which is not installed ({how})"
