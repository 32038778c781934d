"""Torque over a fan of friction factors: in a straight line from zero, as long as the string stays where it is."""

import fctd

case = fctd.load_case("examples/my_well.toml", {"contact.friction_law": "paper"})
chart = fctd.torque_drag(case, "rotate_off_bottom", [3000], friction=[0.1, 0.2, 0.3, 0.4])
print(chart[["friction", "surface_torque_N_m"]].round(2).to_string(index=False))
torque = chart["surface_torque_N_m"].to_numpy()
assert abs(torque[3] / torque[0] - 4) < 0.02
