"""The same string in the engines of rivals and plugins: loads, friction, cost, and each engine against itself."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, InputError
from fctd.mechanics import state
from fctd.simulation.run import Run
from references import engines, rivals
from references.engines import EngineRun, StringEngine, Window
from references.engines.friction_law import sliding
from references.engines.run import InWindows, late
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows
from validation.parts.engine_cases import LEAD, TURNING, chain, s_shape

OWN = "fctd"
NOT_INSTALLED, REFUSED = "not installed", "refused"
# Error of the torque for which a rival is bounded, in percent: Exudyn has FCTD's wall, the others their own.
TORQUE = {"exudyn": 2.0}
OWN_WALL = 5.0
# The step over that of the run with which an engine is compared with itself, and a shift of its start [m].
FINER, SHIFT = 16, 1e-6
AZIMUTHS = (0.0, 30.0)


def holes(quick: bool) -> dict[str, tuple[Case, Window]]:
    """A turning string in cylinders, in arcs, and in a hole that turns."""
    long, short = Window(LEAD, 1.0 if quick else 2.5), Window(LEAD, 1.2 if quick else 2.4)
    found = {
        "cylinders": (chain("rotate_off_bottom", long, wellbore__geometry="cylinders"), long),
        "arcs": (s_shape("arcs", short), short),
        "turn": (chain("rotate_off_bottom", long, wellbore__stations=TURNING), long),
    }
    return dict(list(found.items())[:1]) if quick else found


def found_engines() -> list[str]:
    """FCTD, all rivals, and the plugins that are registered here."""
    return [OWN, *rivals.ENGINES, *engines.REGISTRY.plugins()]


def row_of(name: str, find: Callable[[StringEngine], dict[str, Any]]) -> dict[str, Any]:
    """The row of an engine: what ``find`` gives of it, or why it has none."""
    found: dict[str, Any]
    try:
        installed = engines.installed_version(name) is not None
        found = find(engines.build(name)) if installed else {"status": NOT_INSTALLED, "failed": ""}
    except InputError as error:
        found = {"status": REFUSED, "failed": str(error)}
    return {"engine": name, **found}


@table_of_rows
def loads(quick: bool, context: Context) -> Rows:
    """Every engine over the same window of every hole, from the same state."""
    for hole, (case, window) in context.progress(holes(quick).items(), "holes"):
        own = engines.build(OWN).run(case, window)
        for name in found_engines():
            yield {"hole": hole, **row_of(name, partial(numbers, case=case, window=window, own=own))}


def numbers(engine: StringEngine, case: Case, window: Window, own: EngineRun) -> dict[str, Any]:
    """The loads of an engine's run, against those of FCTD's own, and its cost."""
    run = engine.run(case, window)
    end, reference = late(run), late(own)
    segments = len(run.profile) // run.profile["bit_depth_m"].nunique() - 1
    simulated = run.history["time_s"].iloc[-1] - window.start

    def off(column: str) -> float:
        return 100 * float(end[column] / reference[column] - 1)

    return {
        "status": run.status,
        "failed": run.message,
        "note": run.note,
        "hookload_kN": end["hookload_N"] / 1e3,
        "torque_kN_m": end["surface_torque_N_m"] / 1e3,
        "contact_force_kN": end["total_contact_force_N"] / 1e3,
        "friction_across_share": end["sum_r_ft_N_m"] / end["sum_r_mu_fn_N_m"],
        "hookload_off_percent": off("hookload_N"),
        "torque_off_percent": off("surface_torque_N_m"),
        "contact_off_percent": off("total_contact_force_N"),
        "energy_error_percent": 100 * float(run.checks.set_index("check")["value"]["energy"]),
        "segments": segments,
        "step_ms": 1e3 * run.step,
        "segment_step_us": 1e6 * run.wall_s / run.steps / segments,
        "real_time_factor": simulated / run.wall_s,
    }


@table_of_rows
def friction(azimuths: tuple[float, ...], duration: float) -> Rows:
    """Every engine by Coulomb's law alone: a pipe that turns in a straight hole, over azimuths of the hole [deg]."""
    for name in found_engines():
        for azimuth in azimuths:
            yield {"azimuth_deg": azimuth, **row_of(name, partial(slid, azimuth=azimuth, duration=duration))}


def slid(engine: StringEngine, azimuth: float, duration: float) -> dict[str, Any]:
    """Friction of an engine in a hole of this azimuth [deg] over a window [s]."""
    found = sliding(engine.name, azimuth, duration)
    return {
        "status": found.status,
        "failed": found.failed,
        "share_of_mu_n": found.share,
        "lean_deg": np.degrees(found.lean),
    }


class Shifted(InWindows):
    """An engine whose string starts with every second segment shifted sideways by SHIFT, a micrometre."""

    def __init__(self, engine: StringEngine) -> None:
        self._engine = engine
        self.name, self.honours = engine.name, engine.honours  # type: ignore[misc]

    def begin(self, run: Run) -> Any:
        """See ``StringEngine.begin``."""
        state.row(run.S, state.Y, run.segments)[::2] += SHIFT
        run.refresh()
        return self._engine.begin(run)


