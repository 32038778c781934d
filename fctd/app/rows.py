"""The rows of the page's chart: as those of ``fctd.torque_drag``, with memory that is kept from one move to the next.

A move of a slider asks for a few dozen rows at once; arrays made anew for each would take half of its time.
"""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Final

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.model.operations import SteadyRates, rates_of_all
from fctd.model.wellbore import Wellbore
from fctd.results.buckling import UNKNOWN
from fctd.results.columns import IN_CHART, SHAPES
from fctd.results.doing import does
from fctd.results.status import SteadyStatus
from fctd.steady.batch import Row, solve_batch
from fctd.steady.equilibrium import Solver
from fctd.steady.laid_string import LaidString
from fctd.steady.laws import hole_of
from fctd.steady.problem import Workspace
from fctd.steady.steady_string import Equilibrium
from fctd.store.limits import cores

MOST_THREADS: Final = 4


class Rows:
    """Solves rows on all processors, up to ``MOST_THREADS``."""

    def __init__(self) -> None:
        count = min(cores(), MOST_THREADS)
        self._work, self._own = [Workspace(0) for _ in range(count)], Workspace(0)
        self._threads = ThreadPoolExecutor(count)

    def solver(self, case: Case, hole: Wellbore) -> Solver:
        """A solver of single strings."""
        return Solver(case, hole, self._own)

    def solve(self, case: Case, hole: Wellbore, kinds: Sequence[str], depths: Sequence[float]) -> list[dict[str, Any]]:
        """A row for each operation and bit depth [m], with those columns of ``fctd.torque_drag`` that a chart draws."""
        rates, solver = rates_of_all(case, kinds), self.solver(case, hole)
        laid: dict[float, LaidString | str] = {}
        for depth in depths:
            try:
                laid[depth] = solver.lay_out(depth)
            except InputError as error:
                laid[depth] = error.message
        asked = [
            Row(string, 0, kind, rates[kind])
            for string in laid.values()
            if isinstance(string, LaidString)
            for kind in kinds
        ]
        parts = [asked[k :: len(self._work)] for k in range(len(self._work))]
        segments = max((row.laid.string.segments for row in asked), default=0)
        self._work = [work.for_segments(segments) for work in self._work]
        packed = hole_of(case, [hole])
        futures = [
            self._threads.submit(solve_batch, case, packed, p, w) for p, w in zip(parts, self._work, strict=True)
        ]
        answers = [future.result() for future in futures]
        found: dict[tuple[float, str], Equilibrium | str] = {}
        for part, of in zip(parts, answers, strict=True):
            for row, answer in zip(part, of, strict=True):
                try:
                    point: Equilibrium | str = solver.finish(row.operation, row.rates, row.laid, answer)
                except InputError as error:
                    point = error.message
                found[row.laid.string.bit_depth, row.operation] = point
        self._own = solver.work
        return [
            _row(
                case,
                kind,
                rates[kind],
                depth,
                string if isinstance(string, str) else found[string.string.bit_depth, kind],
            )
            for kind in kinds
            for depth, string in laid.items()
        ]


def _row(case: Case, kind: str, rates: SteadyRates, depth: float, point: Equilibrium | str) -> dict[str, Any]:
    found = None if isinstance(point, str) else point
    answer = found if found is not None and found.answered else None
    row: dict[str, Any] = {"operation": kind, "friction": float("nan"), "bit_depth_m": depth, **does(case, kind, rates)}
    row |= {load.name: float("nan") if answer is None else load.value(answer) for load in IN_CHART}
    row |= {end.name: float("nan") if found is None else end.value(found) for end in SHAPES}
    if found is None:
        return row | {"buckling": UNKNOWN.mode, "status": str(SteadyStatus.NOT_POSSIBLE), "reason": point}
    return row | {
        "buckling": found.buckling.mode, "status": str(found.status), "reason": found.message or "none",
    }  # fmt: skip
