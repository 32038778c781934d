"""Fixtures that skip the test of an engine whose package is missing."""

import pytest

from tests.references.engines.turning import needs


@pytest.fixture(autouse=True)
def installed(request: pytest.FixtureRequest) -> None:
    """Skip a test whose parameter ``name`` is an engine that is not installed."""
    callspec = getattr(request.node, "callspec", None)
    if callspec is not None and "name" in callspec.params:
        needs(callspec.params["name"])


@pytest.fixture
def bullet() -> None:
    needs("bullet")
