"""Rows of buckled strings, drawn at random, and how far noise of the size of rounding moves their loads."""

import time
from collections.abc import Iterator, Sequence
from itertools import count
from typing import Any, NamedTuple

import numpy as np

from fctd import Case
from fctd.case.errors import InputError
from fctd.model.perturbed import with_noise
from fctd.results.notes import HARDLY
from fctd.steady.steady_string import Equilibrium
from fctd.steady.torque_drag import chart_rows
from validation.harness.study import Context
from validation.parts import compressed, fed_strings

SEED = 55
SEEDS = 101, 102  # of the noise, beside the plain row; others than those of the note
BEYOND = 1.3  # compression over the sinusoidal limit, from which on a row counts
STRAIGHT, WELL = "straight hole", "well"
WELL_FRICTION = (0.1, 0.25)  # with more, most strings lock up, and a row takes ten times as long
ABOVE = 0.94  # of the bit depth: where a chart has the depth above


class Drawn(NamedTuple):
    """A string: where it lies, its number there, the case, operation, bit depth [m] and buoyed weight [N]."""

    family: str
    number: int
    case: Case
    operation: str
    bit_depth: float
    weight: float


def straight() -> Iterator[Drawn]:
    """Strings that are pressed beyond ``BEYOND`` times their limit, in straight holes, without end."""
    for index in count():
        string = compressed.drawn(SEED, index)
        if string.over_limit > BEYOND:
            case = compressed.on_mesh(string, "own", "detect")
            yield Drawn(STRAIGHT, index, case, compressed.OPERATION, case.depths[1], string.weight)


def wells(context: Context) -> Iterator[Drawn]:
    """Strings that buckle in the horizontal well and in wells drawn at random, without end."""
    for index in count():
        if fed_strings.WELLS[index % len(fed_strings.WELLS)] not in ("horizontal", "random"):
            continue  # that needs public data
        well = fed_strings.drawn(context, index, WELL_FRICTION)
        try:
            weight = fed_strings.weight_of(well.case, well.bit_depth)
            cut = fed_strings.solve(changed(well.case, "detect", None), well.operation, well.bit_depth)
        except InputError:
            continue
        if cut.is_buckled:
            yield Drawn(WELL, index, well.case, well.operation, well.bit_depth, weight)


def changed(case: Case, buckling: str, seed: int | None) -> Case:
    """The case with ``solver.buckling`` and the noise of a seed."""
    buckled = case.model_copy(update={"solver": case.solver.model_copy(update={"buckling": buckling})})
    return with_noise(buckled, seed)


def excess_of(point: Equilibrium) -> float:
    """Largest compression over the sinusoidal limit, also of a string without loads."""
    return point._shape.buckling.excess


def row_of(string: Drawn, buckling: str, seeds: Sequence[int] = SEEDS) -> dict[str, Any] | None:
    """The row of a string with ``solver.buckling``, and how far noise moves it; None below ``BEYOND`` times the limit.

    It moves where hook load or surface torque changes by more than a hundredth of the weight (times the radius of the
    pipe), or where it has loads with one noise and none with another.
    """
    rows, seconds = [], []
    for seed in (None, *seeds):
        row = fed_strings.solve(changed(string.case, buckling, seed), string.operation, string.bit_depth)
        if row.point is None:
            raise RuntimeError(f"{string.family} {string.number} {buckling}: {row.raised}")
        rows.append(row.point)
        seconds.append(row.seconds)
        if excess_of(rows[0]) < BEYOND:
            return None
    point, shape = rows[0], rows[0]._shape
    pipe = shape.laid.string
    compression = max(-float(shape.joints[:, 0].min()), -shape.bit_tension)
    half_wave = float(np.pi * np.sqrt(2 * pipe.of("EI")[-1] / compression))
    buckled = shape.buckling.to_md - shape.buckling.from_md
    arm = float(pipe.contact_radius()[0])
    hookload, torque = (
        100 * _spread([getattr(of, name) for of in rows]) / (string.weight * scale)
        for name, scale in (("hookload", 1.0), ("surface_torque", arm))
    )
    has_loads = {of.answered for of in rows}
    began = time.process_time()
    note = {note.code: note for note in point.notes}.get("several_balances")
    drawing = time.process_time() - began
    return {
        "family": string.family, "string": string.number, "buckling": buckling, "operation": string.operation,
        "bit_depth_m": string.bit_depth, "weight_kN": string.weight / 1e3,
        "inclination_deg": _inclination(point),
        "method": point.method, "status": str(point.status), "shape": point.shape, "mode": shape.buckling.mode,
        "over_sinusoidal_limit": shape.buckling.excess, "half_waves": buckled / half_wave,
        "segments": pipe.segments, "iterations": point.iterations, "fed_balances": len(point.fed),
        "snaps": sum(of.snapped for of in point.fed),
        "slack_off_spent_at": point.slack_off_spent_at, "locked_up_at": point.locked_up_at,
        "hookload_kN": point.hookload / 1e3, "hookload_spread_percent_of_weight": hookload,
        "torque_spread_percent": torque, "methods": ", ".join(of.method for of in rows),
        "statuses": ", ".join(str(of.status) for of in rows), "shapes": ", ".join(of.shape for of in rows),
        "moves": len(has_loads) > 1 or max(hookload, torque) > 100 * HARDLY,
        "predicted": point.draw is not None, "noted": note is not None,
        "noted_spread_percent_of_weight": 100 * HARDLY * note.excess if note is not None else np.nan,
        "seconds": seconds[0], "drawing_seconds": drawing,
    }  # fmt: skip


def _inclination(point: Equilibrium) -> float:
    """Inclination of the hole at the lower end of the buckled part [°]."""
    shape = point._shape
    _, tangent = shape.hole.at(np.array([shape.buckling.to_md]))
    return float(np.degrees(np.arccos(np.clip(tangent[0, 2], -1.0, 1.0))))


def _spread(loads: Sequence[float]) -> float:
    """Largest difference of loads, of those that there are."""
    found = np.array(loads)[np.isfinite(loads)]
    return float(np.ptp(found)) if len(found) else 0.0


def carried_row(string: Drawn) -> dict[str, Any]:
    """The resolved row of a string below another row of its chart, and alone."""
    case, depth = changed(string.case, "resolve", None), string.bit_depth
    _, chart = chart_rows(case, string.operation, [ABOVE * depth, depth], threads=1)
    (alone,) = chart_rows(case, string.operation, [depth], threads=1)
    return {
        "family": string.family, "string": string.number, "status": chart["status"], "alone_status": alone["status"],
        "shape": chart["shape"], "alone_shape": alone["shape"], "notes": chart["notes"],
        "off_percent_of_weight": 100 * abs(chart["hookload_N"] - alone["hookload_N"]) / string.weight,
    }  # fmt: skip
