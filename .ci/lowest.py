"""The lowest versions that pyproject.toml allows, as pins for pip; ``make lowest`` installs them and runs tests.

``lowest.py`` prints the pins of the engine and of the extras that a user installs, and those that the tests need, which
requirements.lock has.
"""

import sys
import tomllib
from pathlib import Path
from typing import Any

from packaging.requirements import Requirement

ROOT = Path(__file__).parents[1]
# Extras of the checkout: the lock alone installs them.
OF_CHECKOUT = ("suite", "pages", "docs", "dev")
# What runs and builds the tests, and the charts of pytest-benchmark.
RUNNERS = ("hypothesis", "pytest", "pytest-benchmark", "pytest-xdist", "setuptools")


def bounded(project: dict[str, Any]) -> list[Requirement]:
    """Requirements of the engine and of users' extras; project : the table of that name in pyproject.toml."""
    extras = project["optional-dependencies"]
    asked = [*project["dependencies"], *(text for name in extras if name not in OF_CHECKOUT for text in extras[name])]
    return [Requirement(text) for text in dict.fromkeys(asked)]


def lowest(need: Requirement) -> str:
    """The pin of a requirement's lower bound; ValueError where it has not exactly one."""
    bounds = [each.version for each in need.specifier if each.operator == ">="]
    if len(bounds) != 1:
        raise ValueError(f"pyproject.toml: {need}: expected one lower bound, as in {need.name}>=1.2.0")
    return f"{need.name}=={bounds[0]}"


def main() -> int:
    """Print all pins, a line each; exit code 1 where a requirement has no bound."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    locked = (ROOT / "requirements.lock").read_text(encoding="utf-8").splitlines()
    try:
        found = [lowest(need) for need in bounded(project)]
    except ValueError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    print("\n".join([*found, *(line for line in locked if line.partition("==")[0] in RUNNERS)]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
