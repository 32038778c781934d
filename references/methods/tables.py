"""A comparison on the screen: verdicts first, then errors and costs of a point, then loads."""

from collections.abc import Callable, Iterator, Sequence

import pandas as pd

from fctd.arena.result import Comparison, Counts, Quartiles, Row
from fctd.case.text import counted, printable
from fctd.cli.job import FOLD, headed, print_table
from fctd.cli.options import messages, screen
from fctd.cli.refine import print_counts
from fctd.results.shown_tables import NONE, Cell, Head, Table, number, of_column, short, shown_table
from fctd.results.unit_systems import System, shown

LOADS = {"hookload_N": "hook load", "surface_torque_N_m": "torque", "sum_r_mu_fn_N_m": "Σ r μ N"}
ROUNDING = 1e-9  # [m]: a smaller error is shown as 0
TOLD = 2.0  # percent: a load that is further off than this is told in words
LEAST = 1.0  # [N], [N m]: of a smaller load no difference is told in percent


def three(value: Quartiles | None, digits: int = 3) -> Cell:
    """A time or ratio with its quartiles."""
    if value is None:
        return Cell(NONE)
    middle, low, high = (short(each, digits).text for each in (value.median, value.low, value.high))
    return Cell(f"{middle} ({low}–{high})", value.median)


def maybe(value: float | None, digits: int, factor: float = 1.0) -> Cell:
    """A number with digits in all, a dash for none."""
    return Cell(NONE) if value is None else short(factor * value, digits)


def verdicts(rows: Sequence[Row]) -> Table:
    """Verdict and package of each row."""
    cells = (
        [row.label, row.verdict or NONE, row.package or NONE, row.version, row.licence] for row in rows
    )  # fmt: skip
    return shown_table(["method, engine", "verdict", "package", "version", "licence"], cells)


def frames(rows: Sequence[Row]) -> Table:
    """Errors of the wall."""
    cells = []
    for row in rows:
        of = row.errors
        off = None if of is None else of.largest_penetration_m
        cells.append([
            row.label, row.verdict, maybe(off if off is None or off > ROUNDING else 0.0, 3, 1e3),
            maybe(None if of is None else of.largest_angle_deg, 2), maybe(None if of is None else of.missed, 6),
            maybe(None if of is None else of.false_contacts, 6), maybe(row.pieces, 9),
        ])  # fmt: skip
    heads: list[Head | str] = [
        "method", "verdict", Head("penetration", "mm", True), Head("angle", "°", True), Head("missed", "", True),
        Head("false", "", True), Head("pieces", "", True),
    ]  # fmt: skip
    return shown_table(heads, cells)


def costs(rows: Sequence[Row]) -> Table:
    """Costs of a point and of the method itself."""
    cells = []
    for row in rows:
        cost = row.cost
        cells.append([
            row.label, row.verdict, three(None if cost is None else cost.point_ns),
            three(None if cost is None else cost.kernels), maybe(row.memory_MB, 3),
            maybe(row.build_s, 2),
        ])  # fmt: skip
    heads: list[Head | str] = [
        "method", "verdict", Head("a point", "ns", True), Head("a point", "kernels", True),
        Head("memory", "MB", True), Head("build", "s", True),
    ]  # fmt: skip
    return shown_table(heads, cells)


def loads(rows: Sequence[Row], own: Row, units: System) -> Table:
    """Loads of the string, and how far they are from those of the engine's own arcs."""
    cells = []
    base = own.loads
    for row in rows:
        of = row.loads
        line: list[object] = [row.label, row.verdict]
        for column in LOADS:
            value = None if of is None else getattr(of, column)
            line.append(Cell(NONE) if value is None else of_column(column, value, units))
            if column != "sum_r_mu_fn_N_m":
                first = None if base is None or row is own else getattr(base, column)
                line.append(_off(value, first))
        off, where = (None, None) if of is None else (of.force_off_N, of.force_off_md_m)
        line += [
            maybe(off, 3, shown("contact_force_N", units).factor),
            Cell(NONE) if where is None or not off else of_column("md_m", where, units, 0),
        ]
        cells.append(line)
    heads: list[Head | str] = ["method, engine", "verdict"]
    for head in headed(LOADS, units):
        heads.append(head)
        if head.words != LOADS["sum_r_mu_fn_N_m"]:
            heads.append(Head("off", "%", True))
    heads += [
        Head("force off", shown("contact_force_N", units).label, True),
        Head("at", shown("md_m", units).label, True),
    ]
    return shown_table(heads, cells)


def _off(value: float | None, first: float | None) -> Cell:
    """How far a load is from the first one, in percent; a dash where there is next to none."""
    if value is None or first is None or abs(first) < LEAST:
        return Cell(NONE)
    return number(100 * (value / first - 1), 2)


def far_off(row: Row, own: Row) -> Iterator[str]:
    """The loads of a row that are further off than TOLD, in words."""
    if row is own or row.loads is None or own.loads is None:
        return
    for column, words in LOADS.items():
        off = _off(getattr(row.loads, column), getattr(own.loads, column)).number
        if off is not None and abs(off) > TOLD:
            side = "above" if off > 0 else "below"
            yield f"{words} {abs(off):.1f} % {side} that of the engine's own arcs"


