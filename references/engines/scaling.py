"""The 1000:1 model of the paper's §6.3 in three readings of its text.

``similar`` : geometric, kinematic and dynamic similitude at the same gravity and density: lengths by s, time by √s,
hence forces by s³, moduli by s, wall stiffness of a contact point by s².  ``relabelled`` : the same string with
its lengths written in millimetres.  ``naive`` : lengths by s and nothing else.
"""

from typing import Any, NamedTuple

import numpy as np

from fctd.case.load import Case

SCALE = 1e-3


class Factors(NamedTuple):
    """Scale factors of length, time, modulus, wall stiffness and damping of a contact point, and force."""

    length: float
    time: float
    modulus: float
    stiffness: float
    damping: float
    force: float


def factors(reading: str, scale: float = SCALE) -> Factors:
    """The factors of a reading; that of force is the factor of the weight."""
    if reading == "similar":
        return Factors(scale, scale**0.5, scale, scale**2, scale**2.5, scale**3)
    if reading == "naive":
        return Factors(scale, 1.0, 1.0, 1.0, 1.0, scale**3)
    return Factors(1.0, 1.0, 1.0, 1.0, 1.0, 1.0)


def scaled(case: Case, reading: str, scale: float = SCALE) -> Case:
    """The case in one reading, its survey as stations.  Raises InputError if the result is not a valid case."""
    by = factors(reading, scale)

    def length(value: float) -> Any:
        return f"{1e3 * value!r} mm" if reading == "relabelled" else value * by.length

    raw = case.model_dump(exclude_none=True, exclude={"file"})
    hole = raw["wellbore"]
    if hole.pop("survey", None) is not None:
        hole.pop("columns", None)
        md, *angles = case.wellbore.trajectory.T
        hole["stations"] = np.column_stack([md, *np.degrees(angles)]).tolist()
    hole["stations"] = [[md * by.length, inclination, azimuth] for md, inclination, azimuth in hole["stations"]]
    # Intervals and components are tuples of tables; every key below is a length [m].
    for table in (hole, *hole["intervals"], raw["string"], *raw["string"]["components"], *raw["operations"]):
        for key in LENGTHS & table.keys():
            table[key] = length(table[key])
    for table in (hole, *hole["intervals"]):
        if "stiffness" in table:
            table["stiffness"] *= by.stiffness
    for component in raw["string"]["components"]:
        component["youngs_modulus"] *= by.modulus
    raw["contact"]["damping"] *= by.damping
    raw["solver"]["joint_damping"] *= by.time
    raw["record"]["interval"] *= by.time
    for operation in raw["operations"]:
        for key in {"duration", "ramp_time"} & operation.keys():
            operation[key] *= by.time
        if "speed" in operation:
            operation["speed"] *= by.length / by.time
        if "rpm" in operation:
            operation["rpm"] /= by.time
    return Case.model_validate(raw)


LENGTHS = {
    "cylinder_length", "chord_tolerance", "overlap", "to_md", "diameter", "top_md", "length", "outer_diameter",
    "inner_diameter", "contact_diameter", "segment_length", "from_md", "at_md",
}  # fmt: skip
