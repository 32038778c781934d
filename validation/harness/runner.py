"""Run studies, compare each with its record in expected.toml, and keep finished results."""

import difflib
import importlib
import os
import sys
import time
import tomllib
import traceback
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Sized
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from functools import cache
from itertools import chain
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
from rich.text import Text

from fctd.arena.result import Comparison
from fctd.case.errors import InputError
from fctd.case.text import counted, printable_lines
from validation.harness import fingerprint, store
from validation.harness.files import reading
from validation.harness.fingerprint import Inputs, Sources
from validation.harness.registry import RIVALS, STUDIES
from validation.harness.side_by_side import apart, each
from validation.harness.store import Judged, Provenance, Record, Standing
from validation.harness.study import NEEDS, ROOT, Context, Outcome, Study, T, silent

EXPECTED = ROOT / "validation" / "expected.toml"

Expected = Mapping[str, Mapping[str, str]]
VERDICTS = "missed", "finding", "varies"

STYLES: dict[Standing, str] = {
    "met": "green",
    "missed (recorded)": "yellow",
    "finding about the paper": "blue",
    "better than recorded": "cyan",
    "worse than recorded": "bold red",
}


class UsageError(Exception):
    """The command line, or a file that it reads, names something that does not exist."""


def check_name(name: str) -> None:
    """Refuse a name that no study has, with the nearest one that a study has."""
    if name not in STUDIES:
        near = difflib.get_close_matches(name, STUDIES, n=1, cutoff=0.4)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise UsageError(f"unknown study {name!r}{hint} (see --list)")


def load(name: str) -> Study:
    """The study registered under that name."""
    study: Study = importlib.import_module(STUDIES[name]).STUDY
    if study.name != name:
        raise ValueError(f"{STUDIES[name]} calls its study {study.name!r}, the registry {name!r}")
    return study


def loaded(name: str) -> Study | None:
    """The study; None where it cannot be loaded: it is run all the same, so that its failure is recorded and seen."""
    try:
        return load(name)
    except Exception:
        return None


