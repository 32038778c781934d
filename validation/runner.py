"""Run studies one after the other, hold each against what is recorded of it, and keep what finished."""

import difflib
import importlib
import time
import tomllib
import traceback
from collections.abc import Iterable, Iterator, Mapping, Sequence, Sized
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    SpinnerColumn,
    TextColumn,
    TimeElapsedColumn,
)
from rich.text import Text

from validation import record
from validation.record import Judged, Provenance, Record, Standing
from validation.registry import STUDIES
from validation.study import NEEDS, ROOT, Context, Outcome, Study, T

EXPECTED = ROOT / "validation" / "expected.toml"

Expected = Mapping[str, Mapping[str, str]]

STYLES: dict[Standing, str] = {
    "met": "green",
    "missed (recorded)": "yellow",
    "better than recorded": "cyan",
    "worse than recorded": "bold red",
}


class UsageError(Exception):
    """The command line, or a file it rests on, asks for something that is not there."""


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


def is_reproduced(name: str) -> bool:
    """Whether ``--reproduce`` runs the study."""
    try:
        return load(name).reproduce
    except Exception:
        # A study that cannot be loaded is run all the same, so that its failure is recorded and seen.
        return True


def read_expected(path: Path) -> Expected:
    """study -> check -> why it is known to be missed."""
    expected: dict[str, dict[str, str]] = {}
    try:
        tables = tomllib.loads(path.read_text())
    except tomllib.TOMLDecodeError as error:
        raise UsageError(f"{path.name}: {error}") from error
    for study, checks in tables.items():
        if study not in STUDIES or not isinstance(checks, dict):
            raise UsageError(f"{path.name}: {study!r} is no table named after a study")
        for check, text in checks.items():
            verdict, _, why = str(text).partition(":")
            if verdict != "missed" or not why.strip():
                raise UsageError(f"{path.name}, [{study}] {check!r}: expected 'missed: why', got {text!r}")
            expected.setdefault(study, {})[check] = why.strip()
    return expected


def run_all(
    names: Sequence[str],
    *,
    quick: bool,
    data: Path | None,
    expected: Expected,
    results: Path,
    console: Console,
) -> int:
    """Run and store each study named; return the exit code: 0, 1 for worse than recorded, 130 interrupted."""
    origin = record.provenance()
    finished: list[Record] = []
    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}", markup=False),
        BarColumn(bar_width=24),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bars:
        context = Context(quick=quick, data=data, progress=Bars(bars))
        try:
            for name in context.progress(names, "studies"):
                done = run_one(name, context, expected.get(name, {}), origin, results)
                finished.append(done)
                tell(done, expected.get(name, {}), console)
        except KeyboardInterrupt:
            kept = ", ".join(done.study for done in finished) or "nothing had finished"
            _say(console, f"interrupted; kept: {kept}", "bold red")
            return 130
    errors = [done.study for done in finished if done.is_error]
    verdict = f"worse than recorded: {', '.join(errors)}" if errors else "none worse than recorded"
    _say(console, f"studies run: {len(finished)}; {verdict}", "bold red" if errors else "bold")
    _say(console, f"results: {results}")
    return 1 if errors else 0


def run_one(name: str, context: Context, recorded: Mapping[str, str], origin: Provenance, results: Path) -> Record:
    """Run one study and store what came of it: tables and checks, or why it was skipped, or how it failed."""
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
        provenance=origin,
    )
    try:
        study = load(name)
        blank = replace(blank, question=study.question)
        # What a study needs is a field of the context by the same name.
        absent = [NEEDS[need] for need in study.needs if getattr(context, need) is None]
        if absent:
            run, tables = replace(blank, status="skipped", message="; ".join(absent)), {}
        else:
            outcome = study.run(context)
            run, tables = _finished(blank, outcome, recorded), outcome.tables
        run = replace(run, wall_s=time.perf_counter() - start)
        record.write(run, tables, results)
    except Exception as error:
        # One study must not take the others with it: its failure is a result, and the exit code tells.
        traceback.print_exc()
        message = f"{type(error).__name__}: {error}"
        run = replace(blank, message=message, wall_s=time.perf_counter() - start)
        record.write(run, {}, results)
    return run


def _finished(blank: Record, outcome: Outcome, recorded: Mapping[str, str]) -> Record:
    return replace(
        blank,
        status="finished",
        checks=tuple(Judged(check, recorded.get(check.name)) for check in outcome.checks),
        notes=tuple(outcome.notes),
        display=outcome.display,
        tables=tuple(outcome.tables),
    )


def tell(done: Record, recorded: Mapping[str, str], console: Console) -> None:
    """Print a run: a line for the study, one for each check, and what expected.toml should be told."""
    style = "bold red" if done.is_error else "bold"
    _say(console, f"{done.study}: {done.summary}  ({done.wall_s:.1f} s)", style)
    if done.message:
        _say(console, f"  {done.message}")
    for judged in done.checks:
        check = judged.check
        found = f"{check.value:.6g} {check.unit}".rstrip()
        line = f"  {judged.standing:<20}  {check.name}: {found} ({check.requirement()})"
        _say(console, line, STYLES[judged.standing])
        if judged.standing == "better than recorded":
            _say(console, "    recorded as missed; please take it out of expected.toml")
    gone = sorted(recorded.keys() - {judged.check.name for judged in done.checks})
    # A quick run may leave a check out.
    if gone and done.status == "finished" and not done.quick:
        _say(console, f"  expected.toml records checks that this study does not make: {gone}", "yellow")


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
    """Print as it stands: check names may hold brackets, and a log must not wrap."""
    console.print(Text(text, style), soft_wrap=True)
