"""A comparison as sections of tables, which screen and page show: verdicts, errors and costs of a point, loads."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

import pandas as pd

from fctd.arena.result import Comparison, Counts, Loads, Quartiles, Row
from fctd.case.text import counted, printable
from fctd.cli.job import FOLD, headed, print_table
from fctd.cli.options import messages, screen
from fctd.cli.refine import counts_parts
from fctd.report.parts import Section, Text
from fctd.results.shown_tables import NONE, Cell, Head, Table, number, of_column, short, shown_table
from fctd.results.unit_systems import System, shown

LOADS = {"hookload_N": "hook load", "surface_torque_N_m": "torque", "sum_r_mu_fn_N_m": "Σ r μ N"}
ROUNDING = 1e-9  # [m]: a smaller error is shown as 0
TOLD = 2.0  # percent: a load that is further off than this is told in words
# [N], [N m], and share of all contact forces, or of the torque of their friction: of a smaller load no difference is
# told in percent.
LEAST, SMALL = 1.0, 0.01
VERDICTS, SEGMENTS = "Verdicts", "Numbers of segments, by the engine's own steady string"  # titles of sections
VERSIONS = ("fctd", "python", "numpy", "numba", "commit")


def three(value: Quartiles | None, digits: int = 3) -> Cell:
    """A time or ratio with its quartiles."""
    if value is None:
        return Cell(NONE)
    middle, low, high = (short(each, digits).text for each in (value.median, value.low, value.high))
    return Cell(f"{middle} ({low}–{high})", value.median)


def maybe(value: float | None, digits: int, factor: float = 1.0) -> Cell:
    """A number with digits in all, a dash for none."""
    return Cell(NONE) if value is None else short(factor * value, digits)


def _table(
    heads: Iterable[Head | str], rows: Sequence[Row], cells: Iterable[Sequence[object]], *notes: str
) -> Table:  # fmt: skip
    """A table with label and verdict of each row before its cells; what is broken is struck through."""
    first = "method" if all(row.kind == "contact" for row in rows) else "method, engine"
    lines = ([row.label, row.verdict or NONE, *of] for row, of in zip(rows, cells, strict=True))
    struck = (k for k, row in enumerate(rows) if row.struck)
    return shown_table([first, "verdict", *heads], lines, notes=notes, struck=struck)


def about(comparison: Comparison) -> Table:
    """What was compared, where and when."""
    window, machine = comparison.window, comparison.machine
    facts = [("well", f"{comparison.case}, {comparison.digest}")]
    if window is not None:
        metre = shown("md_m", comparison.units)
        ends = [f"{depth * metre.factor:.1f}" for depth in dict.fromkeys((window.from_md_m, window.to_md_m))]
        bit = f"bit at {' to '.join(ends)} {metre.label}"
        facts += [
            ("operation", f"{window.operation}, {bit}; {counted(window.segments, 'segment')}"),
            ("window", f"from {window.start_s:.3g} s on over {window.duration_s:.3g} s: {window.whole} "
                       f"{window.vibration} periods of {window.period_s:.3g} s"),
        ]  # fmt: skip
    facts += [
        ("errors by", comparison.reference),
        ("times on", f"{machine['processor']}, {machine['cores']} cores, load average {machine['load average']}"),
        ("versions", ", ".join(f"{name} {machine[name]}" for name in VERSIONS if name in machine)),
        ("date", comparison.date),
    ]
    return shown_table((), (fact for fact in facts if fact[1]))


def verdicts(rows: Sequence[Row]) -> Table:
    """Verdict and package of each row."""
    cells = ([row.package or NONE, row.version, row.licence] for row in rows)
    return _table(["package", "version", "licence"], rows, cells)


def frames(rows: Sequence[Row]) -> Table:
    """Errors of the wall."""
    cells = []
    for row in rows:
        of = row.errors
        off = None if of is None else of.largest_penetration_m
        cells.append([
            maybe(off if off is None or off > ROUNDING else 0.0, 3, 1e3),
            maybe(None if of is None else of.largest_angle_deg, 2), maybe(None if of is None else of.missed, 6),
            maybe(None if of is None else of.false_contacts, 6), maybe(row.pieces, 9),
        ])  # fmt: skip
    heads = [
        Head("penetration", "mm", True), Head("angle", "°", True), Head("missed", "", True), Head("false", "", True),
        Head("pieces", "", True),
    ]  # fmt: skip
    return _table(
        heads, rows, cells,
        "penetration, angle: largest error of the depth in the wall, and of the normal of a point that touches. "
        "missed, false: points that touch by the reference alone, and by the method alone.",
    )  # fmt: skip


def costs(rows: Sequence[Row]) -> Table:
    """Costs of a point and of the method itself."""
    cells = (
        [
            three(None if row.cost is None else row.cost.point_ns),
            three(None if row.cost is None else row.cost.kernels),
            maybe(row.memory_MB, 3), maybe(row.build_s, 2),
        ]
        for row in rows
    )  # fmt: skip
    heads = [
        Head("a point", "ns", True), Head("a point", "kernels", True), Head("memory", "MB", True),
        Head("build", "s", True),
    ]  # fmt: skip
    return _table(heads, rows, cells, "memory, build: growth of resident memory, and time of building the method.")


def loads(rows: Sequence[Row], own: Row, units: System) -> Table:
    """Loads of the string, and how far they are from those of the engine's own wall."""
    cells = []
    for row in rows:
        of, line = row.loads, []
        for column in LOADS:
            value = None if of is None else getattr(of, column)
            line.append(Cell(NONE) if value is None else of_column(column, value, units))
            if column != "sum_r_mu_fn_N_m":
                line.append(Cell(NONE) if row is own else _off(of, own.loads, column))
        off, where = (None, None) if of is None else (of.force_off_N, of.force_off_md_m)
        line += [
            maybe(off, 3, shown("contact_force_N", units).factor),
            Cell(NONE) if where is None or not off else of_column("md_m", where, units, 0),
        ]
        cells.append(line)
    heads = []
    for head in headed(LOADS, units):
        heads.append(head)
        if head.words != LOADS["sum_r_mu_fn_N_m"]:
            heads.append(Head("off", "%", True))
    heads += [
        Head("force off", shown("contact_force_N", units).label, True), Head("at", shown("md_m", units).label, True)
    ]  # fmt: skip
    return _table(
        heads, rows, cells,
        f"Means under a Hann window. off: from the load of {own.label}. force off, at: largest difference of a contact "
        "force from that row, and where.",
    )  # fmt: skip


