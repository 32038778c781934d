"""Every rival was measured: no study skipped, no row ``not installed``.

After the studies of rivals: their results are in validation/results.
"""

import pytest

from validation.harness import store, study
from validation.harness.registry import RIVALS


@pytest.mark.parametrize("name", RIVALS)
def test_every_rival_was_measured(name: str) -> None:
    folder = study.RESULTS / name
    record = store.read(folder)
    assert record.status == "finished"
    for title, table in store.read_tables(folder, record).items():
        assert not (table.astype(str) == "not installed").any(axis=None), title
