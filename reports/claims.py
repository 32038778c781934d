"""The ledger of the paper's claims as the page prints it, from the stored result of the study ``claims``."""

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from reports import words
from validation.harness import store
from validation.harness.store import Record

LEDGER = "claims"

# Verdict -> its class in the style sheet and its sign, which tells it apart without colour.
LOOKS: dict[str, tuple[str, str]] = {
    "holds": ("good", "✓"),
    "holds with limits": ("known", "◐"),
    "does not hold": ("bad", "✗"),
    "cannot be tested": ("absent", "–"),
    "not yet run": ("absent", "○"),
    "routes disagree": ("bad", "≠"),
}


@dataclass(frozen=True)
class Quantity:
    """A number of a claim: what it is, its value, the bound, and the study that it comes from."""

    name: str
    value: str
    bound: str
    met: bool
    study: str
    quick: bool


@dataclass(frozen=True)
class Row:
    """A claim; without ``number`` there is nothing to print but ``why``."""

    claim: str
    section: str
    says: str
    verdict: str
    look: str
    sign: str
    surprise: str
    because: str
    why: str
    limit: str
    one_route: str
    remark: str
    command: str
    number: Quantity | None
    limited: Quantity | None
    second_route: Quantity | None


@dataclass(frozen=True)
class Claims:
    """The ledger; without a record it has not been run, or there is a problem with what it stored."""

    record: Record | None = None
    rows: list[Row] = field(default_factory=list)
    misprints: list[dict[Any, Any]] = field(default_factory=list)
    problem: str = ""

    @property
    def counts(self) -> list[tuple[str, str, str, int]]:
        """Look, sign, verdict and how many claims have it, for the verdicts that occur."""
        found = Counter(row.verdict for row in self.rows)
        return [(*LOOKS[verdict], verdict, found[verdict]) for verdict in LOOKS if found[verdict]]


def read_claims(folder: Path) -> Claims:
    """The ledger stored in a result folder; empty where there is none, or none that can be read, or it failed."""
    if not (folder / "verdict.json").exists():
        return Claims()
    try:
        run = store.read(folder)
        if run.status != "finished":
            return Claims(run)
        tables = store.read_tables(folder, run)
        rows = [_row(cells) for cells in tables["ledger"].to_dict("records")]
        return Claims(run, rows, tables["misprints"].to_dict("records"))
    except (OSError, ValueError, TypeError, LookupError) as error:
        return Claims(problem=f"the result cannot be read: {type(error).__name__}: {error}")


def _row(cells: dict[Any, Any]) -> Row:
    verdict, recorded = cells["verdict"], cells["recorded"]
    look, sign = LOOKS[verdict]
    differs = verdict not in ("not yet run", recorded)
    same = ("claim", "section", "says", "verdict", "because", "why", "limit", "one_route", "remark", "command")
    return Row(
        **{name: cells[name] for name in same},
        look=look,
        sign=sign,
        surprise=f"recorded: {recorded or 'nothing'}" if differs else "",
        number=_quantity(cells, "number"),
        # What narrows a claim is told where the claim does not hold as it stands.
        limited=_quantity(cells, "limited") if verdict != "holds" else None,
        second_route=_quantity(cells, "second_route"),
    )


def _quantity(cells: dict[Any, Any], role: str) -> Quantity | None:
    """A number that was found; None where there is none."""
    if not cells[f"{role}_bound"]:
        return None
    return Quantity(
        name=cells[f"{role}_name"],
        value=words.quantity(cells[f"{role}_value"], cells[f"{role}_of_unit"]),
        bound=cells[f"{role}_bound"],
        met=cells[f"{role}_met"],
        study=cells[f"{role}_study"],
        quick=cells[f"{role}_quick"],
    )