def _off(of: Loads | None, own: Loads | None, column: str) -> Cell:
    """How far a load is from that of the engine's own wall, in percent; a dash where there is next to none."""
    value, first = (None if each is None else getattr(each, column) for each in (of, own))
    if own is None or value is None or first is None:
        return Cell(NONE)
    scale = own.sum_r_mu_fn_N_m or 0.0 if column != "hookload_N" else sum(force or 0.0 for force in own.forces_N)
    return Cell(NONE) if abs(first) < max(LEAST, SMALL * scale) else number(100 * (value / first - 1), 2)


def far_off(row: Row, own: Row) -> Iterator[str]:
    """The loads of a row that are further off than TOLD, in words."""
    for column, words in LOADS.items():
        off = _off(row.loads, own.loads, column).number
        if off is not None and abs(off) > TOLD:
            side = "above" if off > 0 else "below"
            yield f"{words} {abs(off):.1f} % {side} that of {own.label}"


def steps(rows: Sequence[Row]) -> Table:
    """What a step takes."""
    cells = (
        [
            three(None if row.loads is None else row.loads.step_us),
            three(None if row.loads is None else row.loads.step_kernels),
            maybe(None if row.loads is None else row.loads.steps, 6),
            maybe(None if row.loads is None else row.loads.energy_error, 2), maybe(row.predicted_s, 3),
        ]
        for row in rows
    )  # fmt: skip
    heads = [
        Head("a step", "µs", True), Head("a step", "kernels", True), Head("steps", "", True),
        Head("energy error", "", True), Head("expected", "s", True),
    ]  # fmt: skip
    return _table(
        heads, rows, cells,
        "a step: processor time, median (quartiles) of the records. energy error: residual of the ledger. expected: "
        "processor time of all steps.",
    )  # fmt: skip


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


def counts_of(counts: Counts) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Steps and orders of a range of counts as tables."""
    return pd.DataFrame(counts.steps), pd.DataFrame(counts.orders)


def sections(comparison: Comparison) -> Iterator[Section]:
    """What was compared, verdicts with their reasons, errors and costs, loads and steps."""
    rows, units = comparison.rows, comparison.units
    yield Section("What was compared", (about(comparison),))
    if not rows:
        return
    said = [*reasons(rows), *(f"note: {note}" for note in comparison.notes)]
    yield Section(VERDICTS, (verdicts(rows), *(Text(printable(line)) for line in said)))
    wall = [row for row in rows if row.errors is not None]
    if wall:
        points = next(row.errors for row in wall if row.errors is not None)
        told = f"{points.points} points within 15 mm of touching, {points.touching} touch"
        yield Section("Wall of this hole", (Text(f"Errors by {comparison.reference}: {told}."), frames(wall)))
    timed = [row for row in rows if row.cost is not None]
    if timed and comparison.kernel_ns is not None:
        yield Section("Cost of a point", (Text(_units_of(timed[0], comparison.kernel_ns)), costs(timed)))
    run = [row for row in rows if row.loads is not None]
    if run:
        yield Section("Loads of this string", (loads(run, rows[0], units),))
        yield Section("Steps", (steps([row for row in rows if row.loads is not None or row.predicted_s is not None]),))
    if (counts := comparison.counts) is not None:
        parts = counts_parts(*counts_of(counts), counts.tolerance, units)
        yield Section(SEGMENTS, tuple(Text(part) if isinstance(part, str) else part for part in parts))


def _units_of(row: Row, kernel_ns: Quartiles) -> str:
    """What the times of a point are."""
    points = 0 if row.cost is None else row.cost.points
    return (
        f"A point: processor time in a call of {points} points, median (quartiles) of rounds in turns; kernels: in "
        f"columns of the reference kernel, {three(kernel_ns).text} ns."
    )


def ending(comparison: Comparison) -> str:
    """How many rows there are, after which time."""
    end = "interrupted after" if comparison.interrupted else "compared in"
    quick = ", quick" if comparison.quick else ""
    return f"{counted(len(comparison.rows), 'row')} {end} {comparison.seconds:.0f} s{quick}"


def print_comparison(comparison: Comparison) -> None:
    """Print the sections of a comparison; reasons, which stand below their table, are messages."""
    for section in sections(comparison):
        console = screen
        screen.print(section.title, style="bold")
        for part in section.parts:
            if isinstance(part, Table):
                table = replace(part, heads=part.heads or ("", ""))
                print_table(table, words=FOLD, numbers=FOLD, show_header=bool(part.heads))
                console = messages if section.title == VERDICTS else screen
            elif isinstance(part, Text):
                console.print(part.text, soft_wrap=True)
    screen.print(ending(comparison))
