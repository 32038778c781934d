"""A string that is stuck: the part of it above the place where it sticks, as a case of its own."""

from typing import Final

from fctd.case.errors import InputError
from fctd.case.load import Case, check_bit_depth
from fctd.case.message import quantity

# A shorter remainder of a component becomes part of the one above it [m].
SHORTEST: Final = 0.1


def above_stuck_point(case: Case, bit_depth: float, md: float) -> Case:
    """The case of the string above a depth [m] at which it is stuck, with its bit at ``bit_depth`` [m].

    Its lower end, at that depth, has no loads of its own.  What lies below is cut off: the rock holds it.  Pressures of
    the mud act as they do along the whole string.  Raises InputError for a depth that is not on the string.
    """
    check_bit_depth(bit_depth, *case.depths, "bit_depth", quantity(bit_depth, "m"))
    if not case.string.top_md < md <= bit_depth:
        expected = (
            f"a depth below the string's top at {quantity(case.string.top_md, 'm')}, down to its bit at "
            f"{quantity(bit_depth, 'm')}"
        )
        raise InputError(expected, key="stuck_at", value=quantity(md, "m"))
    below, kept = bit_depth - md, []
    for component in case.string.components:
        if component.length is None:
            kept.append(component)
        elif below < component.length - SHORTEST:
            kept.append(component.model_copy(update={"length": component.length - below}))
            below = 0.0
        else:
            below -= component.length
    ended = "float" if case.end == "open" else case.end  # nothing flows through a cut, whatever the pressures are
    unloaded = {"weight_on_bit": 0.0, "torque": 0.0, "overpull": 0.0, "rock": None, "end": ended}
    return case.model_copy(
        update={
            "string": case.string.model_copy(update={"components": tuple(kept)}),
            "bit": case.bit.model_copy(update=unloaded),
            "mud": case.mud.model_copy(update={"packer_bore": None}),
        }
    )
