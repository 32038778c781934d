"""The same string in independent engines: the gate before any speed, loads, contact forces, and the 1000:1 model."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, equilibrium, simulate
from references import engines
from references.engines import EngineRun, Window
from references.engines.run import late
from references.engines.scaling import SCALE, Factors, factors, scaled
from references.methods.loop import Timed
from validation.cases import load, rotation
from validation.harness.study import Check, Context, Outcome, Rows, Study, in_columns, table_of_rows
from validation.parts import engine_notes, engine_settings, gated
from validation.parts.engine_cases import BIT, LEAD, RAMP, S_BIT, TURNING, WELL_LEAD, chain, s_shape, well
from validation.parts.windows import last_seconds

# Engines and their configurations: the best fair one, and the engine's defaults.
ENGINES: dict[str, tuple[str, dict[str, Any]]] = {
    "FCTD": ("fctd", {}),
    "Bullet": ("bullet", {}),
    "Bullet, default": ("bullet", {"settings": "default"}),
    "MuJoCo": ("mujoco", {}),
    "MuJoCo, default": ("mujoco", {"settings": "default"}),
    "PyElastica": ("elastica", {}),
}
CHAIN: dict[str, tuple[str, dict[str, Any]]] = {"MuJoCo ball chain": ("mujoco_chain", {})}  # hangs freely alone
SOLVER, BY_SIMILARITY = "steady solver", "steady solver, full size by similarity"
STEPPER = "FCTD's stepper, at its own size"
FAIR = ("Bullet", "MuJoCo", "PyElastica")
SMALL_WINDOW = 0.1  # [s] of the model at a thousandth, down whose 1.5 m of steel a wave runs and back in a millisecond
# Holes and operations of the curved chain.
WINDOWS = (
    ("planar", "rotate_off_bottom"), ("planar", "trip_out"), ("planar", "trip_in"), ("turning", "rotate_off_bottom"),
)  # fmt: skip


def row(name: str, run: EngineRun, reference: EngineRun, steady: Any) -> dict[str, Any]:
    """An engine's numbers, those of FCTD's stepper over the same window, and the steady solver's."""
    end, own = late(run), late(reference)
    force, other = (r.profile["contact_force_N"].to_numpy()[-reference_rows(reference) :] for r in (run, reference))

    def off(column: str, reference: float) -> float:
        return 100 * (end[column] / reference - 1) if reference else np.nan

    torque = bool(abs(own["surface_torque_N_m"]) > 1)
    return {
        "engine": name,
        "status": run.status,
        "failed": run.message,
        "note": run.note,
        "hookload_kN": end["hookload_N"] / 1e3,
        "torque_kN_m": end["surface_torque_N_m"] / 1e3 if torque else np.nan,
        "contact_force_kN": end["total_contact_force_N"] / 1e3,
        "sum_r_mu_fn_kN_m": end["sum_r_mu_fn_N_m"] / 1e3,
        "friction_across_share": end["sum_r_ft_N_m"] / end["sum_r_mu_fn_N_m"] if torque else np.nan,
        "hookload_off_percent": off("hookload_N", own["hookload_N"]),
        "sum_off_percent": off("sum_r_mu_fn_N_m", own["sum_r_mu_fn_N_m"]),
        "torque_off_percent": off("surface_torque_N_m", own["surface_torque_N_m"]) if torque else np.nan,
        "contact_off_percent": off("total_contact_force_N", own["total_contact_force_N"]),
        "profile_off_percent": 100 * np.abs(force - other).sum() / np.abs(other).sum(),
        "steady_hookload_off_percent": off("hookload_N", steady.hookload),
        "steady_torque_off_percent": off("surface_torque_N_m", steady.surface_torque) if torque else np.nan,
        "step_ms": 1e3 * run.step,
        "simulated_s": run.history["time_s"].iloc[-1] - run.history["time_s"].iloc[0],
    }


