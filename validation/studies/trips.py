"""Trips of real wells from surface to total depth and back, stand by stand, against the steady string.

A stroke of the block gives one hook load: its mean over whole axial periods, less the weight in air of the pipe above
the rotary table.  After the block reverses, the mean begins where it has moved twice the change of stretch between
slacking off and picking up.
"""

from dataclasses import dataclass
from random import Random
from time import process_time
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, equilibrium
from fctd.mechanics import state
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.operations import Phase
from fctd.model.string_in_hole import squeeze_of
from fctd.results.notes import codes_of
from fctd.simulation.hung import Hung
from fctd.simulation.intervals import Interval, Window, within
from fctd.simulation.run import Run
from fctd.simulation.simulate import Simulation
from validation.cases import load, trip
from validation.harness.study import Check, Context, Outcome, Rows, Study, in_columns
from validation.parts.random_paths import path
from validation.parts.windows import factors

SPEED, RAMP = 0.5, 5.0  # [m/s], [s]
CONNECTION = 10.0  # [s]
RECORD, SELDOM = 0.25, 60.0  # [s] between records of a measured stroke, and of others
DEPTHS = 10
FROM = 30.0  # [m]: the first bit depth
WELL_9 = {"md": "Measured Depth ( ft )", "inc": "Inclination ( deg )", "azi": "Azimuth Grid ( deg )"}
# Survey, depth [m], length of the segments [m] and columns of the survey.
WELLS: dict[str, tuple[str, float, float, dict[str, str] | None]] = {
    "K05-ENC-05-S1": ("nlog_K05-ENC-05-S1.csv", 8161.0, 28.5, None),
    "ISCWSA reference": ("iscwsa_reference_well.csv", 2940.0, 28.5, None),
    "well 9": ("wellpathpy_well9_horizontal_reference.csv", 2400.0, 28.5, WELL_9),
}

DRAWN, DEEPEST = 3, 2500.0  # wells drawn at random, in which one tuned nothing, and their greatest depth [m]


@dataclass(frozen=True)
class Trip:
    """A trip of a well: in from one bit depth to another and back out [m]."""

    case: Case
    shallow: float
    deep: float
    depths: tuple[float, ...]


def trip_of(depth: float, segment: float, ends: tuple[float, float], depths: tuple[float, ...], **changes: Any) -> Trip:
    """5 in pipe in an 8.5 in hole along a path, as in the case ``nlog_k05``, in and out between two depths.

    depth : of the hole, and length of the string [m]; segment : length of the segments [m]; changes : of the case,
    its path among them.
    """
    case = load(
        "nlog_k05",
        wellbore__geometry="arcs",
        wellbore__intervals__0__to_md=depth,
        string__components__0__length=depth,
        string__components__0__segments=None,
        string__components__0__segment_length=segment,
        rig__feed="stands",
        rig__connection_time=CONNECTION,
        operations=trip(*ends, SPEED, RAMP) + trip(*ends[::-1], SPEED, RAMP),
        **changes,
    )
    return Trip(case, *ends, depths)


def surveyed(context: Context, name: str) -> dict[str, Any]:
    """The changes of a case that give it the path of a public survey."""
    assert context.data is not None  # the runner has checked that the data are there
    file, _, _, columns = WELLS[name]
    return {"wellbore__survey": context.data / "surveys" / file, "wellbore__columns": columns}


def trips(context: Context) -> dict[str, Trip]:
    """The wells by name: public ones, and some drawn at random."""
    if context.quick:
        return {"well 9": trip_of(2400.0, 28.5, (1000.0, 1060.0), (1010.0, 1050.0), **surveyed(context, "well 9"))}
    found = {
        name: trip_of(depth, segment, (FROM, depth), _depths(depth), **surveyed(context, name))
        for name, (_, depth, segment, _) in WELLS.items()
    }
    for seed in range(DRAWN):
        stations = path(Random(seed), deepest=DEEPEST)
        depth = stations[-1][0]
        drawn = {"wellbore__survey": None, "wellbore__stations": stations}
        found[f"drawn {seed + 1}"] = trip_of(depth, 28.5, (FROM, depth), _depths(depth), **drawn)
    return found


