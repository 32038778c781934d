"""What a case says of itself, as tables that screen, notebook and report draw: path, hole, string, fluids, loads."""

from dataclasses import replace

import numpy as np

from fctd.case.calipers.caliper import Caliper
from fctd.case.friction import factors_label
from fctd.case.load import Case
from fctd.case.rig import MudSpec
from fctd.case.systems import ACROSS, DENSITY, DOG_LEG, FORCE, LENGTH, LINEAR_MASS, YIELD_STRESS, Kind, System
from fctd.case.text import counted
from fctd.model.summary import Summary
from fctd.results.shown_tables import NONE, Cell, Fact, Head, Table, facts, number, quantities, quantity, short, text


def path_facts(summary: Summary, units: System) -> Table:
    """Depth, departure, greatest inclination and dog-leg of the hole."""
    metre = LENGTH.shown(units)
    path = summary.path
    per, course = DOG_LEG[units]
    turns = f"{course} from {path.dogleg_from * metre.factor:.0f} to {path.dogleg_to * metre.factor:.0f} {metre.label}"
    steepest = f"° at {path.inclination_at * metre.factor:.0f} {metre.label}"
    depth = quantity(LENGTH, path.depth, units)
    return facts("Path", [
        ("total depth, measured", depth, f"{metre.label} ({counted(path.stations, 'station')})"),
        ("true vertical depth", quantity(LENGTH, path.vertical_depth, units), metre.label),
        ("departure", quantity(LENGTH, path.departure, units), metre.label),
        ("greatest inclination", number(np.degrees(path.inclination), 1), steepest),
        ("greatest dog-leg", number(np.degrees(path.dogleg) * per, 2), turns if path.dogleg > 0 else course),
    ])  # fmt: skip


def hole_table(case: Case, units: System, *, casings: bool = False) -> Table:
    """A row for each interval; casings : with the pipe of the catalogue."""
    across, intervals = ACROSS.shown(units), case.wellbore.intervals
    starts = 0.0, *(one.to_md for one in intervals[:-1])
    heads: tuple[Head | str, ...] = (
        "hole", "kind", Head("from", LENGTH.label(units), True), Head("to", LENGTH.label(units), True),
        Head("diameter", across.label, True), Head("μ", "", True), *(["casing"] * casings),
    )  # fmt: skip
    rows = (
        (
            text(k if one.name is None else f"{k}: {one.name}"), text(one.kind or NONE), quantity(LENGTH, start, units),
            quantity(LENGTH, one.to_md, units), short(one.diameter * across.factor), text(factors_label([one])),
            *([text(one.casing or NONE)] * casings),
        )
        for k, (start, one) in enumerate(zip(starts, intervals, strict=True), start=1)
    )  # fmt: skip
    return Table("Intervals", heads, tuple(rows))


def string_table(summary: Summary, units: System, *, sizes: bool = False) -> Table:
    """A row for each component from the top to the bit; sizes : with diameters and mass in place of clearances."""
    across = ACROSS.shown(units)
    parts = list(zip(summary.parts, summary.case.string.components[: len(summary.parts)][::-1], strict=True))
    of_pipe: list[tuple[str, Kind]] = [(f"{which} diameter", ACROSS) for which in ("outer", "inner", "contact")] * sizes
    clearances = () if sizes else range(1, len(summary.case.wellbore.intervals) + 1)
    at = LENGTH.shown(units)
    reached = summary.bit_depth == summary.path.depth
    bit = "the bottom" if reached else f"{summary.bit_depth * at.factor:.1f} {at.label}"
    columns: list[tuple[str, Kind | None]] = [
        (f"string, the bit at {bit}", None), ("from", LENGTH), ("to", LENGTH), *of_pipe,
        *([("mass", LINEAR_MASS)] * sizes), ("in air", FORCE), ("in mud", FORCE),
    ]  # fmt: skip
    rows = [
        (
            part.name, part.from_md, part.to_md, *(getattr(of, name.replace(" ", "_")) for name, _ in of_pipe),
            *([part.mass] * sizes), part.air, part.buoyed,
        )
        for part, of in parts
    ]  # fmt: skip
    table = quantities("String", columns, rows, units)
    heads = (*table.heads, *(Head("clearance", f"in {k}, {across.label}", True) for k in clearances))
    told = ([short(part.clearances[k - 1] * across.factor, 3) for k in clearances] for part, _ in parts)
    return replace(table, heads=heads, rows=tuple((*row, *more) for row, more in zip(table.rows, told, strict=True)))


