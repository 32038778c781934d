"""Registries: what is not there is named, with what to do about it."""

import pytest

from fctd.case.errors import InputError
from references import contact, engines
from references.registry import Registry, version_of

OPTIONAL = [("fcl", contact.REGISTRY), ("coal", contact.REGISTRY), ("mujoco", engines.REGISTRY)]


@pytest.mark.parametrize(("name", "registry"), OPTIONAL)
def test_a_missing_package_is_named(name: str, registry: Registry) -> None:
    with pytest.raises(InputError) as told:
        registry.need("a_module_that_is_not_there", name)
    assert registry.find(name).distribution in str(told.value)
    assert "not installed" in str(told.value)
    assert told.value.key == registry.key


def test_a_package_that_is_not_there_has_no_version() -> None:
    assert version_of("fctd") is not None
    assert version_of("fctd-is-not-called-so") is None


@pytest.mark.parametrize(
    ("wrong", "right", "registry"),
    [("cylindrs", "cylinders", contact.REGISTRY), ("elastic", "elastica", engines.REGISTRY)],
)
def test_an_unknown_name_is_answered_with_the_nearest(wrong: str, right: str, registry: Registry) -> None:
    with pytest.raises(InputError, match=right) as told:
        registry.find(wrong)
    assert (told.value.key, told.value.value) == (registry.key, wrong)


@pytest.mark.parametrize("registry", [contact.REGISTRY, engines.REGISTRY])
def test_every_entry_is_a_class_of_its_name(registry: Registry) -> None:
    for name in registry.entries:
        assert registry.find(name).name == name
