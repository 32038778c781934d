"""The claims of the paper: what ``claims.toml`` may say, and how a verdict follows from stored numbers.

A claim has one number of one study and a bound, which the number meets if the claim holds. If it does not, a second
number, of a narrower question or with a wider bound, may show the limits within which the claim holds. A number that
misses its bound contradicts the paper and needs a second route to the same quantity.
"""

import math
import re
import tomllib
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple, Self

import pandas as pd
from pydantic import Field, model_validator

from fctd.case.errors import MISSING, InputError, Table, exclusive
from fctd.case.raw_case import checked, look_up
from fctd.store.parquet import read_frame
from validation.harness import store
from validation.harness.registry import STUDIES
from validation.harness.store import Record
from validation.harness.study import ROOT, Check, Kind

CLAIMS = ROOT / "validation" / "claims" / "claims.toml"

Recorded = Literal["holds", "holds with limits", "does not hold", "cannot be tested"]
Verdict = Literal[Recorded, "not yet run", "routes disagree"]
Real = Annotated[float, Field(strict=True, allow_inf_nan=False, description="a number")]
Text = Annotated[str, Field(min_length=1, description="a text in quotes")]


class Number(Table):
    """Where a number is stored, and its bound.

    check : a check of the study, which brings its unit.  Otherwise table and column, with ``where`` (column -> value
    of the rows that count), ``take`` (which of them) and ``called`` (the name of the number).
    """

    study: Text
    check: Text | None = None
    table: Text | None = None
    column: Text | None = None
    where: dict[str, Real | bool | str] = Field(default_factory=dict)
    take: Literal["only", "first", "last", "least", "greatest", "largest", "mean"] = "only"
    called: Text | None = None
    unit: str | None = None
    at_most: Real | None = None
    at_least: Real | None = None
    within: tuple[Real, Real] | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        exclusive(self, "check", "table", required=True)
        for key in ("column", "called", "unit"):
            if self.table is not None and getattr(self, key) is None:
                raise InputError("a text in quotes: a number of a table needs it", key=key)
            if self.check is not None and getattr(self, key) is not None:
                raise InputError("nothing: the check has its own", key=key, value=getattr(self, key))
        bounds = [key for key in ("at_most", "at_least", "within") if getattr(self, key) is not None]
        if len(bounds) != 1:
            raise InputError(
                "one of at_most, at_least and within = [low, high]", key=bounds[1] if bounds else "at_most"
            )
        return self

    @property
    def source(self) -> tuple[Any, ...]:
        """Where it is stored; two numbers differ if this differs."""
        return self.study, self.check, self.table, self.column, self.take, sorted(self.where.items())

    def held(self, found: "Stored", because: str) -> Check:
        """A stored number beside the bound."""
        kinds: tuple[Kind, ...] = ("at_most", "at_least", "within")
        kind, bound = next((kind, getattr(self, kind)) for kind in kinds if getattr(self, kind) is not None)
        return Check(found.name, found.value, bound, kind, found.unit, because, interval=found.interval)


class Limited(Number):
    """A number that shows the limits within which a claim holds; ``limit`` : the limits in words."""

    limit: Text


class Claim(Table):
    """One claim of the paper.

    says : the claim in our words. verdict : the recorded verdict; a run that finds another is an error. because : where
    the bound comes from.  limited : the number within limits.  second_route : the same quantity from elsewhere,
    compared with the same bound; required where the number contradicts the paper. one_route : why a claim that holds
    with limits has no second route.  untestable : why nothing can be computed.
    """

    id: Annotated[str, Field(pattern=r"^[a-z0-9]+(-[a-z0-9]+)*$", description="a name such as overlap-closes-gaps")]
    section: Annotated[str, Field(pattern=r"^(abstract|\d(\.\d)?)(, (abstract|\d(\.\d)?))*$", description="a section")]
    says: Text
    verdict: Recorded | None = None
    because: Text | None = None
    number: Number | None = None
    limited: Limited | None = None
    second_route: Number | None = None
    one_route: Text | None = None
    untestable: Text | None = None
    remark: str = ""

    @model_validator(mode="after")
    def _check(self) -> Self:
        exclusive(self, "number", "untestable", required=True)
        if self.untestable is not None:
            for key in ("because", "limited", "second_route", "one_route"):
                if getattr(self, key) is not None:
                    raise InputError("nothing, where the claim cannot be tested", key=key)
        elif self.because is None:
            raise InputError("a text in quotes: where the bound comes from", key="because")
        if (self.verdict == "cannot be tested") != (self.untestable is not None):
            raise InputError("cannot be tested together with untestable, and not without", key="verdict")
        if self.verdict == "holds with limits" and self.limited is None:
            raise InputError("a number that shows the limits of a claim that holds with limits", key="limited")
        self._check_routes()
        return self

    def _check_routes(self) -> None:
        """A number that contradicts the paper has a second route, or a reason why there is none."""
        exclusive(self, "second_route", "one_route")
        needed = "a second route to the number, since the result contradicts the paper"
        if self.verdict == "does not hold" and self.second_route is None:
            raise InputError(needed, key="second_route")
        if self.verdict == "holds with limits" and self.second_route is None and self.one_route is None:
            raise InputError(f"{needed}, or one_route = why there is none", key="second_route")
        if self.one_route is not None and self.verdict != "holds with limits":
            raise InputError("nothing, except for a claim that holds with limits", key="one_route")
        if self.second_route is not None and self.second_route.source in [number.source for number in self.first]:
            raise InputError("a number of its own, not one that the claim already has", key="second_route")

    @property
    def first(self) -> tuple[Number, ...]:
        """The number that decides, and the one within limits."""
        return tuple(number for number in (self.number, self.limited) if number is not None)

    @property
    def numbers(self) -> tuple[Number, ...]:
        """All its numbers."""
        return self.first if self.second_route is None else (*self.first, self.second_route)


