"""Registries of what may not be installed: a name stands for "module:class", imported when it is asked for.

Entries come from three places: the suite; rivals, whose packages have an environment of their own (``make rivals``);
and plugins, which other packages register as entry points.
"""

import importlib
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.metadata import EntryPoint, PackageNotFoundError, entry_points, version
from typing import Any, ClassVar, Generic, Protocol, TypeVar

from fctd.case.errors import InputError, Table, nearest
from fctd.case.raw_case import checked

# The first Python that pybullet has no wheels for.
NO_PYBULLET = (3, 12)
# Packages of rivals.lock that a rival stands for.
RIVAL_PACKAGES = ("embreex", "exudyn", "newton", "rapier3d", "warp-lang")


class Registered(Protocol):
    """What a class in a registry gives: the package that brings it, and its options."""

    distribution: ClassVar[str]
    does: ClassVar[str]
    Options: ClassVar[type[Table]]


T = TypeVar("T", bound=Registered)


@dataclass(frozen=True)
class Registry(Generic[T]):
    """Names of classes, "module:class" each.

    entries : of the suite.  rivals : the module with rivals' entries, and the name of their table; a name, so that
    nothing of the suite depends on rivals' code.  group : of plugins' entry points.  noun : what messages call an
    entry.  key : the key of messages under which a name is given.
    """

    entries: Mapping[str, str]
    rivals: tuple[str, str]
    group: str
    noun: str
    key: str

    def rival_entries(self) -> Mapping[str, str]:
        """The rivals by name, installed or not."""
        module, table = self.rivals
        found: Mapping[str, str] = getattr(importlib.import_module(module), table)
        return found

    def plugins(self) -> dict[str, EntryPoint]:
        """The entry points of plugins by name; none shadows a name of suite or rivals, nor one found before it."""
        taken = {**self.entries, **self.rival_entries()}
        found: dict[str, EntryPoint] = {}
        for point in _entry_points(self.group):
            if point.name not in taken:
                found.setdefault(point.name, point)
        return found

    def shadowed(self) -> list[EntryPoint]:
        """The entry points of plugins that are left out, since their names are taken."""
        kept = set(map(label, self.plugins().values()))
        return [point for point in _entry_points(self.group) if label(point) not in kept]

    def names(self) -> list[str]:
        """All names: of the suite, of rivals, of plugins."""
        return [*self.entries, *self.rival_entries(), *self.plugins()]

    def find(self, name: str) -> type[T]:
        """The class registered under a name.

        Raises InputError with the nearest name for an unknown one, and for a plugin that cannot be imported.
        """
        if entry := self.entries.get(name) or self.rival_entries().get(name):
            module, _, attribute = entry.partition(":")
            found: type[T] = getattr(importlib.import_module(module), attribute)
            return found
        plugins = self.plugins()
        if name not in plugins:
            raise InputError(nearest(name, self.names(), self.noun), key=self.key, value=name)
        try:
            found = plugins[name].load()
        except Exception as error:  # whatever a plugin raises, the others go on
            why = f"{type(error).__name__}: {error}"
            expected = f"a plugin that can be imported; {label(plugins[name])} raises {why}"
            raise InputError(expected, key=self.key, value=name) from error
        if lacking := [part for part in ("distribution", "does", "Options") if not hasattr(found, part)]:
            expected = f"a class with {', '.join(lacking)}; {label(plugins[name])} has none"
            raise InputError(expected, key=self.key, value=name)
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


@cache
def _entry_points(group: str) -> tuple[EntryPoint, ...]:
    return tuple(sorted(entry_points(group=group), key=lambda point: (point.name, point.value)))


def label(point: EntryPoint) -> str:
    """A plugin's distribution and what it registers."""
    brought = f"{point.dist.name} {point.dist.version}, " if point.dist is not None else ""
    return f"{brought}{point.name} = {point.value}"


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
    elif distribution in RIVAL_PACKAGES:
        how = "'make rivals' installs it in an environment of its own, .venv-rivals"
    else:
        how = "it is part of the extra 'suite'"
    return f"{distribution}, which is not installed ({how})"