@table_of_rows
def against_itself(context: Context) -> Rows:
    """Each engine in the hole that turns, against itself with a sixteenth of the step, and from a shifted start."""
    for name in context.progress(found_engines(), "steps"):
        yield row_of(name, itself)


def itself(engine: StringEngine) -> dict[str, Any]:
    """An engine in the hole that turns over a second, with its step, a finer one, and from a shifted start."""
    case, window = holes(quick=False)["turn"]
    window = Window(window.start, 1.0)
    run = engine.run(case, window)
    finer = engines.build(engine.name, step=run.step / FINER).run(case, window)
    shifted = Shifted(engine).run(case, window)
    return {
        "status": finer.status,
        "failed": finer.message,
        "step_ms": 1e3 * run.step,
        "finer_step_ms": 1e3 * finer.step,
        **apart(run, finer, "finer"),
        **apart(shifted, run, "shifted"),
    }


def apart(run: EngineRun, other: EngineRun, label: str) -> dict[str, float]:
    """By how much the loads of a run differ from those of another one, in percent."""
    ratio = late(run) / late(other) - 1
    return {
        f"hookload_{label}_percent": 100 * float(ratio["hookload_N"]),
        f"torque_{label}_percent": 100 * float(ratio["surface_torque_N_m"]),
    }


def run(context: Context) -> Outcome:
    """Loads in three holes, Coulomb's law, and each engine against itself."""
    quick = context.quick
    tables = {
        "loads": loads(quick, context),
        "friction": friction(AZIMUTHS[1:] if quick else AZIMUTHS, 0.5 if quick else 2.0),
    }
    if not quick:
        tables["itself"] = against_itself(context)
    display = {
        "loads": "A turning string in three holes: every engine over the same window from FCTD's state in motion",
        "friction": "Coulomb's law alone: friction of a pipe turning in a straight hole, over the azimuth of the hole",
        "itself": "The hole that turns: each engine against itself at a sixteenth of the step, and from a start "
        "shifted by a micrometre",
    }
    return Outcome(
        tables=tables,
        checks=checks(tables),
        notes=NOTES,
        display={name: caption for name, caption in display.items() if name in tables},
    )


NOTES = [
    "A rival that is not installed (make rivals) is a row without numbers; so is a plugin that refuses the case. A run "
    "that fails a check is invalid, and its numbers are kept: the row says which check, and by how much.",
    "Exudyn runs in double precision on its own springs, dampers and integrator. Wall, friction, top drive and its "
    "joint are FCTD's, so that its agreement verifies joints, inertia and integration, and its friction is FCTD's.",
    "Rapier runs in single precision with its own springs, contact with a mesh and friction. It tells the size of a "
    "contact's friction and not its direction: the friction around the string is what its joints leave.",
    "Cost is that of a run with its sums, read through Python in every step; Rapier's grows with the number of joints "
    "and contacts that are read.",
]


def checks(tables: dict[str, pd.DataFrame]) -> list[Check]:
    """Bounds for every rival that is installed; plugins have rows alone."""
    made: list[Check] = []
    table = tables["loads"]
    for name in rivals.ENGINES:
        for hole, rows in table[(table["engine"] == name) & (table["status"] != NOT_INSTALLED)].groupby(
            "hole", sort=False
        ):
            row, torque = rows.iloc[0], TORQUE.get(name, OWN_WALL)
            failed = 0.0 if row["status"] == "valid" else 1.0
            made += [
                Check(f"{name}, {hole}: run failed a check", failed, 0, "at_most", "",
                      "in the hole, length, energy, finite, settled"),
                Check(f"{name}, {hole}: hook load against FCTD's", abs(row["hookload_off_percent"]), 1.0, "at_most",
                      "%", "target: 1 %, same start"),
                Check(f"{name}, {hole}: torque against FCTD's", abs(row["torque_off_percent"]), torque, "at_most", "%",
                      f"target: {torque:g} %, same start"),
            ]  # fmt: skip
        own = tables["friction"][lambda rows, name=name: (rows["engine"] == name) & (rows["status"] != NOT_INSTALLED)]
        if len(own):
            made += [
                Check(f"{name}: least friction over μN of a pipe turning in a straight hole",
                      float(own["share_of_mu_n"].min()), (0.98, 1.005), "within", "", "Coulomb's law: 1"),
                Check(f"{name}: angle between that friction and the sliding", float(own["lean_deg"].abs().max()), 0.5,
                      "at_most", "deg", "Coulomb's law: 0"),
            ]  # fmt: skip
    return made


STUDY = Study(
    "rival_engines", "What do the engines of rivals make of the same string, and at what cost?", run, timed=True,
)  # fmt: skip
