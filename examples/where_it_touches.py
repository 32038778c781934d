"""Where the string touches the hole, how hard, and on which side."""

import fctd

case = fctd.load_case("examples/my_well.toml")
profile = fctd.equilibrium(case, operation="trip_out", bit_depth=3000).profile
touching = profile[profile["contact_force_N"] > 0]
print(touching[["md_m", "contact_force_N", "contact_angle_deg"]].round(1).to_string(index=False))
# In the hold section the string lies on the low side, 180° from the high side.
hold = touching[touching["md_m"].between(1900, 2600)]
assert hold["contact_angle_deg"].between(150, 210).mean() == 1.0
