"""Hook load picking up, rotating and slacking off: the broomstick of a well."""

import fctd

case = fctd.load_case("examples/my_well.toml")
chart = fctd.torque_drag(case, ["trip_in", "rotate_off_bottom", "trip_out"], range(1000, 3001, 500))
hookload = chart.pivot(index="bit_depth_m", columns="operation", values="hookload_N") / 1e3
print(hookload.round(1))
ordered = (hookload["trip_in"] < hookload["rotate_off_bottom"]) & (hookload["rotate_off_bottom"] < hookload["trip_out"])
assert ordered.sum() == 5
