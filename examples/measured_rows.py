"""Rows for docs/calibrate.md: what a rig would read in the example well, with known friction and seeded noise.

`python examples/measured_rows.py 1200 1700 > rows.csv` writes rows at those bit depths [m].
"""

import sys

import numpy as np

import fctd

TRUTH = {
    "wellbore.intervals[0].friction": 0.17,
    "wellbore.intervals[1].friction": 0.26,
    "rig.block_weight": "265 kN",
    "rig.torque_offset": "0.6 kN*m",
}
depths = [float(depth) for depth in sys.argv[1:]] or [1200.0, 1500.0]
noise = np.random.default_rng([18, len(depths)])
case = fctd.load_case("examples/my_well.toml", TRUTH)
hookload, torque, read = 5e3, 200.0, []  # one standard deviation [N], [N m]
print("id,bit_depth_m,operation,rpm,hookload_kN,torque_kN_m")
for depth in depths:
    for label, operation, rpm in (("up", "trip_out", 0), ("down", "trip_in", 0), ("turning", "rotate_off_bottom", 60)):
        string = fctd.equilibrium(case, operation, depth, rpm=rpm)
        pull = (string.weight_indicator + noise.normal(0, hookload)) / 1e3
        turn = f"{(string.drive_torque + noise.normal(0, torque)) / 1e3:.2f}" if rpm else ""
        print(f"{depth:.0f} m {label},{depth:g},{operation},{rpm},{pull:.1f},{turn}")
        read.append(pull)
print(f"slips,,in_slips,,{(265e3 + noise.normal(0, hookload)) / 1e3:.1f},")
print(f"free drive,,tare,0,,{(600 + noise.normal(0, torque)) / 1e3:.2f}")
assert read[0] > read[2] > read[1]  # up, rotating, down
