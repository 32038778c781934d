"""Fields of the rig's readings, as series over time and measured rows name them: in words, and as mnemonics.

Mnemonics are those of the WITS records and of common service companies.  Whoever reads a table takes its fields from
here, and says what is its own: further names, bounds, ranges.
"""

from typing import Final

from fctd.case.tables.fields import Field
from fctd.case.units import DEEPEST, FLOW, FORCE, LENGTH, MOST_RPM, ROTATION, TORQUE, Dimension, Quantity


def reading(
    key: str, names: str, dimension: Dimension, example: str, bare: str | None = None, most: float | None = None
) -> Field:
    """The field of a reading; a word beside its name may say which of the readings a column has.

    most : [SI], beyond which there is none.
    """
    beside = "average avg mean surface rig md"
    return Field(key, names, Quantity(dimension=dimension, at_most=most), beside, bare, example)


BIT_DEPTH: Final = reading(
    "bit_depth", "bit depth, depth bit, bit md, bit position, bit measured depth, dbtm, dbit, bdep, bitdep",
    LENGTH, "m", most=DEEPEST,
)  # fmt: skip
HOOK_LOAD: Final = reading(
    "hook_load", "hook load, weight indicator, indicator, hook weight, hkla, hkld, hkl, hklda, hl, whkl", FORCE, "kN"
)
TORQUE_OF_STRING: Final = reading("torque", "torque, rotary torque, tqa, stor, torq, trq, tq", TORQUE, "kN_m")
# What the drive reads holds what it needs itself.
TORQUE_OF_DRIVE: Final = reading(
    "torque", f"{TORQUE_OF_STRING.names}, drive torque, top drive torque, td torque", TORQUE, "kN_m"
)
ROTATION_OF_DRIVE: Final = reading(
    "rpm", "rpm, rpma, rotary speed, rotary rpm, top drive rpm, top drive speed, td rpm, srpm, rota", ROTATION, "rpm",
    bare="rpm", most=MOST_RPM,
)  # fmt: skip
FLOW_IN: Final = reading(
    "flow", "flow, mud flow in, flow in, flow rate, flow rate in, mfia, flwi, pump flow", FLOW, "L_min"
)
