"""The flow curves of a case's muds along its string."""

from collections.abc import Sequence

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.fluids import OutsideSpec
from fctd.case.rheology import Rheology as Rheology
from fctd.case.rig import MudSpec
from fctd.model.fluids import Column

INVISCID = Rheology.newtonian(0.0)


def along(mud: MudSpec, rows: Sequence[OutsideSpec], column: Column | None, above: Array) -> Rheology:
    """Flow curves (n,) of one side at distances from the bit (n,) [m].

    rows : of that side in the case, whose fluids are the column, None where all is one mud; a row that says nothing of
    its flow has the curve of the mud, and a mud that says nothing flows without friction.
    """
    own = [row.curve or mud.curve or INVISCID for row in rows] or [mud.curve or INVISCID]
    index = np.zeros(len(above), int) if column is None else column.row_of(above)
    return Rheology(*np.array(own, float)[index].T)


def check_flows(mud: MudSpec) -> None:
    """Raise InputError for a mud of whose flow the case says nothing."""
    silent = [side for side in ("inside", "outside") if any(row.curve is None for row in getattr(mud, side))]
    if mud.curve is None and (silent or not (mud.inside and mud.outside)):
        raise InputError(
            "readings of a viscometer such as {600 = 60, 300 = 40}, a table [mud.rheology], or mud.viscosity: the mud "
            "has no friction without them",
            key="mud.fann",
        )
