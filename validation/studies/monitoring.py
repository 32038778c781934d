"""Steps of the friction in synthetic readings: how soon they are found, how often an alarm is false, and the time."""

import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd

import fctd
from fctd import Case
from fctd.monitoring.alarm import Alarm, Detector
from fctd.monitoring.friction import Uncertainty, apparent
from fctd.monitoring.monitor import Monitor
from fctd.monitoring.stretches import by_depth
from fctd.monitoring.synthetic import over_time, raised, steady_readings, with_noise, with_step
from references.timing.stopwatch import rounds
from validation.cases.wells import COLLAR, PIPE, S_WELL, TURN, Stations
from validation.harness.study import Check, Context, Outcome, Study, time_check

STAND = 28.0  # [m]
STEP = 0.25
ROWS, ROUNDS = 100_000, 3
# Of a step in new hole: stands in which it is to be found, and the share of trials in which it must be.
STANDS, FOUND = 10, 0.8
SHARES = (0.25, 0.5, 1.0, 2.0, 4.0)
BUILD: Stations = [[0, 0, 0], [400, 0, 0], [1000, 50, 0], [2800, 50, 0]]


def wells(context: Context) -> dict[str, tuple[Case, float]]:
    """Cases with the casing shoe [m]: build and hold; a well that turns and builds to 85°; an S."""
    stations: Stations = [*BUILD[:-1], [2200, 50, 0]] if context.quick else BUILD
    found = {"build and hold": (case_of("build and hold", stations, 1400.0), 1400.0)}
    if not context.quick:
        found["turn"] = (case_of("turn", TURN, 1500.0), 1500.0)
        found["S"] = (case_of("S", S_WELL, 1200.0), 1200.0)
    return found


def case_of(name: str, stations: Stations, shoe: float) -> Case:
    """8.5 in hole below a casing of 8.681 in, 120 m of collars, 5 in pipe in 25 m segments."""
    end = stations[-1][0]
    intervals = [
        {"to_md": shoe, "diameter": 0.2205, "friction": 0.2, "kind": "cased"},
        {"to_md": end, "diameter": 0.2159, "friction": 0.3, "kind": "open"},
    ]
    parts = [{**COLLAR, "length": 120.0, "segment_length": 20.0}, {**PIPE, "segment_length": 25.0}]
    wellbore = {"stations": stations, "geometry": "arcs", "stiffness": 5e7, "intervals": intervals}
    return Case.model_validate(
        {"name": name, "wellbore": wellbore, "string": {"components": parts},
         "mud": {"density": 1250.0, "viscosity": 0}, "rig": {"block_weight": 250e3}}
    )  # fmt: skip


class Trials:
    """Noisy series of one well, seen through one chart."""

    def __init__(self, case: Case, shoe: float) -> None:
        self.case = case
        self.depths = np.arange(shoe + 4 * STAND, case.depths[1], STAND)
        self.chart = Monitor(case).chart
        self.calm = steady_readings(case, list(self.depths))

    def alarms(self, rows: pd.DataFrame, seed: int) -> list[Alarm]:
        """The alarms of one trial."""
        detector, noisy = Detector(STEP), with_noise(rows, np.random.default_rng(seed))
        found = (detector.feed(apparent(stretch, self.chart, Uncertainty())) for stretch in by_depth(noisy))
        return [alarm for alarm in found if alarm is not None]

    def stands(self, stepped: Case, at: float, seeds: Sequence[int]) -> list[float]:
        """Stands from a step at a depth to its alarm, by trial; infinite where none comes."""
        behind = self.depths[self.depths >= at]
        rows = pd.concat([self.calm[self.calm["bit_depth_m"] < at], steady_readings(stepped, list(behind))])
        first = []
        for seed in seeds:
            later = [alarm.found for alarm in self.alarms(rows, seed) if alarm.found >= at and alarm.size > 0]
            first.append(1 + round((later[0] - behind[0]) / STAND) if later else np.inf)
        return first


