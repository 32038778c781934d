"""What the packages of contact methods or engines cost their user, a row each."""

from collections.abc import Iterable
from typing import Any

from fctd import InputError
from references import packages
from references.registry import Registry
from validation.harness.study import Rows, table_of_rows


@table_of_rows
def brought(registry: Registry[Any], names: Iterable[str]) -> Rows:
    """Status, distribution, version, licence, installed_mb and pythons of each name; of a plugin that fails, why."""
    for name in names:
        try:
            package = packages.about(registry.find(name).distribution)
        except InputError as error:
            yield {"name": name, "status": f"cannot be loaded: {error}"}
            continue
        about = package._asdict() | {"pythons": ", ".join(package.pythons)}
        yield {"name": name, "status": "installed" if package.version else "not installed"} | about