class Misprint(Table):
    """A misprint of the paper, what is implemented in its place, and the tests that check the engine for it."""

    where: Text
    printed: Text
    meant: Text
    reason: Text
    tests: Annotated[list[Text], Field(min_length=1, description="a list of tests, each tests/FILE.py::test_name")]


class Ledger(Table):
    """``claims.toml``.  pending : studies that claims name and that are not written yet."""

    pending: list[Text] = Field(default_factory=list)
    claim: list[Claim]
    misprint: list[Misprint] = Field(default_factory=list)

    @model_validator(mode="after")
    def _check(self) -> Self:
        doubled = [name for name, count in Counter(claim.id for claim in self.claim).items() if count > 1]
        if doubled:
            raise InputError("an id of its own for each claim", key="claim.id", value=doubled[0])
        for i, name in enumerate(self.pending):
            if name in STUDIES:
                raise InputError("no study that there is", key=f"pending[{i}]", value=name)
        for i, claim in enumerate(self.claim):
            for number in claim.numbers:
                if number.study not in STUDIES and number.study not in self.pending:
                    known = ", ".join([*STUDIES, *self.pending])
                    key = f"claim[{i}].{_role(claim, number)}.study"
                    raise InputError(f"one of the studies {known}", key=key, value=number.study)
        return self


def read_ledger(path: Path = CLAIMS) -> Ledger:
    """Read ``claims.toml``; InputError with file, claim, key, value and what was expected."""
    try:
        raw: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"a TOML file: {error}", file=path.name) from None
    try:
        return checked(Ledger, raw)
    except InputError as error:
        raise _named(error, raw).in_file(path.name) from None


def _named(error: InputError, raw: Any) -> InputError:
    """The same error with the id of the claim in place of its index, ``claim[7]``."""
    key = re.sub(r"^claim\[(\d+)\]", lambda found: _name(raw, int(found[1])), error.key)
    more = [_named(other, raw) for other in error.more]
    return InputError(error.expected, key=key, value=error.value, more=more)


def _name(raw: Any, index: int) -> str:
    name = look_up(raw, "claim", index, "id")
    return f"claim[{index}]" if name is MISSING else f"claim {name}"


@dataclass(frozen=True)
class Finding:
    """A claim with its numbers; ``why`` : the reason where there is no verdict yet."""

    claim: Claim
    verdict: Verdict
    number: "Found | Missing | None" = None
    limited: "Found | Missing | None" = None
    second_route: "Found | Missing | None" = None
    why: str = ""

    @property
    def as_recorded(self) -> bool:
        """Whether the verdict is the recorded one, or there is none yet."""
        return self.verdict in ("not yet run", self.claim.verdict)

    @property
    def studies(self) -> list[str]:
        """The studies whose numbers it rests on, without those that are still to come."""
        return [name for name in dict.fromkeys(number.study for number in self.claim.numbers) if name in STUDIES]


class Found(NamedTuple):
    """A number with its bound and the run it comes from."""

    check: Check
    study: str
    quick: bool

    @property
    def met(self) -> bool:
        """Whether it meets the bound."""
        return self.check.verdict == "met"


class Stored(NamedTuple):
    """A number as its study has stored it, without a bound."""

    name: str
    value: float
    unit: str
    interval: tuple[float, float] | None


class Missing(NamedTuple):
    """A number that is not there, and why."""

    study: str
    why: str