def check_results(folder: Path) -> None:
    """Refuse a folder that cannot hold results, before the computation."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        writable = os.access(folder, os.W_OK)
    except OSError:
        writable = False
    if not writable:
        raise UsageError(f"{folder}: expected a folder that can be written")


def read_by_check(path: Path) -> Iterator[tuple[str, str, str]]:
    """Study, check and text of a file with a table for each study; ``UsageError`` for another file."""
    try:
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise UsageError(f"{path.name}: {error}") from error
    for study, checks in tables.items():
        if study not in STUDIES or not isinstance(checks, dict):
            raise UsageError(f"{path.name}: {study!r} is no table named after a study")
        for check, text in checks.items():
            if not isinstance(text, str) or not text.strip():
                raise UsageError(f"{path.name}, [{study}] {check!r}: expected a text, got {text!r}")
            yield study, check, text.strip()


def read_expected(path: Path) -> Expected:
    """study -> check -> ``missed: why``, ``finding: why`` the paper misses it, or ``varies: why`` machines differ."""
    expected: dict[str, dict[str, str]] = {}
    for study, check, text in read_by_check(path):
        verdict, _, why = text.partition(":")
        if verdict not in VERDICTS or not why.strip():
            raise UsageError(
                f"{path.name}, [{study}] {check!r}: expected 'missed: why', 'finding: why' or 'varies: why', "
                f"got {text!r}"
            )
        expected.setdefault(study, {})[check] = f"{verdict}: {why.strip()}"
    return expected


@dataclass(frozen=True)
class Run:
    """What holds for all studies of a run; force : repeat also what is up to date; variation : see ``Record``."""

    results: Path
    sources: Sources
    origin: Provenance
    force: bool
    variation: str


@dataclass(frozen=True)
class StudyRun:
    """A result, and why its study was run: ``kept`` where it was not, what has changed, or empty."""

    record: Record
    why: str = ""

    @property
    def kept(self) -> bool:
        """Whether the result was there before."""
        return self.why == KEPT


KEPT = "kept"
INTERRUPTED = 130
DATA = "public data folder"


def run_all(
    names: Sequence[str],
    *,
    quick: bool,
    force: bool = False,
    processes: int = 1,
    data: Path | None,
    expected: Expected,
    results: Path,
    sources: Sources,
    console: Console,
    variation: str = "",
) -> int:
    """Run and store each study named, unless its result is up to date; return the exit code.

    force : repeat those as well.  processes : in which studies run side by side that time nothing; the others run alone
    afterwards.  variation : see ``Record``.  The code is 0, 1 for worse than recorded, 130 when interrupted.
    """
    rules = Run(results, sources, store.provenance(), force, variation)
    around = fingerprint.surroundings(quick, sources.root)
    finished: list[StudyRun] = []
    text, bar = TextColumn("{task.description}", markup=False), BarColumn(bar_width=24)
    columns = (SpinnerColumn(), text, bar, MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bars:
        context = Context(quick=quick, data=data, progress=Bars(bars))
        alone = [name for name in names if processes == 1 or ((study := loaded(name)) is not None and study.timed)]
        beside = [name for name in names if name not in alone]
        spread = replace(context, progress=silent, apart=apart)

        def done_in(its: Context) -> Callable[[str], StudyRun]:
            return lambda name: run_one(name, its, expected.get(name, {}), around, rules)

        try:
            together = each(done_in(spread), beside, processes) if beside else ()
            for done in context.progress(Counted(chain(together, map(done_in(context), alone)), len(names)), "studies"):
                finished.append(done)
                tell(done, expected.get(done.record.study, {}), console)
        except KeyboardInterrupt:
            there = ", ".join(done.record.study for done in finished) or "nothing had finished"
            _say(console, f"interrupted; kept: {there}; the same command continues from there", "bold red")
            return INTERRUPTED
    errors = [done.record.study for done in finished if done.record.is_error]
    kept = sum(done.kept for done in finished)
    verdict = f"worse than recorded: {', '.join(errors)}" if errors else "none worse than recorded"
    _say(console, f"studies run: {len(finished) - kept}, kept: {kept}; {verdict}", "bold red" if errors else "bold")
    standings = Counter(judged.standing for done in finished for judged in done.record.checks)
    found = counted(standings["finding about the paper"], "finding")
    _say(console, f"recorded misses: {standings['missed (recorded)']}; apart from them, {found} about the paper")
    _say(console, f"results: {results}")
    return 1 if errors else 0


def run_one(
    name: str,
    context: Context,
    recorded: Mapping[str, str],
    around: Mapping[str, str],
    rules: Run,
) -> StudyRun:
    """Take one study's result if it is up to date; otherwise run it and store the outcome.

    Stored are tables and checks, or why it was skipped, or how it failed.
    """
    start = time.perf_counter()
    blank = Record(
        study=name,
        question="",
        status="failed",
        message="",
        checks=(),
        notes=(),
        display={},
        tables=(),
        quick=context.quick,
        date=datetime.now(UTC).isoformat(timespec="seconds"),
        wall_s=0.0,
        provenance=rules.origin,
        variation=rules.variation,
    )
    why, results = "", rules.results
    comparisons: Mapping[str, Comparison] = {}
    try:
        study = load(name)
        blank = replace(blank, question=study.question)
        now = Inputs(rules.sources.used_by(STUDIES[name]), dict(around))
        if name in RIVALS:
            now.around |= fingerprint.rivals()
        if "data" in study.needs:
            now.around[DATA] = str(context.data)
        else:
            context = replace(context, data=None)
        why = "forced" if rules.force else outdated(name, now, rules)
        if why == KEPT:
            return StudyRun(store.judge_again(store.read(results / name), recorded, results), KEPT)
        # What a study needs is a field of the context by the same name.
        absent = [NEEDS[need] for need in study.needs if getattr(context, need) is None]
        if absent:
            run, tables = replace(blank, status="skipped", message="; ".join(absent)), {}
        else:
            outcome, now.files = _run(study, context, now.code, rules)
            run, tables = _finished(blank, outcome, recorded), outcome.tables
            comparisons = outcome.comparisons
        run = replace(run, wall_s=time.perf_counter() - start)
        store.write(run, tables, results, now, comparisons)
    except Exception as error:
        # A failed study must not stop the others: its failure is a result, and the exit code reports it.
        if not isinstance(error, InputError):  # its message is complete
            print(printable_lines(traceback.format_exc()), end="", file=sys.stderr)
        message = f"{type(error).__name__}: {error}"
        run = replace(blank, message=message, wall_s=time.perf_counter() - start)
        store.write(run, {}, results)
    return StudyRun(run, why)


def outdated(name: str, now: Inputs, rules: Run) -> str:
    """Why a study has to be run: ``kept`` when it has not, empty when there is no result yet."""
    folder = rules.results / name
    try:
        kept = store.read(folder)
    except FileNotFoundError:
        return ""
    except (OSError, ValueError, TypeError, LookupError):
        return "the result cannot be read"
    before = fingerprint.read(folder)
    if kept.status != "finished":
        return f"was {kept.status}"
    if lost := store.unreadable(folder, kept):
        return f"table {lost} cannot be read"
    if before is None or not now.code:
        return "its inputs are not known"
    changed = now.changed_since(before, rules.sources.root)
    if changed == fingerprint.LENGTH:
        return f"replaces a {before.around[fingerprint.LENGTH]} result"
    return f"changed: {changed}" if changed else KEPT


def changes(names: Iterable[str], results: Path, sources: Sources) -> dict[str, str]:
    """Study -> what has changed since its result was stored, for those where something has."""
    surroundings, found = cache(fingerprint.surroundings), {}
    for name in names:
        if (before := fingerprint.read(results / name)) is None:
            continue
        around = surroundings(before.around.get(fingerprint.LENGTH) == "quick", sources.root)
        # The folder of the data is no input here; the files that were read are.  Rivals have their own environment.
        elsewhere = (DATA, fingerprint.RIVAL, fingerprint.PLUGIN)
        around = around | {key: value for key, value in before.around.items() if key.startswith(elsewhere)}
        if changed := Inputs(sources.used_by(STUDIES[name]), around).changed_since(before, sources.root):
            found[name] = changed
    return found


def _run(study: Study, context: Context, code: Mapping[str, str], rules: Run) -> tuple[Outcome, dict[str, str]]:
    """Run a study; also gives the files that it read, file -> digest.

    Raises RuntimeError where it imported a module of the project to which no import statement and no registry leads.
    """
    sources, loaded = rules.sources, set(sys.modules)
    with reading(sources.root, *([context.data] if context.data else [])) as read:
        outcome = study.run(context)
    files = {name: file for name in sys.modules.keys() - loaded if (file := sources.file(name))}
    if lacking := sorted(name for name, file in files.items() if sources.name_of(file) not in code):
        raise RuntimeError(
            f"{', '.join(lacking)}: imported by {study.name} under a name made as it runs, so that a change would not "
            'repeat it: import it by a statement, or name it in a registry, "module:class"'
        )
    return outcome, {sources.name_of(file): digest for file, digest in read.files.items()}


def _finished(blank: Record, outcome: Outcome, recorded: Mapping[str, str]) -> Record:
    return replace(
        blank,
        status="finished",
        checks=tuple(Judged(check, recorded.get(check.name)) for check in outcome.checks),
        notes=tuple(outcome.notes),
        display=outcome.display,
        tables=tuple(outcome.tables),
    )


def tell(done: StudyRun, recorded: Mapping[str, str], console: Console) -> None:
    """Print a run: a line for the study, one for each check, and the changes due in expected.toml."""
    run = done.record
    style = "bold red" if run.is_error else "bold"
    when = f"kept from {run.date[:16].replace('T', ' ')} UTC" if done.kept else f"{run.wall_s:.1f} s"
    why = f"; {done.why}" if done.why and not done.kept else ""
    _say(console, f"{run.study}: {run.summary}  ({when}{why})", style)
    if run.message:
        _say(console, f"  {run.message}")
    for note in run.notes if not run.checks else ():  # the notes say why there are no checks
        _say(console, f"  {note}")
    for judged in sorted(run.checks, key=lambda judged: judged.is_finding):  # the findings apart, after the others
        check = judged.check
        found = f"{check.value:.6g} {check.unit}".rstrip()
        line = f"  {judged.standing:<23}  {check.name}: {found} ({check.requirement()})"
        _say(console, line, STYLES[judged.standing])
        if judged.standing == "worse than recorded":
            _say(console, f"    {check.source}", STYLES[judged.standing])
        if judged.standing == "better than recorded":
            verdict = str(judged.recorded).partition(":")[0]
            _say(console, f"    recorded as {verdict}; remove the entry from expected.toml")
    gone = sorted(recorded.keys() - {judged.check.name for judged in run.checks})
    # A quick run may leave a check out.
    if gone and run.status == "finished" and not run.quick:
        _say(console, f"  expected.toml records checks that this study does not make: {gone}", "yellow")


@dataclass(frozen=True)
class Counted:
    """Items of which the number is known before they are."""

    items: Iterable[StudyRun]
    count: int

    def __iter__(self) -> Iterator[StudyRun]:
        return iter(self.items)

    def __len__(self) -> int:
        return self.count


class Bars:
    """The progress of nested loops, each a bar for as long as it runs."""

    def __init__(self, bars: Progress) -> None:
        self._bars = bars

    def __call__(self, items: Iterable[T], label: str) -> Iterator[T]:
        total = len(items) if isinstance(items, Sized) else None
        task = self._bars.add_task(label, total=total)
        try:
            for item in items:
                yield item
                self._bars.advance(task)
        finally:
            self._bars.remove_task(task)


def _say(console: Console, text: str, style: str = "") -> None:
    """Print unchanged: check names may hold brackets, messages anything, and a log must not wrap."""
    console.print(Text(printable_lines(text), style), soft_wrap=True)
