"""What a study is: a question, a function from a context to tables and checks, and what it needs to run."""

import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import wraps
from pathlib import Path
from typing import Any, Literal, ParamSpec, Protocol, TypeVar

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike
from scipy import stats

from fctd.arena.result import Comparison, Quartiles
from references.registry import absent

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "validation" / "results"

Kind = Literal["at_most", "at_least", "within"]
Need = Literal["data"]
ENDS = "", "_low", "_high"  # of the columns of a measured number: its median and quartiles
T = TypeVar("T")
A = TypeVar("A")
P = ParamSpec("P")
Rows = Iterator[dict[str, Any]]  # of a table, by its columns

NEEDS: dict[Need, str] = {
    "data": (
        "the public data folder is missing: surveys and field measurements from open registries; "
        "set the environment variable FCTD_DATA to its path, see docs/claims.md"
    ),
}


def data_folder() -> Path | None:
    """The public data: ``FCTD_DATA``, else ``../shared/data`` beside the checkout; None if absent."""
    folder = Path(os.environ.get("FCTD_DATA") or ROOT.parent / "shared" / "data")
    return folder if folder.is_dir() else None


@dataclass(frozen=True)
class Check:
    """A number from a study and its bound; the verdict follows from the two.

    ``bound`` is one number for ``at_most`` and ``at_least``, and a pair (low, high) for ``within``.
    ``source`` says where the bound comes from: a closed form, a publication, a target of this project.  ``timed`` :
    whether the number is a time of this machine, or follows from one, so that it differs from run to run.
    ``interval`` : (low, high) of a measured number, the quartiles of its rounds or of a fit; both ends must meet the
    bound.
    """

    name: str
    value: float
    bound: float | tuple[float, float]
    kind: Kind
    unit: str
    source: str
    timed: bool = False
    interval: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        if isinstance(self.bound, tuple) != (self.kind == "within"):
            raise ValueError(f"check {self.name!r}: 'within' takes a pair (low, high), the others one number")

    @property
    def limits(self) -> tuple[float, float]:
        """Lowest and highest value that meets the bound."""
        if isinstance(self.bound, tuple):
            return self.bound
        return (-math.inf, self.bound) if self.kind == "at_most" else (self.bound, math.inf)

    @property
    def verdict(self) -> Literal["met", "missed"]:
        """A value that is not finite meets no bound."""
        low, high = self.limits
        values = (self.value, *(self.interval or ()))
        return "met" if all(math.isfinite(value) and low <= value <= high for value in values) else "missed"

    def found(self, number: Callable[[float], str] = "{:.6g}".format) -> str:
        """The value in words, an interval in brackets, e.g. ``1.32 (1.3 to 1.34)``, with numbers by ``number``."""
        value = number(self.value)
        return f"{between(value, *map(number, self.interval)) if self.interval else value} {self.unit}".rstrip()

    def requirement(self, number: Callable[[float], str] = "{:.6g}".format) -> str:
        """The bound in words, e.g. ``at most 0.02 kN·m``, with numbers printed by ``number``."""
        if isinstance(self.bound, tuple):
            words = f"within {number(self.bound[0])} to {number(self.bound[1])}"
        else:
            words = f"{self.kind.replace('_', ' ')} {number(self.bound)}"
        return f"{words} {self.unit}".rstrip()


def between(value: str, low: str, high: str) -> str:
    """A printed number with its interval in brackets."""
    return f"{value} ({low} to {high})"


def ratio_check(name: str, ratio: Quartiles, bound: float, kind: Kind, source: str, unit: str = "") -> Check:
    """A check on a ratio of times, by the quartiles of the ratios within its rounds."""
    return Check(name, ratio.median, bound, kind, unit, source, timed=True, interval=(ratio.low, ratio.high))


def time_check(name: str, times: ArrayLike, bound: float, unit: str, source: str) -> Check:
    """A check that times are at most a bound, by their quartiles; times : of rounds, or of rows of one kind."""
    return ratio_check(name, Quartiles.of(times), bound, "at_most", source, unit)


def quartiles_of(row: Any, column: str) -> Quartiles:
    """A number whose quartiles stand in the columns of the same name with ``_low`` and ``_high``; row : of a table."""
    return Quartiles(median=row[column], low=row[f"{column}_low"], high=row[f"{column}_high"])


