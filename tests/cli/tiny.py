"""What the tests of the commands share: small cases as texts, and options."""

CASE = """
name = "tiny"
[wellbore]
stations = [[0, 0, 0], [100, 0, 0], [550, 90, 0], [900, 90, 0]]
[[wellbore.intervals]]
to_md = "900 m"
diameter = "8.5 in"
friction = 0.2
[string]
[[string.components]]
name = "pipe"
outer_diameter = "5 in"
inner_diameter = "4.276 in"
segment_length = "40 m"
[mud]
density = 0
"""
# With an operation to run in time.
SMALL = """
name = "small"
[wellbore]
stations = [[0, 0, 0], [300, 0, 0], [750, 90, 0], [900, 90, 0]]
overlap = "0.2 m"
[[wellbore.intervals]]
to_md = "900 m"
diameter = "8.5 in"
friction = 0.2
[string]
[[string.components]]
name = "pipe"
length = "800 m"
outer_diameter = "5 in"
inner_diameter = "4.276 in"
segments = 32
[mud]
density = 0
[[operations]]
kind = "rotate_off_bottom"
at_md = "800 m"
duration = "4 s"
rpm = 60
ramp_time = "2 s"
"""
# 5 inch pipe in a level hole, compressed to 2.6 times its sinusoidal limit.
LEVEL = """
name = "level"
[wellbore]
stations = [[0, 90, 0], [170, 90, 0]]
stiffness_per_length = 1e6
[[wellbore.intervals]]
to_md = "170 m"
diameter = "8.5 in"
friction = 0.5
[[string.components]]
name = "pipe"
outer_diameter = "127 mm"
inner_diameter = "108.6 mm"
segment_length = "10 m"
[mud]
density = "1200 kg/m^3"
[rig]
block_weight = "2 MN"
[bit]
weight_on_bit = "300 kN"
"""
# A pound-force and a foot in SI, exact by definition (NIST SP 811, appendix B.8).
LBF, FOOT = 4.4482216152605, 0.3048
# Below 600 m the wall is too soft to hold any string.
SOFT_BELOW = (
    "wellbore.intervals=[{to_md = 600, diameter = 0.2159, friction = 0.2},"
    "{to_md = 900, diameter = 0.2159, friction = 0.2, stiffness = 100}]"
)


def settings(*changes: str) -> list[str]:
    """The options that make these changes."""
    return [part for change in changes for part in ("--set", change)]


CHART = {"--operation": "trip_in", "--depths": "500:800:100", "--out": "chart.csv"}
POINT = {"--operation": "trip_in", "--bit-depth": "800 m", "--out": "profile.csv"}
