"""The energy ledger from numbers written by hand."""

import numpy as np
import pandas as pd
import pytest

from fctd.mechanics import state, topdrive
from fctd.mechanics.energy import Energy
from fctd.results import ledger


def table(**columns: list[float]) -> pd.DataFrame:
    """Two rows with the given terms, zero elsewhere, and a loss of 1 J of each kind in the last row."""
    empty = {name: [0.0, 0.0] for name in ("kinetic_J", "gravity_J", "strain_J", "top_drive_work_J", "residual_J")}
    return pd.DataFrame({**empty, **{name: [0.0, 1.0] for name in ledger.LOSSES}, **columns})


def test_an_entry_compares_stored_and_lost_energy_with_energy_put_in() -> None:
    S, top = state.new_state(3), np.zeros(topdrive.TOP_SIZE)
    for k, offset in enumerate(ledger.LOSSES.values()):
        state.row(S, offset, 3)[:] = 10.0**k
    top[[topdrive.TOP_WORK, topdrive.FED_ENERGY, topdrive.LOST_BIT]] = 5000.0, 200.0, 40_000.0
    top[topdrive.GIVEN_WORK] = 600_000.0
    row = ledger.entry(S, top, 3, Energy(1.0, 2.0, 3.0, 4.0), Energy(11.0, 22.0, 33.0, 44.0))
    assert row == {
        "kinetic_J": 10.0, "gravity_J": 20.0, "strain_J": 30.0, "contact_J": 40.0, "top_drive_work_J": 5000.0,
        "fed_pipe_J": 200.0, "flow_work_J": 600_000.0, "lost_friction_J": 3.0, "lost_contact_J": 30.0,
        "lost_mud_J": 300.0, "lost_joints_J": 3000.0, "lost_bit_J": 40_000.0,
        "residual_J": 100.0 + 43_333.0 - 605_200.0,
    }  # fmt: skip


def test_work_is_the_larger_of_losses_and_of_what_is_not_lifting() -> None:
    lifted = table(top_drive_work_J=[0.0, 90.0], gravity_J=[0.0, 100.0])
    assert ledger.work(lifted) == 10.0
    assert ledger.work(lifted.assign(gravity_J=[0.0, 87.0])) == 4.0
    assert np.isnan(ledger.work(lifted.assign(lost_mud_J=[0.0, np.nan])))
    assert np.isnan(ledger.work(lifted.assign(gravity_J=[0.0, np.nan])))


def test_the_error_is_the_largest_residual_of_the_run_over_its_work() -> None:
    assert ledger.error(table(residual_J=[-3.0, 1.0])) == pytest.approx(3 / 4)
    assert np.isnan(ledger.error(pd.DataFrame()))
    little = table(**{name: [0.0, 0.1] for name in ledger.LOSSES}, residual_J=[0.0, 0.1])
    assert ledger.error(little) == pytest.approx(1 / 4)
    still = table(**{name: [0.0, 0.0] for name in ledger.LOSSES}, residual_J=[1.0, 1.0])
    assert np.isnan(ledger.error(still))


def test_motion_and_strain_are_work_where_they_are_asked_for() -> None:
    moving = table(kinetic_J=[6.0, 0.0], strain_J=[0.0, -2.0], residual_J=[0.0, 1.0])
    assert ledger.work(moving) == 4.0
    assert ledger.work(moving, motion=True) == 8.0
    assert ledger.error(moving) == pytest.approx(1 / 4)
    assert ledger.error(moving, motion=True) == pytest.approx(1 / 8)
    assert np.isnan(ledger.error(moving.assign(strain_J=[0.0, np.inf]), motion=True))