def in_columns(rounds: Mapping[str, ArrayLike]) -> dict[str, float]:
    """Columns of a row for measured numbers, by their rounds; ``quartiles_of`` reads them."""
    found = {name: Quartiles.of(values) for name, values in rounds.items()}
    return {f"{name}{end}": value for name, of in found.items() for end, value in zip(ENDS, of.all, strict=True)}


@dataclass(frozen=True)
class Outcome:
    """What a study found.

    ``tables`` are stored one file each; row labels are not stored, so what matters is in a column, and a
    column's name ends in its unit (``bit_depth_m``). ``display`` maps the tables the report prints in full to
    their captions. ``notes`` are sentences for the reader of the numbers. ``comparisons`` are stored as JSON.
    """

    tables: dict[str, pd.DataFrame]
    checks: list[Check]
    notes: list[str] = field(default_factory=list)
    display: dict[str, str] = field(default_factory=dict)
    comparisons: dict[str, Comparison] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if unknown := self.display.keys() - self.tables.keys():
            raise ValueError(f"display names tables that are not there: {sorted(unknown)}")
        if len({check.name for check in self.checks}) < len(self.checks):
            raise ValueError("two checks share a name; expected.toml needs different names")


def table_of_rows(rows: Callable[P, Rows]) -> Callable[P, pd.DataFrame]:
    """A function that yields rows, as one that returns the table of them."""

    @wraps(rows)
    def of_rows(*given: P.args, **options: P.kwargs) -> pd.DataFrame:
        return pd.DataFrame(list(rows(*given, **options)))

    return of_rows


def left_out(missing: Sequence[str]) -> list[str]:
    """The note on packages that are not installed and how to install them; empty where none is missing."""
    if not missing:
        return []
    bullet = any(name.lower().startswith("bullet") for name in missing)
    ways = f" Package {absent('pybullet')}." if bullet else ""
    return [f"Not installed, and left out: {', '.join(missing)}.{ways}"]


def log_slope(x: ArrayLike, y: ArrayLike) -> float:
    """Exponent p of y ~ x^p by least squares, both positive: an order of convergence, a growth of cost."""
    return float(np.polyfit(np.log(np.asarray(x, float)), np.log(np.asarray(y, float)), 1)[0])


def fitted_exponent(x: ArrayLike, y: ArrayLike) -> Quartiles:
    """``log_slope`` of measured times with the quartiles of the fit as its low and high; at least three points."""
    fit = stats.linregress(np.log(np.asarray(x, float)), np.log(np.asarray(y, float)))
    half = stats.t.ppf(0.75, len(np.asarray(x)) - 2) * fit.stderr
    return Quartiles(median=float(fit.slope), low=float(fit.slope - half), high=float(fit.slope + half))


class Progress(Protocol):
    """Passes on the items of a loop and shows its progress on the terminal."""

    def __call__(self, items: Iterable[T], label: str) -> Iterable[T]: ...


def silent(items: Iterable[T], label: str) -> Iterable[T]:
    """The progress that shows nothing."""
    return items


class Apart(Protocol):
    """The results of a function for each of several arguments, in their order; it may use a process for each."""

    def __call__(self, function: Callable[[A], T], arguments: Sequence[A]) -> list[T]: ...


def one_by_one(function: Callable[[A], T], arguments: Sequence[A]) -> list[T]:
    """All in this process, one after the other."""
    return [function(argument) for argument in arguments]


@dataclass(frozen=True)
class Context:
    """The input of a study: whether to run the short version, the folder of the public data, the progress display.

    ``data`` is a folder for a study that says ``needs=("data",)`` and None for any other. ``apart`` runs parts of a
    study that do not depend on each other; the function that it takes stands in a module.
    """

    quick: bool = False
    data: Path | None = None
    progress: Progress = silent
    apart: Apart = one_by_one


@dataclass(frozen=True)
class Study:
    """One question, and the function that answers it.

    ``reproduce`` : whether ``make reproduce`` runs it: where a claim of the paper rests on it, or the first page of the
    report. ``timed`` : whether a check or a figure of it is a time, so that nothing may run beside it. ``needs`` : what
    must be available; otherwise the study is skipped with a message.
    """

    name: str
    question: str
    run: Callable[[Context], Outcome]
    reproduce: bool = False
    needs: tuple[Need, ...] = ()
    timed: bool = False
