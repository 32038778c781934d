"""Rows whose balance hangs on rounding: which they may be, and the hook loads of their other balances.

A string that is fed until it winds itself into a helix leaves balances on its way, and in between the last digit of a
number may decide which one it comes to.  Such rows are named by what their answer says (``may_move``, free of cost).
When their notes are read they are solved again with noise of the size of rounding (``model/perturbed.py``), by the same
seeds wherever the row stands: in a chart, in a sweep or alone.  The study ``several_balances`` counts hits and false
alarms.
"""

from collections.abc import Callable
from typing import Final

from fctd.case.load import Case
from fctd.model.perturbed import with_noise
from fctd.steady.findings import Findings
from fctd.steady.steady_string import Equilibrium

SEEDS: Final = (1, 2)  # of the noise
# The row of a case that has noise.
Again = Callable[[Case], Equilibrium]


def may_move(point: Equilibrium, so_far: Findings) -> bool:
    """Whether loads of a row may hang on rounding: a string that was fed and is beyond the limit of the helix.

    A case that has noise already is one of the draws, and is not drawn again.  A string that is held in mud at rest is
    stuck (stuck.py), and its case alone does not say so.
    """
    is_fed = so_far.is_to_be_fed and not so_far.is_fed_in_part and not so_far.problem.laid.rests
    return is_fed and point.buckling.mode == "helical" and so_far.case.solver.perturbed is None


def draw(again: Again, case: Case) -> tuple[float, ...]:
    """Hook loads of a row of a case with noise [N], one a seed, NaN without loads."""
    return tuple(again(with_noise(case, seed)).hookload for seed in SEEDS)
