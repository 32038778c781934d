"""The stopwatch: what it counts, in which order, and that drift of the machine leaves ratios alone."""

import pytest

from references import timing


def test_turns_alternate_and_the_first_round_does_not_count(monkeypatch: pytest.MonkeyPatch) -> None:
    clock, called = [0.0], []

    def acts(name: str, cost: float):
        def act() -> None:
            called.append(name)
            # The machine slows down by a tenth with every call; compiling makes the first calls slow.
            clock[0] += cost * 1.1 ** len(called) + (100.0 if called.count(name) == 1 else 0.0)

        return act

    monkeypatch.setattr(timing.time, "perf_counter", lambda: clock[0])
    actions = {"a": acts("a", 1.0), "b": acts("b", 6.0)}
    table = timing.race(actions, {"a": 10, "b": 20}, rounds=8, baseline="a").set_index("name")
    assert called[:6] == ["a", "b", "a", "b", "b", "a"]
    assert table.loc["a", "ratio"] == 1
    assert table.loc["b", "ratio"] == pytest.approx(3, rel=0.01)
    assert table.loc["b", "ratio_low"] < 3 < table.loc["b", "ratio_high"]
    assert table.loc["a", "ns"] == pytest.approx(table.loc["b", "ns"] / 3, rel=0.3)
    assert table["ns_low"].le(table["ns"]).all()


def test_the_machine_is_named_with_every_version() -> None:
    found = timing.machine()
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
