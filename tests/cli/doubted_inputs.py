"""Inputs that are computed with a warning; rows as in wrong_inputs.py."""

from typing import Any, Final

# Computed with a warning; with --strict exit code 1, and nothing is computed.
DOUBTED: Final[list[tuple[str, Any, str]]] = [
    (
        "mud.density",
        10.4,
        "a mud of 10.4 kg/m^3 (10.4 looks like '10.4 ppg'): write it with its unit; usual is 600 to 2600 kg/m^3",
    ),
    (
        "mud.density",
        1.25,
        "a mud of 1.25 kg/m^3 (1.25 looks like '1.25 sg'): write it with its unit; usual is 600 to 2600 kg/m^3",
    ),
    (
        "mud.density",
        "1.25 kg/m3",
        "a mud of 1.25 kg/m3 (1.25 looks like '1.25 sg'): check it; usual is 600 to 2600 kg/m^3",
    ),
    (
        "mud.density",
        75,
        "a mud of 75 kg/m^3 (75 looks like '75 lb/ft^3'): write it with its unit; usual is 600 to 2600 kg/m^3",
    ),
    (
        "wellbore.intervals[1].diameter",
        3.5,
        "a hole of 3.5 m (3.5 looks like '3.5 in'): write the diameter with its unit",
    ),
    ("wellbore.intervals[1].diameter", "8.5 mm", "a hole of 8.5 mm: write the diameter with its unit"),
    (
        "wellbore.intervals[1].friction",
        0.9,
        "a friction factor of 0.9, where casing has 0.15 to 0.3 and open hole 0.2 to 0.5: check it; 30 "
        "% is written 0.3",
    ),
    (
        "bit.weight_on_bit",
        80,
        "a weight on bit of 80 N (80 looks like '80 kN' or '80 klbf'): write it with its unit; usual is 1 to 2000 kN",
    ),
    ("bit.weight_on_bit", "80 MN", "a weight on bit of 80 MN: check it; usual is 1 to 2000 kN"),
    (
        "bit.torque",
        4,
        "a bit torque of 4 N*m (4 looks like '4 kN*m'): write it with its unit; usual is 0.02 to 200 kN·m",
    ),
    (
        "rig.block_weight",
        250,
        "a block weight of 250 N (250 looks like '250 kN' or '250 klbf'): write it with its unit; usual is 1 to "
        "5000 kN",
    ),
    ("rig.block_weight", "250e3 kN", "a block weight of 250e3 kN: check it; usual is 1 to 5000 kN"),
    (
        "rig.torque_offset",
        0.5,
        "a torque offset of 0.5 N*m (0.5 looks like '0.5 kN*m'): write it with its unit; usual is 0.005 to 50 kN·m",
    ),
    ("rig.sheave_efficiency", 0.5, "an efficiency of 0.5: give that of all sheaves together, which is 0.8 to 1"),
    (
        "string.components[2].linear_mass",
        "19.5 kg/m",
        '"pipe" weighs 19.5 kg/m, its body alone 26.71 kg/m: write linear_mass with its unit, such as '
        "'19.5 lb/ft', and check diameters and density",
    ),
    (
        "string.components[2].linear_mass",
        "4 kg/m",
        '"pipe" weighs 4 kg/m, less than the mud in its place, 4.254 kg/m: write linear_mass with its '
        "unit, such as '19.5 lb/ft', and check diameters and density",
    ),
    (
        "string.components[2].linear_mass",
        "200 lb/ft",
        '"pipe" weighs 297.6 kg/m, its body alone 26.71 kg/m: write linear_mass with its unit, such as '
        "'19.5 lb/ft', and check diameters and density",
    ),
    (
        "string.components[0].outer_diameter",
        "6 in",
        '"bit" has 152.4 mm, "collars" above it 165.1 mm: check both diameters',
    ),
    (
        "string.components[2].youngs_modulus",
        206.8,
        "a modulus of 206.8 Pa (206.8 looks like '206.8 GPa'): write it with its unit; usual is 10 to 450 GPa",
    ),
    (
        "string.components[2].youngs_modulus",
        206800,
        "a modulus of 206800 Pa (206800 looks like '206800 MPa'): write it with its unit; usual is 10 to 450 GPa",
    ),
    (
        "string.components[2].yield_strength",
        135,
        "a strength of 135 Pa (135 looks like '135 ksi'): write it with its unit; usual is 50 to 3000 MPa",
    ),
    (
        "string.components[2].yield_strength",
        931,
        "a strength of 931 Pa (931 looks like '931 MPa'): write it with its unit; usual is 50 to 3000 MPa",
    ),
    (
        "operations[0].speed",
        "9 m/s",
        "moving the string at 9 m/s, which is 32400 m/h: write the speed with its unit, such as '20 m/h'",
    ),
    ("operations[0].rpm", 1000, "1000 rev/min, where top drives turn at up to 300: check the rotation of the string"),
    (
        "wellbore.intervals[1].to_md",
        4921,
        "the interval ends at 4921 m, the survey at 1500 m: write '4921 ft' if these are feet",
    ),
]


