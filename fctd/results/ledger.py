"""The energy ledger: stored energy and losses against the energy put in; the difference is the error."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fctd.mechanics import state, topdrive
from fctd.mechanics.energy import Energy

if TYPE_CHECKING:
    import pandas as pd

# Losses and the rows of the state in which they are summed; what the bit gives to the rock is a loss as well.
LOSSES = {
    "lost_friction_J": state.LOST_FRICTION,
    "lost_contact_J": state.LOST_CONTACT,
    "lost_mud_J": state.LOST_MUD,
    "lost_joints_J": state.LOST_JOINT,
}


def entry(
    S: NDArray[np.float64], top: NDArray[np.float64], segments: int, start: Energy, now: Energy
) -> dict[str, float]:
    """A row of the ledger [J]: stored energy since the start, energy put in, losses, and the residual.

    S, top : state buffers, whose losses and work have been summed since the start.
    """
    stored = {f"{name}_J": b - a for name, a, b in zip(Energy._fields, start, now, strict=True)}
    gains = {"top_drive_work_J": float(top[topdrive.TOP_WORK]), "fed_pipe_J": float(top[topdrive.FED_ENERGY])}
    gains["flow_work_J"] = float(top[topdrive.GIVEN_WORK])
    losses = {name: float(state.row(S, offset, segments).sum()) for name, offset in LOSSES.items()}
    losses["lost_bit_J"] = float(top[topdrive.LOST_BIT])
    residual = sum(stored.values()) + sum(losses.values()) - sum(gains.values())
    return {**stored, **gains, **losses, "residual_J": residual}


def work(energy: pd.DataFrame, *, motion: bool = False) -> float:
    """Energy turned over in a run [J]: the larger of all losses and of the top drive's work beyond lifting.

    energy : a row for every ``entry``.  Lifting and lowering move hundreds of times more energy back and forth, which
    would hide any error.  motion : whether kinetic and strain energy count too, for windows so short that losses are
    small.  NaN where a term is not finite, or there is no row.
    """
    if not np.isfinite(energy.to_numpy(float)).all() or energy.empty:
        return float("nan")
    lost = energy.filter(like="lost_").sum(axis=1).abs()
    beyond = (energy["top_drive_work_J"] - energy["gravity_J"]).abs()
    found = [lost.max(), beyond.max()]
    if motion:
        found.append(energy["kinetic_J"].abs().max() + energy["strain_J"].abs().max())
    return float(max(found))


def error(energy: pd.DataFrame, *, motion: bool = False) -> float:
    """Energy error: the largest residual of a run over its ``work``; NaN without work.

    The largest, not the last: the residual of a swinging string passes through zero again and again.
    """
    turned_over = work(energy, motion=motion)
    return float(energy["residual_J"].abs().max()) / turned_over if turned_over > 0 else float("nan")