def _depths(depth: float) -> tuple[float, ...]:
    return tuple(np.linspace(depth / DEPTHS, 0.995 * depth, DEPTHS))


def measured(phases: list[Phase], of: Trip) -> list[bool]:
    """Which phases are those at full speed, in and out, that are nearest to the depths."""
    depth, middles = of.shallow, np.full((2, len(phases)), np.inf)
    for k, (motion, operation) in enumerate(phases):
        fed = 0.5 * (motion.feed_from + motion.feed_to) * motion.duration
        if motion.feed_from == motion.feed_to != 0:
            middles[operation, k] = depth + 0.5 * fed
        depth += fed
    nearest = {int(np.argmin(np.abs(way - wanted))) for way in middles for wanted in of.depths}
    return [k in nearest for k in range(len(phases))]


def recorded(phases: list[Phase], often: list[bool]) -> list[Interval]:
    """The intervals of a schedule: short ones where the hook load is measured."""
    return [
        interval
        for phase, fine in zip(phases, often, strict=True)
        for interval in within([phase], Window(phase.motion.start, phase.motion.duration), RECORD if fine else SELDOM)
    ]


def missing(run: Run) -> float:
    """What the columns of the string differ in mass and length from those of the tally, the larger share."""
    hung = run.upper_end
    assert isinstance(hung, Hung)
    n, tally = run.segments, hung.tally
    squeeze = squeeze_of(run.case, tally.whole, run.hole)
    length = float(tally.reach[hung.stands]) - float((tally.whole.length * squeeze)[-n:].sum())
    mass = float((tally.whole.of("mass") * tally.whole.length)[-n:].sum())
    arms = sum(float(state.row(run.S, row, n).sum()) for row in (state.ARM_TOP, state.ARM_BOTTOM))
    return max(abs(float(state.row(run.S, state.MASS, n).sum()) / mass - 1), abs(arms / length - 1))


def stroke_rows(case: Case, of: Trip, simulation: Simulation, history: pd.DataFrame) -> Rows:
    """A row for each measured stroke: hook load below the table, and that of the steady string."""
    section = simulation.run.string.sections[0]
    air = section.mass * GRAVITY * float(simulation.run.hole.at(np.zeros(1))[1][0, 2])
    turns = stretch(case, of.deep)
    depth = of.shallow
    for (motion, operation), fine in zip(simulation.phases, measured(simulation.phases, of), strict=True):
        fed = 0.5 * (motion.feed_from + motion.feed_to) * motion.duration
        depth += fed
        # After the reversal at total depth, until the block has moved twice the change of stretch.
        if not fine or (fed < 0 and of.deep - (depth - fed) < 2 * turns):
            continue
        end = motion.start + motion.duration
        stroke = history[(history["time_s"] > motion.start + 1e-6) & (history["time_s"] < end + 1e-6)]
        period = 4 * float(stroke["bit_depth_m"].mean()) / float(np.sqrt(section.EA / section.mass))
        whole = max(int(motion.duration / period), 1) * period
        stroke = stroke[stroke["time_s"] > end - whole]
        bit = float(stroke["bit_depth_m"].mean())
        kind = case.operations[operation].kind
        pull = float((stroke["hookload_N"] - air * stroke["block_position_m"]).mean())
        steady = equilibrium(case, operation=kind, bit_depth=bit)
        weight = section.weight * bit
        yield {
            "operation": kind, "bit_depth_m": bit, "hookload_kN": pull / 1e3,
            "steady_hookload_kN": steady.hookload / 1e3, "steady_status": str(steady.status),
            "off_percent_of_weight": 100 * (pull - steady.hookload) / weight,
            "swing_kN": float(stroke["hookload_N"].std()) / 1e3, "periods": round(whole / period),
        }  # fmt: skip


