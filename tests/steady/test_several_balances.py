"""Rows whose balance hangs on rounding: which are solved again, what the row says, and that every way there says so."""

from typing import Any

import pytest

from fctd import chart, equilibrium
from fctd.app.rows import Rows
from fctd.case.load import Case
from fctd.model import perturbed
from fctd.model.operations import steady_rates
from fctd.model.wellbore import build_wellbore
from fctd.results import notes
from fctd.steady import several_balances
from fctd.steady.equilibrium import Solver
from fctd.steady.steady_string import Equilibrium
from fctd.sweep.spec import WorkSpec
from fctd.sweep.work import WORK, task_of
from tests.steady.buckled import level_case, with_tables

KIND, LENGTH = "drill_sliding", 60.0


def case_of(times_onset: float = 1.7, buckling: str = "feed", seed: int | None = None) -> Case:
    solver = {"buckling": buckling, "perturbed": seed}
    case = level_case(times_onset, LENGTH, 6.0, friction=0.2)
    return with_tables(case, solver=solver, rig={"block_weight": 1e6})


def solved(case: Case) -> Equilibrium:
    return equilibrium(case, KIND, LENGTH)


@pytest.fixture
def coarse_noise(monkeypatch: pytest.MonkeyPatch) -> None:
    """Noise that moves every row a little, and a bound that each of them exceeds, whatever the processor's rounding."""
    monkeypatch.setattr(perturbed, "SHARE", 1e-9)
    monkeypatch.setattr(notes, "HARDLY", 1e-12)
    monkeypatch.setattr(several_balances, "SEEDS", (1,))


def test_a_fed_helix_is_solved_again_and_other_rows_are_not() -> None:
    point = solved(case_of())
    assert (point.status, point.buckling.mode) == ("converged", "helical")
    assert point.draw is not None
    others = case_of(1.2), case_of(buckling="resolve"), case_of(seed=3)
    assert [solved(case).draw for case in others] == [None] * len(others)
    solver = Solver(case_of())
    held = solver.solve_string(KIND, steady_rates(solver.case, KIND), solver.lay_out(LENGTH).at_rest)
    assert (held.buckling.mode, held.draw) == ("helical", None)


def test_the_draws_are_the_rows_of_their_seeds() -> None:
    draw = solved(case_of()).draw
    assert draw is not None
    assert draw() == tuple(solved(case_of(seed=seed)).hookload for seed in (1, 2))


@pytest.mark.slow
@pytest.mark.usefixtures("coarse_noise")
def test_chart_sweep_page_and_equilibrium_pick_one_balance_and_say_one_note() -> None:
    case = case_of()
    alone = solved(case)
    (note,) = alone.notes
    assert alone.draw is not None
    low, high = (pick(alone.hookload, *alone.draw()) for pick in (min, max))
    assert note.code == "several_balances"
    assert note.text.startswith(f"with noise of the size of rounding the hook load is {low / 1e3:.4g} to ")
    string = Solver(case).lay_out(LENGTH).string
    assert note.excess == pytest.approx((high - low) / (notes.HARDLY * string.weight @ string.length))
    below = chart(case, KIND, [LENGTH - 10, LENGTH])
    charted, page = below.table.iloc[-1], Rows().solve(case, build_wellbore(case), [KIND], [LENGTH])[0]
    assert [found.text for found in below.notes if found.bit_depth == LENGTH] == [note.text]
    swept = row_of(case, kind="equilibrium", bit_depth=f"{LENGTH} m")
    assert (charted["notes"], swept["notes"]) == ("several_balances", "several_balances")
    assert {row["hookload_N"] for row in (charted, page, swept)} == {alone.hookload}


def row_of(case: Case, **spec: object) -> dict[str, Any]:
    work = WorkSpec.model_validate({"operations": [KIND], **spec})
    (row,) = WORK[work.kind](case, task_of(work, case), lambda: None)
    return row
