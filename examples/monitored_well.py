"""Readings of a drilled well whose open hole has a quarter more friction from 2,200 m on, and the alarm they raise.

With a file name it writes them, a row for each reading; my_readings.csv is what it wrote.
"""

import sys

import numpy as np
import pandas as pd

import fctd
from fctd.monitoring.synthetic import raised, steady_readings, with_noise

case = fctd.load_case("examples/my_well.toml")
stands = np.arange(1620.0, 2500.0, 28.0)
before = steady_readings(case, stands[stands < 2200])
behind = steady_readings(raised(case, 0.25), stands[stands >= 2200])
readings = with_noise(pd.concat([before, behind], ignore_index=True), np.random.default_rng(4))
if len(sys.argv) == 2 and sys.argv[1].endswith(".csv"):
    readings.round(1).to_csv(sys.argv[1], index=False)
found = fctd.monitor(case, readings)
for alarm in found.alarms:
    print(alarm.sentence)
assert [2200 <= alarm.start <= alarm.found < 2300 for alarm in found.alarms] == [True]
