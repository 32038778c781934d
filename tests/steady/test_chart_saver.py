"""Rows of a chart in its folder: when they are written, and what is read back."""

from pathlib import Path

import numpy as np
import pytest

from fctd.steady.chart_saver import ChartSaver
from fctd.steady.torque_drag import Row, chart_rows
from fctd.store import save_interval
from fctd.store.run_folder import RunFolder, chunks_of, progress_of
from tests.steady.test_carried_shape import DEPTHS, KIND, pushed

EVERY = {"operation": "trip_in", "hookload_N": np.float64(0.1) + np.float64(0.2), "torque": float("nan"), "n": 3}


def depth(k: int) -> list[dict[str, object]]:
    return [EVERY | {"bit_depth_m": k / 3}]


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    now = [0.0]
    monkeypatch.setattr("time.monotonic", lambda: now[0])
    monkeypatch.setattr(save_interval, "clocks", lambda: np.array([now[0], now[0]]))
    monkeypatch.setattr(save_interval, "SHARE", 1.0)
    return now


def test_rows_are_read_back_as_they_were(tmp_path: Path, clock: list[float]) -> None:
    described: list[int] = []
    folder = RunFolder.take(tmp_path / "chart.csv")
    kept = ChartSaver(folder, 2.0, lambda: (described.append(1), ({}, {}))[1])
    for k in range(10):
        clock[0] += 0.5
        kept.keep(depth(k), 10)
    assert described == [1]
    assert list(chunks_of(folder.path).files) == [1, 2]
    again = ChartSaver(folder, 2.0)
    plain = {"hookload_N": 0.1 + 0.2}
    assert repr(again.known) == repr([[row | plain for row in depth(k)] for k in range(8)])
    assert again.kept == 8
    progress = progress_of(tmp_path / "chart.csv")
    assert progress is not None
    assert (progress.done, progress.total, progress.kept) == (10, 10, 8)
    again.keep(depth(8), 10)
    again.write_new(10)
    again.write_new(10)  # nothing is new
    assert list(chunks_of(folder.path).files) == [1, 2, 3]
    folder.leave(remove=True)


@pytest.mark.parametrize("damage", ["cut", "flipped", "gone"])
def test_a_damaged_chunk_ends_what_is_known(tmp_path: Path, clock: list[float], damage: str) -> None:
    folder = RunFolder.take(tmp_path / "chart.csv")
    kept = ChartSaver(folder, 0.0)
    for k in range(4):
        clock[0] += 1.0
        kept.keep(depth(k), 10)
    path = chunks_of(folder.path).path(3)
    content = path.read_bytes()
    changes = {"cut": content[:20], "flipped": content.replace(b'"n": 3', b'"n": 7')}
    path.unlink() if damage == "gone" else path.write_bytes(changes[damage])
    again = ChartSaver(folder, 0.0)
    assert len(again.known) == 2
    clock[0] += 1.0
    again.keep(depth(2) + depth(2), 10)  # in the place of the damaged one, and of those after it
    found = ChartSaver(folder, 0.0).known
    assert [row["bit_depth_m"] for rows in found for row in rows] == [0.0, 1 / 3, 2 / 3, 2 / 3]
    folder.leave(remove=True)


def test_a_resolved_chart_goes_on_with_the_shapes_of_its_last_rows(tmp_path: Path, clock: list[float]) -> None:
    """To the last bit as without the interruption, though each row begins with the shape of the one above."""
    case, folder = pushed(1.9, 0.1), RunFolder.take(tmp_path / "chart.csv")
    whole = chart_rows(case, KIND, DEPTHS)
    kept = ChartSaver(folder, 0.0)

    def keep(rows: list[Row]) -> None:
        clock[0] += 1.0
        kept.keep(rows, len(DEPTHS))

    chart_rows(case, KIND, DEPTHS[:3], above=kept.above, keep=keep)
    again = ChartSaver(folder, 0.0)
    assert repr(chart_rows(case, KIND, DEPTHS, known=again.known, above=again.above)) == repr(whole)
    folder.leave(remove=True)
