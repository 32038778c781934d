"""``fctd check CASE``: what was understood of a case, to compare with the well plan."""

from collections.abc import Sequence

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.table import Column, Table

from fctd.case.calipers.caliper import Caliper
from fctd.case.friction import factors_label
from fctd.case.load import Case, naming_file
from fctd.case.rig import MudSpec
from fctd.case.text import counted, printable
from fctd.case.units import DENSITY, YIELD_STRESS, Quantity
from fctd.cli.base_command import Silent
from fctd.cli.options import CaseFile, Friction, Overrides, Strict, Units, changes_of, read_case, screen, tell
from fctd.model.summary import Summary, segments_in_words, summarise
from fctd.results.unit_systems import Shown, System, shown

# Of a table without columns: key, value, unit.
Row = tuple[str, str, str]


def check_command(
    case_file: CaseFile,
    overrides: Overrides = [],  # noqa: B006 (typer copies it)
    friction: Friction = None,
    units: Units = "si",
    quiet: Silent = False,
    strict: Strict = False,
) -> None:
    """Print what was understood of a case: path, sizes, weights, clearances, segments; and its probable mistakes."""
    case = read_case(case_file, changes_of(overrides, friction))
    with naming_file(case):
        summary = summarise(case)
        if not quiet:
            _print(summary, units)
        string = summary.string()  # raises InputError where it does not fit the hole: after the tables that show why
    metre = shown("bit_depth_m", units)
    if not quiet:
        screen.print(segments_in_words(case, string, metre.factor, metre.label), soft_wrap=True)
    tell(case, case.warnings, strict=strict, units=units)


def _print(summary: Summary, units: System) -> None:
    metre, across, force = (shown(name, units) for name in ("bit_depth_m", "clearance_m", "hookload_N"))
    screen.print(printable(summary.case.name), style="bold")
    screen.print(facts_table(_path(summary, units, metre)))
    screen.print(_hole(summary.case, metre, across))
    if summary.case.wellbore.calipers is not None:
        screen.print(facts_table(_caliper(summary.case.wellbore.calipers, metre, across)))
    screen.print(_string(summary, metre, across, force))
    if rows := _fittings(summary.case, metre, across):
        screen.print(facts_table(rows))
    screen.print(facts_table(_loads(summary, units, force)))
    if rows := flow_curves(summary.case.mud, units):
        screen.print(facts_table(rows))


def flow_curves(mud: MudSpec, units: System) -> list[Row]:
    """The flow curve of the mud and of each row of fluids that has its own, with what misses the readings most."""
    named = [("flow curve of the mud", mud)]
    named += [
        (f"of mud.{side}[{k}]", row) for side in ("inside", "outside") for k, row in enumerate(getattr(mud, side))
    ]
    unit = "Pa" if units == "si" else "lbf/(100 ft²)"
    stress = 1 / YIELD_STRESS.factor("Pa" if units == "si" else "lbf/hsqft")
    rows = []
    for name, flow in named:
        if flow.curve is None:
            continue
        least, consistency, index = (float(value) for value in flow.curve)
        said = f"yield stress, consistency {consistency * stress:.3g} {unit}·sⁿ, index {index:.3f}"
        rows.append((name, f"{least * stress:.3g}", f"{unit} {said}"))
        if flow.fit is not None and flow.fann is not None:
            worst = int(np.argmax(np.abs(flow.fit.misfit)))
            speed, read = list(flow.fann.items())[worst]
            miss = f"degrees off at most, at {speed} rev/min, where {read:g} was read"
            rows.append((f"by {flow.fit.rule}", f"{flow.fit.misfit[worst]:+.1f}", miss))
    return rows


def _path(summary: Summary, units: System, metre: Shown) -> list[Row]:
    path = summary.path
    per, course = (30.0, "°/30 m") if units == "si" else (30.48, "°/100 ft")
    turns = f"{course} from {path.dogleg_from * metre.factor:.0f} to {path.dogleg_to * metre.factor:.0f} {metre.label}"
    return [
        (
            "total depth, measured",
            f"{path.depth * metre.factor:.1f}",
            f"{metre.label} ({counted(path.stations, 'station')})",
        ),
        ("true vertical depth", f"{path.vertical_depth * metre.factor:.1f}", metre.label),
        ("departure", f"{path.departure * metre.factor:.1f}", metre.label),
        (
            "greatest inclination",
            f"{np.degrees(path.inclination):.1f}",
            f"° at {path.inclination_at * metre.factor:.0f} {metre.label}",
        ),
        ("greatest dog-leg", f"{np.degrees(path.dogleg) * per:.2f}", turns if path.dogleg > 0 else course),
    ]


