"""Samples: which disturbances cancel, and the exchange with the processes that measure."""

from pathlib import Path

import pytest

from benchmarks import measure, worker
from benchmarks.subjects import ARCS, CYLINDERS, FCL, FREE, REFERENCE, Subject
from fctd.case.errors import InputError


def test_disturbances_of_machine_and_process_cancel_in_a_round() -> None:
    """All costs doubled by load, or a slower reference kernel, do not change the compared ratios."""
    quiet = measure.in_units([{REFERENCE: 4.0, FREE: 20.0}, {REFERENCE: 6.0, FREE: 22.0}])
    assert quiet == measure.in_units([{REFERENCE: 8.0, FREE: 40.0}, {REFERENCE: 12.0, FREE: 44.0}])
    assert quiet[1][FREE] / quiet[0][FREE] == pytest.approx(22 / 20)


def test_kernels_of_the_gate_and_ratios_for_information() -> None:
    costs = {REFERENCE: [1.0, 1.0], FREE: [5.0, 6.0], CYLINDERS: [8.0, 9.0], ARCS: [10.0, 9.0], FCL: [4000.0, 4500.0]}
    assert measure.judged(costs) == {
        FREE: [5.0, 6.0], CYLINDERS: [8.0, 9.0], ARCS: [10.0, 9.0],
        "contact's addition, cylinders": [3.0, 3.0], "contact's addition, arcs": [5.0, 3.0],
    }  # fmt: skip
    assert measure.shown(costs)["FCL query from Python : step, cylinders"] == [500.0, 500.0]
    del costs[FCL]
    assert measure.shown(costs)["contact : contact-free, cylinders"] == [1.6, 1.5]
    assert measure.ratios({REFERENCE: [2.0], FREE: [10.0]}) == {FREE: [5.0]}


def test_a_round_takes_the_shortest_of_its_calls(monkeypatch: pytest.MonkeyPatch) -> None:
    clock, costs = [0.0], iter([3.0, 2.0, 5.0])

    def act() -> None:
        clock[0] += next(costs)

    monkeypatch.setattr(worker.time, "thread_time", lambda: clock[0])
    assert worker.one_round({"x": Subject(act, 4, "unit", "size")}, backwards=False) == {"x": pytest.approx(0.5e9)}


FAKE = """
import json, pathlib, sys
cost = float(pathlib.Path("cost").read_text())
print(json.dumps({{"protocol": {protocol}, "reference": "{reference}", "subjects": {{}}}}), flush=True)
for k, _ in enumerate(sys.stdin):
    print(json.dumps({{"reference": 4.0, "x": cost + (k % 3 == 2)}}), flush=True)
"""


def sources(root: Path, cost: float, protocol: int = worker.PROTOCOL, reference: str = "") -> Path:
    """Sources whose worker returns the given costs and handshake."""
    package = root / "benchmarks"
    package.mkdir(parents=True)
    (package / "__init__.py").touch()
    program = FAKE.format(protocol=protocol, reference=reference or worker.reference_digest())
    (package / "worker.py").write_text(program)
    (root / "cost").write_text(str(cost))
    return root


def test_two_releases_take_turns_in_pairs_of_processes(tmp_path: Path) -> None:
    release, today = sources(tmp_path / "a", 40.0), sources(tmp_path / "b", 60.0)
    before, now = measure.side_by_side(release, 2, today)
    assert before == {REFERENCE: [1.0, 1.0], "x": [10.0, 10.0]}
    assert now == {REFERENCE: [1.0, 1.0], "x": [15.0, 15.0]}
    costs, _ = measure.alone(2, today)
    assert costs["x"] == [60.0, 60.0]


def test_sources_are_compiled_into_a_cache_of_their_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Not into the cache that tests and studies have filled in any order."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "tests"))
    folders = set()
    for text in ("1", "2"):
        (tmp_path / text / "fctd").mkdir(parents=True)
        (tmp_path / text / "fctd" / "joints.py").write_text(text)
        folders.add(measure.environment(tmp_path / text)["NUMBA_CACHE_DIR"])
    assert len(folders) == 2
    assert {Path(folder).parent for folder in folders} == {tmp_path / "fctd"}
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setattr(Path, "home", lambda: (_ for _ in ()).throw(RuntimeError("no home")))
    assert measure.environment(tmp_path)["NUMBA_CACHE_DIR"] == str(tmp_path / "tests")


def test_a_worker_that_fails_or_measures_in_other_units_is_an_error(tmp_path: Path) -> None:
    for name, changes in {"old": {"protocol": 0}, "other": {"reference": "another"}}.items():
        with pytest.raises(InputError, match="same reference kernel and protocol"):
            measure.alone(1, sources(tmp_path / name, 1.0, **changes))
    broken = sources(tmp_path / "broken", 1.0)
    (broken / "benchmarks" / "worker.py").write_text("raise SystemExit('failed')")
    with pytest.raises(InputError, match="whose worker runs"):
        measure.alone(1, broken)
