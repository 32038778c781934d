"""The judgement of the paper's claims as the page prints it."""

from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from fctd.case.errors import InputError
from validation.claims.judgement import Judgement, judge_all
from validation.claims.ledger import Verdict

# Verdict -> its class in the style sheet and its sign, which distinguishes it without colour.
LOOKS: dict[Verdict, tuple[str, str]] = {
    "holds": ("good", "✓"),
    "holds with limits": ("known", "◐"),
    "does not hold": ("bad", "✗"),
    "cannot be tested": ("absent", "–"),
    "not yet run": ("absent", "○"),
    "routes disagree": ("bad", "≠"),
}


@dataclass(frozen=True)
class Claims:
    """The judgement, or the problem that prevented it."""

    judgement: Judgement
    problem: str = ""

    @property
    def counts(self) -> list[tuple[Verdict, int]]:
        """How many claims have a verdict, for the verdicts that occur."""
        found = Counter(finding.verdict for finding in self.judgement.findings)
        return [(verdict, found[verdict]) for verdict in LOOKS if found[verdict]]


def judged(results: Path, ledger: Path) -> Claims:
    """Judge the claims by a folder of results; a ledger that does not fit them is a problem of the page."""
    try:
        return Claims(judge_all(results, ledger))
    except (InputError, OSError, ValueError) as error:
        return Claims(Judgement([], []), f"the claims cannot be judged: {error}")