def _loads(summary: Summary, units: System, force: Shown) -> list[Row]:
    case, unit = summary.case, "kg/m^3" if units == "si" else "ppg"
    density = case.mud.density / Quantity(dimension=DENSITY).parse(f"1 {unit}")
    return [
        ("mud density", "by depth" if case.mud.given else f"{density:.4g}", "" if case.mud.given else unit),
        ("buoyancy factor", f"{summary.buoyancy_factor:.3f}", ""),
        ("string in air", f"{summary.air * force.factor:.1f}", force.label),
        ("string in mud", f"{summary.buoyed * force.factor:.1f}", force.label),
        ("block weight", f"{case.rig.block_weight * force.factor:.1f}", force.label),
        ("weight on bit", f"{case.bit.weight_on_bit * force.factor:.1f}", f"{force.label} while drilling"),
    ]


def facts_table(rows: Sequence[Row]) -> Table:
    """A table of one fact a row."""
    table = Table(box=SIMPLE_HEAD, show_header=False, pad_edge=False)
    for row in rows:
        table.add_row(*row)
    table.columns[1].justify = "right"
    return table


def _hole(case: Case, metre: Shown, across: Shown) -> Table:
    table = _table(["hole", "kind"], [f"from\n{metre.label}", f"to\n{metre.label}", f"diameter\n{across.label}", "μ"])
    start = 0.0
    for k, interval in enumerate(case.wellbore.intervals, start=1):
        sizes = (start * metre.factor, interval.to_md * metre.factor, interval.diameter * across.factor)
        cells = (f"{sizes[0]:.1f}", f"{sizes[1]:.1f}", f"{sizes[2]:.4g}", factors_label([interval]))
        table.add_row(_name(interval.name, k), interval.kind or "–", *cells)
        start = interval.to_md
    return table


def _caliper(caliper: Caliper, metre: Shown, across: Shown) -> list[Row]:
    md, size = caliper.md * metre.factor, 2 * caliper.radii * across.factor
    arms = "round" if size.shape[1] == 1 else "an oval" if size.shape[1] == 2 else f"{size.shape[1]} radii"
    depths = f"{metre.label}, {counted(len(md), 'row')}, {arms}"
    missing = int(np.isnan(size).any(axis=1).sum())
    sizes = f"{np.nanmin(size):.4g} to {np.nanmax(size):.4g}"
    return [
        ("caliper", f"{md[0]:.1f} to {md[-1]:.1f}", depths),
        ("diameter", sizes, f"{across.label}, {np.nanmean(size):.4g} in the mean"),
        ("first arm", f"{np.degrees(caliper.angles[0, 0]) % 360:.4g}", f"° from {caliper.reference.replace('_', ' ')}"),
        *([("without a value", str(missing), "rows, where the hole has its interval's size")] if missing else []),
    ]


def _fittings(case: Case, metre: Shown, across: Shown) -> list[Row]:
    """A line for the fittings of each component, and one for each swivel."""
    rows = []
    for part in case.string.components:
        of, name = part.fittings, printable(part.name)
        if of is not None:
            what = "bow springs" if part.has_bows else part.repeat_key.replace("_", " ")
            said = f"{across.label}, every {of.every * metre.factor:.4g} {metre.label} of {name}"
            own = "" if of.friction is None else f", friction {of.friction:g}"
            rows.append((what, f"{of.diameter * across.factor:.4g}", said + own))
        if part.swivel:
            rows.append(("swivel", "", f"above {name}"))
    return rows


def _string(summary: Summary, metre: Shown, across: Shown, force: Shown) -> Table:
    intervals = summary.case.wellbore.intervals
    columns = [f"from\n{metre.label}", f"to\n{metre.label}", f"in air\n{force.label}", f"in mud\n{force.label}"]
    columns += [f"clearance\nin {k + 1}, {across.label}" for k in range(len(intervals))]
    table = _table(["string, the bit at the bottom"], columns)
    for part in summary.parts:
        depths = (f"{part.from_md * metre.factor:.1f}", f"{part.to_md * metre.factor:.1f}")
        weights = (f"{part.air * force.factor:.1f}", f"{part.buoyed * force.factor:.1f}")
        table.add_row(printable(part.name), *depths, *weights, *(f"{c * across.factor:.3g}" for c in part.clearances))
    return table


def _table(names: Sequence[str], numbers: Sequence[str]) -> Table:
    return Table(
        *(Column(heading, overflow="fold") for heading in names),
        *(Column(heading, justify="right", overflow="fold") for heading in numbers),
        box=SIMPLE_HEAD, collapse_padding=True, pad_edge=False,
    )  # fmt: skip


def _name(name: str | None, number: int) -> str:
    return f"{number}" if name is None else f"{number}: {printable(name)}"
