"""The same string in other people's engines: loads, where it touches, and the 1000:1 model."""

from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, equilibrium
from references import engines
from references.engines import EngineRun, Window
from references.scaling import READINGS, factors, scaled
from validation.cases import load, rotation, trip
from validation.study import Check, Context, Outcome, Study

BIT = 2450.0
SPEED = 0.2  # [m/s] of the trips
# FCTD's stepper runs this long and hands over its state in motion [s].
LEAD = 20.0
# Engines and their configurations: the best fair one, and what comes without being asked for.
ENGINES: dict[str, tuple[str, dict[str, Any]]] = {
    "FCTD": ("fctd", {}),
    "Bullet": ("bullet", {}),
    "Bullet, default": ("bullet", {"settings": "default"}),
    "MuJoCo": ("mujoco", {}),
    "MuJoCo, default": ("mujoco", {"settings": "default"}),
    "PyElastica": ("elastica", {}),
}
FAIR = ("Bullet", "MuJoCo", "PyElastica")
KINDS = ("rotate_off_bottom", "trip_out", "trip_in")


def chain(kind: str, window: Window, **overrides: Any) -> Case:
    """The curved chain in one operation, the bit at its depth in the middle of the window."""
    if kind == "rotate_off_bottom":
        operations = rotation(BIT, window.start + window.duration + 1, ramp=4.0)
    else:
        sign = 1 if kind == "trip_in" else -1
        travel = SPEED * (window.start - 2.0 + window.duration / 2)
        operations = trip(BIT - sign * travel, BIT + sign * (SPEED * window.duration), SPEED, ramp=4.0)
    pipe = {"length": None, "segments": None, "segment_length": 25.0} if kind != "rotate_off_bottom" else {}
    changes = {f"string__components__0__{key}": value for key, value in pipe.items()}
    return load("curved_chain", operations=operations, record__interval=0.25, **changes, **overrides)


def well(segments: int, window: Window) -> Case:
    """The paper's well tripped into to 2250 m, with 60 segments or with the 170 of its Adams model."""
    counts = (20, 40) if segments == 60 else (50, 120)
    travel = SPEED * (window.start - 2.0 + window.duration / 2)
    return load(
        "paper_well",
        operations=trip(2250.0 - travel, 2250.0 + SPEED * window.duration, SPEED, ramp=4.0),
        record__interval=0.25,
        string__components__0__segments=counts[0],
        string__components__1__segments=counts[1],
    )


def late(run: EngineRun, seconds: float = np.inf) -> pd.Series:
    """Means of the history under a Hann window, of its last seconds."""
    history = run.history[run.history["time_s"] > run.history["time_s"].max() - seconds]
    numbers = history.select_dtypes("number")
    weights = np.hanning(len(numbers) + 2)[1:-1]
    return pd.Series(numbers.mul(weights, axis=0).sum() / weights.sum())


def row(name: str, run: EngineRun, reference: EngineRun, steady: Any, seconds: float) -> dict[str, Any]:
    """An engine's numbers beside FCTD's stepper over the same window and the steady solver."""
    end, own = late(run, seconds), late(reference, seconds)
    force, other = (r.profile["contact_force_N"].to_numpy()[-reference_rows(reference) :] for r in (run, reference))

    def off(column: str, reference: float) -> float:
        return 100 * (end[column] / reference - 1) if reference else np.nan

    torque = bool(abs(own["surface_torque_N_m"]) > 1)
    return {
        "engine": name,
        "status": run.status,
        "failed": run.message,
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
        "wall_s": run.wall_s,
    }


def reference_rows(run: EngineRun) -> int:
    """Rows of one profile: the last of a run, which may have recorded others."""
    return int((run.profile["bit_depth_m"] == run.profile["bit_depth_m"].iloc[-1]).sum())


