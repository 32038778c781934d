"""Wrong inputs of a user: what differs from a case that is right, and the message that answers it.

A row has the key of a case file or the option, its value (None: absent), and what the message says behind "expected",
or as a warning.  Rows of several changes have keys of the case, options of ``fctd chart``, and the message.
"""

from typing import Any, Final

CASE = """
name = "well"
[wellbore]
stations = [[0, 0, 0], [400, 0, 0], [800, 40, 0], [1200, 60, 0], [1500, 60, 0]]
geometry = "arcs"
[[wellbore.intervals]]
kind = "cased"
to_md = "800 m"
diameter = "12.4 in"
friction = 0.2
[[wellbore.intervals]]
kind = "open"
to_md = "1500 m"
diameter = "8 1/2 in"
friction = 0.3
[[string.components]]
name = "bit"
length = "0.3 m"
outer_diameter = '8.4"'
inner_diameter = "2 in"
segments = 1
[[string.components]]
name = "collars"
length = "100 m"
outer_diameter = "6-1/2 in"
inner_diameter = "2.8125 in"
segment_length = "25 m"
[[string.components]]
name = "pipe"
outer_diameter = "5 in"
inner_diameter = "4.276 in"
linear_mass = "20.9 ppf"
segment_length = "50 m"
[mud]
density = "1.25 SG"
[rig]
block_weight = "20 t"
[bit]
weight_on_bit = "18 klb"
torque = "3000 ft-lb"
[[operations]]
kind = "trip_in"
from_md = "1000 m"
to_md = "1010 m"
speed = "30 m/min"
"""
OPTIONS: Final = {"--operation": "trip_in", "--depths": "1000:1000:1"}

JOINT: Final = {"length": "9.6 m", "tool_joint_length": "0.5 m", "tool_joint_diameter": "6 5/8 in"}
RESOLVED: Final = {
    "string.components[2].joint": JOINT,
    "string.components[2].segment_length": None,
    "string.components[2].joint_segments": 4,
}
LENGTHS: Final = "a length such as '12 m' or '40 ft' (units: m, cm, mm, km, ft, in)"
DENSITIES: Final = "a density such as '1200 kg/m^3' or '10 ppg' (units: kg/m^3, g/cm^3, sg, ppg, lb/gal, lb/ft^3)"
FORCES: Final = "a force such as '50 kN' or '12 klbf' (units: N, daN, kN, MN, kgf, t, lbf, klbf, kip)"
TORQUES: Final = "a torque such as '0.5 kN*m' or '400 ft*lbf' (units: N*m, kN*m, daN*m, kgf*m, ft*lbf, kft*lbf)"
ROTATIONS: Final = "a rotation such as 60 or '60 rev/min' (units: rpm, rev/min, c/min, rev/s, rad/s)"
FRICTIONS: Final = (
    "a factor such as 0.25, a list of them such as 0.1,0.2,0.3, a fan FROM:TO:STEP such as 0.1:0.4:0.1, or factors by "
    "kind such as cased=0.2,open=0.3, where each factor but those of a fan may be a pair such as 0.3/0.2, along and "
    "around the hole"
)

