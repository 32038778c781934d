"""The study of speed: steps that hold, the contents of the ratios, and the table of targets."""

import numpy as np
import pandas as pd
import pytest

from references.timing.workloads import moving
from validation.parts import speed_kernel
from validation.studies import speed
from validation.studies.speed import EQUAL, FCTD, FREE, OWN, TAKEN, TOUCHING

FCL = "FCL in our loop"


def times() -> pd.DataFrame:
    """A race in which FCTD's step costs 10 for 60 segments, 4 of them contact, and FCL's 1000 with its loop's 50."""
    rows = []
    for segments, growth in ((60, 1.0), (170, 10.0)):
        for state, step, engine, cost, base in (
            (TOUCHING, EQUAL, FCTD, 10, 10), (TOUCHING, EQUAL, FCL, 1000, 10), (TOUCHING, EQUAL, "Bullet", 5000, 10),
            (TAKEN, EQUAL, FCTD, 6, 10), (TAKEN, EQUAL, FCL, 50, 10),
            (FREE, EQUAL, FCTD, 6, 6), (FREE, EQUAL, FCL, 50, 6), (FREE, EQUAL, "Bullet", 600, 6),
            (TOUCHING, OWN, FCTD, 3, 3), (TOUCHING, OWN, FCL, 300, 3), (TOUCHING, OWN, "Bullet", 2000, 3),
            (FREE, OWN, FCTD, 2, 2), (FREE, OWN, FCL, 20, 2), (FREE, OWN, "Bullet", 240, 2),
        ):  # fmt: skip
            gate = "failed: lean" if (engine, state) == ("Bullet", TOUCHING) else "passed"
            rows.append((state, segments, step, engine, growth * cost, cost / base, "valid", gate))
    columns = ["state", "segments", "step", "engine", "ms_per_simulated_s", "ratio_to_fctd", "check", "gate"]
    return rounds(pd.DataFrame(rows, columns=columns), "ms_per_simulated_s", "ratio_to_fctd")


def rounds(table: pd.DataFrame, *columns: str) -> pd.DataFrame:
    """The same with quartiles 10 % below and above."""
    for column in columns:
        table = table.assign(**{f"{column}_low": 0.9 * table[column], f"{column}_high": 1.1 * table[column]})
    return table


def scaling() -> pd.DataFrame:
    """Twice the segments at half the step and the same cost of a segment-step: four times the cost of a second."""
    segments = np.array([60.0, 120.0, 170.0, 340.0])
    table = pd.DataFrame({"segments": segments, "step_ms": 240.0 / segments, "ns": [20.0, 20.0, 20.0, 30.0]})
    return speed_kernel.with_growth(rounds(table, "ns"))


def test_growth_of_a_simulated_second():
    table = scaling()
    assert table["ms_per_simulated_s"].iloc[0] == pytest.approx(60 * 20e-6 / 4e-3)
    assert np.isnan(table["growth_when_doubled"].iloc[0])
    last = 4.0 * 1.5 ** (1 / np.log2(340 / 60))
    assert table["growth_when_doubled"].iloc[1:].to_list() == pytest.approx([4.0, 4.0, last])
    assert table["growth_when_doubled_low"].iloc[1] == pytest.approx(4.0 * 0.9 / 1.1)


def test_ratios_say_what_they_contain():
    table = speed.ratios(times(), scaling()).set_index("ratio")
    value = table["value"]
    assert value["the same for each segment, 34/4 × 60/170"] == pytest.approx(3.0)
    assert value["what is left for contact, (34/4 × 60/170) / (12/4)"] == pytest.approx(1.0)
    assert value[speed.LEFT_AS_OURS] == pytest.approx(34 / 12 * (60 / 170) ** 2)
    assert value[f"{FCL} : FCTD, 60 segments, a step"] == 100
    # (1000 − 50) / (10 − 6)
    assert value[f"{FCL} : FCTD, 60 segments, each less its own loop without contact"] == pytest.approx(237.5)
    assert value[f"{FCL} with 170 segments : FCTD with 60, contact, own steps"] == pytest.approx(1000)
    assert value["Bullet : FCTD, 60 segments, no contact, own steps"] == 120
    # Each quartile of one time over the farthest of the other; what the paper prints is exact.
    across = table.loc[f"{FCL} with 170 segments : FCTD with 60, contact, own steps"]
    assert (across["value_low"], across["value_high"]) == pytest.approx((1000 * 0.9 / 1.1, 1000 * 1.1 / 0.9))
    assert np.isnan(table["value_low"]["the same for each segment, 34/4 × 60/170"])
    assert table["value_high"][speed.LEFT_AS_OURS] == pytest.approx(value[speed.LEFT_AS_OURS] * 1.1 / 0.9)
    assert "contact" not in table["contains"]["Bullet : FCTD, 60 segments, no contact, own steps"]