# The same for several changes.
DOUBTED_TOGETHER: Final[list[tuple[dict[str, Any], dict[str, str], str]]] = [
    (
        {"mud": None},
        {},
        "mud.density: there is no mud, so the string hangs in air in a hole of 1500 m: give a density "
        'such as "1200 kg/m^3", or 0 for air',
    ),
    (
        {"wellbore.intervals[0].diameter": "8.5 in", "wellbore.intervals[1].diameter": "17.5 in"},
        {},
        "wellbore.intervals[1].diameter: the hole widens downwards, from 215.9 to 444.5 mm: list the "
        "intervals from the surface down",
    ),
    (
        {},
        {"--friction": "0.9"},
        "friction: a friction factor of 0.9, where casing has 0.15 to 0.3 and open hole 0.2 to 0.5: "
        "check it; 30 % is written 0.3",
    ),
    (
        {"bit": None},
        {"--operation": "drill_rotating"},
        'bit.weight_on_bit: drill_rotating without weight on bit: give bit.weight_on_bit, such as "80 kN"',
    ),
    (
        {"wellbore.intervals[0].to_md": "1800 m", "wellbore.intervals[1].to_md": "2000 m"},
        {},
        "wellbore.intervals[0].to_md: the interval ends at 1800 m, the survey at 1500 m: check depth and unit of both",
    ),
    (
        {"wellbore.intervals[0].to_md": 2625, "wellbore.intervals[1].to_md": 4921},
        {},
        "wellbore.intervals[0].to_md: the interval ends at 2625 m, the survey at 1500 m: write '2625 "
        "ft' if these are feet",
    ),
    (
        {"string.components[0].name": "pipe", "string.components[2].name": "PDC bit"},
        {},
        'string.components[2]: "PDC bit" is above "pipe": list the components from the bit up',
    ),
    (
        {"string.components[2].density": "65 kg/m3", "mud": {"density": 0}},
        {},
        "string.components[2].density: a pipe of 65 kg/m3: check it; usual is 1.2 to 20 g/cm^3",
    ),
    (
        {"operations": None},
        {"--operation": "drill_sliding", "--speed": "0.5"},
        "speed: drilling at 0.5 m/s, which is 1800 m/h: write the speed with its unit, such as '20 m/h'",
    ),
    ({}, {"--rpm": "1000"}, "rpm: 1000 rev/min, where top drives turn at up to 300: check the rotation of the string"),
    (
        {"wellbore.intervals[1].kind": "cased", "wellbore.intervals[1].to_md": "1600 m"},
        {},
        "wellbore.intervals[1].to_md: the interval ends at 1600 m, the survey at 1500 m: check depth and unit of both",
    ),
]
