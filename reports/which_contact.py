"""Which contact method to take: a row for each need, with numbers from stored results; for the page and the guide."""

import hashlib
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import takewhile
from pathlib import Path
from typing import Any, Literal

import pandas as pd

from fctd.case.errors import InputError
from references import contact, engines, packages
from reports import words
from reports.chapters import Strict
from validation.harness import store
from validation.harness.registry import RIVALS
from validation.harness.store import Record
from validation.harness.study import ENDS

FILE = Path(__file__).with_name("which_contact.toml")
GUIDE = Path(__file__).parents[1] / "docs" / "which_contact.md"
COMMAND = "python -m reports which-contact"
# The mark at the end of the guide; a text that was written otherwise has another digest.
MARK = "<!-- written by `{command}`, digest {digest} -->"
STUDIES = ("contact_fronts", "rival_contact", "rival_engines", "washed_out_hole", "sticking", "sweep")
# Before the origin of what comes from the guide; the heading of all origins.
RECORD, MEASURED_ON = "last record, ", "## Measured on"
HEADINGS = ("need", "method", "setting", "cost", "error in torque", "precision", "licence, size", "Python", "trap")

# Columns of the table of all settings, and their headings.
MEASURED = {
    "setting": "setting",
    "single_us": "a call with one point [µs]",
    "ns_1000": "a point of 1000 [ns]",
    "max_error_mm": "largest error [mm]",
    "max_angle_deg": "largest angle [°]",
    "torque_off_percent": "torque [%]",
    "memory_MB": "memory [MB]",
}

Source = tuple[str, str] | tuple[str, str, str, str, str] | tuple[str, str, str, str, str, dict[str, float]]


class Need(Strict):
    """A need and what to take for it.

    costs, errors : for ``{0}`` and so on in the text before, a check (study, name) or a cell of a table (study, table,
    name of the row, column, unit; and values of other columns where a name has several rows).
    take : a name of the registry, or ``own``.
    """

    need: str
    kind: Literal["contact", "engine"]
    take: str
    setting: str
    cost: str
    costs: tuple[Source, ...]
    error: str
    errors: tuple[Source, ...]
    precision: str
    trap: str


class _Needs(Strict):
    row: tuple[Need, ...]


@dataclass(frozen=True)
class Table:
    """A table as text, and what it was made of: dates, machines and commits.

    from_guide : the studies that have no result, so that the guide's record stands for them.
    """

    headings: tuple[str, ...]
    rows: list[tuple[str, ...]]
    origins: list[str]
    from_guide: tuple[str, ...] = ()


@cache
def needs() -> tuple[Need, ...]:
    """The rows of ``which_contact.toml``.  Raises InputError for a method or an engine that no registry has."""
    found = _Needs.model_validate(tomllib.loads(FILE.read_text(encoding="utf-8"))).row
    for each in found:
        if each.take != "own" and each.take not in _registry(each).names():
            raise InputError("a name of a registry, or own", key=f"take, for {each.need!r}", value=each.take)
    return found


