"""What a package costs its user."""

import pytest

from references import packages


@pytest.mark.slow
def test_the_size_is_that_of_what_a_package_brings_alone() -> None:
    """numpy and scipy are FCTD's own; coal brings its library, a package by another name."""
    coal, own, trimesh = (packages.about(name) for name in ("coal", "fctd", "trimesh"))
    assert coal.version is not None
    assert "libcoal" in packages.needed("coal")
    assert coal.installed_mb is not None
    assert trimesh.installed_mb is not None
    assert coal.installed_mb > trimesh.installed_mb > 1
    assert own.installed_mb == 0
    assert coal.licence == "BSD-3-Clause"


def test_the_pythons_are_those_of_the_locks() -> None:
    assert packages.pythons("pybullet") == ("3.11",)
    assert packages.pythons("trimesh") == packages.PYTHONS == packages.pythons("warp-lang")


def test_a_package_that_is_not_installed_has_no_version_size_or_licence() -> None:
    assert packages.about("no-such-package")[1:4] == (None, None, None)
