"""Torque-and-drag charts: the steady string of several operations at many bit depths, one row for each."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from fctd.case.errors import InputError
from fctd.case.friction import FrictionChoice, FrictionSet, friction_sets, own_label, table_of
from fctd.case.load import Case, naming_file, with_friction
from fctd.case.operation_names import kinds_of
from fctd.model.depths import depths_of
from fctd.model.operations import SteadyRates, rates_of_all
from fctd.model.wellbore import Wellbore, build_wellbore
from fctd.results.buckling import UNKNOWN
from fctd.results.columns import IN_CHART, SHAPES, SHARES
from fctd.results.doing import does
from fctd.results.notes import Note, RowNote, codes_of
from fctd.results.status import SteadyStatus
from fctd.steady import batch
from fctd.steady.carried_shape import Carried
from fctd.steady.equilibrium import Solver
from fctd.steady.laid_string import LaidString
from fctd.steady.reading import Answer
from fctd.steady.steady_string import Equilibrium
from fctd.store.limits import cores

if TYPE_CHECKING:
    pass

# Called after every row with the number of rows done and their total.
Progress = Callable[[int, int], None]
Row = dict[str, Any]
# Largest number of rows in a batch: the progress of a chart comes in steps of it.
ROWS = 16


def chart_rows(
    case: Case,
    operation: str | Sequence[str],
    bit_depths: float | str | Sequence[float | str],
    friction: FrictionChoice | Sequence[FrictionChoice] | None = None,
    speed: float | str | None = None,
    rpm: float | str | None = None,
    flow: float | str | None = None,
    progress: Progress | None = None,
    threads: int | None = None,
    *,
    known: Sequence[list[Row]] = (),
    above: dict[str, Carried] | None = None,
    keep: Callable[[list[Row]], None] | None = None,
    notes: list[RowNote] | None = None,
) -> list[Row]:
    """The rows of ``fctd.torque_drag``, each a mapping from column to value.

    known : the rows of the first depths, where another process has computed them; above : the shapes of its last
    resolved rows by their loads, which change with the rows; keep : called with the rows of each other depth, in their
    order; notes : gets those of the rows that are computed here, in the order of the rows.
    """
    with naming_file(case):
        depths = depths_of(bit_depths, case, "bit_depths")
        kinds = kinds_of(operation)
        rates = rates_of_all(case, kinds, speed, rpm, flow)
        sets = None if friction is None else friction_sets(friction)
        chart = _Chart(_solvers(case, build_wellbore(case), sets), kinds, rates, {} if above is None else above)
        threads = cores() if threads is None else threads
        parts = list(_parts(depths[len(known) :], max(1, ROWS // len(chart.loads)), threads))
        total = len(depths) * len(chart.loads)
        rows = list(known)
        unfit: list[InputError] = []
        misfits = sum(all(row["status"] == SteadyStatus.NOT_POSSIBLE for row in at_depth) for at_depth in known)
        for found in batch.on_threads(chart.attempt, parts, threads):
            for string, at_depth in found:
                rows.append([])
                if isinstance(string, InputError):
                    unfit.append(string)
                for row in at_depth:
                    rows[-1].append(row if isinstance(row, dict) else row())
                    if progress is not None:
                        progress((len(rows) - 1) * len(chart.loads) + len(rows[-1]), total)
                if keep is not None:
                    keep(rows[-1])
        if notes is not None:
            notes += chart.notes_of(depths)
        if unfit and misfits + len(unfit) == len(depths):
            raise unfit[0]
        return [row for series in zip(*rows, strict=True) for row in series]


# The string at a depth, or why it does not fit, and its rows; for one that needs more than an attempt, how to find it.
AtDepth = tuple[LaidString | InputError, list[Row | Callable[[], Row]]]


class _Chart:
    """Operations and friction factors of a chart.

    solvers : with their labels, one for each set of factors; above : shapes of the last resolved row by its loads.
    Rows that need other methods are solved in their order, and change it.
    """

    def __init__(
        self,
        solvers: Sequence[tuple[str, Solver]],
        kinds: Sequence[str],
        rates: Mapping[str, SteadyRates],
        above: dict[str, Carried],
    ) -> None:
        self.solvers, self.rates, self._above = solvers, rates, above
        self.loads = [(kind, k) for kind in kinds for k in range(len(solvers))]
        self._batches = batch.Batches(solvers[0][1].case, [solver.hole for _, solver in solvers])
        self._notes: dict[tuple[str, int, float], tuple[Note, ...]] = {}

    def attempt(self, depths: Sequence[float]) -> list[AtDepth]:
        """What one attempt finds at some bit depths [m]; several threads may call it."""
        # The string is laid out once a depth, for all operations and frictions.
        strings = [_lay_out(self.solvers[0][1], depth) for depth in depths]
        fit = [string for string in strings if isinstance(string, LaidString)]
        asked = [batch.Row(string, k, kind, self.rates[kind]) for string in fit for kind, k in self.loads]
        answers = iter(self._batches.solve(asked))
        return [
            (string, [self._row(kind, k, depth, string, answers) for kind, k in self.loads])
            for depth, string in zip(depths, strings, strict=True)
        ]

    def _row(
        self, kind: str, k: int, depth: float, string: LaidString | InputError, answers: Iterator[Answer]
    ) -> Row | Callable[[], Row]:
        label, solver = self.solvers[k]
        rates = self.rates[kind]
        if isinstance(string, InputError):
            return _row(label, solver, kind, rates, depth, None, str(string))
        point = solver.first(kind, rates, string, next(answers))
        if point is not None:
            return self._answer(kind, k, depth, point)

        def by_other_methods() -> Row:
            above = self._above.pop(loads := f"{kind} {k}", None)
            try:
                point = solver.solve_problem(solver.problem(kind, rates, string), above)
            except InputError as error:  # as of a resolved string with too many segments
                return _row(label, solver, kind, rates, depth, None, error.message)
            if point.carried is not None:
                self._above[loads] = point.carried
            return self._answer(kind, k, depth, point)

        return by_other_methods

    def _answer(self, kind: str, k: int, depth: float, point: Equilibrium) -> Row:
        if point.notes:
            self._notes[kind, k, depth] = point.notes
        return _row(*self.solvers[k], kind, self.rates[kind], depth, point)

    def notes_of(self, depths: Sequence[float]) -> list[RowNote]:
        """The notes of the rows so far, in the order of the rows."""
        return [
            RowNote(**vars(note), operation=kind, friction=self.solvers[k][0], bit_depth=depth)
            for kind, k in self.loads
            for depth in depths
            for note in self._notes.get((kind, k, depth), ())
        ]


def _parts(depths: Sequence[float], most: int, threads: int) -> Iterator[Sequence[float]]:
    """The depths in parts, which become smaller where threads share them: then all end at nearly the same time."""
    done = 0
    while done < len(depths):
        left = len(depths) - done
        size = most if threads == 1 else max(1, min(most, left // (2 * threads)))
        yield depths[done : done + size]
        done += size


def _solvers(case: Case, hole: Wellbore, sets: Sequence[FrictionSet] | None) -> list[tuple[str, Solver]]:
    """A solver with its label for each set of friction factors, or for the case's own."""
    intervals = case.wellbore.intervals
    if sets is None:
        return [(own_label(intervals), Solver(case, hole))]
    cases = [(one.label, with_friction(case, one)) for one in sets]
    return [(label, Solver(one, hole.with_friction(table_of(one.wellbore.intervals)))) for label, one in cases]