def test_ratios_of_an_engine_that_failed_the_gate_are_kept_and_say_so():
    """Rules of the wall do not concern a string that hangs freely."""
    gates = speed.ratios(times(), scaling()).set_index("ratio")["gate"]
    assert gates["Bullet : FCTD, 60 segments, contact, equal step"] == "failed: lean"
    assert gates["Bullet with 170 segments : FCTD with 60, contact, own steps"] == "failed: lean"
    assert gates["Bullet : FCTD, 60 segments, no contact, own steps"] == "passed"
    assert gates[f"{FCL} : FCTD, 60 segments, a step"] == "passed"
    assert (gates[:5] == "").all()


def test_one_count_has_no_ratio_across_counts():
    table = speed.ratios(times()[lambda t: t["segments"] == 60], scaling())
    assert not table["ratio"].str.contains("with 170 segments : FCTD with 60, contact, own").any()


def test_checks_of_a_race():
    made = {check.name: check for check in speed.swap_checks(times())}
    assert made["FCL in our loop over FCTD, a step of 60 segments"].value == 100
    assert made["FCL in our loop over FCTD, a step of 60 segments"].verdict == "missed"
    assert made["FCL in our loop over FCTD, a step of 60 segments"].interval == pytest.approx((90, 110))
    assert made["fastest other engine over FCTD, contact, equal step"].value == 100
    broken = times()
    broken.loc[3, "check"] = "invalid: a position or velocity is not finite"
    (lost,) = (check for check in speed.swap_checks(broken) if "stay in their hole" in check.name)
    assert (lost.value, lost.verdict) == (1, "missed")


def test_targets_and_real_time_factor():
    kernel = pd.DataFrame(
        {
            "name": ["contact", "no contact", speed.BEST, *(f"query {where}, {what}" for where in
                     ("in the step", "of free points") for what in ("cylinders", "arcs"))],
            "ns_least": [30.0, 20.0, 25.0, 3.0, 4.0, 12.0, 36.0],
            "ns": [30.0, 20.0, 25.0, 3.0, 4.0, 12.0, 36.0],
            "step_ms": [3.0, 3.0, 4.5, np.nan, np.nan, np.nan, np.nan],
        }
    )  # fmt: skip
    kernel = rounds(kernel, "ns")
    scaling = pd.DataFrame({"segments": [60.0, 1000.0, 10_000.0], "ns_least": [20.0, 24.0, 90.0]})
    scaling = scaling.assign(ns=scaling["ns_least"])
    steady = pd.DataFrame({"segments": [61.0, 500.0], "slowest_ms": [0.9, 9.5]})
    checks = speed.targets(times(), {"kernel": kernel, "scaling": scaling, "steady": steady})
    found = {check.name: (round(check.value, 3), check.verdict) for check in checks}
    assert found["segment-step with contact, 60 to 1000 segments, slowest"] == (24.0, "met")
    assert found["contact's addition to a segment-step"] == (10.0, "missed")
    # The median meets the bound of 3000, and the lower quartile misses it.
    assert found["real-time factor, 60 segments, largest stable step"] == (3000.0, "missed")
    assert found["query in the step, arcs"] == (4.0, "met")
    assert found["query of free points, cylinders"] == (12.0, "missed")
    assert found["steady depth, 500 segments"] == (9.5, "missed")
    assert found["exponent of a step's cost, 60 to 10000 segments"][1] == "missed"
    table = speed_kernel.table_of(checks, checks[:1], kernel).set_index("what")
    # A quick run has no verdict on the targets of absolute times.
    assert table["verdict"].iloc[:-1].to_list() == [checks[0].verdict, *["not checked"] * (len(checks) - 1)]
    assert table["reached"]["real-time factor, 60 segments, default step"] == "1667"
    # A quick run has no string of 10000 segments, and then no check of the exponent.
    short = {"kernel": kernel, "scaling": scaling[:2], "steady": steady}
    assert not any("exponent" in check.name for check in speed.targets(times(), short))


def test_the_exponent_is_the_slope():
    n = np.array([60.0, 500.0, 10_000.0])
    found = speed_kernel.exponent(pd.DataFrame({"segments": n, "ns": 3 * n**0.2}))
    assert (found.low, found.median, found.high) == pytest.approx((1.2, 1.2, 1.2))


def test_the_ladder_ends_at_the_first_step_that_does_not_hold():
    steps = speed_kernel.ladder(20, 20.0)
    assert steps["holds"][:-1].all()
    assert not steps["holds"].iloc[-1]
    assert 1.2 <= steps.loc[steps["holds"], "over_default"].max() <= 1.5  # the bound of the stiffest mode is 1.25
    assert steps["off_percent"][steps["holds"]].max() <= 1


def test_a_step_whose_loads_are_off_does_not_hold(monkeypatch):
    start, motion = moving(speed_kernel.chain(10), 2.0)
    honest = speed_kernel.run_at(start, motion, start.step, 2.0)
    assert honest["status"] == "valid"
    assert honest["hookload_kN"] == pytest.approx(426.5, rel=0.02)

    def off(start, motion, step, duration):
        return honest | {"step_ms": 1e3 * step, "torque_kN_m": 1.0 + 0.02 * (step > 1.1 * start.step)}

    monkeypatch.setattr(speed_kernel, "run_at", off)
    assert speed_kernel.ladder(10, 2.0)["over_default"].tolist() == [0.25, 1.0, 1.1, 1.2]
