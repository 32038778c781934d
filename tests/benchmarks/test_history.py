"""Records: readable files, the newest of them, and when one is comparable on this machine."""

import json
from datetime import UTC, datetime
from pathlib import Path

import pytest

from benchmarks import history
from benchmarks.history import Kernel, Record
from fctd.case.errors import InputError

VERSIONS = {"python": "3.11.7", "numba": "0.68.1", "llvmlite": "0.50.0", "numpy": "2.4.6"}


def a_record(**changes: object) -> Record:
    kernel = Kernel(unit="joint", size="64 joints", ns=8.0, samples=(2.0, 1.9, 2.4))
    known = {
        "release": "1.0", "date": datetime(2026, 1, 2, tzinfo=UTC), "commit": "abc1234", "sources": "s",
        "reference": "r", "processor": "P", "versions": VERSIONS, "reference_ns": 4.0,
        "kernels": {"joint loads": kernel},
    }  # fmt: skip
    return Record.model_validate(known | changes)


def test_a_record_is_read_back_from_its_file(tmp_path: Path) -> None:
    record = a_record()
    path = history.write(record, tmp_path)
    assert path.name == "2026-01-02-1.0-abc1234.json"
    assert '"ratio": 2.0' in path.read_text()
    assert history.read(tmp_path) == [(path, record)]


def test_an_old_record_with_counts_of_instructions_is_still_read(tmp_path: Path) -> None:
    path = history.write(a_record(), tmp_path)
    stored = json.loads(path.read_text())
    stored["kernels"]["joint loads"]["instructions"] = 30.0
    path.write_text(json.dumps(stored))
    assert history.read(tmp_path) == [(path, a_record())]


def test_the_last_release_is_the_newest_by_its_own_date(tmp_path: Path) -> None:
    assert history.last_release(tmp_path) is None
    history.write(a_record(release="9.9"), tmp_path)
    history.write(a_record(date=datetime(2026, 3, 1, tzinfo=UTC), release="1.1"), tmp_path)
    history.write(a_record(date=datetime(2026, 2, 1, tzinfo=UTC), release="1.2"), tmp_path)
    found = history.last_release(tmp_path)
    assert found is not None
    assert found[1].release == "1.1"


def test_an_invalid_record_file_is_named(tmp_path: Path) -> None:
    (tmp_path / "x.json").write_text('{"release": "1.0"}')
    with pytest.raises(InputError, match=r"x\.json: date is missing: expected a record"):
        history.read(tmp_path)
    (tmp_path / "x.json").write_bytes(b"\xff\xfe")
    with pytest.raises(InputError, match=r"x\.json: .*expected a record"):
        history.read(tmp_path)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("date", "2026-01-02T00:00:00"),  # without a time zone dates cannot be sorted
        ("commit", "--output=here"),  # git would take it for an option
        ("kernels", {}),
        ("kernels", {"joint loads": {"unit": "joint", "size": "64", "ns": 8.0, "samples": []}}),
        ("kernels", {"joint loads": {"unit": "joint", "size": "64", "ns": 8.0, "samples": [float("nan")]}}),
    ],
)
def test_a_record_with_invalid_values_is_refused(key: str, value: object, tmp_path: Path) -> None:
    path = history.write(a_record(), tmp_path)
    path.write_text(json.dumps(json.loads(path.read_text()) | {key: value}))
    with pytest.raises(InputError, match=rf"\.json: {key}.*expected a record"):
        history.read(tmp_path)


@pytest.mark.parametrize(
    ("reference", "processor", "changed", "reason"),
    [
        ("r", "P", {}, ""),
        ("r", "P", {"numpy": "9"}, ""),
        ("q", "P", {}, "another reference kernel"),
        ("r", "Q", {}, "another processor, P"),
        ("r", "P", {"numba": "0.69"}, "another numba 0.68.1"),
    ],
)
def test_when_ratios_are_comparable(reference: str, processor: str, changed: dict[str, str], reason: str) -> None:
    assert a_record().not_here(reference, processor, VERSIONS | changed) == reason


def test_the_last_record_is_in_units_of_the_present_reference_kernel() -> None:
    """The gate needs a release whose worker measures in the same units."""
    found = history.last_release()
    assert found is not None
    assert found[1].reference == history.reference_digest()
    assert min(len(kernel.samples) for kernel in found[1].kernels.values()) >= 3
