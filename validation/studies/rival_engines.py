"""The same string in the engines of rivals and plugins: loads, friction, cost, and each engine against itself."""

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from fctd import Case, InputError
from references import engines, rivals
from references.engines import EngineRun, StringEngine, Window
from references.engines.friction_law import sliding
from references.engines.run import late
from references.methods.loop import Timed
from validation.harness.study import ENDS, Check, Context, Outcome, Rows, Study, in_columns, table_of_rows
from validation.parts import gated
from validation.parts.brought import brought
from validation.parts.engine_cases import LEAD, TURNING, chain, s_shape
from validation.parts.engine_fronts import FINER, Shifted

OWN = "fctd"
MESH = "exudyn, mesh"
NOT_INSTALLED, REFUSED, BROKEN = "not installed", "refused", "broken"
# Error of the torque for which a rival is bounded, in percent: Exudyn has FCTD's wall, the others their own.
TORQUE = {"exudyn": 2.0}
OWN_WALL = 5.0
# Steps of the runs with which an engine is compared with itself: its own over these.
PARTS = (4, FINER)
SELF_WINDOW = 1.0  # [s]
AZIMUTHS = (0.0, 30.0)
SPEEDS = [f"{name}{end}" for name in ("segment_step_us", "real_time_factor") for end in ENDS]


def holes(quick: bool) -> dict[str, tuple[Case, Window]]:
    """A turning string in cylinders, in arcs, and in a hole that turns."""
    long, short = Window(LEAD, 1.0 if quick else 2.5), Window(LEAD, 1.2 if quick else 2.4)
    found = {
        "cylinders": (chain("rotate_off_bottom", long, wellbore__geometry="cylinders"), long),
        "arcs": (s_shape("arcs", short), short),
        "turn": (chain("rotate_off_bottom", long, wellbore__stations=TURNING), long),
    }
    return dict(list(found.items())[:1]) if quick else found


class Configuration(NamedTuple):
    """An engine with options, and its label in tables."""

    label: str
    name: str
    options: Mapping[str, Any] = {}

    def build(self, **options: Any) -> StringEngine:
        """The engine, with further options."""
        return engines.build(self.name, **self.options, **options)


def configurations() -> list[Configuration]:
    """FCTD, all rivals, Exudyn with its own contact, and the plugins that are registered here."""
    names = [OWN, *rivals.ENGINES, *engines.REGISTRY.plugins()]
    found = [Configuration(name, name) for name in names]
    found.insert(names.index("exudyn") + 1, Configuration(MESH, "exudyn", {"contact": "mesh"}))
    return found


def rows_of(engine: Configuration, find: Callable[[Configuration], Rows]) -> Rows:
    """The rows that ``find`` gives of an engine, or one that says why there are none."""
    try:
        if engines.installed_version(engine.name) is None:
            yield {"engine": engine.label, "status": NOT_INSTALLED, "failed": ""}
        else:
            for row in find(engine):
                yield {"engine": engine.label, **row}
    except InputError as error:
        yield {"engine": engine.label, "status": REFUSED, "failed": str(error)}
    except Exception as error:
        if engine.name not in engines.REGISTRY.plugins():
            raise
        yield {"engine": engine.label, "status": BROKEN, "failed": f"{type(error).__name__}: {error}"}


@table_of_rows
def loads(quick: bool, context: Context) -> Rows:
    """Every engine over the same window of every hole, from the same state."""
    for hole, (case, window) in context.progress(holes(quick).items(), "holes"):
        own = engines.build(OWN).run(case, window)
        for engine in configurations():
            found = rows_of(engine, partial(numbers, case=case, window=window, own=own))
            yield from ({"engine": engine.label, "hole": hole, **row} for row in found)


def numbers(engine: Configuration, case: Case, window: Window, own: EngineRun) -> Rows:
    """The loads of an engine's run, against those of FCTD's own, and its cost."""
    timed = Timed(engine.build())
    run = timed.run(case, window)
    end, reference = late(run), late(own)
    segments = len(run.profile) // run.profile["bit_depth_m"].nunique() - 1
    factors = timed.real_time_factors

    def off(column: str) -> float:
        return 100 * float(end[column] / reference[column] - 1)

    yield {
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
        **in_columns({"segment_step_us": 1e6 * run.step / factors / segments, "real_time_factor": factors}),
    }


@table_of_rows
def friction(azimuths: tuple[float, ...], duration: float) -> Rows:
    """Every engine by Coulomb's law alone: a pipe that turns in a straight hole, over azimuths of the hole [deg]."""
    for engine in configurations():
        yield from rows_of(engine, partial(slid, azimuths=azimuths, duration=duration))


