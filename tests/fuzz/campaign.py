"""Items by seed and index, the outcome of one, and the counts of many."""

import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

from fctd import Case, Equilibrium, InputError, build_wellbore, equilibrium, load_case, simulate, torque_drag
from fctd.case.operations import KINDS
from fctd.case.raw_case import parse_override
from fctd.model.operations import steady_rates
from fctd.simulation.preparation import prepare
from fctd.steady.equilibrium import Solver
from tests.fuzz import mechanics
from tests.fuzz.items import Item
from tests.fuzz.mutants import mutant
from tests.fuzz.surveys import survey
from tests.fuzz.wells import well

# Case files and survey files by turns; they are solved once if they load.  Every 25th item is a plausible well, solved
# for every kind of operation, so that 20,000 loads go with 5,000 plausible solves; every thousandth is simulated too.
PLAUSIBLE, SIMULATED = 25, 1000
SLOWEST_LOAD = 5.0  # [s]


@dataclass
class Outcome:
    """The outcome of one item, or of many.

    tally : counts of each outcome; offences : outcomes that must not occur; load_s, solve_s : the time they took of the
    processor, which others may be using as well [s].
    """

    tally: Counter[str] = field(default_factory=Counter)
    offences: list[str] = field(default_factory=list)
    load_s: float = 0.0
    solve_s: float = 0.0

    @contextmanager
    def watching(self, what: str) -> Iterator[None]:
        """Count InputErrors; any other exception is an offence."""
        try:
            yield
        except InputError as error:
            self.tally[f"{what}: refused"] += 1
            try:
                str(error).encode()
            except Exception as failure:
                self.offences.append(f"{what}: a message that cannot be written ({failure!r})")
        except Exception as error:
            frame = traceback.extract_tb(error.__traceback__)[-1]
            text = f"{type(error).__name__}: {error}".replace("\n", " ")[:200]
            self.tally[f"{what}: {type(error).__name__}"] += 1
            self.offences.append(f"{what}: {text} ({Path(frame.filename).name}:{frame.lineno})")


def make(seed: int, index: int) -> Item:
    """The item of a seed and an index, always the same."""
    rng = Random(f"{seed}:{index}")
    if index % PLAUSIBLE == PLAUSIBLE - 1:
        return well(rng, simulated=index % SIMULATED == SIMULATED - 1)
    return survey(rng) if index % 2 else mutant(rng)


def write(item: Item, folder: Path) -> Path:
    """Write an item's files; returns the case file."""
    for name, content in item.files.items():
        (folder / name).write_bytes(content)
    path = folder / "well.toml"
    path.write_bytes(item.content)
    return path


def judge(item: Item, rng: Random) -> Outcome:
    """Load an item and solve what loads."""
    outcome = Outcome()
    with tempfile.TemporaryDirectory(prefix="fctd-fuzz-") as folder:
        path = write(item, Path(folder))
        began = time.process_time()
        case = None
        with outcome.watching("load"):
            case = load_case(path, dict(map(parse_override, item.overrides)))
            outcome.tally["load: accepted"] += 1
        outcome.load_s = time.process_time() - began
        if outcome.load_s > SLOWEST_LOAD:
            outcome.offences.append(f"load: {outcome.load_s:.3g} s")
        began = time.process_time()
        if case is not None:
            _solve(case, item, rng, outcome)
        outcome.solve_s = time.process_time() - began
    return outcome


def _solve(case: Case, item: Item, rng: Random, outcome: Outcome) -> None:
    if not item.plausible:
        kind = case.operations[0].kind if case.operations else rng.choice(list(KINDS))
        depth = case.operations[0].end_md if case.operations else case.depths[1]
        with outcome.watching("solve"):
            point = equilibrium(case, kind, depth)
            outcome.tally[f"solve: {point.status}"] += 1
            outcome.offences += [f"{kind} at {depth:g} m: {text}" for text in mechanics.finite(point)]
        with outcome.watching("hole"):
            outcome.offences += [f"hole: {text}" for text in mechanics.axis(build_wellbore(case))]
        with outcome.watching("prepare"):
            prepare(case)
            outcome.tally["prepare: done"] += 1
        return
    top, deepest = case.depths
    depth = rng.choice([deepest, round(rng.uniform(0.3, 1.0) * (deepest - top) + top, 2)])
    points: dict[str, Equilibrium] = {}
    with outcome.watching("plausible"):
        solver = Solver(case)
        for kind in KINDS:
            point = points[kind] = solver.solve(kind, steady_rates(case, kind), depth)
            outcome.tally[f"plausible: {point.status}"] += 1
            found = [*mechanics.finite(point), *mechanics.steadiness(case, point)]
            if point.answered and not found:
                found = list(mechanics.balance(case, solver.hole, point))
            outcome.offences += [f"{kind} at {depth:g} m, {point.status}: {text}" for text in found]
        outcome.offences += [f"at {depth:g} m: {text}" for text in mechanics.ordered(points)]
    if points:
        _alike(case, depth, points, outcome)
    if item.simulated:
        with outcome.watching("run"):
            result = simulate(case)
            outcome.tally[f"run: {result.status}"] += 1
            outcome.offences += [f"run: {text}" for text in mechanics.run(case, result)]


def _alike(case: Case, depth: float, points: dict[str, Equilibrium], outcome: Outcome) -> None:
    """A chart has the same answers, independent of what was solved before with the same arrays."""
    kind, point = list(points.items())[-1]
    with outcome.watching("chart"):
        row = torque_drag(case, kind, [depth]).iloc[0]
        outcome.tally["chart: rows"] += 1
        same = row["status"] == point.status
        if not same or (point.answered and row["hookload_N"] != point.hookload):
            outcome.offences.append(
                f"{kind} at {depth:g} m: {row['hookload_N']} N in a chart, {point.hookload} N alone"
            )
