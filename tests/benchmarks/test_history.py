"""Baselines: readable files, the rule by which they move forward, and the curve over them."""

import json
import math
from datetime import UTC, datetime
from pathlib import Path

import pytest

from benchmarks import checkout, history
from benchmarks.history import Change, Record
from benchmarks.verdict import Verdict
from fctd.case.errors import InputError

AS_BEFORE, FASTER = Verdict("a", "as before", 1.01, 0.99, 1.03), Verdict("a", "faster", 0.8, 0.79, 0.82)
SLOWER = Verdict("b", "slower", 1.2, 1.15, 1.25)


def a_record(**changes: object) -> Record:
    known = {
        "date": datetime(2026, 1, 2, tzinfo=UTC), "commit": "abc12345", "sources": "s", "machine": {"processor": "P"},
        "changes": {"joint loads": Change(ratio=1.2, low=1.15, high=1.25)},
    }  # fmt: skip
    return Record.model_validate(known | changes)


def test_a_record_is_read_back_from_its_file(tmp_path: Path) -> None:
    later = a_record(date=datetime(2026, 3, 1, tzinfo=UTC), accepted={"joint loads": "two springs"})
    path = history.write(later, tmp_path)
    assert path.name == "2026-03-01-abc12345.json"
    earlier = history.write(a_record(), tmp_path)
    assert history.read(tmp_path) == [(earlier, a_record()), (path, later)]
    assert later.entry("joint loads") == "joint loads 1.20 times (1.15 to 1.25): two springs"
    assert a_record(accepted={"gone": "not needed"}).entry("gone") == "gone: not needed"


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("date", "2026-01-02T00:00:00"),  # without a time zone dates cannot be sorted
        ("commit", "--output=here"),  # git would take it for an option
        ("changes", {"joint loads": {"ratio": 0.0, "low": 1.0, "high": 1.0}}),
        ("changes", {"joint loads": {"ratio": float("nan"), "low": 1.0, "high": 1.0}}),
        ("kernels", {}),
    ],
)
def test_a_record_with_invalid_values_is_refused(key: str, value: object, tmp_path: Path) -> None:
    path = history.write(a_record(), tmp_path)
    path.write_text(json.dumps(json.loads(path.read_text()) | {key: value}))
    with pytest.raises(InputError, match=rf"\.json: {key}.*expected a record"):
        history.read(tmp_path)


def test_an_invalid_record_file_is_named(tmp_path: Path) -> None:
    (tmp_path / "x.json").write_text('{"release": "1.0"}')
    with pytest.raises(InputError, match=r"x\.json: date is missing: expected a record"):
        history.read(tmp_path)
    with pytest.raises(InputError, match="a folder of records"):
        history.read(tmp_path / "none")


@pytest.mark.parametrize(
    ("verdicts", "accepted", "refusal"),
    [
        ([AS_BEFORE], {}, "the baseline stays"),
        ([FASTER, SLOWER], {}, "a reason, as in --accept 'b=REASON'"),
        ([FASTER], {"a": "it is slower"}, r"a kernel that the gate fails \(none\)"),
        ([SLOWER], {"b": "two springs", "a": "and this"}, r"a kernel that the gate fails \(b\)"),
        ([Verdict("late", "no baseline")], {}, "--accept 'late=REASON'"),
        ([Verdict("gone", "missing")], {}, "--accept 'gone=REASON'"),
    ],
)
def test_a_baseline_moves_only_by_a_gain_or_an_explained_entry(
    verdicts: list[Verdict], accepted: dict[str, str], refusal: str
) -> None:
    with pytest.raises(InputError, match=refusal):
        history.record_of(verdicts, accepted, a_record())


def test_a_gain_a_new_kernel_and_an_explained_slowdown_make_a_baseline() -> None:
    for verdicts, accepted in (
        ([FASTER], {}), ([AS_BEFORE, Verdict("fresh", "new")], {}), ([AS_BEFORE, SLOWER], {"b": "two springs"}),
    ):  # fmt: skip
        record = history.record_of(verdicts, accepted, a_record())
        assert record.accepted == accepted
        assert record.changes.keys() == {each.kernel for each in verdicts if not math.isnan(each.change)}
        assert {"load average", "governor", "caches", "reference kernel", "numba"} <= record.machine.keys()
    assert record.changes["b"] == Change(ratio=1.2, low=1.15, high=1.25)
    assert history.record_of([], {}, None).changes == {}  # the first of all


def test_what_is_accepted_since_a_date_adds_up() -> None:
    def one(month: int, accepted: dict[str, str]) -> tuple[Path, Record]:
        return Path(), a_record(date=datetime(2026, month, 1, tzinfo=UTC), accepted=accepted)

    records = [one(1, {"joint loads": "a"}), one(3, {"joint loads": "b"}), one(4, {}), one(5, {"joint loads": "c"})]
    assert history.accepted_since(datetime(2026, 2, 1, tzinfo=UTC), records) == pytest.approx({"joint loads": 1.44})
    assert history.accepted_since(datetime(2026, 6, 1, tzinfo=UTC), records) == {}


def test_a_curve_is_the_product_of_the_changes() -> None:
    def one(**changes: float) -> tuple[Path, Record]:
        found = {name: Change(ratio=ratio, low=ratio, high=ratio) for name, ratio in changes.items()}
        return Path(), a_record(changes=found)

    found = history.curves([one(), one(a=0.5, b=2.0), one(a=1.2), one(a=1.0, fresh=1.1)])
    assert found["a"] == pytest.approx([1.0, 0.5, 0.6, 0.6])
    assert found["b"] == [1.0, 2.0]
    np_nan = [math.isnan(each) for each in found["fresh"]]
    assert np_nan == [True, True, False, False]
    assert found["fresh"][2:] == [1.0, 1.1]


def test_a_rewritten_commit_is_found_by_the_file_of_its_record(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """On a rebased branch the recorded commit no longer exists."""
    file = history.HISTORY / "any.json"
    monkeypatch.setattr(checkout, "commit_of", lambda file: "c0ffee")
    monkeypatch.setattr(checkout, "check_out", lambda commit: tmp_path)
    gone = a_record(commit="0123abc", sources=checkout.sources_of(tmp_path))
    assert history.commit_of(gone, file) == "c0ffee"
    with pytest.raises(InputError, match="a commit of this clone"):
        history.commit_of(a_record(commit="0123abc"), file)
    with pytest.raises(InputError, match="a commit of this clone"):
        history.commit_of(gone, tmp_path / "elsewhere.json")


def test_the_last_baseline_has_a_change_for_every_kernel() -> None:
    (_, last) = history.read()[-1]
    assert min(len(last.changes), len(last.machine)) > 10
