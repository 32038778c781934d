"""What the project says of itself: version, citation, licence, supported Pythons, and the lowest versions it allows."""

import runpy
import tomllib
from importlib.metadata import version
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import fctd

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


@pytest.fixture(scope="module")
def lowest() -> SimpleNamespace:
    """The script that names the pins of ``make lowest``."""
    return SimpleNamespace(**runpy.run_path(str(ROOT / ".ci" / "lowest.py")))


@pytest.fixture(scope="module")
def citation() -> dict[str, Any]:
    """CITATION.cff as a YAML reader sees it."""
    found: dict[str, Any] = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    return found


def test_the_version_is_one() -> None:
    assert fctd.__version__ == version("fctd") == PROJECT["version"]


def test_the_citation_names_this_version_and_has_what_cff_demands(citation: dict[str, Any]) -> None:
    assert citation["cff-version"] == "1.2.0"
    assert {"message", "title", "authors"} <= citation.keys()
    assert citation["type"] == "software"
    assert str(citation["version"]) == PROJECT["version"]


def test_the_citation_names_the_paper(citation: dict[str, Any]) -> None:
    """The numbers are those of the journal; CFF has ``start`` and ``end`` for pages."""
    (paper,) = citation["references"]
    assert {"type", "title", "authors"} <= paper.keys()
    assert (paper["volume"], paper["issue"], paper["year"]) == (30, 1, 2024)
    assert (paper["start"], paper["end"]) == (417, 443)
    readme = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
    assert paper["title"] in readme
    assert paper["journal"] in readme


def test_nothing_names_a_licence_before_the_owner_has_chosen_one(citation: dict[str, Any]) -> None:
    """The day a licence is chosen, this test goes, and README, metadata and citation name it."""
    assert not list(ROOT.glob("LICEN[CS]E*"))
    assert "No licence is chosen" in (ROOT / "README.md").read_text(encoding="utf-8")
    assert "license" not in citation
    assert "license" not in PROJECT
    assert [each for each in PROJECT["classifiers"] if each.startswith("License")] == []


def test_the_classifiers_name_the_pythons_that_set_up_accepts() -> None:
    specifier = Requirement(f"fctd{PROJECT['requires-python']}").specifier
    accepted = {f"3.{minor}" for minor in range(9, 18) if f"3.{minor}.0" in specifier}
    head = "Programming Language :: Python :: "
    assert {each.removeprefix(head) for each in PROJECT["classifiers"] if each.startswith(head)} == accepted


def test_every_requirement_of_a_user_has_one_lower_bound_that_the_lock_keeps(lowest: SimpleNamespace) -> None:
    """``make lowest`` tests with exactly these versions; the same package has one bound in all extras."""
    needs = lowest.bounded(PROJECT)
    names = [canonicalize_name(need.name) for need in needs]
    assert {"numpy", "scipy", "typer", "matplotlib", "dask"} <= set(names)
    assert len(names) == len(set(names))
    assert set(lowest.OF_CHECKOUT) < PROJECT["optional-dependencies"].keys()
    locked = [line.split(" ")[0].partition("==") for line in (ROOT / "requirements.lock").read_text().splitlines()]
    pinned = {canonicalize_name(name): pin for name, found, pin in locked if found}
    for need in needs:
        bound = Requirement(lowest.lowest(need))
        assert next(iter(bound.specifier)).version in need.specifier
        assert pinned[canonicalize_name(need.name)] in need.specifier


@pytest.mark.parametrize("text", ["numpy", "numpy<3", "numpy>=1,>=2"])
def test_a_requirement_without_one_lower_bound_is_refused(text: str, lowest: SimpleNamespace) -> None:
    with pytest.raises(ValueError, match=r"expected one lower bound, as in numpy>=1\.2\.0"):
        lowest.lowest(Requirement(text))


def test_the_pins_hold_the_bounds_and_what_runs_the_tests(
    lowest: SimpleNamespace, capsys: pytest.CaptureFixture[str]
) -> None:
    assert lowest.main() == 0
    pins = capsys.readouterr().out.splitlines()
    assert all(pin.count("==") == 1 for pin in pins)
    assert {pin.partition("==")[0] for pin in pins} > {"numba", "lasio", *lowest.RUNNERS}
