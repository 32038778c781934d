"""The paper's claims one by one: verdicts computed from the stored results of the studies."""

from collections.abc import Container
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.text import Text

from fctd.case.errors import InputError
from fctd.case.text import printable_lines
from validation.claims.ledger import CLAIMS, Finding, Misprint, Results, judge, read_ledger


@dataclass(frozen=True)
class Judgement:
    """Every claim of ``claims.toml`` beside what was found, in its order, and the misprints."""

    findings: list[Finding]
    misprints: list[Misprint]

    @property
    def surprises(self) -> list[Finding]:
        """The claims whose verdict is not the recorded one."""
        return [found for found in self.findings if not found.as_recorded]


def judge_all(results: Path, ledger: Path = CLAIMS) -> Judgement:
    """Judge every claim by what is stored in a folder of results; InputError for a ledger that does not fit it."""
    found, stored = read_ledger(ledger), Results(results)
    return Judgement([judge(claim, stored) for claim in found.claim], found.misprint)


def run(results: Path, console: Console, ledger: Path, timed: Container[str] = ()) -> int:
    """Judge the claims and print a line for each; the exit code, 1 where a verdict is not the recorded one.

    timed : studies whose numbers are times of other code than this machine's own, by which no claim is judged.
    """
    try:
        judgement = judge_all(results, ledger)
    except InputError as error:
        console.print(Text(printable_lines(f"claims: failed: {error}"), "bold red"), soft_wrap=True)
        return 1
    count, waiting = len(judgement.findings), sum(found.verdict == "not yet run" for found in judgement.findings)
    others = [found for found in judgement.surprises if any(study in timed for study in found.studies)]
    surprises = [found for found in judgement.surprises if found not in others]
    parts = [
        f"{count - len(judgement.surprises) - waiting} as recorded", f"{waiting} not yet run",
        f"{len(others)} not judged by times of other code", f"{len(surprises)} other than recorded",
    ]  # fmt: skip
    style = "bold red" if surprises else "bold"
    console.print(Text(f"claims: {', '.join(part for part in parts if part[0] != '0')}", style), soft_wrap=True)
    for found in judgement.findings:
        line = f"  {found.claim.id}: {found.verdict}"
        if found.verdict == "not yet run":
            line += f" ({found.why})"
        if not found.as_recorded:
            line += f", recorded is {found.claim.verdict or 'nothing'}"
        console.print(Text(printable_lines(line), "bold red" if found in surprises else ""), soft_wrap=True)
    return 1 if surprises else 0