class Results:
    """Stored results by study: records and tables, read once."""

    def __init__(self, folder: Path) -> None:
        self.records: dict[str, Record] = {}
        self.tables: dict[str, dict[str, pd.DataFrame]] = {}
        for study in STUDIES:
            try:
                record = store.read(folder / study)
                self.records[study], self.tables[study] = record, store.read_tables(folder / study, record)
            except (OSError, ValueError, TypeError, LookupError):
                continue  # its numbers are said to be missing

    def lacks(self, each: Need) -> bool:
        """Whether a number of a need is in no result."""
        return any(self._quantity(source) is None for source in (*each.costs, *each.errors))

    def filled(self, text: str, sources: Iterable[Source]) -> str:
        """A text with its numbers; where one has not been measured, the command that measures it."""
        found = [(source[0], self._quantity(source)) for source in sources]
        if missing := dict.fromkeys(study for study, quantity in found if quantity is None):
            # Numbers of rivals come from an environment of their own: make rivals.
            places = {study: ".venv-rivals/bin/" if study in RIVALS else "" for study in missing}
            asked = [
                f"`{place}python -m validation {' '.join(study for study, its in places.items() if its == place)}`"
                for place in dict.fromkeys(places.values())
            ]
            return f"not measured yet: run {' and '.join(asked)}"
        return text.format(*(quantity for _, quantity in found))

    def _quantity(self, source: Source) -> str | None:
        """A number with its unit, None where no result has it."""
        study = source[0]
        if study not in self.records:
            return None
        if len(source) == 2:
            checks = {judged.check.name: judged.check for judged in self.records[study].checks}
            check = checks.get(source[1])
            return None if check is None else words.found(check)
        _, table, key, column, unit, *where = source
        others = where[0] if where else {}
        rows = self.tables[study].get(table)
        if rows is None or not {column, *others} <= set(rows.columns):
            return None
        for name, value in {rows.columns[0]: key, **others}.items():
            rows = rows[rows[name] == value]
        found = rows[rows[column].notna()]
        if not len(found):
            return None
        ends = [words.number(float(found[each].iloc[0])) for each in map(column.__add__, ENDS) if each in found]
        return f"{words.measured(*ends) if len(ends) == len(ENDS) else ends[0]}{words.SPACE}{unit}".rstrip()

    def gate(self, engine: str) -> str:
        """How an engine failed the gate before any speed; empty where it passed, or where it was not tried."""
        for rows in (each for of in self.tables.values() for each in of.values() if "gate" in each):
            named = rows[rows["name" if "name" in rows else "engine"] == engine]
            if len(named) and words.failed_gate(named).iloc[0]:
                return str(named["gate"].iloc[0])
        return ""

    def origins(self) -> list[str]:
        """For each study: day, machine, commit, and whether the run was quick."""
        return [
            f"{study}: {record.date[:10]}, {record.provenance.cpu}, {record.provenance.cores} cores, commit "
            f"{record.provenance.commit}, {'quick' if record.quick else 'full'} run"
            for study, record in self.records.items()
        ]


def table(folder: Path) -> Table:
    """The needs with their numbers from the results in a folder, and from the guide where a result is missing."""
    results, kept = Results(folder), recorded()
    last = {row[0]: row for row in kept.rows}
    rows: list[tuple[str, ...]] = []
    from_guide: dict[str, None] = {}
    for each in needs():
        if results.lacks(each) and each.need in last:
            rows.append(last[each.need])
            from_guide |= dict.fromkeys(source[0] for source in (*each.costs, *each.errors))
            continue
        cost, error = results.filled(each.cost, each.costs), results.filled(each.error, each.errors)
        if failed := results.gate(each.take):
            cost = f"~~{cost}~~ {failed}"
        method = "FCTD itself" if each.take == "own" else f"`{each.take}`"
        rows.append((each.need, method, each.setting, cost, error, each.precision, *_package(each, results), each.trap))
    origins = [line for line in kept.origins if line.removeprefix(RECORD).partition(":")[0] in from_guide]
    of_record = [RECORD + line.removeprefix(RECORD) for line in origins]
    return Table(HEADINGS, rows, results.origins() + of_record, tuple(from_guide))


def recorded() -> Table:
    """The needs of the guide: the last record, whose numbers stand for results that are missing."""
    lines = GUIDE.read_text(encoding="utf-8").splitlines() if GUIDE.exists() else []
    begin = lines.index("| " + " | ".join(HEADINGS) + " |") + 2 if lines else 0
    cells = [line[2:-2].split(" | ") for line in takewhile(lambda line: line.startswith("| "), lines[begin:])]
    whole = [tuple(row) for row in cells if len(row) == len(HEADINGS)]
    measured = lines[lines.index(MEASURED_ON) :] if lines else []
    return Table(HEADINGS, whole, [line[2:] for line in measured if line.startswith("- ") and ": 20" in line])


def fronts(folder: Path) -> Table:
    """Every setting of every method that has been measured, in the order of the studies."""
    results = Results(folder)
    columns = list(MEASURED)
    found = [of["fronts"] for of in results.tables.values() if "setting" in of.get("fronts", ())]
    rows = pd.concat(found, ignore_index=True) if found else pd.DataFrame(columns=columns)
    rows = rows.drop_duplicates("setting")  # the baselines of rivals are those of the suite
    printed = words.columns(rows.reindex(columns=[*dict.fromkeys([*columns, *rows.columns])]))
    return Table(tuple(MEASURED.values()), list(zip(*(printed[name] for name in columns), strict=True)), [])


def write_guide(folder: Path) -> None:
    """Write ``docs/which_contact.md`` from the results in a folder."""
    text = guide(table(folder), fronts(folder))
    GUIDE.write_text(text + mark(text) + "\n", encoding="utf-8")


