"""A valid case, and the rules that it can break."""

from typing import Any

from fctd.case.errors import MISSING

CASE = """
name = "test-well"
[wellbore]
stations = [[0, 0, 0], [1000, 0, 45], [2000, 60, 45]]
intervals = [
    {to_md = "1000 m", diameter = "12.25 in", friction = 0.2},
    {to_md = "2000 m", diameter = "215.9 mm", friction = 0.3, name = "open hole"},
]
[[string.components]]
name = "collar"
length = "200 m"
outer_diameter = "158 mm"
inner_diameter = "65 mm"
segments = 20
[[string.components]]
name = "pipe"
outer_diameter = "102 mm"
inner_diameter = "60 mm"
segment_length = "25 m"
[[operations]]
kind = "trip_in"
from_md = "1000 m"
to_md = "1500 m"
speed = "0.5 m/s"
[[operations]]
kind = "rotate_off_bottom"
duration = "1 min"
rpm = 60
[[operations]]
kind = "back_ream"
to_md = "1200 m"
speed = "0.1 m/s"
rpm = 90
[[operations]]
kind = "trip_out"
from_md = "1200 m"
to_md = "1100 m"
speed = "0.2 m/s"
"""


# One wrong value, or None to delete the key, and what the message expects in its place.
RULES: list[tuple[str, Any, str]] = [
    ("name", None, "a name in quotes"),
    ("name", 3, "a text in quotes"),
    ("wellbore", None, "a table [wellbore]"),
    ("string", None, "a table [string]"),
    ("string", 3, "a table of keys and values"),
    ("operations", 3, "a list"),
    ("muds", {"density": 3}, "the key mud"),
    ("file", "x.toml", "one of the keys name, units, datum, wellbore"),
    ("wellbore.overlp", "2 mm", "the key overlap"),
    ("rig.xyz", 1, "one of the keys block_weight, guide_friction, sheave_efficiency, torque_offset, torque_per_rpm"),
    ("wellbore.survey", "a.csv", "a survey file that exists"),
    ("wellbore.survey", 3, "a file name in quotes"),
    ("wellbore.columns", {"md": "D"}, "columns only beside survey"),
    ("wellbore.columns", 1, "a table of keys and values"),
    ("wellbore.sheet", "A", "sheet only beside survey"),
    ("wellbore.survey_smoothing", "2 deg", "an angle above 0 and at most 0.02 rad"),
    ("wellbore.survey_smoothing", 0, "an angle above 0 and at most 0.02 rad"),
    ("wellbore.stations", [[0, 0, 0]], "two different stations, found 1"),
    ("wellbore.stations[0][0]", -5, "a measured depth of at least 0"),
    ("wellbore.stations[0][0]", "0 kg", "a length such as"),
    ("wellbore.stations[2][0]", 900, "greater than that of the station"),
    ("wellbore.stations[2][0]", 50_001, "a measured depth of at most 50 km"),
    ("wellbore.stations[1][1]", 181, "an inclination from 0 to 180 deg"),
    ("wellbore.stations[1]", [9, 0, 0, 0], "at most 3 values"),
    ("wellbore.survey_method", "tangent", "'average_angle' or"),
    ("wellbore.geometry", "tubes", "'cylinders', 'arcs' or 'sampled'"),
    ("wellbore.chord_tolerance", 0, "a length above 0"),
    ("wellbore.cylinder_length", "0 m", "a length above 0"),
    ("wellbore.overlap", "-1 mm", "a length at least 0"),
    ("wellbore.stiffness", "1e7 N/m/m", "a stiffness such as '1e7 N/m'"),
    ("wellbore.intervals", None, "tables [[wellbore.intervals]]"),
    ("wellbore.intervals", [], "at least one"),
    ("wellbore.intervals[0].to_md", None, "a length such as '12 m'"),
    ("wellbore.intervals[1].to_md", 1000, "below the interval above"),
    ("wellbore.intervals[0].diameter", "-2 mm", "a length above 0"),
    ("wellbore.intervals[0].diameter", 8.5, "a length above 0 and at most 5"),
    ("wellbore.intervals[0].friction", -0.1, "factor at least 0"),
    ("wellbore.intervals[0].friction", 20, "factor at least 0 and at most 5"),
    ("wellbore.intervals[1].stiffness_per_length", 1e6, "stiffness, the kind of the whole wellbore"),
    ("string.top_md", "-1 m", "a length at least 0"),
    ("string.components", [], "at least one"),
    ("string.components[0].name", None, "a name in quotes"),
    ("string.components[0].length", None, "only the last may omit"),
    ("string.components[0].length", 0, "a length above 0"),
    ("string.components[0].segments", 0, "a whole number at least 1"),
    ("string.components[0].segments", 2.5, "a whole number"),
    ("string.components[0].segments", True, "a whole number"),
    ("string.components[0].segment_length", "9 m", "segments or segment_length, not both"),
    ("string.components[0].inner_diameter", "158 mm", "a diameter below outer_diameter"),
    ("string.components[0].inner_diameter", -1, "at least 0"),
    ("string.components[0].outer_diameter", 1.7e308, "a length above 0 and at most 5"),
    ("string.components[0].outer_diameter", "2 kg", "a length such as '12 m' or '40 ft'"),
    ("string.components[0].contact_diameter", "6.5 m", "a length above 0 and at most 5"),
    ("string.components[0].contact_diameter", "157 mm", "at least outer_diameter"),
    ("string.components[0].linear_mass", 0, "a mass per length above 0"),
    ("string.components[0].youngs_modulus", "2 GN", "a stress such as '206.8 GPa'"),
    ("string.components[0].poisson_ratio", 0.6, "at most 0.5"),
    ("string.components[0].density", 0, "a density above 0"),
    ("string.components[0].axial_stiffness", 0, "stiffness above 0"),
    ("string.components[0].bending_stiffness", 0, "stiffness above 0"),
    ("string.components[0].torsional_stiffness", 0, "stiffness above 0"),
    ("string.components[0].shear_stiffness", 0, "stiffness above 0"),
    ("mud.density", "-1 ppg", "a density at least 0"),
    ("mud.viscosity", -1, "a viscosity at least 0 and at most 2 Pa*s"),
    ("mud.viscosity", 30, "at most 2 Pa*s (30 looks like '30 mPa*s')"),
    ("mud.viscosity", "3 N", "a viscosity such as '30 mPa*s' or '30 cP'"),
    ("mud.axial_damping", -1, "at least 0"),
    ("mud.lateral_damping", "1 N*s/m", "such as '5 N*s/m^2'"),
    ("mud.rotational_damping", "1 N", "such as '0.1 N*s'"),
    ("rig.block_weight", -1, "a force at least 0"),
    ("rig.sheave_efficiency", 0, "an efficiency above 0 and at most 1"),
    ("rig.sheave_efficiency", 1.1, "an efficiency above 0 and at most 1"),
    ("rig.torque_offset", "3 N", "a torque such as '0.5 kN*m'"),
    ("contact.friction_law", "stick", "'coulomb', 'paper', 'karnopp' or 'stribeck'"),
    ("contact.helical_force", "full", "'none' or 'analytic'"),
    ("contact.damping", -1, "a damping coefficient at least 0"),
    ("solver.step", 0, '"auto", "largest" or a time'),
    ("solver.step", "fast", '"auto", "largest" or a time such as'),
    ("solver.joint_damping", "-1 ms", "a time at least 0"),
    ("solver.loss_factor", 2, "a loss factor at least 0 and at most 0.2"),
    ("string.components[0].eccentricity", "80 mm", "less than half of outer_diameter"),
    ("record.interval", 0, "a time above 0"),
    ("record.profile_at", "1 m", "a list"),
    ("operations[0].kind", None, "one of the kinds trip_in, trip_out, rotate_off"),
    ("operations[0].kind", "trip_up", "the kind trip_"),
    ("operations[0].from_md", None, "a length such as"),
    ("operations[0].to_md", None, "a length such as"),
    ("operations[0].to_md", "900 m", "a depth below from_md, 1000 m"),
    ("operations[2].to_md", "1500 m", "a depth above from_md, 1500 m"),
    ("operations[3].to_md", "1.3 km", "a depth above from_md, 1200 m"),
    ("operations[0].to_md", "9 km", "within survey and intervals, 2000 m"),
    ("operations[3].from_md", "1300 m", "1200 m, where the operation before"),
    ("operations[1].at_md", "1400 m", "1500 m, where the operation before"),
    ("operations[0].speed", 0, "a speed above 0"),
    ("operations[0].speed", None, "a speed such as '0.5 m/s'"),
    ("operations[0].speed", "11 m/s", "a speed above 0 and at most 10 m/s"),
    ("operations[0].rpm", -1, "a rotation at least 0 and at most 10000 rpm"),
    ("operations[1].rpm", 10001, "a rotation above 0 and at most 10000 rpm"),
    ("operations[0].rpm", "1 Hz", "a rotation such as 60 or '60 rev/min' (units: rpm, rev/min"),
    ("operations[0].ramp_time", 0, "a time above 0"),
    ("operations[0].duration", "9 s", "of trip_in"),
    ("operations[1].rpm", 0, "a rotation above 0"),
    ("operations[1].duration", None, "a time such as"),
    ("operations[1].speed", 1, "of rotate_off_bottom"),
    ("operations[2].rpm", None, "a rotation such as 60"),
]


