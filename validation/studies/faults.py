"""Is anything lost when a run is killed, or when disk, cache or environment fail?  What do guards and checkpoints cost?

The processes that are killed begin with compiled code, so that most kills come while they compute.
"""

import tempfile
import time
from pathlib import Path

import numpy as np
import pandas as pd

from fctd.arena.result import Quartiles
from fctd.case.load import load_case
from fctd.cli.compile import compile_all
from fctd.results import ledger
from fctd.results.tables import open_result
from fctd.simulation.run_saver import RunSaver
from fctd.simulation.simulate import simulate
from fctd.store.run_folder import RunFolder, chunks_of
from validation.harness.study import Check, Context, Outcome, Study, ratio_check
from validation.parts.faults import FAULTS, SLOW, Ground, at_once
from validation.parts.killed_runs import Command, Killed, chart, drill, kill_again_and_again, meshed, trip

SEED = 20
TIMED_RUNS = 3  # of which guards and checkpoints take a share
# Kills of each command: 50 in three kinds, on arcs and cylinders, and a few against FCL.
KILLS: list[tuple[Command, int]] = [
    (trip("arcs", 1100.0), 10), (trip("cylinders", 1100.0), 10), (drill("arcs", 1502.0), 8),
    (drill("cylinders", 1502.0), 8), (chart(5.0), 14), (meshed(1.5), 4),
]  # fmt: skip
QUICK: list[tuple[Command, int]] = [
    (trip("arcs", 900.0), 2), (drill("cylinders", 1501.0), 2), (chart(10.0), 2), (meshed(0.5), 1),
]  # fmt: skip
LASTING, QUICK_LASTING = (trip("arcs", to_md, speed="0.12 m/s") for to_md in (1900.0, 1400.0))
# 47 connections of eight minutes, and 1,350 m between them: eight hours.
LONG, LONG_KILLS, HOURS, RECORDED = trip("arcs", 1950.0, "8 min", "0.22 m/s", "10 s"), 10, 8.0, 10.0


def run(context: Context) -> Outcome:
    """Kills, faults, shares of the time, and in full a trip of eight hours."""
    rng = np.random.default_rng(SEED)
    with tempfile.TemporaryDirectory(prefix="fctd-faults-") as name:
        base = Path(name)
        compile_all()  # and read: the processes that are forked from this one have the code
        killed = [
            kill_again_and_again(command, kills, rng, base / f"kills-{k}")
            for k, (command, kills) in enumerate(context.progress(QUICK if context.quick else KILLS, "commands"))
        ]
        wanted = Ground(base / "undisturbed").wanted
        tried = [
            fault(Ground(base / f"fault-{k}", wanted=wanted))
            for k, (name, fault) in enumerate(FAULTS.items())
            if not (context.quick and name in SLOW)
        ]
        if not context.quick:
            cache = base / "one-cache"
            tried.append(at_once(base / "empty", "16 runs at once, empty cache", cache))
            tried.append(at_once(base / "warm", "16 runs at once, warm cache", cache))
        lasting = QUICK_LASTING if context.quick else LASTING
        shares = pd.DataFrame([_shares(base / f"shares-{k}", lasting) for k in range(TIMED_RUNS)])
        long = [] if context.quick else _eight_hours(base / "long", rng)
    return Outcome(
        tables={"kills": _table(killed), "faults": pd.DataFrame(map(vars, tried)), "shares": shares},
        checks=[
            Check("SIGKILLs at random moments", sum(of.kills for of in killed), 7 if context.quick else 50, "at_least",
                  "", "as many as were asked for"),
            Check("of them, those after which something was lost or differs in a bit",
                  sum(len(of.wrong) for of in killed), 0, "at_most", "", "nothing is lost beyond a chunk"),
            Check("processes that went on with what another had kept", sum(of.resumed for of in killed),
                  4 if context.quick else 30, "at_least", "", "most kills come while there is something to lose"),
            Check("faults with another exit code, message or result than they should have",
                  sum(bool(of.wrong) for of in tried), 0, "at_most", "", "no traceback, a clear message"),
            *(
                ratio_check(f"share of the {name} in a run's time", Quartiles.of(shares[name]), most, "at_most",
                            "target")
                for name, most in (("guards", 0.02), ("checkpoints", 0.01))
            ),
            Check("checkpoints of that run", int(shares["chunks"].min()), 1, "at_least", "",
                  "there is a share to measure"),
            *long,
        ],
        notes=[
            *(f"{of.command}: {'; '.join(of.wrong)}" for of in killed if of.wrong),
            *(f"{of.fault}: {of.wrong}" for of in tried if of.wrong),
            "A kill comes after a random share, up to 70 %, of the time for which the undisturbed run computes, every "
            "fourth while the process prepares; the process that goes on is killed again. An earlier result stands in "
            "the place of the new one meanwhile, and is opened after each kill.",
            "Shares are those of one process by its own clock, which stands while other processes run and while the "
            "disk writes; the table has the checkpoints' share by the clock on the wall too. A checkpoint comes as "
            "often as 1 % of the time allows by both.",
        ],
        display={"kills": "Kills of commands", "faults": "Other faults", "shares": "Shares of a run's time"},
    )  # fmt: skip


