"""Doubts about mud that is pumped: what its flow lacks, and a motor with another flow."""

from collections.abc import Sequence

from fctd.case.doubts.usual import Doubts
from fctd.case.drilling import BitSpec
from fctd.case.input_warnings import InputWarning
from fctd.case.message import quantity
from fctd.case.operations import Operation
from fctd.case.rig import MudSpec

# Misfits of a curve through readings of a viscometer that are worth a doubt: degrees, and share of the largest reading.
ODD_READING, ODD_SHARE = 3.0, 0.1


def of_flow(mud: MudSpec, bit: BitSpec, operations: Sequence[Operation], flow: float | None) -> Doubts:
    """Flow without a flow curve of the mud or without nozzles; flow [m³/s] : asked for beside the operations'."""
    rows = [(f"mud.{side}[{i}]", row) for side in ("inside", "outside") for i, row in enumerate(getattr(mud, side))]
    for where, of in (("mud", mud), *rows):
        if of.fit is None or of.fann is None:
            continue
        worst, allowed = max(map(abs, of.fit.misfit)), max(ODD_READING, ODD_SHARE * max(of.fann.values()))
        if worst > allowed:
            text = f"readings that the curve through them misses by up to {worst:.1f} degrees"
            yield InputWarning("fann_misfit", f"{where}.fann", text, "check the readings: no mud flows so")
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
            text = (
                f"{quantity(6e4 * one, 'L/min', '.0f')}, where bit.motor.flow turns the motor with "
                f"{quantity(6e4 * bit.motor.flow, 'L/min', '.0f')}"
            )
            yield InputWarning("motor_flow", where, text, "give one flow to both")