def stretch(case: Case, bit: float) -> float:
    """Change of the string's stretch between slacking off and picking up [m]."""
    ends = [equilibrium(case, operation=kind, bit_depth=bit) for kind in ("trip_out", "trip_in")]
    pulls = [point.profile.set_index("md_m")["effective_tension_N"] for point in ends]
    apart = pulls[0].to_numpy() - np.interp(pulls[0].index, pulls[1].index, pulls[1])
    section_EA = np.pi / 4 * (0.127**2 - 0.1086**2) * 206.8e9
    return float(np.trapezoid(apart, pulls[0].index)) / section_EA


def one(name: str, of: Trip) -> tuple[dict[str, Any], pd.DataFrame]:
    """Row of a well, and the rows of its strokes."""
    case = of.case
    simulation = Simulation(case)
    simulation.intervals = recorded(simulation.phases, measured(simulation.phases, of))
    first, leaks, records = simulation.run.segments, [], []
    for _ in simulation:
        leaks.append(missing(simulation.run))
        records.append((simulation.run.time, process_time()))
    result, run = simulation.result(), simulation.run
    strokes = pd.DataFrame(stroke_rows(case, of, simulation, result.history))
    row = {
        "well": name, "begins_deg": float(np.degrees(run.hole.inclination(np.zeros(1))[0])),
        "status": str(result.status), "from_m": of.shallow, "to_m": of.deep,
        "connections": int((result.history["in_slips"].astype(int).diff() == 1).sum()),
        "most_segments": run.upper_end.longest.segments, "hours_simulated": result.run["simulated_s"] / 3600,
        **in_columns({"real_time_factor": factors(records)}),
        "largest_off_percent_of_weight": float(strokes["off_percent_of_weight"].abs().max()),
        "energy_error_percent": 100 * result.run["energy_error"],
        "notes": codes_of(result.notes), "missing_share": max(leaks), "segments_gained": run.segments - first,
    }  # fmt: skip
    return row, strokes.assign(well=name)


def _largest_off(strokes: pd.DataFrame, wells: pd.DataFrame) -> float:
    return float(strokes.loc[strokes["well"].isin(wells["well"]), "off_percent_of_weight"].abs().max())


def run(context: Context) -> Outcome:
    """In and out of every well."""
    found = [one(name, of) for name, of in context.progress(list(trips(context).items()), "trips")]
    wells = pd.DataFrame([row for row, _ in found])
    strokes = pd.concat([rows for _, rows in found], ignore_index=True)
    slant = wells[wells["begins_deg"] > 0]
    target = "target of this project"
    return Outcome(
        tables={"wells": wells, "strokes": strokes},
        checks=[
            Check("trips that do not complete", float((wells["status"] != "completed").sum()), 0, "at_most", "",
                  target),
            Check("trips whose hook load flutters, by the note", float(wells["notes"].str.contains("flutter").sum()), 0,
                  "at_most", "", target),
            Check("hook load below the table against the steady string, largest difference",
                  _largest_off(strokes, wells[wells["begins_deg"] == 0]), 0.5, "at_most", "% of the weight", target),
            *(
                [Check("hook load in a well that begins inclined, largest difference", _largest_off(strokes, slant),
                       0.5, "at_most", "% of the weight", target)]
                if len(slant) else []
            ),
            Check("energy ledger, residual over work", float(wells["energy_error_percent"].max()), 0.1, "at_most",
                  "%", target),
            Check("mass or length that is missing, largest share", float(wells["missing_share"].max()), 1e-9,
                  "at_most", "", "exact but for rounding"),
            Check("segments that a trip in and out leaves behind", float(wells["segments_gained"].abs().max()), 0,
                  "at_most", "", "exact"),
        ],
        notes=[
            "Hole, string, mud and friction are assumed; the surveys are real, but those of the wells drawn at random. "
            "Geometry arcs: cylinders add energy at their seams.",
            f"{SPEED:g} m/s, {CONNECTION:g} s a connection. Without axial damping a start swings the hook load for the "
            "whole stroke; the means are over whole periods.",
        ],
        display={"wells": "Trips in and out", "strokes": "Hook load below the rotary table against the steady string"},
    )  # fmt: skip


STUDY = Study(
    "trips",
    "Does a trip of stands, in any well, have the hook load of the steady string?",
    run,
    needs=("data",),
)
