"""The judgement of the paper's claims as the page prints it."""

from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from fctd.case.errors import InputError
from validation.claims.judgement import Judgement, judge_all
from validation.claims.ledger import Finding, Verdict

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

    @property
    def listed(self) -> str:
        """How many claims have each verdict, as a sentence without its full stop."""
        total = len(self.judgement.findings)
        return "; ".join(f"{count} of {total} {SAID[verdict][count > 1]}" for verdict, count in self.counts)

    @property
    def against(self) -> list[tuple[Verdict, list[Finding]]]:
        """The claims that do not hold, and those whose routes disagree; what a reader has to know first."""
        found = {verdict: [each for each in self.judgement.findings if each.verdict == verdict] for verdict in AGAINST}
        return [(verdict, those) for verdict, those in found.items() if those]

    @property
    def answer(self) -> str:
        """Whether the paper's claims hold, in a sentence."""
        found = dict(self.counts)
        total, tested = len(self.judgement.findings), sum(found.get(verdict, 0) for verdict in DECIDED)
        if not tested:
            return "Not answered yet: no study has been run."
        holding = found.get("holds", 0) + found.get("holds with limits", 0)
        yes = "Yes" if holding == tested else "Mostly" if 2 * holding > tested else "Mostly not"
        parts = [f"{n} {words[n > 1]}" for verdict, words in DECIDED.items() if (n := found.get(verdict, 0))]
        if rest := total - tested:
            parts.append(f"{rest} {'is' if rest == 1 else 'are'} not decided")
        listed = parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"
        return f"{yes}: of {total} claims of the paper {listed}."


# Verdicts that decide a claim, as a sentence says them of one claim and of several.
DECIDED: dict[Verdict, tuple[str, str]] = {
    "holds": ("holds", "hold"),
    "holds with limits": ("holds within limits", "hold within limits"),
    "does not hold": ("does not hold", "do not hold"),
}
SAID: dict[Verdict, tuple[str, str]] = DECIDED | {
    "cannot be tested": ("cannot be tested", "cannot be tested"),
    "not yet run": ("is not yet run", "are not yet run"),
    "routes disagree": ("has routes that disagree", "have routes that disagree"),
}
AGAINST: tuple[Verdict, ...] = ("does not hold", "routes disagree")


def judged(results: Path, ledger: Path) -> Claims:
    """Judge the claims by a folder of results; a ledger that does not fit them is a problem of the page."""
    try:
        return Claims(judge_all(results, ledger))
    except (InputError, OSError, ValueError) as error:
        return Claims(Judgement([], []), f"the claims cannot be judged: {error}")
