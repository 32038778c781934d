"""The statuses in tables, files and exit codes."""

import json
from itertools import chain
from pathlib import Path

import pandas as pd
import pyarrow.parquet as pq
import pytest

from fctd.results.status import RefineStatus, RunStatus, SteadyStatus
from fctd.results.tables import write_table

ALL = list(chain(SteadyStatus, RunStatus, RefineStatus))


def test_what_is_acceptable_has_loads() -> None:
    assert [str(status) for status in SteadyStatus if status.has_loads] == [
        "converged", "locked_up", "under_resolved", "unstable",
    ]  # fmt: skip
    assert [str(status) for status in ALL if status.acceptable] == [
        "converged", "locked_up", "completed", "within_tolerance",
    ]  # fmt: skip
    assert all(status.has_loads for status in ALL if status.acceptable)
    assert all(status.message for status in ALL if not status.acceptable)


@pytest.mark.parametrize("status", ALL)
def test_a_status_is_plain_text(status: SteadyStatus | RunStatus | RefineStatus) -> None:
    assert (status == status.value, f"{status}", json.dumps(status)) == (True, status.value, f'"{status.value}"')
    assert type(status)(status.value) is status


def test_files_keep_the_word(tmp_path: Path) -> None:
    write_table(pd.DataFrame({"status": ALL}), tmp_path / "t.parquet", {"status": RunStatus.COMPLETED})
    table = pq.read_table(tmp_path / "t.parquet")
    assert table["status"].to_pylist() == [status.value for status in ALL]
    assert (table.schema.metadata or {})[b"status"] == b"completed"
