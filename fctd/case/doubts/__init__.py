"""Probable mistakes of a case: input that can be used and is probably not what the user meant, a function for each.

Every bound lies beyond what wells and rigs have, so that a warning is worth reading.
"""

from collections.abc import Sequence

from fctd.case.doubts.caliper import measured_size
from fctd.case.doubts.flow import of_flow
from fctd.case.doubts.hole import (
    casing_bore,
    hole_size,
    rough_wall,
    shoe_below_td,
    smooth_along,
    wider_below,
)
from fctd.case.doubts.rig import no_bit_load, no_block, no_mud, rates, sheaves_and_drive
from fctd.case.doubts.string import (
    bent_along_gauge,
    bit_size,
    does_not_drift,
    light_string,
    no_tool_joints,
    reach,
    unlike_pipe,
)
from fctd.case.doubts.usual import Well, bare_lengths, unusual
from fctd.case.friction import FrictionSet
from fctd.case.input_warnings import InputWarning


def warnings_of(
    case: Well,
    kinds: Sequence[str] = (),
    speed: float | None = None,
    rpm: float | None = None,
    flow: float | None = None,
    frictions: Sequence[FrictionSet] = (),
    indicator: bool = False,
) -> tuple[InputWarning, ...]:
    """The probable mistakes of a case, and of what is asked for: kinds of operation, rates [m/s], [rev/min], friction.

    indicator : whether readings of the weight indicator are asked for, which include the block.  Reads the survey;
    raises InputError where it cannot be used.
    """
    stations = case.wellbore.trajectory
    return (
        *case.wellbore.survey_warnings,
        *shoe_below_td(case.wellbore, float(stations[-1, 0])),
        *hole_size(case),
        *wider_below(case.wellbore),
        *casing_bore(case.wellbore),
        *rough_wall(case.wellbore, frictions),
        *smooth_along(case.wellbore, frictions),
        *measured_size(case.wellbore, float(stations[-1, 0])),
        *no_mud(case.mud, float(stations[-1, 0])),
        *unusual(case),
        *light_string(case.string, case.mud),
        *no_tool_joints(case.string),
        *unlike_pipe(case.string),
        *reach(case.string, [max(of.start_md, of.end_md) for of in case.operations], case.depths[1]),
        *bit_size(case.string, case.wellbore, float(stations[-1, 0])),
        *bent_along_gauge(case.string, case.wellbore),
        *does_not_drift(case.string, case.wellbore, min(float(stations[-1, 0]), case.wellbore.intervals[-1].to_md)),
        *bare_lengths(case.bare_lengths),
        *no_bit_load(case, {*kinds, *(operation.kind for operation in case.operations)}),
        *sheaves_and_drive(case.rig),
        *no_block(case.rig, indicator),
        *rates(case.operations, kinds, speed, rpm),
        *of_flow(case.mud, case.bit, case.operations, flow),
    )