def compare(
    case: Case, kind: str, depth: float, window: Window, names: tuple[str, ...], seconds: float = np.inf
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """All engines over one window of a case: numbers, and the contact profile at its end."""
    steady = equilibrium(case, kind, depth)
    runs = {name: engines.build(ENGINES[name][0], **ENGINES[name][1]).run(case, window) for name in names}
    rows = [row(name, run, runs["FCTD"], steady, seconds) for name, run in runs.items()]
    profiles = [
        run.profile[["md_m", "contact_force_N"]].assign(engine=name, operation=kind) for name, run in runs.items()
    ]
    table = pd.DataFrame(rows)
    table.insert(0, "operation", kind)
    return table, pd.concat(profiles, ignore_index=True)


def hanging(names: tuple[str, ...], duration: float) -> pd.DataFrame:
    """The chain in the open, spun up from rest: hook load, and the torque of the running wave against FCTD's."""
    case = load(
        "curved_chain", operations=rotation(BIT, duration + 1, ramp=4.0), record__interval=0.25,
        contact__enabled=False, wellbore__stations=[[0, 0, 0], [2600, 0, 0]],
    )  # fmt: skip
    rows, own = [], None
    for name in names:
        engine, options = ENGINES.get(name, ("mujoco_chain", {}))
        run = engines.build(engine, **options).run(case, Window(0.0, duration))
        torque = run.history["surface_torque_N_m"].to_numpy()
        own = torque if own is None else own
        rows.append(
            {
                "engine": name,
                "status": run.status,
                "failed": run.message,
                "hookload_kN": float(run.history["hookload_N"].mean()) / 1e3,
                "torque_rms_off_percent": 100 * float(np.sqrt(((torque - own) ** 2).mean() / (own**2).mean())),
                "step_ms": 1e3 * run.step,
                "wall_s": run.wall_s,
            }
        )
    return pd.DataFrame(rows)


def one_to_thousand(names: tuple[str, ...], duration: float) -> pd.DataFrame:
    """Each reading of the paper's 1000:1 model: loads scaled back, against the string as it is, in percent."""
    case = chain("rotate_off_bottom", Window(LEAD, duration))
    full = equilibrium(case, "rotate_off_bottom", BIT)
    rows = []
    for reading in READINGS:
        by = factors(reading)
        if reading == "naive":
            # By similarity, which the row above proves, a thousandth of the length with the same steel is the full
            # length with steel a thousand times as stiff; the solver then works at the size it was made for.
            model = chain(
                "rotate_off_bottom", Window(LEAD, duration), string__components__0__youngs_modulus=206.8e12,
                wellbore__stiffness=1e10,
            )  # fmt: skip
            by = factors("relabelled")
        else:
            model = scaled(case, reading)
        point = equilibrium(model, "rotate_off_bottom", model.operations[0].start_md)
        loads = [("steady solver", point.status, point.hookload, point.surface_torque)]
        for name in names if reading != "naive" else ():
            engine, options = ENGINES[name]
            if engine == "bullet":
                # A user of Adams writes millimetres, and so the engine sees metres' numbers again or a thousandfold.
                options = options | {"unit": "1 mm"}
            run = engines.build(engine, **options).run(model, Window(LEAD * by.time, duration * by.time))
            end = late(run)
            word = run.status if run.status == "valid" else f"invalid: {run.message}"
            loads.append((name, word, end["hookload_N"], end["surface_torque_N_m"]))
        for name, status, hookload, torque in loads:
            rows.append(
                {
                    "reading": reading,
                    "engine": name,
                    "status": status,
                    "hookload_off_percent": 100 * (hookload / by.force / full.hookload - 1),
                    "torque_off_percent": 100 * (torque / by.force / by.length / full.surface_torque - 1),
                }
            )
    return pd.DataFrame(rows)


def run(context: Context) -> Outcome:
    """Curved chain in three operations, the paper's well in windows, spin-up from rest, hanging free, 1000:1."""
    missing = [name for name, (engine, _) in ENGINES.items() if engines.installed_version(engine) is None]
    everyone = tuple(name for name in ENGINES if name not in missing)
    fair = tuple(name for name in ("FCTD", *FAIR) if name not in missing)
    window = Window(LEAD, 1.5 if context.quick else 4.0)
    numbers, profiles = [], []
    for kind in context.progress(KINDS[:1] if context.quick else KINDS, "curved chain"):
        table, profile = compare(chain(kind, window), kind, BIT, window, fair if context.quick else everyone)
        numbers.append(table)
        profiles.append(profile)
    chains = pd.concat(numbers, ignore_index=True)
    wells = []
    short = Window(LEAD, 1.0 if context.quick else 2.0)
    for segments in context.progress((60,) if context.quick else (60, 170), "paper-well"):
        chosen = tuple(name for name in fair if not (context.quick and name == "Bullet"))
        wells.append(compare(well(segments, short), "trip_in", 2250.0, short, chosen)[0].assign(segments=segments))
    paper = pd.concat(wells, ignore_index=True)
    chains_free = ("MuJoCo ball chain",) if "MuJoCo" not in missing else ()
    free = hanging((*fair, *chains_free), 2.5 if context.quick else 5.0)
    thousand = one_to_thousand(tuple(n for n in ("Bullet",) if n not in missing), 1.0 if context.quick else 3.0)
    tables = {
        "chain": chains, "profiles": pd.concat(profiles, ignore_index=True), "well": paper,
        "hanging": free, "thousand": thousand,
    }  # fmt: skip
    display = {
        "chain": "Curved chain: every engine over the same window from FCTD's state in motion",
        "well": "Paper-well tripped in to 2250 m: 60 and 170 segments",
        "hanging": "No wall, vertical, spun up from rest",
        "thousand": "The 1000:1 model: loads scaled back, against the string as it is",
    }
    if not context.quick:
        rest = Window(0.0, 10.0)
        tables["spin_up"] = compare(chain(KINDS[0], rest), KINDS[0], BIT, rest, fair, 4.0)[0]
        display["spin_up"] = "The same rotating chain spun up from rest by each engine itself, its last 4 s"
    return Outcome(tables=tables, checks=checks(tables, fair), notes=notes(missing), display=display)


def checks(tables: dict[str, pd.DataFrame], fair: tuple[str, ...]) -> list[Check]:
    """The bounds of the issue for every engine, and the readings of the 1000:1 model."""
    chains, paper, thousand = tables["chain"], tables["well"], tables["thousand"]
    made = []
    for name in fair[1:]:
        own = chains[chains["engine"] == name]
        wells = paper[paper["engine"] == name]
        made += [
            Check(f"{name}: curved chain, hook load against FCTD", float(own["hookload_off_percent"].abs().max()), 1.0,
                  "at_most", "%", "issue: 1 %, same window, same start"),
            Check(f"{name}: curved chain, torque against FCTD", float(own["torque_off_percent"].abs().max()), 5.0,
                  "at_most", "%", "issue: 5 %, same window, same start"),
            Check(f"{name}: runs of the curved chain that failed a check", float((own["status"] != "valid").sum()), 0,
                  "at_most", "", "in the hole, length, energy, finite, settled"),
        ]  # fmt: skip
        if len(wells):
            made.append(
                Check(f"{name}: paper-well, Σ rμF_n against FCTD", float(wells["sum_off_percent"].abs().max()), 5.0,
                      "at_most", "%", "as for the torque of the curved chain")
            )  # fmt: skip
    free = tables["hanging"].set_index("engine")
    made.append(
        Check("hanging free: torque of the running wave against FCTD, largest RMS",
              float(free["torque_rms_off_percent"].max()), 5.0, "at_most", "%", "as for the torque in contact")
    )  # fmt: skip
    steady = thousand[thousand["engine"] == "steady solver"].set_index("reading")
    off = steady[["hookload_off_percent", "torque_off_percent"]].abs().max(axis=1).to_dict()
    for reading, bound in (("similar", 1e-3), ("relabelled", 1e-6)):
        made.append(
            Check(f"1000:1, {reading}: loads scaled back", float(off[reading]), bound, "at_most", "%",
                  "exact: similitude; rounding and the solver's tolerance")
        )  # fmt: skip
    made.append(
        Check("1000:1, naive: torque scaled back is off by", float(off["naive"]), 10.0, "at_least", "%",
              "steel of a thousandth of the length is a thousand times as stiff for its weight")
    )  # fmt: skip
    return made


def notes(missing: list[str]) -> list[str]:
    """What a reader of the numbers must know."""
    absent = [f"Not installed, and left out: {', '.join(missing)}."] if missing else []
    return [
        *absent,
        f"Every engine starts from the same state: FCTD's stepper after {LEAD:g} s, in motion; the rows spun up from "
        "rest start from FCTD's frictionless shape at rest and leave the rest to the engine. All are read as means "
        "under a Hann window. A run that fails a check is marked invalid and its numbers are kept.",
        "Bullet's hook load is 0.5 to 0.8 % high while the string turns: it solves friction along two directions fixed "
        "in space, each over its own effective mass, so that what it returns does not oppose the sliding exactly and "
        "holds some of the weight. The share of friction that acts around the string says how much.",
        "MuJoCo's friction is a soft constraint: a sliding point is lifted off its wall. The fair configuration holds "
        "contact from a margin of 5 mm on; by default points leave the wall and fall back, and the torque is low.",
        "Bullet and MuJoCo turn bodies by an explicit gyroscopic moment and need half of FCTD's step; PyElastica's rod "
        "needs a shorter one still. In PyElastica wall and friction are ours: its agreement tells of the beam and the "
        "integrator alone. While tripping its upper end is lowered, no pipe is fed.",
        "Rows of the 1000:1 model with Bullet are read in millimetres, as a user of Adams would: limits and tolerances "
        "that Bullet has in its own units spoil both, and the checks say so. The naive model is "
        "computed at full size with steel a thousand times as stiff, which similarity makes the same.",
    ]


STUDY = Study("engines_agree", "Does the same string give the same loads in engines that are not ours?", run, True)
