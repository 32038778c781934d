"""Rivals beside the suite: without their packages they are listed, and ask for ``make rivals``."""

import sys
from importlib.metadata import PackageNotFoundError, version

import pytest

from fctd.case.errors import InputError
from references import contact, registry
from references.rivals import METHODS
from tests.references.listing import listed
from tests.references.wells import bent_case


@pytest.fixture
def without_rivals(monkeypatch: pytest.MonkeyPatch) -> None:
    """The environment of the suite, wherever this runs."""

    def found(distribution: str) -> str:
        if distribution in registry.RIVAL_PACKAGES:
            raise PackageNotFoundError(distribution)
        return version(distribution)

    monkeypatch.setattr(registry, "version", found)
    for package in ("embreex", "rapier3d", "warp"):
        monkeypatch.setitem(sys.modules, package, None)


@pytest.mark.usefixtures("without_rivals")
def test_rivals_that_are_not_installed_are_listed() -> None:
    found = listed()
    for name in METHODS:
        distribution = contact.method_class(name).distribution
        row = next(line for line in found.splitlines() if line.startswith(f"│ {name} "))  # methods before engines
        assert [cell.strip() for cell in row.split("│")[2:4]] == [distribution, "not installed"]
        told = f"Package {distribution}, which is not installed ('make rivals' installs it in an environment of its own"
        assert told in found


@pytest.mark.usefixtures("without_rivals")
@pytest.mark.parametrize("name", METHODS)
def test_a_rival_that_is_not_installed_is_an_input_error(name: str) -> None:
    with pytest.raises(InputError, match="which is not installed \\('make rivals'") as told:
        contact.build(name, bent_case())
    assert contact.method_class(name).distribution in str(told.value)
    assert contact.installed_version(name) is None


@pytest.mark.parametrize("name", METHODS)
def test_every_rival_has_the_name_of_its_entry(name: str) -> None:
    assert contact.method_class(name).name == name
    assert name not in contact.METHODS