# Refused, exit code 2.
REFUSED: Final[list[tuple[str, Any, str]]] = [
    ("wellbore.intervals[1].diameter", 8.5, "a length above 0 and at most 5 m (8.5 looks like '8.5 in')"),
    ("wellbore.intervals[1].diameter", 215.9, "a length above 0 and at most 5 m (215.9 looks like '215.9 mm')"),
    ("wellbore.intervals[1].diameter", "8.5", LENGTHS),
    ("wellbore.intervals[1].diameter", "85/8 in", LENGTHS),
    ("wellbore.intervals[1].diameter", "8 1/3 in", LENGTHS),
    ("wellbore.intervals[1].diameter", "8,5 in", "a length, written '8.5 in' (with a decimal point)"),
    (
        "mud.density",
        "1,200 kg/m3",
        "a density, written '1200 kg/m3' or '1.200 kg/m3' (a comma may separate thousands or decimals)",
    ),
    ("mud.density", "1 250 kg/m3", "a density, written '1250 kg/m3' (without separators between thousands)"),
    ("mud.density", "1.250,5 kg/m3", "a density, written '1250.5 kg/m3' (with a decimal point)"),
    ("mud.density", "12 in", DENSITIES),
    ("mud.density", "0.52 psi/ft", DENSITIES),
    ("mud.density", "12.5 g/cm3", "a density below the string's, 7850 kg/m^3 (string.components[0].density)"),
    ("mud.density", -1200, "a density at least 0"),
    (
        "rig.block_weight",
        "20 ton",
        "a force, written '20 t' (metric tons), '40 klb' (short tons) or '44.8 klb' (long tons)",
    ),
    (
        "rig.block_weight",
        "40 Mlb",
        "a force, written '40 klb' (thousands of pounds) or '40000 klb' (millions of pounds)",
    ),
    ("rig.block_weight", "20 m", FORCES),
    ("bit.weight_on_bit", "80", FORCES),
    ("bit.torque", "4 kN", TORQUES),
    ("bit.torque", "4 mN", TORQUES),
    ("operations[0].speed", "30 mph", "a speed, written '30 m/h' (metres per hour) or '30 mile/h' (miles per hour)"),
    ("operations[0].speed", 30, "a speed above 0 and at most 10 m/s"),
    ("operations[0].speed", 0, "a speed above 0 and at most 10 m/s"),
    ("operations[0].rpm", "1 Hz", ROTATIONS),
    ("operations[0].rpm", 20000, "a rotation at least 0 and at most 10000 rpm"),
    ("string.components[1].bend", "3 °/30m", "an angle such as '1.5 deg' (units: deg, °, rad)"),
    ("string.components[1].bend", "90 deg", "an angle at least 0 and at most 0.1 rad"),
    ("wellbore.intervals[0].friction", 25, "a friction factor at least 0 and at most 5 (25 looks like '0.25')"),
    ("wellbore.intervals[0].friction", "0.25", "a friction factor at least 0 and at most 5, without quotes"),
    ("wellbore.intervals[0].friction", -0.2, "a friction factor at least 0 and at most 5"),
    ("wellbore.intervals[0].kind", "casing", "'cased' or 'open'"),
    ("wellbore.intervals", [], "at least one"),
    ("wellbore.intervals[0].to_md", None, "a length such as '12 m' or '40 ft'"),
    ("wellbore.geometri", "arcs", "the key geometry"),
    ("wellbore.intervals[0].dia", "8.5 in", "one of the keys diameter, outer_diameter"),
    ("wellbore.geometry", "arc", "'cylinders', 'arcs' or 'sampled'"),
    ("string", None, "a table [string]"),
    ("string.components", {"name": "pipe"}, "a list of tables, the name of each in double brackets: [[name]]"),
    ("string.components[2].outer_diameter", None, "a length such as '12 m' or '40 ft'"),
    ("string.components[2].inner_diameter", "5 in", "a diameter below outer_diameter"),
    ("string.components[2].contact_diameter", "4 in", "at least outer_diameter, 0.127 m"),
    ("string.components[2].outer_diameter", 127, "a length above 0 and at most 5 m (127 looks like '127 mm')"),
    ("string.components[0].segments", 1.5, "a whole number at least 1 and at most 1e+06"),
    ("string.components[2].poisson_ratio", 3, "a number at least 0 and at most 0.5"),
    (
        "string.components[2].linear_mass",
        "20.9 lb",
        "a mass per length such as '36.8 kg/m' or '19.5 lb/ft' (units: kg/m, N/m, lb/ft, lbf/ft, ppf)",
    ),
    (
        "string.components[2].youngs_modulus",
        "206.8",
        "a stress such as '206.8 GPa' or '30e6 psi' (units: Pa, MPa, GPa, bar, psi, ksi)",
    ),
    ("rig.sheave_efficiency", 85, "an efficiency above 0 and at most 1"),
    ("wellbore.stations", [[0, 0, 0]], "at least two different stations, found 1"),
    ("operations[0].kind", "tripinn", "the kind trip_in"),
    ("operations[0].to_md", "5 km", "a depth below string.top_md, 0 m, within survey and intervals, 1500 m"),
    ("operations[0].to_md", "900 m", "a depth below from_md, 1000 m"),
    ("operations[0].from_md", None, "a length such as '12 m' or '40 ft'"),
    ("name", None, "a name in quotes"),
    ("contact.friction_law", "stick", "'coulomb', 'paper', 'karnopp' or 'stribeck'"),
    ("contact.enabled", "yes", "true or false"),
    ("solver.step", "2", "\"auto\", \"largest\" or a time such as '10 s' or '2 min' (units: s, ms, min, h)"),
    ("solver.buckling", "yes", "'detect', 'resolve' or 'feed'"),
    ("wellbore.stiffness", "1e7 N/m/m", "a stiffness such as '1e7 N/m' (units: N/m, kN/m, MN/m, lbf/in, lbf/ft)"),
    ("--operation", "tripinn", "the kind trip_in"),
    (
        "--depths",
        "1000-1500",
        "a bit depth, or FROM:TO:STEP, such as 1750:2450:10, '5000 ft:8000 ft:30 ft' or shoe:td:50",
    ),
    ("--depths", "1500:1000:10", "depths that rise: TO at least FROM, and a STEP above 0"),
    ("--depths", "1000:1500:0", "depths that rise: TO at least FROM, and a STEP above 0"),
    ("--friction", "low", FRICTIONS),
    ("--friction", "25", "a friction factor at least 0 and at most 5 (25 looks like '0.25')"),
    ("--friction", "casing=0.2", "one of the kinds cased, open"),
    ("--friction", "cased=0.2,0.3", FRICTIONS),
    ("--friction", "cased=", FRICTIONS),
    ("--friction", "0.3/", FRICTIONS),
    ("--friction", "0.3/0.2/0.1", FRICTIONS),
    ("--friction", "0.3/-1", "a friction factor at least 0 and at most 5"),
    ("wellbore.intervals[0].rotational_friction", "rough", "a friction factor at least 0 and at most 5"),
    ("--speed", "fast", "a speed such as '0.5 m/s' or '60 ft/min' (units: m/s, m/min, m/h, ft/s, ft/min, ft/h)"),
    ("--rpm", "sixty", ROTATIONS),
    ("--rpm", "-60", "a rotation at least 0"),
    ("--set", "mud.density", "key=value"),
    ("--out", "chart.txt", "a file name that ends in .csv or .parquet or .xlsx or .png or .svg or .pdf or .html"),
    ("--plot", "chart.bmp", "a file name that ends in .png or .svg or .pdf or .html"),
]