def slid(engine: Configuration, azimuths: tuple[float, ...], duration: float) -> Rows:
    """Friction of an engine over azimuths of the hole [deg], in windows of this duration [s]."""
    for azimuth in azimuths:
        found = sliding(engine.name, azimuth, duration, **engine.options)
        yield {
            "azimuth_deg": azimuth,
            "status": found.status,
            "failed": found.failed,
            "share_of_mu_n": found.share,
            "lean_deg": np.degrees(found.lean),
        }


@table_of_rows
def against_itself(context: Context) -> Rows:
    """Each engine over steps, and from a start shifted by a micrometre, in the hole that turns."""
    case, window = holes(quick=False)["turn"]
    whole = [engine for engine in configurations() if engine.label != MESH]  # a minute for one engine twice
    for engine in context.progress(whole, "steps"):
        yield from rows_of(engine, partial(itself, case=case, window=Window(window.start, SELF_WINDOW)))


def itself(engine: Configuration, case: Case, window: Window) -> Rows:
    """An engine's loads against its own at the finest of PARTS of its step; those of a shifted start at its step."""
    usual = engine.build().run(case, window)
    runs = [usual, *(engine.build(step=usual.step / part).run(case, window) for part in PARTS)]
    for run in runs:
        yield {"start": "as handed over", **apart(run, runs[-1])}
    yield {"start": "shifted by 1 µm", **apart(Shifted(engine.build()).run(case, window), usual)}


def apart(run: EngineRun, other: EngineRun) -> dict[str, Any]:
    """A run, and by how much its loads differ from those of another one."""
    end, ratio = late(run), late(run) / late(other) - 1
    return {
        "status": run.status,
        "failed": run.message,
        "step_ms": 1e3 * run.step,
        "hookload_kN": end["hookload_N"] / 1e3,
        "torque_kN_m": end["surface_torque_N_m"] / 1e3,
        "hookload_apart_percent": 100 * float(ratio["hookload_N"]),
        "torque_apart_percent": 100 * float(ratio["surface_torque_N_m"]),
    }


def run(context: Context) -> Outcome:
    """Loads in three holes, Coulomb's law, and each engine against itself."""
    quick = context.quick
    tables = {
        "loads": loads(quick, context),
        "friction": friction(AZIMUTHS[1:] if quick else AZIMUTHS, 0.5 if quick else 2.0),
    }
    gates: gated.Gates = {}
    if quick:  # the gate takes some ten seconds an engine, and no speed is printed without it
        tables["loads"] = tables["loads"].drop(columns=SPEEDS, errors="ignore")
    else:
        ran = tables["loads"].loc[tables["loads"]["real_time_factor"].notna(), "engine"]
        tried = {each.label: (each.name, dict(each.options)) for each in configurations() if each.label in set(ran)}
        tables, gates = gated.held(tables, tried)
        tables["itself"] = against_itself(context)
    display = {
        "loads": "A turning string in three holes: every engine over the same window from FCTD's state in motion",
        "friction": "Coulomb's law alone: friction of a pipe turning in a straight hole, over the azimuth of the hole",
        "gate": gated.CAPTION,
        "packages": "What the package of an engine costs its user",
        "itself": "The hole that turns: each engine against itself at a sixteenth of the step; a start that is "
        "shifted by a micrometre, against the same step",
    }
    tables["packages"] = brought(engines.REGISTRY, [*rivals.ENGINES, *engines.REGISTRY.plugins()])
    return Outcome(
        tables=tables,
        checks=[*checks(tables), *gated.checks(gates)],
        notes=[*NOTES, gated.NOTE],
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
    if "itself" in tables:
        made += [check for name in rivals.ENGINES for check in self_checks(name, tables["itself"])]
    return made


def self_checks(name: str, table: pd.DataFrame) -> Iterator[Check]:
    """An engine converges, stays valid on the way, and does not magnify a small shift."""
    own = table[(table["engine"] == name) & (table["status"] != NOT_INSTALLED)]
    if own.empty:
        return
    shifted = own["start"] != "as handed over"
    yield Check(f"{name}: runs with finer steps that failed a check", float((own["status"] != "valid").sum()), 0,
                "at_most", "", "in the hole, length, energy, finite, settled")  # fmt: skip
    for load in ("hookload", "torque"):
        off = own[f"{load}_apart_percent"].abs()
        yield from [
            Check(f"{name}: {load} against its own at a sixteenth of the step", float(off.iloc[0]), 1.0, "at_most", "%",
                  "as for the best step of an engine"),
            Check(f"{name}: change of the {load} by a start shifted by 1 µm", float(off[shifted].max()), 0.1, "at_most",
                  "%", "a tenth of the target"),
        ]  # fmt: skip


STUDY = Study(
    "rival_engines", "What do the engines of rivals make of the same string, and at what cost?", run, timed=True,
)  # fmt: skip
