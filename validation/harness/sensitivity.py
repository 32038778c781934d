"""Which numbers hang on rounding: each study's plain result beside its runs with noise and as other compiled code."""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from rich.console import Console
from rich.text import Text

from fctd.case.text import counted, printable_lines
from validation.harness import fingerprint, store
from validation.harness.fingerprint import VARIED, Inputs
from validation.harness.registry import STUDIES
from validation.harness.runner import read_by_check
from validation.harness.store import Record
from validation.harness.study import ROOT, Check
from validation.harness.variation import FOLDER

REASONS = ROOT / "validation" / "sensitive.toml"
SHARE = 0.1  # of its tolerance, by which a number moves that is sensitive
UNEXPLAINED = "not explained"

Reasons = Mapping[str, Mapping[str, str]]


@dataclass(frozen=True)
class Moved:
    """A check of a plain result, and its values in the runs of other rounding, by their labels.

    A run that failed, or does not make the check, has nan.  why : the reason of ``sensitive.toml``, or empty.
    """

    study: str
    check: Check
    runs: Mapping[str, float]
    why: str = ""

    @property
    def low(self) -> float:
        """The lowest value of all runs, the plain one included."""
        return min(self._values)

    @property
    def high(self) -> float:
        """The highest one."""
        return max(self._values)

    @property
    def _values(self) -> list[float]:
        return [value for value in (self.check.value, *self.runs.values()) if not math.isnan(value)] or [math.nan]

    @property
    def tolerance(self) -> float:
        """The width of the bound, or the distance of the plain value from its one limit."""
        low, high = self.check.limits
        return high - low if math.isfinite(high - low) else abs(self.check.value - (high if math.isinf(low) else low))

    @property
    def share(self) -> float:
        """What the number moved by, over its tolerance; infinite where a verdict changed."""
        if self.changed:
            return math.inf
        apart, tolerance = self.high - self.low, self.tolerance
        if not apart > 0:
            return 0.0
        return apart / tolerance if tolerance > 0 else math.inf  # it was at its limit

    @property
    def changed(self) -> list[str]:
        """The runs with another verdict."""
        return [
            label
            for label, value in self.runs.items()
            if replace(self.check, value=value).verdict != self.check.verdict
        ]

    @property
    def is_sensitive(self) -> bool:
        """Whether it moved by more than a tenth of its tolerance."""
        return self.share > SHARE

    @property
    def explained(self) -> str:
        """The reason; empty for a number that is not sensitive."""
        return (self.why or UNEXPLAINED) if self.is_sensitive else ""


def read_reasons(path: Path) -> Reasons:
    """study -> check -> why it is sensitive, and what was done; ``UsageError`` for anything else."""
    found: dict[str, dict[str, str]] = {}
    for study, check, why in read_by_check(path):
        found.setdefault(study, {})[check] = why
    return found


def moved(results: Path, reasons: Reasons, studies: Iterable[str] = STUDIES) -> list[Moved]:
    """Every number of a plain result that has runs of other rounding, those that move most first; times left out.

    A run counts where all other inputs are those of the plain result: code, files, packages, processor and length.
    """
    found = [each for study in studies for each in _of_study(results, study, reasons.get(study, {}))]
    return sorted(found, key=lambda each: -each.share)


def _of_study(results: Path, study: str, reasons: Mapping[str, str]) -> Iterator[Moved]:
    plain, inputs = _stored(results / study)
    if plain is None or inputs is None or plain.status != "finished":
        return
    runs: dict[str, dict[str, float]] = {}
    for folder in sorted((results / FOLDER).glob(f"*/{study}")):
        record, its = _stored(folder)
        # A run that failed has no inputs, and is repeated by the next one.
        if record is not None and (record.status == "failed" or (its is not None and _alike(its, inputs))):
            runs[record.variation] = {judged.check.name: judged.check.value for judged in record.checks}
    for judged in plain.checks if runs else ():
        name = judged.check.name
        if not judged.check.timed:
            values = {label: values.get(name, math.nan) for label, values in runs.items()}
            yield Moved(study, judged.check, values, reasons.get(name, ""))


def _stored(folder: Path) -> tuple[Record | None, Inputs | None]:
    try:
        return store.read(folder), fingerprint.read(folder)
    except (OSError, ValueError, TypeError, LookupError):
        return None, None


def _alike(one: Inputs, other: Inputs) -> bool:
    around = [{key: value for key, value in each.around.items() if key not in VARIED} for each in (one, other)]
    return around[0] == around[1] and (one.code, one.files) == (other.code, other.files)


def tell(found: list[Moved], reasons: Reasons, console: Console) -> int:
    """Print the sensitive numbers; the exit code, 1 where one has another verdict and no explanation."""
    sensitive = [each for each in found if each.is_sensitive]
    runs = len({label for each in found for label in each.runs})
    unexplained = [each for each in sensitive if not each.why]
    style = "bold red" if unexplained else "bold"
    _say(
        console,
        f"numbers of {', '.join(dict.fromkeys(each.study for each in found)) or 'no study'} with other rounding, "
        f"{counted(runs, 'run')}: {len(found)}, of them sensitive {len(sensitive)}, not explained {len(unexplained)}",
        style,
    )
    for each in sensitive:
        look = "" if each.why else "bold red"
        _say(console, f"  {each.study}: {each.check.name}", look)
        span = f"{each.check.value:.6g}, {each.low:.6g} to {each.high:.6g} {each.check.unit}".rstrip()
        _say(console, f"    {span} ({each.check.requirement()}); {in_words(each)}")
        _say(console, f"    {each.explained}", look)
    still = {(each.study, each.check.name) for each in found if not each.is_sensitive}
    for study, name in sorted(still & {(study, name) for study, checks in reasons.items() for name in checks}):
        _say(console, f"  {study}: {name}: explained in {REASONS.name}, and did not move", "yellow")
    return 1 if any(each.changed for each in unexplained) else 0


def in_words(each: Moved) -> str:
    """By how much a number moved, or in which runs its verdict changed."""
    if each.changed:
        return f"another verdict in {', '.join(each.changed)}"
    return f"{100 * each.share:.3g} % of its tolerance"


def _say(console: Console, text: str, style: str = "") -> None:
    console.print(Text(printable_lines(text), style), soft_wrap=True)
