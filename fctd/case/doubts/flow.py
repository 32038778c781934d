"""Doubts about mud that is pumped: what its flow lacks, and a motor with another flow."""

from collections.abc import Sequence

from fctd.case.doubts.usual import Doubts
from fctd.case.drilling import BitSpec
from fctd.case.input_warnings import InputWarning
from fctd.case.operations import Operation
from fctd.case.rig import MudSpec


def of_flow(mud: MudSpec, bit: BitSpec, operations: Sequence[Operation], flow: float | None) -> Doubts:
    """Flow without a flow curve of the mud or without nozzles; flow [m³/s] : asked for beside the operations'."""
    flows = [(f"operations[{i}].flow", operation.flow) for i, operation in enumerate(operations)]
    pumped = [where for where, one in flows if one] or (["flow"] if flow else [])
    if not pumped:
        return
    if mud.curve is None and not any(row.curve for row in (*mud.inside, *mud.outside)):
        yield InputWarning(
            "no_flow_curve", pumped[0], "a flow of mud without viscosity: its friction is left out",
            "give the readings of a viscometer, mud.fann, or mud.rheology or mud.viscosity",
        )  # fmt: skip
    if not bit.nozzle_area:
        yield InputWarning(
            "no_nozzles", pumped[0], "a flow through a bit without nozzles: its pressure drop and thrust are left out",
            "give bit.nozzles, a list of their diameters, or bit.flow_area",
        )  # fmt: skip
    for where, one in flows:
        if bit.motor is not None and one and abs(bit.motor.flow - one) > 1e-3 * one:
            text = f"{6e4 * one:.0f} L/min, where bit.motor.flow turns the motor with {6e4 * bit.motor.flow:.0f}"
            yield InputWarning("motor_flow", where, text, "give one flow to both")
