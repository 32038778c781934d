"""What hangs on rounding: each number beside its values with noise and as other compiled code."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from fctd.case.text import counted
from reports.sections import Printed, printed
from validation.harness import sensitivity
from validation.harness.runner import UsageError
from validation.harness.sensitivity import Moved, in_words


@dataclass(frozen=True)
class Page:
    """The answer in words, the sensitive numbers and all others; problem : why there is no table, or empty."""

    answer: str
    sensitive: Printed | None = None
    others: Printed | None = None
    problem: str = ""


def page_of(stored: Path, reasons: Path) -> Page:
    """The page from the results of a folder, and the reasons of a file."""
    try:
        found = sensitivity.moved(stored, sensitivity.read_reasons(reasons))
    except UsageError as error:
        return Page("", problem=str(error))
    if not found:
        return Page("Not measured here yet: run python -m validation STUDY --perturbed 1 --draws 4.")
    labels = sorted({label for each in found for label in each.runs})
    sensitive = [each for each in found if each.is_sensitive]
    changed = sum(bool(each.changed) for each in sensitive)
    studies = list(dict.fromkeys(each.study for each in found))
    answer = (
        f"{len(sensitive)} of {counted(len(found), 'number')} moved by more than a tenth of what its bound allows, and "
        f"{counted(changed, 'verdict')} changed. Studies that ran again: {', '.join(studies)}. Their runs: "
        f"{', '.join(labels)}."
    )
    others = [each for each in found if not each.is_sensitive]
    return Page(
        answer,
        _table(sensitive, "Numbers that hang on rounding"),
        _table(others, "Numbers that moved less"),
    )


def _table(found: Sequence[Moved], caption: str) -> Printed:
    rows = [
        {
            "study": each.study,
            "check": each.check.name,
            "plain": f"{each.check.value:.6g}",
            "lowest": f"{each.low:.6g}",
            "highest": f"{each.high:.6g}",
            "bound": each.check.requirement(),
            "runs": str(len(each.runs)),
            "moved": in_words(each),
            **({"why": each.explained} if each.is_sensitive else {}),
        }
        for each in found
    ]
    return printed(pd.DataFrame(rows), caption)