def judge(claim: Claim, results: "Results") -> Finding:
    """The verdict on a claim from the stored results of its studies."""
    if claim.number is None:
        return Finding(claim, "cannot be tested", why=claim.untestable or "")
    number, limited, second = (
        None if wanted is None else results.number(wanted, claim)
        for wanted in (claim.number, claim.limited, claim.second_route)
    )

    def verdict() -> tuple[Verdict, str]:
        assert number is not None
        if isinstance(number, Missing):
            return "not yet run", number.why
        if isinstance(second, Found) and second.met != number.met:
            keeps, misses = ("first", "second") if number.met else ("second", "first")
            lacking = math.isnan((second if number.met else number).check.value)
            does_not = "has no number" if lacking else "does not"
            return "routes disagree", f"the {keeps} route meets the bound and the {misses} {does_not}"
        if number.met:
            return "holds", ""
        if isinstance(limited, Missing):
            return "not yet run", limited.why
        if isinstance(second, Missing):
            return "not yet run", f"second route: {second.why}"
        return ("holds with limits" if limited is not None and limited.met else "does not hold"), ""

    found, why = verdict()
    return Finding(claim, found, number, limited, second, why)


class Results:
    """The stored results of the studies, each read once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._records: dict[str, Record | Missing] = {}

    def number(self, wanted: Number, claim: Claim) -> Found | Missing:
        """Find a number; InputError where a full result does not have it."""
        run = self._record(wanted.study)
        if isinstance(run, Missing):
            return run
        try:
            stored = self._check(wanted, run) if wanted.check else self._cell(wanted, run)
        except InputError as error:
            if run.quick:  # a quick run lacks some numbers of a full run
                return Missing(wanted.study, f"the quick run of {wanted.study} has no such number")
            raise error.at(f"claim {claim.id}.{_role(claim, wanted)}").in_file(CLAIMS.name) from None
        return Found(wanted.held(stored, claim.because or ""), wanted.study, run.quick)

    def _record(self, study: str) -> Record | Missing:
        if study not in self._records:
            self._records[study] = self._read(study)
        return self._records[study]

    def _read(self, study: str) -> Record | Missing:
        try:
            run = store.read(self._folder / study)
        except FileNotFoundError:
            return Missing(
                study, f"{study} has not been run" if study in STUDIES else f"study {study} is not written yet"
            )
        except (ValueError, TypeError, LookupError):
            return Missing(study, f"the result of {study} cannot be read")
        if run.status != "finished":
            return Missing(study, f"{study}: {run.status}, {run.message}")
        return run

    def _check(self, wanted: Number, run: Record) -> Stored:
        checks = {judged.check.name: judged.check for judged in run.checks}
        if wanted.check not in checks:
            raise InputError(_one_of(f"checks of {run.study}", checks), key="check", value=wanted.check)
        check = checks[wanted.check]
        return Stored(check.name, check.value, check.unit, check.interval)

    def _cell(self, wanted: Number, run: Record) -> Stored:
        if wanted.table not in run.tables:
            raise InputError(_one_of(f"tables of {run.study}", run.tables), key="table", value=wanted.table)
        table = read_frame(self._folder / run.study / f"{wanted.table}.parquet")
        for column in (wanted.column, *wanted.where):
            if column not in table:
                raise InputError(_one_of(f"columns of {wanted.table}", table.columns), key="column", value=column)
        rows = table
        for column, value in wanted.where.items():
            rows = rows[rows[column] == value]
            if rows.empty:
                there = _one_of(f"values of {column}", table[column].drop_duplicates().astype(str))
                raise InputError(there, key=f"where.{column}", value=value)
        value = _taken(rows[wanted.column].astype(float), wanted.take)
        if math.isnan(value):
            raise InputError(f"a number in column {wanted.column} of those rows", key="column", value=wanted.column)
        ends = [f"{wanted.column}_low", f"{wanted.column}_high"]  # as in every table of timed rounds
        low, high = (_taken(rows[end].astype(float), wanted.take) if end in rows else math.nan for end in ends)
        return Stored(wanted.called or "", value, wanted.unit or "", None if math.isnan(low + high) else (low, high))


def _taken(values: "pd.Series[float]", take: str) -> float:
    """One number of a column."""
    match take:
        case "first" | "last":
            return float(values.iloc[0 if take == "first" else -1])
        case "least" | "greatest" | "mean":
            return float({"least": values.min, "greatest": values.max, "mean": values.mean}[take]())
        case "largest":
            return float(values.abs().max())
    if len(values) != 1:
        raise InputError(f"a way to take one number of {len(values)} rows, or a where with one", key="take", value=take)
    return float(values.iloc[0])


def _role(claim: Claim, number: Number) -> str:
    return next(role for role in ("number", "limited", "second_route") if getattr(claim, role) is number)


def _one_of(noun: str, names: Any) -> str:
    return f"one of the {noun}: {'; '.join(map(str, names))}"
