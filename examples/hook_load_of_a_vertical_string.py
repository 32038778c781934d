"""The hook load of a string at rest in a vertical hole is its buoyed weight."""

import math

import fctd

case = fctd.load_case(
    "examples/my_well.toml",
    {"wellbore.survey": None, "wellbore.stations": [[0, 0, 0], [3000, 0, 0]]},
)
point = fctd.equilibrium(case, operation="rotate_off_bottom", bit_depth=2000)

buoyancy = 1 - 1250 / 7850
collars = 120 * 7850 * math.pi / 4 * ((6.75 * 0.0254) ** 2 - (2.8125 * 0.0254) ** 2)
heavy = 150 * 7850 * math.pi / 4 * ((5 * 0.0254) ** 2 - (3 * 0.0254) ** 2)
pipe = (2000 - 120 - 150) * 31.1
weight = 9.80665 * buoyancy * (collars + heavy + pipe)
print(f"hook load {point.hookload / 1e3:.1f} kN, buoyed weight {weight / 1e3:.1f} kN")
assert abs(point.hookload / weight - 1) < 1e-4
