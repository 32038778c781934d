"""A case must not become slower, or other than it was: for the CI of whoever relies on its numbers.

`python examples/guard_a_case.py loads.parquet` keeps the loads where the file is missing, and else compares with them.
`python examples/guard_a_case.py loads.parquet trusted/bin/python` also races the release of that environment.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import pandas as pd

import fctd

OTHER = 1e-3  # change of a load, as a share of the largest
SLOWER = 1.15  # time over that of the trusted release
RACE = """
import time, fctd
case = fctd.load_case("examples/my_well.toml")
times = []
for _ in range(20):
    began = time.process_time()
    fctd.torque_drag(case, ["trip_in", "trip_out"], range(1000, 3001, 250), threads=1)
    times.append(time.process_time() - began)
print(min(times[1:]))  # the first compiles
"""


def least_time(python: str) -> float:
    """The least time of a chart on the processor, in a process of its own [s]."""
    done = subprocess.run([python, "-c", RACE], capture_output=True, text=True, check=True)
    return float(done.stdout)


kept = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(tempfile.mkdtemp()) / "loads.parquet"
case = fctd.load_case("examples/my_well.toml")
loads = fctd.torque_drag(case, ["trip_in", "rotate_off_bottom", "trip_out"], range(1000, 3001, 500))
if not kept.exists():
    loads.to_parquet(kept)
before = pd.read_parquet(kept)  # attrs say of which case and version it is
if before.attrs["case"] != loads.attrs["case"]:
    sys.exit(f"{kept} is of another case: {before.attrs['case']}")
columns = ["hookload_N", "surface_torque_N_m"]
change = ((loads[columns] - before[columns]).abs().max() / before[columns].abs().max()).max()
print(f"largest change since version {before.attrs['version']}: {change:.2e}, statuses: {set(loads['status'])}")
if len(sys.argv) > 2:
    # In turns, as a machine may be busy for a while, and the least, as nothing makes a program faster than it is.
    races = [(least_time(sys.executable), least_time(sys.argv[2])) for _ in range(3)]
    slower = min(here for here, _ in races) / min(there for _, there in races)
    print(f"time over that of {sys.argv[2]}: {slower:.2f}")
    if slower > SLOWER:
        sys.exit("slower than allowed")
assert change <= OTHER
