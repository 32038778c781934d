"""What a package costs its user: licence, installed size, and the Pythons for which it has wheels."""

from functools import cache
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path
from typing import NamedTuple

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[1]
LOCKS = ("requirements.lock", "rivals.lock")
PYTHONS = ("3.11", "3.12", "3.13", "3.14")  # of pyproject.toml
OWN = "fctd"
LONGEST = 40  # letters of a licence's name; longer is its text


class Package(NamedTuple):
    """version : None where it is not installed, as are licence and size then.

    licence : as its metadata say.  installed_mb : with what it needs beside the packages that FCTD needs.
    pythons : for which the locks have it.
    """

    distribution: str
    version: str | None
    licence: str | None
    installed_mb: float | None
    pythons: tuple[str, ...]


@cache
def about(name: str) -> Package:
    """What is known of a package, also of one that is not installed."""
    found = _installed(name)
    if found is None:
        return Package(name, None, None, None, pythons(name))
    brought = needed(name) - (set() if name == OWN else needed(OWN))
    size = sum(_size(each) for each in brought) if name != OWN else 0.0
    return Package(name, found.version, _licence(found), size, pythons(name))


def needed(name: str) -> set[str]:
    """A package and all that it needs, without extras; those that are installed."""
    found: set[str] = set()
    waiting = [name]
    while waiting:
        each = canonicalize_name(waiting.pop())
        if each in found or (package := _installed(each)) is None:
            continue
        found.add(each)
        asked = map(Requirement, package.requires or [])
        waiting += [need.name for need in asked if need.marker is None or need.marker.evaluate({"extra": ""})]
    return found


def pythons(name: str) -> tuple[str, ...]:
    """Versions of Python for which a lock holds the package; all of them for one that no lock names."""
    for text in _pins():
        pin = Requirement(text)
        if canonicalize_name(pin.name) == canonicalize_name(name) and pin.marker is not None:
            return tuple(each for each in PYTHONS if pin.marker.evaluate({"python_version": each}))
    return PYTHONS


@cache
def _pins() -> tuple[str, ...]:
    lines = (line.partition("#")[0].strip() for lock in LOCKS for line in (ROOT / lock).read_text().splitlines())
    return tuple(line for line in lines if line)


def _installed(name: str) -> Distribution | None:
    try:
        return distribution(name)
    except PackageNotFoundError:
        return None


def _licence(package: Distribution) -> str:
    """The licence by its expression, else by classifiers, else by a short text; long texts are left to the package."""
    about = package.metadata
    if "License-Expression" in about:
        return about["License-Expression"].removeprefix("LicenseRef-")
    kinds = [each.rpartition("::")[2].strip() for each in about.get_all("Classifier") or [] if "License ::" in each]
    text = about["License"] if "License" in about else ""  # noqa: SIM401 (typed without get)
    return "; ".join(kinds) or (text if 0 < len(text) < LONGEST else "see the package")


def _size(name: str) -> float:
    """Size of an installed package's files [MB]."""
    files = distribution(name).files or []
    return sum(path.stat().st_size for file in files if (path := Path(str(file.locate()))).is_file()) / 1e6