def guide(chosen: Table, measured: Table) -> str:
    """The guide without its mark."""
    origins = "".join(f"- {line}\n" for line in chosen.origins)
    return (
        "# Which contact method?\n\n"
        f"`{COMMAND}` writes this page from stored results; no number of it is written by hand.\n\n"
        f"{_markdown(chosen)}\n"
        f"{LEGEND}\n"
        "## Every setting\n\n"
        f"{SETTINGS}\n"
        f"{_markdown(measured)}\n"
        f"{MEASURED_ON}\n\n"
        f"{origins}\n"
        f"{NOT_TAKEN}\n"
    )


def mark(text: str) -> str:
    """The mark that belongs to the text of a guide."""
    return MARK.format(command=COMMAND, digest=hashlib.sha256(text.encode()).hexdigest()[:16])


LEGEND = """An error of a contact method is the change of the torque of the curved chain that turns. It is against
FCTD's own arcs over the same window. Below 0.01 % it is that of the start, which settles a little longer with a method
from outside. An engine's own error is against what its cell names.

Brackets behind a number hold its quartiles. A time is struck through where its engine failed [the gate before any
speed](references.md); its error stands. Lean is the angle of friction from the direction against the sliding, 0 by
Coulomb's law. A point is one test of contact. Size is that of a package with what it needs beside FCTD's own packages.
`make rivals` installs `embree`, `warp`, `rapier` and `exudyn` in an environment of their own.
"""

SETTINGS = """Behind a method stand facets around the hole and metres between rings, the length of cylinders, the cell
of a sampled distance, or the way of a node before it is found anew. FOR-loop is the paper's search; an axis frame keeps
nodes at fixed depths. Errors are those of the penetration and of the direction of a contact. What has a dash was not
measured. Caliper holes in FCTD itself have a study of their own, `washed_out_hole`.
"""

NOT_TAKEN = """## Tried, and not taken

- Open3D: single precision and 945 MB, slower than libigl in single calls.
- MeshLib: licensed for evaluation and non-commercial use alone.
- VTK: a Python loop over points, 566 MB, 100 times the cost of a ray of Embree.
- point-cloud-utils: it builds its tree anew in every call.
- pysdf: no wheel; it fails to build and takes the whole installation with it.
- ovphysx: 623 MB, its licence binds it to one vendor's platform, and it changes the versions of other packages.
- openseespy: its licence forbids commercial redistribution, and it has no pipe in a pipe.
- Genesis: 30 packages in single precision; its claims of speed were disputed.
- Drake: its last wheel for Python 3.11 is old, and its meshes have to be closed, which a hole is not.
"""


def _registry(need: Need) -> Any:
    return contact.REGISTRY if need.kind == "contact" else engines.REGISTRY


def _package(need: Need, results: Results) -> tuple[str, str]:
    """Licence with installed size, and Pythons; of a package that is not installed here, from a study that had it."""
    if need.take == "own":
        return "FCTD's own", _span(packages.PYTHONS)
    about = packages.about(_registry(need).find(need.take).distribution)
    if about.distribution == packages.OWN:
        return "FCTD's own", _span(about.pythons)
    if about.version is None:
        about = _stored(about, results.tables.values())
    if about.version is None or about.installed_mb is None:
        return f"{about.distribution}: not installed", _span(about.pythons)
    return f"{about.licence}, {about.installed_mb:.0f} MB", _span(about.pythons)


def _stored(about: packages.Package, tables: Iterable[Mapping[str, pd.DataFrame]]) -> packages.Package:
    for of in tables:
        rows = of.get("packages", pd.DataFrame(columns=["distribution", "version"]))
        found = rows[(rows["distribution"] == about.distribution) & rows["version"].notna()]
        for _, row in found.head(1).iterrows():
            return about._replace(version=row["version"], licence=row["licence"], installed_mb=row["installed_mb"])
    return about


def _span(pythons: tuple[str, ...]) -> str:
    return pythons[0] if len(pythons) == 1 else f"{pythons[0]} to {pythons[-1]}"


def _markdown(of: Table) -> str:
    lines = [of.headings, ["---"] * len(of.headings), *of.rows]
    return "".join(f"| {' | '.join(cell.replace('|', '/') for cell in line)} |\n" for line in lines)