def caliper_facts(caliper: Caliper, units: System) -> Table:
    """What a caliper has measured."""
    metre, across = LENGTH.shown(units), ACROSS.shown(units)
    md, size = caliper.md * metre.factor, 2 * caliper.radii * across.factor
    arms = "round" if size.shape[1] == 1 else "an oval" if size.shape[1] == 2 else f"{size.shape[1]} radii"
    depths = f"{metre.label}, {counted(len(md), 'row')}, {arms}"
    missing = int(np.isnan(size).any(axis=1).sum())
    sizes = f"{np.nanmin(size):.4g} to {np.nanmax(size):.4g}"
    lacks = [("without a value", number(missing, 0), "rows, where the hole has its interval's size")]
    first = short(np.degrees(caliper.angles[0, 0]) % 360)
    return facts("Caliper", [
        ("caliper", text(f"{md[0]:.1f} to {md[-1]:.1f}"), depths),
        ("diameter", text(sizes), f"{across.label}, {np.nanmean(size):.4g} in the mean"),
        ("first arm", first, f"° from {caliper.reference.replace('_', ' ')}"),
        *(lacks if missing else []),
    ])  # fmt: skip


def fitting_facts(case: Case, units: System) -> Table:
    """A row for the fittings of each component, and one for each swivel."""
    metre, across = LENGTH.shown(units), ACROSS.shown(units)
    rows: list[Fact] = []
    for part in case.string.components:
        of, name = part.fittings, part.name
        if of is not None:
            what = "bow springs" if part.has_bows else part.repeat_key.replace("_", " ")
            said = f"{across.label}, every {of.every * metre.factor:.4g} {metre.label} of {name}"
            own = "" if of.friction is None else f", friction {of.friction:g}"
            rows.append((what, short(of.diameter * across.factor), said + own))
        if part.swivel:
            rows.append(("swivel", Cell(""), f"above {name}"))
    return facts("Fittings", rows)


def load_facts(summary: Summary, units: System) -> Table:
    """Mud, weights of the string and of the block, weight on bit."""
    case, force = summary.case, FORCE.label(units)
    mud = (text("by depth"), "") if case.mud.given else (
        short(case.mud.density / DENSITY.si(units)), DENSITY.unit(units)
    )  # fmt: skip
    return facts("Weights", [
        ("mud density", *mud),
        ("buoyancy factor", number(summary.buoyancy_factor, 3), ""),
        ("string in air", quantity(FORCE, summary.air, units), force),
        ("string in mud", quantity(FORCE, summary.buoyed, units), force),
        ("block weight", quantity(FORCE, case.rig.block_weight, units), force),
        ("weight on bit", quantity(FORCE, case.bit.weight_on_bit, units), f"{force} while drilling"),
    ])  # fmt: skip


def flow_curves(mud: MudSpec, units: System) -> Table:
    """The flow curve of the mud and of each row of fluids that has its own, with what misses the readings most."""
    named = [("flow curve of the mud", mud)]
    named += [
        (f"of mud.{side}[{k}]", row) for side in ("inside", "outside") for k, row in enumerate(getattr(mud, side))
    ]
    stress, unit = YIELD_STRESS.shown(units)
    rows: list[Fact] = []
    for name, flow in named:
        if flow.curve is None:
            continue
        least, consistency, index = (float(value) for value in flow.curve)
        said = f"yield stress, consistency {consistency * stress:.3g} {unit}·sⁿ, index {index:.3f}"
        rows.append((name, short(least * stress, 3), f"{unit} {said}"))
        if flow.fit is not None and flow.fann is not None:
            worst = int(np.argmax(np.abs(flow.fit.misfit)))
            speed, read = list(flow.fann.items())[worst]
            miss = f"degrees off at most, at {speed} rev/min, where {read:g} was read"
            off = float(flow.fit.misfit[worst])
            rows.append((f"by {flow.fit.rule}", Cell(f"{off:+.1f}", off), miss))
    return facts("Flow curves", rows)
