"""The contact query by itself: penetration of points in a hole."""

import fctd

case = fctd.load_case(
    "examples/my_well.toml",
    {"wellbore.survey": None, "wellbore.stations": [[0, 0, 0], [3000, 0, 0]]},
)
hole = fctd.build_wellbore(case)
hits = fctd.find_contacts(hole, [[0.06, 0.0, 500.0], [0.0, 0.0, 500.0]], 0.0635)
print("penetration [m]:", hits.penetration, "normal:", hits.normal[0])
# 8.681 in casing: 60 mm off the axis, a pipe of 63.5 mm radius is 13.2 mm inside the wall.
assert abs(hits.penetration[0] - (0.06 + 0.0635 - 0.5 * 8.681 * 0.0254)) < 1e-12
