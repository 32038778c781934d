"""Well 15/9-F-4 in its 12¼ in section, from its public data."""

from pathlib import Path

import pandas as pd

from fctd import Case


def f4(folder: Path) -> Case:
    """Well 15/9-F-4 with the string of its 12¼ in section.

    Survey, casing, mud and drill pipe are recorded.  Collars and block weight are assumed so that the string weighs
    what the hook carries near 1,400 m, 60 t, and the block what it reads in slips, 66 t.  The torque offset is the
    reading with no rotation, 0.5 kN m; torque for each rev/min is that between 6.1 kN m at 60 and 8 kN m at 130
    rev/min, as the data's notes say; the friction of the casing, 0.12, is a guess.  None of them enters the medians of
    stretches, but for the limit of slips, half way between block and string.
    """
    stations = pd.read_csv(folder / "survey.csv")[["md_m", "inc_deg", "azi_deg"]].to_numpy().tolist()
    intervals = [
        {"to_md": 1351, "diameter": "12.415 in", "friction": 0.12, "kind": "cased"},
        {"to_md": 2770, "diameter": "12.25 in", "friction": 0.25, "kind": "open"},
    ]
    pipe = {"name": "5 1/2 in drill pipe", "outer_diameter": 0.1397, "inner_diameter": 0.12136, "segment_length": 25,
            "contact_diameter": 0.18415, "linear_mass": 36.76}  # fmt: skip
    collars = {"name": "collars", "length": 110, "outer_diameter": "8.25 in", "inner_diameter": "2.8125 in",
               "segment_length": 10}  # fmt: skip
    return Case.model_validate(
        {
            "name": "15/9-F-4, 12 1/4 in",
            "wellbore": {"stations": stations, "geometry": "arcs", "stiffness": 5e7, "intervals": intervals},
            "string": {"components": [collars, pipe]},
            "mud": {"density": 1400, "viscosity": 0},
            "rig": {"block_weight": "66 t", "torque_offset": "0.5 kN*m", "torque_per_rpm": 27},
        }
    )