# Keys that do not go together and wrong items of lists: overrides, key, value shown, what is expected.
COMBINED: list[tuple[dict[str, Any], str, Any, str]] = [
    ({"operations": [3]}, "operations[0]", 3, "a table of keys and values"),
    (
        {"contact.helical_force": "analytic", "solver.buckling": "resolve"},
        "contact.helical_force",
        "analytic",
        '"none" with solver.buckling = "resolve", whose segments',
    ),
    ({"wellbore.stations": None}, "wellbore.survey", MISSING, "survey or stations"),
    ({"wellbore.columns": {"m": "D"}}, "wellbore.columns.m", "D", "the key md"),
    ({"wellbore.columns": {"md": 1}}, "wellbore.columns.md", 1, "a header in quotes or a table"),
    ({"wellbore.columns": {"md": {"head": "D"}}}, "wellbore.columns.md.head", "D", "the key header"),
    ({"wellbore.columns": {"md": {"unit": "km"}}}, "wellbore.columns.md.unit", "km", "m, ft or usft"),
    ({"wellbore.columns": {"inc": {"unit": "m"}}}, "wellbore.columns.inc.unit", "m", "deg or rad"),
    ({"wellbore.stations[1]": [9, 0]}, "wellbore.stations[1][2]", MISSING, "a bare number"),
    (
        {"wellbore.geometry": "arcs", "wellbore.survey_method": "average_angle"},
        "wellbore.geometry",
        "arcs",
        "cylinders, since arcs need survey_method minimum_curvature",
    ),
    (
        {"wellbore.cylinder_length": "2 m", "wellbore.chord_tolerance": "2 mm"},
        "wellbore.chord_tolerance",
        "2 mm",
        "cylinder_length or chord_tolerance, not both",
    ),
    (
        {"wellbore.stiffness": 1e7, "wellbore.stiffness_per_length": 1e6},
        "wellbore.stiffness_per_length",
        1e6,
        "stiffness or stiffness_per_length, not both",
    ),
    ({"friction": "0.1"}, "wellbore.intervals[0].friction", "0.1", "a friction factor"),
    (
        {"wellbore.stiffness_per_length": 1e6, "wellbore.intervals[0].stiffness": 1e7},
        "wellbore.intervals[0].stiffness",
        1e7,
        "stiffness_per_length, the kind of the whole wellbore",
    ),
    ({"mud.float": True, "bit.end": "open"}, "bit.end", "open", '"float", or mud.float = false'),
    ({"mud.packer_bore": 0.1, "bit.end": "closed"}, "bit.end", "closed", '"open" beside mud.packer_bore'),
    ({"mud.packer_bore": 0.1, "operations[0].flow": 0.02}, "operations[0].flow", 0.02, "0 beside mud.packer_bore"),
    ({"bit.nozzles": ["12/32 in", 12]}, "bit.nozzles[1]", 12, "12 looks like '12/32 in' or '12 mm'"),
    ({"record.profile_at": ["1 s"]}, "record.profile_at[0]", "1 s", "a length such as"),
    ({"string.top_md": "1 km"}, "operations[0].from_md", "1000 m", "a depth below string.top_md, 1000 m"),
]