def run(context: Context) -> Outcome:
    """Readings of rotation, pick-up and slack-off after every stand; noise of 4 % in torque and 1 t in hook load."""
    trials = 20 if context.quick else 100
    rows, new, false, metres = [], [], 0, 0.0
    for name, (case, shoe) in context.progress(wells(context).items(), "well"):
        each = Trials(case, shoe)
        alarms = sum(len(each.alarms(each.calm, seed)) for seed in range(trials))
        length = (each.depths[-1] - each.depths[0]) * trials / 1e3
        false, metres = false + alarms, metres + length
        for share in (2 / 3,) if context.quick else (1 / 3, 2 / 3):
            at = float(each.depths[int(share * len(each.depths))])
            stands = each.stands(raised(case, STEP), at, range(1000, 1000 + trials))
            rows.append(
                {"well": name, "step_at_m": at, "trials": trials, "median_stands": float(np.median(stands)),
                 "within_three": float(np.mean(np.array(stands) <= 3)), "false_alarms_per_km": alarms / length}
            )  # fmt: skip
        at = float(each.depths[len(each.depths) // 3])
        for step in SHARES[1:2] if context.quick else SHARES:
            stands = each.stands(with_step(case, at, step), at, range(2000, 2000 + trials))
            new.append(
                {"well": name, "step_at_m": at, "step": step,
                 "found_within_ten": float(np.mean(np.array(stands) <= STANDS)),
                 "median_stands": float(np.median(stands))}
            )  # fmt: skip
    whole, fresh = pd.DataFrame(rows), pd.DataFrame(new)
    found = fresh.groupby("step")["found_within_ten"].min()
    smallest = float(found[found >= FOUND].index.min()) if (found >= FOUND).any() else float("inf")
    checks = [
        Check("trials in which a 25 % step of the whole open hole is found within three stands, worst",
              float(whole["within_three"].min()), 0.9, "at_least", "", "target: found within three stands"),
        Check("stands until a 25 % step of the whole open hole is found, largest median",
              float(whole["median_stands"].max()), 3, "at_most", "", "target: three stands"),
        Check("false alarms in 1,000 m", false / metres, 1, "at_most", "", "target"),
    ]  # fmt: skip
    tables = {"whole_hole": whole, "new_hole": fresh}
    if not context.quick:
        time_table = timed()
        tables["time"] = time_table
        checks.append(time_check(f"time for {ROWS} rows over time", time_table["seconds"], 10, "s",
                                 "target, file to alarms"))  # fmt: skip
    told = "none of those tried" if np.isinf(smallest) else f"{smallest:.0%}"
    return Outcome(
        tables=tables,
        checks=checks,
        notes=[
            f"Smallest step in new hole alone that is found within {STANDS} stands in {FOUND:.0%} of the trials of "
            f"every well: {told}. New hole holds a small part of the string, and what it adds to torque and hook load "
            "grows with every stand.",
            f"{false} false alarms in {metres:.0f} km without a step.",
        ],
        display={"whole_hole": "A step of the whole open hole by 25 %", "new_hole": "A step in new hole alone"},
    )


def timed() -> pd.DataFrame:
    """Time from a CSV file to the alarms, a row a round."""
    case, shoe = case_of("build and hold", BUILD, 1400.0), 1400.0
    depths = np.arange(shoe + 4 * STAND, case.depths[1], STAND)
    generator = np.random.default_rng(5)
    readings = with_noise(steady_readings(case, list(depths)), generator)
    interval = 5.0 * len(over_time(readings, generator, case.rig.block_weight)) / ROWS
    series = over_time(readings, generator, case.rig.block_weight, interval)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "series.csv"
        series.to_csv(path, index=False)
        found = fctd.monitor(case, path)
        seconds = rounds(lambda: fctd.monitor(case, path), ROUNDS, time.perf_counter)
    told = {"rows": len(series), "stretches": len(found.stretches), "alarms": len(found.alarms)}
    return pd.DataFrame([told | {"seconds": each} for each in seconds])


STUDY = Study(
    "monitoring",
    "How soon does monitoring find a step of the friction, and how often is an alarm false?",
    run,
    timed=True,
)