def steps(rows: Sequence[Row]) -> Table:
    """What a step takes."""
    cells = [
        [
            row.label, row.verdict, three(None if row.loads is None else row.loads.step_us),
            maybe(None if row.loads is None else row.loads.steps, 6),
            maybe(None if row.loads is None else row.loads.energy_error, 2), maybe(row.predicted_s, 3),
        ]
        for row in rows
    ]  # fmt: skip
    heads: list[Head | str] = [
        "method, engine", "verdict", Head("a step", "µs", True), Head("steps", "", True),
        Head("energy error", "", True), Head("expected", "s", True),
    ]  # fmt: skip
    return shown_table(heads, cells)


def reasons(rows: Sequence[Row]) -> Iterator[str]:
    """What is wrong, and what was left out, a line each, with the names of all rows of which it is said."""
    said: dict[str, list[str]] = {}
    for row in rows:
        for text in _said(row, rows[0]):
            said.setdefault(text, []).append(row.label)
    for text, labels in said.items():
        yield f"{', '.join(labels)}: {text}"


def _said(row: Row, own: Row) -> Iterator[str]:
    """What is said of a row."""
    if row.reason:
        yield f"{row.status}: {row.reason}"
    what = "contract of contact methods" if row.kind == "contact" else "gate before any speed"
    for finding in row.broken or []:
        yield f"breaks the {what}: {finding}"
    if row.loads is not None and row.loads.message:
        yield f"{row.loads.status}: {row.loads.message}"
    yield from far_off(row, own)
    if row.loads_reason:
        yield f"no loads: {row.loads_reason}"
    for remark in row.remarks:
        yield f"remark: {remark}"


def print_comparison(comparison: Comparison, units: System) -> None:
    """Print a comparison: what was compared, verdicts with their reasons, errors and costs, loads."""
    rows, window = comparison.rows, comparison.window
    methods = [row for row in rows if row.kind == "contact"]
    _print(verdicts, rows)
    for line in reasons(rows):
        messages.print(printable(line), soft_wrap=True)
    for note in comparison.notes:
        messages.print(f"note: {printable(note)}", soft_wrap=True)
    points = next((row.errors for row in methods if row.errors is not None), None)
    if points is not None:
        screen.print(
            f"errors of the wall in this hole, by {comparison.reference}: {points.points} points within 15 mm of "
            f"touching, {points.touching} touch", style="bold", soft_wrap=True,
        )  # fmt: skip
        _print(frames, [row for row in methods if row.errors is not None])
        _print(costs, [row for row in methods if row.cost is not None])
        _say_units(comparison, methods)
    if window is not None and rows[0].loads is not None:
        metre = shown("md_m", units)
        ends = [f"{depth * metre.factor:.1f}" for depth in dict.fromkeys((window.from_md_m, window.to_md_m))]
        screen.print(
            f"loads: {window.operation}, bit at {' to '.join(ends)} {metre.label}, from {window.start_s:.3g} s on over "
            f"{window.duration_s:.3g} s: {window.whole} {window.vibration} periods of {window.period_s:.3g} s; "
            f"{counted(window.segments, 'segment')}", style="bold", soft_wrap=True,
        )  # fmt: skip
        _print(lambda each: loads(each, rows[0], units), [row for row in rows if row.loads is not None])
        _print(steps, [row for row in rows if row.loads is not None or row.predicted_s is not None])
    if comparison.counts is not None:
        screen.print("numbers of segments, by the engine's own steady string")
        print_counts(*counts_of(comparison.counts), comparison.counts.tolerance, units)
    machine = comparison.machine
    screen.print(
        f"times on {machine['processor']}, {machine['cores']} cores, load average {machine['load average']}",
        soft_wrap=True,
    )
    end = "interrupted after" if comparison.interrupted else "compared in"
    screen.print(f"{counted(len(rows), 'row')} {end} {comparison.seconds:.0f} s", soft_wrap=True)


def counts_of(counts: Counts) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Steps and orders of a range of counts as tables."""
    return pd.DataFrame(counts.steps), pd.DataFrame(counts.orders)


def _print(table: Callable[[Sequence[Row]], Table], rows: Sequence[Row]) -> None:
    """Print a table of rows, if there are any; what is broken is struck through."""
    if rows:
        print_table(table(rows), words=FOLD, numbers=FOLD, struck=[k for k, row in enumerate(rows) if row.struck])


def _say_units(comparison: Comparison, methods: Sequence[Row]) -> None:
    """What the times of a point are."""
    cost = next((row.cost for row in methods if row.cost is not None), None)
    if cost is None or comparison.kernel_ns is None:
        return
    kernel = three(comparison.kernel_ns).text
    screen.print(
        f"a point: processor time in a call of {cost.points} points, median (quartiles) of rounds in turns; kernels: "
        f"in columns of the reference kernel, {kernel} ns", soft_wrap=True,
    )  # fmt: skip