def reference_rows(run: EngineRun) -> int:
    """Rows of the last profile of a run."""
    return int((run.profile["bit_depth_m"] == run.profile["bit_depth_m"].iloc[-1]).sum())


def compare(
    case: Case, kind: str, depth: float, window: Window, names: tuple[str, ...]
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """All engines over one window of a case: numbers, and the contact profile at its end."""
    steady = equilibrium(case, kind, depth)
    timed = {name: Timed(engines.build(ENGINES[name][0], **ENGINES[name][1])) for name in names}
    runs = {name: engine.run(case, window) for name, engine in timed.items()}
    rows = [
        row(name, run, runs["FCTD"], steady) | in_columns({"real_time_factor": timed[name].real_time_factors})
        for name, run in runs.items()
    ]
    profiles = [
        run.profile[["md_m", "contact_force_N"]].assign(engine=name, operation=kind) for name, run in runs.items()
    ]
    table = pd.DataFrame(rows)
    table.insert(0, "operation", kind)
    return table, pd.concat(profiles, ignore_index=True)


@table_of_rows
def hanging(names: tuple[str, ...], duration: float) -> Rows:
    """The chain without a hole, spun up from rest: hook load, and the torque of the running wave against FCTD's."""
    case = load(
        "curved_chain", operations=rotation(BIT, duration + 1, ramp=4.0), record__interval=0.25,
        contact__enabled=False, wellbore__stations=[[0, 0, 0], [2600, 0, 0]],
    )  # fmt: skip
    own = None
    for name in names:
        engine, options = (ENGINES | CHAIN)[name]
        timed = Timed(engines.build(engine, **options))
        run = timed.run(case, Window(0.0, duration))
        torque = run.history["surface_torque_N_m"].to_numpy()
        own = torque if own is None else own
        yield {
            "engine": name,
            "status": run.status,
            "failed": run.message,
            "hookload_kN": float(run.history["hookload_N"].mean()) / 1e3,
            "torque_rms_off_percent": 100 * float(np.sqrt(((torque - own) ** 2).mean() / (own**2).mean())),
            "step_ms": 1e3 * run.step,
            **in_columns({"real_time_factor": timed.real_time_factors}),
        }


def one_to_thousand(names: tuple[str, ...], duration: float) -> pd.DataFrame:
    """Each reading of the paper's 1000:1 model: loads scaled back, against the full-size string, in percent."""
    window = Window(LEAD, duration)
    case = chain("rotate_off_bottom", window)
    full = equilibrium(case, "rotate_off_bottom", BIT)
    rows = []

    def add(reading: str, engine: str, by: Factors, status: str, hookload: float, torque: float) -> None:
        rows.append(
            {
                "reading": reading,
                "engine": engine,
                "status": status,
                "hookload_off_percent": 100 * (hookload / by.force / full.hookload - 1),
                "torque_off_percent": 100 * (torque / by.force / by.length / full.surface_torque - 1),
            }
        )

    def solve(reading: str, by: Factors, model: Case, engine: str = SOLVER) -> None:
        # At a thousandth of the size with the full wall stiffness the solver overflows; its status reports it.
        with np.errstate(over="ignore"):
            point = equilibrium(model, "rotate_off_bottom", model.operations[0].start_md)
        loads = (point.hookload, point.surface_torque) if point.answered else (np.nan, np.nan)
        add(reading, engine, by, point.status, *loads)

    for reading in ("similar", "relabelled"):
        by, model = factors(reading), scaled(case, reading)
        solve(reading, by, model)
        for name in names:
            engine, options = ENGINES[name]
            # A user of Adams works in millimetres, so the engine computes with the full-size numbers or a thousand
            # times them.
            options = options | ({"unit": "1 mm"} if engine == "bullet" else {})
            run = engines.build(engine, **options).run(model, Window(LEAD * by.time, duration * by.time))
            end = late(run)
            word = run.status if run.status == "valid" else f"invalid: {run.message}"
            add(reading, name, by, word, end["hookload_N"], end["surface_torque_N_m"])
    for reading, scale in (("naive, a tenth", 0.1), ("naive", SCALE)):
        solve(reading, factors("naive", scale), scaled(case, "naive", scale))
        # By similarity the same steel at a fraction of the length equals the full length with steel stiffer by the
        # inverse of that fraction. The wall is stiffer too, which does not matter: it is stiff at either value.
        stiff = chain(
            "rotate_off_bottom", window, string__components__0__youngs_modulus=206.8e9 / scale, wellbore__stiffness=1e10
        )
        solve(reading, factors("relabelled"), stiff, BY_SIMILARITY)
    model = small()
    result = simulate(model)
    end = last_seconds(result, SMALL_WINDOW)
    add("naive", STEPPER, factors("naive"), result.status, end["hookload_N"], end["surface_torque_N_m"])
    return pd.DataFrame(rows)


def chain_tables(context: Context, names: tuple[str, ...]) -> dict[str, pd.DataFrame]:
    """The curved chain in every hole and operation: numbers and profiles."""
    numbers, profiles = [], []
    window = Window(LEAD, 1.5 if context.quick else 2.5)
    for hole, kind in context.progress(WINDOWS[:1] if context.quick else WINDOWS, "curved chain"):
        stations = {"wellbore__stations": TURNING} if hole == "turning" else {}
        table, profile = compare(chain(kind, window, **stations), kind, BIT, window, names)
        numbers.append(table.assign(hole=hole))
        profiles.append(profile.assign(hole=hole))
    return {"chain": pd.concat(numbers, ignore_index=True), "profiles": pd.concat(profiles, ignore_index=True)}


def well_table(context: Context, names: tuple[str, ...]) -> pd.DataFrame:
    """The paper's well with 60 and 170 segments."""
    quick, found = context.quick, []
    for segments in context.progress((60,) if quick else (60, 170), "paper-well"):
        # Two periods of ringing; with 170 segments one, which costs a minute.
        window = Window(WELL_LEAD, 1.0 if quick else 4.2 if segments == 60 else 2.1)
        chosen = tuple(name for name in names if not (quick and name in ("Bullet", "MuJoCo")))
        table, _ = compare(well(segments, window), "trip_in", 2250.0, window, chosen)
        found.append(table.assign(segments=segments))
    return pd.concat(found, ignore_index=True)


def s_shape_table(context: Context, names: tuple[str, ...]) -> pd.DataFrame:
    """The S-shaped well in cylinders and in arcs, over several periods of its ringing."""
    found, window = [], Window(LEAD, 1.2 if context.quick else 4.0)
    for geometry in context.progress(("arcs",) if context.quick else ("cylinders", "arcs"), "S-shaped well"):
        table, _ = compare(s_shape(geometry, window), "rotate_off_bottom", S_BIT, window, names)
        found.append(table.assign(geometry=geometry))
    return pd.concat(found, ignore_index=True)


def small() -> Case:
    """The naive model at its own size, turned off bottom; only its wall and dampers are those of a small string."""
    return scaled(
        load(
            "curved_chain",
            operations=rotation(BIT, 2 * SMALL_WINDOW, ramp=SMALL_WINDOW / 2),
            record__interval=SMALL_WINDOW / 50,
            wellbore__stiffness=1e10 * SCALE**2,
            contact__damping=1e4 * SCALE**2.5,
            solver__joint_damping=1e-5 * SCALE,
        ),
        "naive",
    )


@dataclass(frozen=True)
class Part:
    """What one process computes: the runs of one engine beside FCTD's own, or, without one, what is not split.

    names : configurations of the engine; fair : FCTD, and the best one of each engine; missing : not installed.
    """

    engine: str
    names: tuple[str, ...]
    fair: tuple[str, ...]
    missing: tuple[str, ...]
    quick: bool


def of_part(part: Part) -> dict[str, pd.DataFrame]:
    """The tables of a part."""
    quick, context = part.quick, Context(quick=part.quick)
    if not part.engine:
        names = (*part.fair, *(CHAIN if "MuJoCo" in part.fair else ()))
        tables = {
            "hanging": hanging(names, 2.5 if quick else 5.0),
            "thousand": one_to_thousand(("Bullet",) if "Bullet" in part.fair else (), 1.0 if quick else 3.0),
            "friction": engine_settings.friction((0.0, 30.0) if quick else engine_settings.AZIMUTHS, [*part.missing]),
        }
        return tables | ({"impedance": engine_settings.impedances()} if "MuJoCo" in part.fair and not quick else {})
    fair = tuple(dict.fromkeys(("FCTD", *(name for name in part.names if name in part.fair))))
    return {
        **chain_tables(context, tuple(dict.fromkeys(("FCTD", *part.names)))),
        "well": well_table(context, fair),
        "s_shape": s_shape_table(context, fair),
        **({} if quick else {"steps": engine_settings.steps(fair)}),
    }


def joined(parts: list[dict[str, pd.DataFrame]]) -> dict[str, pd.DataFrame]:
    """The tables of all parts, as if one process had computed them: by case, then by engine; FCTD's rows once."""
    found: dict[str, pd.DataFrame] = {}
    for name in dict.fromkeys(name for part in parts for name in part):
        own = [part[name] for part in parts if name in part]
        table = pd.concat([own[0], *(other[other["engine"] != "FCTD"] for other in own[1:])], ignore_index=True)
        if len(own) > 1:
            cases = [key for key in ("hole", "operation", "segments", "geometry") if key in table]
            order = table["engine"].map({engine: k for k, engine in enumerate(ENGINES)})
            groups = table.groupby(cases, sort=False).ngroup() if cases else 0
            table = table.assign(group=groups, order=order).sort_values(["group", "order"], kind="stable")
            table = table.drop(columns=["group", "order"]).reset_index(drop=True)
        found[name] = table
    return found


def run(context: Context) -> Outcome:
    """Curved chain in three operations and in a turning hole, paper-well, 1000:1; the settings of the engines."""
    missing = tuple(name for name, (engine, _) in ENGINES.items() if engines.installed_version(engine) is None)
    quick, there = context.quick, [name for name in ENGINES if name not in missing]
    fair = tuple(name for name in there if name in ("FCTD", *FAIR))
    others = [name for name in (fair if quick else there) if name != "FCTD"] or ["FCTD"]
    split = {engine: tuple(name for name in others if name.partition(",")[0] == engine) for engine in ("FCTD", *FAIR)}
    parts = [Part(engine, names, fair, missing, quick) for engine, names in split.items() if names]
    found = context.apart(of_part, [*parts, Part("", (), fair, missing, quick)])
    tables, gates = gated.held(joined(found[:-1]) | found[-1], ENGINES | CHAIN, free=("hanging",))
    display = {
        "gate": gated.CAPTION,
        "chain": "Curved chain: every engine over the same window from FCTD's state in motion",
        "well": "Paper-well tripped in to 2250 m: 60 and 170 segments",
        "s_shape": "A well not used to set any engine: S-shaped, turning by 50°, inclined at the top, in mud",
        "hanging": "No wall, vertical, spun up from rest",
        "thousand": "The 1000:1 model: loads scaled back, against the full-size string",
        "friction": "Coulomb's law alone: friction of a pipe turning in a straight hole, over the azimuth of the hole",
        "steps": "The rotating chain spun up from rest over 10 s in each engine, over the time step",
        "impedance": "MuJoCo's contact: friction of the pipe in a straight hole, over impedance and wall",
    }
    return Outcome(
        tables=tables,
        checks=[*checks(tables, fair, [*missing]), *gated.checks(gates)],
        notes=[*engine_notes.notes([*missing], LEAD, WELL_LEAD, RAMP), gated.NOTE],
        display={name: caption for name, caption in display.items() if name in tables},
    )


def checks(tables: dict[str, pd.DataFrame], fair: tuple[str, ...], missing: list[str]) -> list[Check]:
    """The bounds for every engine, and the readings of the 1000:1 model."""
    chains, paper, turns = tables["chain"], tables["well"], tables["s_shape"]
    made = []
    for name in fair:
        for where, table in (("curved chain", chains), ("paper-well", paper), ("the S-shaped well", turns)):
            own = table[table["engine"] == name]
            if len(own):
                made.append(
                    Check(f"{name}: runs of {where} that failed a check", float((own["status"] != "valid").sum()), 0,
                          "at_most", "", "in the hole, length, energy, finite, settled")
                )  # fmt: skip
    for name in fair[1:]:
        own = chains[chains["engine"] == name]
        places = [
            ("curved chain" if hole == "planar" else "curved chain in a hole that turns", rows, "torque", "torque")
            for hole, rows in own.groupby("hole")
        ]
        places.append(("paper-well", paper[paper["engine"] == name], "Σ rμF_n", "sum"))
        places.append(("S-shaped well", turns[turns["engine"] == name], "torque", "torque"))
        for where, rows, what, column in places:
            if len(rows):
                off = rows[["hookload_off_percent", f"{column}_off_percent"]].abs().max()
                made += [
                    Check(f"{name}: {where}, hook load against FCTD's over the same window", float(off.iloc[0]), 1.0,
                          "at_most", "%", "target: 1 %, same start"),
                    Check(f"{name}: {where}, {what} against FCTD's over the same window", float(off.iloc[1]), 5.0,
                          "at_most", "%", "target: 5 %, same start" if column == "torque" else "as for torque"),
                ]  # fmt: skip
    free = tables["hanging"].set_index("engine")
    made.append(
        Check("hanging free: torque of the running wave against FCTD, largest RMS",
              float(free["torque_rms_off_percent"].max()), 5.0, "at_most", "%", "as for the torque in contact")
    )  # fmt: skip
    made += engine_settings.friction_checks(tables["friction"], missing)
    if "steps" in tables:
        turning = chains[chains["operation"] == "rotate_off_bottom"].drop_duplicates("engine").set_index("engine")
        own_steps = {name: float(turning["step_ms"][name]) for name in fair}
        made += engine_settings.step_checks(tables["steps"], own_steps)
    if "impedance" in tables:
        made.append(engine_settings.impedance_check(tables["impedance"]))
    return made + scaling_checks(tables["thousand"])


def scaling_checks(table: pd.DataFrame) -> list[Check]:
    """The readings of the 1000:1 model."""
    columns = ["hookload_off_percent", "torque_off_percent"]
    off = {key: rows[columns].to_numpy() for key, rows in table.groupby(["reading", "engine"])}
    made = [
        Check(f"1000:1, {reading}: loads scaled back", float(np.abs(off[reading, SOLVER]).max()), bound, "at_most", "%",
              "exact: similitude; rounding and the solver's tolerance")
        for reading, bound in (("similar", 1e-3), ("relabelled", 1e-6))
    ]  # fmt: skip
    apart = np.abs(off["naive, a tenth", SOLVER] - off["naive, a tenth", BY_SIMILARITY]).max()
    made += [
        Check("10:1, naive: solved at its own size against full size by similarity", float(apart), 1e-3, "at_most", "%",
              "exact except for the stiffness of the wall"),
        Check("1000:1, naive: torque scaled back is off by", float(np.abs(off["naive", BY_SIMILARITY]).max()), 10.0,
              "at_least", "%", "steel at a thousandth of the length is a thousand times as stiff for its weight"),
    ]  # fmt: skip
    return made


STUDY = Study(
    "engines_agree", "Does the same string give the same loads in independent engines?", run,
    reproduce=True,
)  # fmt: skip
