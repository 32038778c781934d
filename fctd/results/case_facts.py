"""What a case says of itself, one fact a row: path, caliper, fittings, loads, flow curves; for screens and reports."""

from typing import TypeAlias

import numpy as np

from fctd.case.calipers.caliper import Caliper
from fctd.case.load import Case
from fctd.case.rig import MudSpec
from fctd.case.systems import ACROSS, DENSITY, DOG_LEG, FORCE, LENGTH, YIELD_STRESS, System
from fctd.case.text import counted, printable
from fctd.model.summary import Summary

# What, how much, and its unit or what else there is to say.
Row: TypeAlias = tuple[str, str, str]


def path_facts(summary: Summary, units: System) -> list[Row]:
    """Depth, departure, greatest inclination and dog-leg of the hole."""
    metre = LENGTH.shown(units)
    path = summary.path
    per, course = DOG_LEG[units]
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


def caliper_facts(caliper: Caliper, units: System) -> list[Row]:
    """What a caliper has measured."""
    metre, across = LENGTH.shown(units), ACROSS.shown(units)
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


def fitting_facts(case: Case, units: System) -> list[Row]:
    """A row for the fittings of each component, and one for each swivel."""
    metre, across = LENGTH.shown(units), ACROSS.shown(units)
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


def load_facts(summary: Summary, units: System) -> list[Row]:
    """Mud, weights of the string and of the block, weight on bit."""
    force = FORCE.shown(units)
    case, unit = summary.case, DENSITY.unit(units)
    density = case.mud.density / DENSITY.si(units)
    return [
        ("mud density", "by depth" if case.mud.given else f"{density:.4g}", "" if case.mud.given else unit),
        ("buoyancy factor", f"{summary.buoyancy_factor:.3f}", ""),
        ("string in air", f"{summary.air * force.factor:.1f}", force.label),
        ("string in mud", f"{summary.buoyed * force.factor:.1f}", force.label),
        ("block weight", f"{case.rig.block_weight * force.factor:.1f}", force.label),
        ("weight on bit", f"{case.bit.weight_on_bit * force.factor:.1f}", f"{force.label} while drilling"),
    ]


def flow_curves(mud: MudSpec, units: System) -> list[Row]:
    """The flow curve of the mud and of each row of fluids that has its own, with what misses the readings most."""
    named = [("flow curve of the mud", mud)]
    named += [
        (f"of mud.{side}[{k}]", row) for side in ("inside", "outside") for k, row in enumerate(getattr(mud, side))
    ]
    stress, unit = YIELD_STRESS.shown(units)
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