def _lay_out(solver: Solver, depth: float) -> LaidString | InputError:
    """The string at a depth, or why string and hole do not fit."""
    try:
        return solver.lay_out(depth)
    except InputError as error:
        return error


def _row(
    label: str, solver: Solver, kind: str, rates: SteadyRates, depth: float, point: Equilibrium | None, misfit: str = ""
) -> Row:
    """A chart row, of a string in balance or of a depth where string and hole do not fit."""
    answer = point if point is not None and point.answered else None
    # The values of an unfinished iteration are not loads.
    loads = {load.name: float("nan") if answer is None else load.value(answer) for load in IN_CHART}
    # A string that no push moves has no loads, but a share at which it locked up.
    found = {column.name: float("nan") if point is None else column.value(point) for column in (*SHAPES, *SHARES)}
    return {
        "operation": kind,
        **solver.friction,
        "friction_label": label,
        "bit_depth_m": depth,
        **does(solver.case, kind, rates),
        **loads,
        **(UNKNOWN if point is None else point.buckling).columns(),
        "shape": "none" if point is None else point.shape,
        **found,
        "status": str(SteadyStatus.NOT_POSSIBLE if point is None else point.status),
        "iterations": 0 if point is None else point.iterations,
        "notes": codes_of(() if point is None else point.notes),
        "reason": (misfit if point is None else point.message) or "none",
    }