def _table(killed: list[Killed]) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "command": of.command, "undisturbed_s": of.took, "computing_s": of.computing, "kills": of.kills,
            "processes": of.processes, "resumed": of.resumed, "chunks_at_most": max(of.kept, default=0),
            "wrong": "; ".join(of.wrong) or "nothing",
        }
        for of in killed
    )  # fmt: skip


def _shares(folder: Path, lasting: Command) -> dict[str, float]:
    """Shares of guards and checkpoints in the time of a trip, whose checkpoints come as often as they may.

    It takes more than ten seconds on a fast machine too, the quick one five: the first checkpoint comes after two, and
    may take a hundredth of all.
    """
    folder.mkdir()
    (folder / "case.toml").write_text(lasting.case)
    kept = RunFolder.take(folder / "out")
    wall, own = time.perf_counter(), time.process_time()
    result = simulate(load_case(folder / "case.toml"), checkpointer=RunSaver(kept, 0.0, tell=lambda _: None))
    wall, own = time.perf_counter() - wall, time.process_time() - own
    chunks = len(chunks_of(kept.path).files)
    kept.leave(remove=True)
    return {
        "records": len(result.history), "chunks": chunks, "whole_s": wall, "of_the_process_s": own,
        "guards": result.run["guards_s"] / own, "checkpoints": result.run["checkpoints_s"] / own,
        "checkpoints_on_the_wall": result.run["checkpoints_wall_s"] / wall,
    }  # fmt: skip


def _eight_hours(folder: Path, rng: np.random.Generator) -> list[Check]:
    """A trip of eight hours with connections, killed and resumed ten times."""
    found = kill_again_and_again(LONG, LONG_KILLS, rng, folder, longest=0.15)
    result = open_result(folder / LONG.result)
    gap = float(np.diff(result.history["time_s"], prepend=0.0).max())
    return [
        Check("simulated time of a trip with connections, killed ten times", result.run["simulated_s"] / 3600, HOURS,
              "at_least", "h", "eight hours"),
        Check("of these kills, those after which something was lost or differs", len(found.wrong), 0, "at_most", "",
              "one history"),
        Check("longest gap between two records", gap, RECORDED + 1e-6, "at_most", "s",
              "record.interval"),
        Check("energy error of the trip", ledger.error(result.energy), 1e-3, "at_most", "", "target: 0.1 %"),
    ]  # fmt: skip


# Shares of the time are by the process's own clock: other studies may run beside it.
STUDY = Study("faults", "Is anything lost when a run is killed or something fails?", run)
