"""The contract of contact methods as tests: ``pytest -p fctd.arena.pytest_plugin --contact-method MODULE:CLASS``.

Each demand is a test of its own, beside those that pytest collects.
"""

from importlib import import_module
from typing import Any

import pytest

from fctd.arena.contract import DEMANDS, Demand, Trial, held


def pytest_addoption(parser: pytest.Parser) -> None:
    """The option that names the methods."""
    parser.addoption(
        "--contact-method", action="append", default=[], metavar="MODULE:CLASS",
        help="hold a contact method of FCTD to its contract; may be repeated",
    )  # fmt: skip


def pytest_collection_modifyitems(session: pytest.Session, config: pytest.Config, items: list[pytest.Item]) -> None:
    """Add the demands of each method."""
    for given in config.getoption("--contact-method"):
        module, _, name = given.partition(":")
        try:
            trial = Trial(getattr(import_module(module), name), {})
        except (ImportError, AttributeError, ValueError) as error:
            raise pytest.UsageError(f"--contact-method {given}: expected MODULE:CLASS ({error})") from error
        for demand in DEMANDS:
            named = f"{given}::{demand.__name__}"
            items.append(DemandItem.from_parent(session, name=named, trial=trial, demand=demand))


class DemandItem(pytest.Item):
    """A demand of a method."""

    def __init__(self, *, trial: Trial, demand: Demand, **others: Any) -> None:
        super().__init__(**others)
        self.trial, self.demand = trial, demand

    def runtest(self) -> None:
        """Fail where the demand is not kept; a remark is a section of the report."""
        found = held(self.demand, self.trial)
        if not found.kept:
            pytest.fail(f"{found.demand}: {found.says}", pytrace=False)
        if found.says:
            self.add_report_section("call", "remark", found.says)

    def reportinfo(self) -> tuple[str, None, str]:
        """Where pytest says that it is."""
        return str(self.path), None, self.name
