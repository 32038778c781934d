"""The stopwatch: units, order of calls, and ratios that do not depend on drift of the machine."""

import pytest

from references.timing import stopwatch


def test_turns_alternate_and_the_first_round_does_not_count(monkeypatch: pytest.MonkeyPatch) -> None:
    clock, called = [0.0], []

    def acts(name: str, cost: float):
        def act() -> None:
            called.append(name)
            # The machine becomes slower by a tenth with every call; compiling makes the first calls slow.
            clock[0] += cost * 1.1 ** len(called) + (100.0 if called.count(name) == 1 else 0.0)

        return act

    monkeypatch.setattr(stopwatch.time, "process_time", lambda: clock[0])
    actions = {"a": acts("a", 1.0), "b": acts("b", 6.0)}
    table = stopwatch.race(actions, {"a": 10, "b": 20}, rounds=8, baseline="a").set_index("name")
    assert called[:6] == ["a", "b", "a", "b", "b", "a"]
    assert table.loc["a", "ratio"] == 1
    # In every round b is the call after a or the call before it: the median lies half-way between both.
    assert table.loc["b", "ratio"] == pytest.approx(3 * (1.1 + 1 / 1.1) / 2)
    assert table.loc["b", "ratio_low"] < 3 < table.loc["b", "ratio_high"]
    # Medians of eight calls: of a its calls 10 and 11 of both, of b 9 and 12.
    assert table.loc["a", "ns"] / (table.loc["b", "ns"] / 3) == pytest.approx((1.1 + 1.1**2) / (1 + 1.1**3))
    assert table["ns_low"].le(table["ns"]).all()


def test_the_machine_is_named_with_its_state_and_every_version(monkeypatch, tmp_path) -> None:
    cache = tmp_path / "cache" / "index0"
    cache.mkdir(parents=True)
    for name, text in {"level": "1\n", "type": "Data\n", "size": "32K\n"}.items():
        (cache / name).write_text(text)
    monkeypatch.setattr(stopwatch, "CPU", tmp_path)
    found = stopwatch.machine()
    assert {
        "processor",
        "cores",
        "fctd",
        "numba",
        "python-fcl",
        "coal",
        "pybullet",
        "mujoco",
        "trimesh",
    } <= found.keys()
    assert found["caches"] == "L1 data 32K"
    assert found["governor"] == "unknown"
    assert all(float(each) >= 0 for each in found["load average"].split(", "))
    number, unit = found["reference kernel"].split(" ", 1)
    assert 0.1 < float(number) < 100
    assert unit == "ns a column"


def test_each_has_its_own_baseline(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = [0.0]

    def takes(cost: float):
        def act() -> None:
            clock[0] += cost

        return act

    monkeypatch.setattr(stopwatch.time, "process_time", lambda: clock[0])
    actions = {"a": takes(1.0), "b": takes(2.0), "c": takes(6.0)}
    counts = {"a": 1, "b": 1, "c": 0.5}
    table = stopwatch.race(actions, counts, 3, {"a": "a", "b": "a", "c": "b"}).set_index("name")
    assert table["ratio"].to_dict() == {"a": 1.0, "b": 2.0, "c": 6.0}
    assert table["ns_least"].to_dict() == {"a": 1e9, "b": 2e9, "c": 12e9}


@pytest.mark.parametrize("cost", [1e-7, 3e-4, 0.2])
def test_units_fill_a_call(cost: float, monkeypatch: pytest.MonkeyPatch) -> None:
    clock, calls = [0.0], []

    def work(units: int) -> None:
        # A fixed cost per call, and compilation in the first.
        calls.append(units)
        clock[0] += 2e-6 + cost * units + (1.0 if len(calls) == 1 else 0.0)

    monkeypatch.setattr(stopwatch.time, "process_time", lambda: clock[0])
    units = stopwatch.units_for(work, 0.01)
    assert units == 1 if cost > 0.01 else 0.005 < units * cost < 0.015
    assert len(calls) < 20


def test_a_race_by_another_clock() -> None:
    clock = [0.0]

    def act() -> None:
        clock[0] += 1e-6

    table = stopwatch.race({"a": act}, {"a": 10}, 3, "a", clock=lambda: clock[0])
    assert table["ns"].to_list() == pytest.approx([100.0])
