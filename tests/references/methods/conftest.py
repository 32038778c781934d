"""Comparisons of tests have time left on any machine; a test of the budget sets what is left of it itself."""

from collections.abc import Iterator

import pytest

from references.methods.compare import Comparing


@pytest.fixture(scope="module", autouse=True)
def hours() -> Iterator[None]:
    """The minute of a quick comparison is of the clock: beside six busy processes an engine had no loads."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Comparing, "left", 3600.0)
        yield
