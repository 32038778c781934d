"""What is said at the end of a run: when its operations were steady, and whether its last records can be used."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from fctd.hydraulics.channel import channel_of
from fctd.mechanics import topdrive
from fctd.mechanics.rock import DRAG_BIT
from fctd.model.operations import Phase, rad_per_s
from fctd.model.torsion import axial_period_of, period_of
from fctd.model.tortuosity import resolving, shortfall
from fctd.results import run_notes
from fctd.results.notes import Note, falling
from fctd.results.swings import Span, swing_of
from fctd.results.tables import SimulationResult
from fctd.simulation.ringing import expected_ringing
from fctd.simulation.run import Run

if TYPE_CHECKING:
    import pandas as pd

# Ringing at the seams between cylinders above this share of the hook load gets a note.
RINGING = 0.005


def end_notes(
    run: Run, phases: list[Phase], result: SimulationResult, start_time: float
) -> tuple[Note | None, list[Note]]:
    """The note on the energy ledger of a completed run, if there is one, and all notes of its end.

    start_time : of the first record [s].
    """
    history, spans = result.history, spans_of(run, phases)
    swing, frequency, depth = expected_ringing(run, phases).largest()
    bound = RINGING * float(history["hookload_N"].abs().mean())
    ledger = run_notes.ledger_off(result.run["energy_error"])
    found = (
        ledger,
        run_notes.rings(swing, frequency, depth, bound),
        torque_note(run, spans[-1], history),
        hookload_note(run, spans[-1], history, start_time),
        _whirl_note(run, spans, history),
        _drilling_note(run, history),
        _falling_note(run),
        *_limit_notes(run),
    )
    return ledger, [note for note in found if note is not None]


def spans_of(run: Run, phases: list[Phase]) -> list[Span]:
    """When the operations begin, are steady and end, with the periods of the string at their end."""
    spans = []
    for k, operation in enumerate(run.case.operations):
        motions = [motion for motion, index in phases if index == k]
        start, end = motions[0].start, motions[-1].start + motions[-1].duration
        # Of the strokes of a trip the last that is no short one: what is left at its end has few periods.
        steady = [m for m in motions if m.feed_from == m.feed_to and m.spin_from == m.spin_to]
        moving = [m for m in steady if m.feed_to or m.spin_to] or steady
        whole = [m for m in moving if m.duration >= 0.5 * max(n.duration for n in moving)]
        steady_from, steady_to = start, end
        if whole:
            steady_from, steady_to = whole[-1].start, whole[-1].start + whole[-1].duration
        string = run.string
        if string.long_segment:
            string = string.lengthened(operation.end_md - string.bit_depth)
        periods = axial_period_of(string), period_of(string)
        spans.append(Span(operation.kind, start, steady_from, steady_to, end, *periods, operation.rpm))
    return spans


def torque_note(run: Run, span: Span, history: "pd.DataFrame") -> Note | None:
    """The note on the surface torque at the end of a run whose string turns there.  span : of its last operation."""
    if not span.rpm:
        return None
    period, time_s = span.torsional_period, np.append(0.0, history["time_s"])
    torque = history["surface_torque_N_m"].to_numpy(float)
    impulse = np.append(0.0, np.cumsum(torque * np.diff(time_s)))
    before, middle, end = np.interp(time_s[-1] - period * np.array([2.0, 1.0, 0.0]), time_s, impulse)
    means = (end - middle) / period, (middle - before) / period
    swings = run_notes.torque_swings(float(torque[-1]), *means, period, float(history["hookload_N"].iloc[-1]))
    turned = np.append(0.0, np.cumsum(history["top_rpm"].to_numpy(float) * np.diff(time_s)))
    turns = float(np.diff(np.interp(time_s[-1] - period * np.array([1.0, 0.0]), time_s, turned))[0])
    return swings or run_notes.turns_slowly(turns / period, span.rpm)


def hookload_note(run: Run, span: Span, history: "pd.DataFrame", start_time: float) -> Note | None:
    """The note on the hook load at the end of a run that is recorded there for two axial periods or more."""
    time_s, period = np.append(start_time, history["time_s"]), span.axial_period
    end = float(time_s[-1])
    if end - 2 * period < max(span.start, time_s[0]):
        return None
    spans = (span._replace(steady_from=end - (k + 1) * period, steady_to=end - k * period) for k in range(2))
    last, before = (swing_of(time_s, history, "hookload", "N", one, period) for one in spans)
    string = run.laid_out
    weight = float(np.abs(string.weight * string.length).sum())
    return run_notes.hookload_swings(max(last.swing, before.swing), last.mean, before.mean, period, weight)


def _whirl_note(run: Run, spans: Sequence[Span], history: "pd.DataFrame") -> Note | None:
    """The note on a string that whirls: the operation in which it moved sideways most, by its last records."""
    found = []
    radius = float(run.string.of("contact_radius").min())
    for operation, span in zip(run.case.operations, spans, strict=True):
        if not operation.rpm:
            continue
        last = history[(history["time_s"] <= span.end + 1e-6) & (history["time_s"] > span.end - span.torsional_period)]
        surface = radius * rad_per_s(operation.rpm)
        # A string that moves along the hole too spends part of its friction there.
        share = surface / np.hypot(surface, operation.speed)
        sideways = float(np.sqrt((last["lateral_speed_m_s"] ** 2).mean()))
        torque, full = float(last["sum_r_ft_N_m"].mean()), float(last["sum_r_mu_fn_N_m"].mean())
        found.append(run_notes.whirls(sideways, surface, torque, share * full))
    return max((note for note in found if note), key=lambda note: note.excess, default=None)


def _drilling_note(run: Run, history: "pd.DataFrame") -> Note | None:
    """The note on a bit that has made no hole."""
    rock = run.laws.rock
    if rock.law != DRAG_BIT or "hole_made_m" not in history:
        return None
    made, weight = float(history["hole_made_m"].iloc[-1]), float(history["weight_on_bit_N"].max())
    return run_notes.drilled_nothing(made, weight, rock.worn)


def _falling_note(run: Run) -> Note | None:
    """The note on fluid inside that falls freely while an operation pumps less than it falls."""
    if run.string.fluids is None:
        return None
    channel = channel_of(run.case, run.laid_out, run.hole)
    flow = min(operation.flow for operation in run.case.operations)
    return falling(channel.free_fall(flow), flow, channel.overweight)


def _limit_notes(run: Run) -> tuple[Note | None, ...]:
    """The notes on penetrations beyond that of the step, and on segments too long for a winding hole."""
    case, longest = run.case, run.string.longest
    wanted = case.wellbore.tortuosity
    deepest = float(run.top[topdrive.TOP_PENETRATION])
    return (
        run_notes.too_deep(deepest, case.contact.largest_penetration),
        run_notes.winds_too_much(shortfall(wanted, longest), longest, resolving(wanted)),
    )