# Refused for keys or options that do not go together.
REFUSED_TOGETHER: Final[list[tuple[dict[str, Any], dict[str, str], str]]] = [
    (
        {"string.components[1].density": 7.85},
        {},
        'well.toml: mud.density = "1.25 SG": expected a density below the string\'s, 7.85 kg/m^3 '
        "(string.components[1].density)",
    ),
    (
        {"wellbore.intervals[0].to_md": "1500 m", "wellbore.intervals[1].to_md": "800 m"},
        {},
        'well.toml: wellbore.intervals[1].to_md = "800 m": expected a depth below the interval above, 1500 m '
        "(wellbore.intervals[0].to_md)",
    ),
    (
        {"string.components[2].length": "500 m"},
        {},
        "warning: well.toml: string.components: all components together are 600.3 m long: with the bit at 1010 m they "
        "do not reach string.top_md: check their lengths, or leave out that of the last one, which then reaches it\n"
        "well.toml: string.components = 600.3 m of string: expected enough to reach from the bit at "
        "1000 m to string.top_md, or no length of the last component, which then reaches it",
    ),
    (
        {"string.components[2].segments": 10},
        {},
        'well.toml: string.components[2].segment_length = "50 m": expected segments or segment_length, not both',
    ),
    (
        {"string.components[2].joint_segments": 4},
        {},
        "well.toml: string.components[2].joint_segments = 4: expected a component with joint, whose bodies are cut",
    ),
    (
        {"string.components[2].joint": JOINT, "string.components[2].joint_segments": 4},
        {},
        "well.toml: string.components[2].joint_segments = 4: expected segment_length or joint_segments, not both",
    ),
    (
        RESOLVED | {"string.components[2].joint_segments": 200},
        {},
        'well.toml: string.components = "18894 segments": expected at most 10000 segments in all',
    ),
    (
        {"string.components[2].segment_length": "1 mm"},
        {},
        'well.toml: string.components = "899700 segments": expected at most 10000 segments in all',
    ),
    (
        {"wellbore.stations": [[0, 0, 0], [500, 200, 0]]},
        {},
        "well.toml: wellbore.stations[1][1] = 200: expected an inclination from 0 to 180 deg",
    ),
    (
        {"wellbore.stations": [[0, 0, 0], [500, 10, -999.25]]},
        {},
        "well.toml: wellbore.stations[1][2] = -999.25: expected an azimuth from -720 to 720 deg",
    ),
    (
        {"wellbore.stations": [[0, 0, 0], [500, 10, 0], [400, 10, 0]]},
        {},
        "well.toml: wellbore.stations[2][0] = 400: expected a measured depth greater than that of the station before",
    ),
    (
        {"wellbore.stations": [[0, 0, 0], [800, 0, 0], [1500, 180, 0]]},
        {},
        'well.toml: wellbore.stations[2] = "1500 m, 180 deg, 0 deg": expected a direction that an arc '
        "can join with that of the station before, which is the opposite",
    ),
    (
        {"wellbore.stations": [[0, 0, 0], ["1500 kg", 10, 0]]},
        {},
        "well.toml: wellbore.stations[1][0] = \"1500 kg\": expected a length such as '12 m' or '40 ft' (units: "
        "m, cm, mm, km, ft, in)",
    ),
    (
        {"wellbore.stations": [[0, 0, 0], [1500, 10]]},
        {},
        "well.toml: wellbore.stations[1][2] is missing: expected a bare number",
    ),
    (
        {"wellbore.survey": "well.toml"},
        {},
        "well.toml: wellbore.stations = [[0, 0, 0], [400, 0, 0], [800, 40, 0], [1200, 60, 0], [1500, "
        "60, 0]]: expected survey or stations, not both",
    ),
    ({"wellbore.stations": None}, {}, "well.toml: wellbore.survey is missing: expected survey or stations"),
    (
        {"string.top_md": "1200 m"},
        {},
        'well.toml: operations[0].from_md = "1000 m": expected a depth below string.top_md, 1200 m, '
        "within survey and intervals, 1500 m",
    ),
    (
        {"wellbore.stiffness": 10000000.0, "wellbore.stiffness_per_length": 1000000.0},
        {},
        "well.toml: wellbore.stiffness_per_length = 1000000.0: expected stiffness or stiffness_per_length, not both",
    ),
    (
        {"wellbore.survey_method": "average_angle"},
        {},
        'well.toml: wellbore.geometry = "arcs": expected cylinders, since arcs need survey_method minimum_curvature',
    ),
    (
        {},
        {"--depths": "5000:5500:100"},
        'well.toml: --depths = "5000 m": expected a depth below string.top_md, 0 m, within survey and '
        "intervals, 1500 m",
    ),
    (
        {},
        {"--depths": "5000:5500:100", "--units": "field"},
        'well.toml: --depths = "5000 ft": expected a depth below string.top_md, 0 ft, within survey and '
        "intervals, 4921 ft",
    ),
    (
        {},
        {"--depths": "1000 kg:1500 m:10 m"},
        "--depths = \"1000 kg\": expected a length such as '12 m' or '40 ft' (units: m, cm, mm, km, ft, in)",
    ),
    (
        {"wellbore.intervals[1].kind": None},
        {"--friction": "cased=0.2"},
        'well.toml: wellbore.intervals[1].kind is missing: expected "cased" or "open", since friction is given by kind',
    ),
    (
        {"wellbore.intervals[1].kind": "cased"},
        {"--friction": "open=0.2"},
        '--friction = {"open": 0.2}: expected factors of kinds that the intervals have, cased',
    ),
    ({}, {"--speed": "60"}, "--speed = \"60\": expected a speed of at most 10 m/s (60 looks like '60 m/min')"),
    (
        {},
        {"--operation": "rotate_off_bottom", "--speed": "1"},
        "--speed = 1.0: expected a speed of 0 for rotate_off_bottom",
    ),
    ({}, {"--operation": "drill_sliding", "--rpm": "60"}, "--rpm = 60.0: expected rev/min of 0 for drill_sliding"),
    ({}, {"--set": "mud.dens=1200"}, "well.toml: mud.dens = 1200: expected the key density"),
    (
        {},
        {"--set": "operations[3].speed=1"},
        "well.toml: operations[3].speed = 1: expected a value for a key that exists, the items are counted from 0 to 0",
    ),
]
