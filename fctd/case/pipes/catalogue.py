"""The catalogue: nominal geometry of pipe as pages print it, and the pipe that a name stands for.

The tables beside this module have inches, feet and pounds per foot, as they are printed; each row names its page in
``sources.csv``.  Capacities are not in them: ``fctd.model.capacity`` computes these.
"""

import csv
import difflib
import math
import re
from collections.abc import Iterator
from functools import cache, partial
from importlib.resources import files
from itertools import product
from typing import Final, NamedTuple

from fctd.case.errors import InputError
from fctd.case.pipes.grades import KSI, OF_CASING, OF_DRILL_PIPE, strength_of
from fctd.case.pipes.names import CASING, CLASSES, COLLAR, DRILL_PIPE, HEAVY, TUBING, PipeName, in_inches, parse

INCH, FOOT, POUND = 0.0254, 0.3048, 0.45359237
# Yield strength of collars up to this diameter [in], and of wider ones (API Spec 7-1, source "victor").
SMALL_COLLAR, COLLAR_STRENGTH, WIDE_COLLAR_STRENGTH = 6.875, 110 * KSI, 100 * KSI
NAMED: Final = 4  # pipes that a refusal names
SAME_DIAMETER: Final = 1e-4  # [m], a rounded diameter


class Source(NamedTuple):
    """A page that prints geometry: title, address, the day on which it was opened."""

    title: str
    address: str
    opened: str


class ToolJoint(NamedTuple):
    """Tool joints: connection, outer and inner diameter [m]; length of pin and box together, and of the joint of pipe
    with them [m], None where they are not printed."""

    connection: str
    outer: float
    inner: float
    length: float | None
    joint_length: float | None


class Pipe(NamedTuple):
    """A pipe with the nominal diameters of its body [m].

    size, second : as it is sold, outer diameter [in] and nominal weight [lb/ft], of a collar its bore [in]; grade :
    None for a collar, and for casing and tubing whose name has none; yield_strength : the least one [Pa], or None;
    wall_share : of the nominal wall that its class leaves to its strength; linear_mass : of new pipe with its tool
    joints or couplings [kg/m], None where it is not printed; coupling : its outer diameter [m], or None; sources : keys
    of ``sources()``.
    """

    kind: str
    size: float
    second: float
    inner: float
    grade: str | None
    yield_strength: float | None
    linear_mass: float | None
    sources: tuple[str, ...]
    joint: ToolJoint | None = None
    coupling: float | None = None
    connection: str = ""
    wall_share: float = 1.0

    @property
    def outer(self) -> float:
        """Nominal outer diameter of the body [m]."""
        return _si(self.size, INCH)

    @property
    def name(self) -> str:
        """The name that ``pipe_named`` reads."""
        if self.kind == COLLAR:
            return f"{in_inches(self.size)} x {in_inches(self.second)} {self.connection} collar"
        kind = self.kind if self.kind in (CASING, TUBING) else ""
        words = [f"{in_inches(self.size)} in {self.second:g}", self.grade or "", self.connection, kind]
        shares = [name for name, share in CLASSES.items() if share == self.wall_share]
        used = (
            "" if self.wall_share == 1.0 else f", {shares[0] if shares else f'{100 * (1 - self.wall_share):g} % worn'}"
        )
        return " ".join(word for word in words if word) + used


def pipe_named(text: str) -> Pipe:
    """The pipe that a name stands for; raises InputError, with the nearest names, for one that is not known."""
    name = parse(text)
    found = [pipe for pipe in catalogue() if _is(pipe, name)]
    if not found:
        raise InputError(f"a pipe of the catalogue, {_nearest(name, text)}; `fctd pipes` lists them", value=text)
    if len(found) > 1:
        names = " or ".join(f"'{pipe.name}'" for pipe in found[:NAMED])
        raise InputError(f"one pipe of those that it may be, {names}", value=text)
    if name.wall_share != 1.0 and found[0].kind != DRILL_PIPE:
        raise InputError(f"{found[0].name} without a class or wear, which drill pipe alone has", value=text)
    return of_grade(found[0], name.grade)._replace(wall_share=name.wall_share)


def pipes_of_size(kind: str, outer: float, inner: float) -> list[Pipe]:
    """The pipes of a kind whose nominal body has these diameters [m], within a tenth of a millimetre."""
    near = partial(math.isclose, rel_tol=0.0, abs_tol=SAME_DIAMETER)
    return [pipe for pipe in catalogue() if pipe.kind == kind and near(pipe.outer, outer) and near(pipe.inner, inner)]


def of_grade(pipe: Pipe, grade: str | None) -> Pipe:
    """Casing and tubing with a grade of theirs; another pipe as it is."""
    if grade not in OF_CASING or pipe.kind not in (CASING, TUBING):
        return pipe
    return pipe._replace(grade=grade, yield_strength=strength_of(grade))


@cache
def catalogue() -> tuple[Pipe, ...]:
    """All pipes, new; casing and tubing without a grade."""
    return (*_drill_pipe(), *_collars(), *_casing(), *_tubing())


@cache
def sources() -> dict[str, Source]:
    """The pages, by their keys."""
    return {row["key"]: Source(row["title"], row["address"], row["opened"]) for row in table("sources")}


def table(name: str) -> list[dict[str, str]]:
    """The rows of one of the tables beside this module."""
    text = files("fctd.case.pipes").joinpath(f"{name}.csv").read_text(encoding="utf-8")
    return list(csv.DictReader(text.splitlines()))


@cache
def connection_of(word: str) -> str:
    """The name by which the catalogue calls a connection, "4 1/2 IF" as "NC50"; in lower case without blanks."""
    plain = _plain(word)
    return next((_plain(row["name"]) for row in table("connections") if _plain(row["alias"]) == plain), plain)


def _plain(word: str) -> str:
    return re.sub(r"[\s-]", "", word.lower())


def _drill_pipe() -> Iterator[Pipe]:
    """Bodies with the tool joints that are printed, and without where none are."""
    joints = table("tool_joints")
    for body, grade in product(table("drill_pipe"), OF_DRILL_PIPE):
        size, weight = float(body["size"]), float(body["weight"])
        plain = Pipe(
            DRILL_PIPE,
            size,
            weight,
            _si(float(body["inner"]), INCH),
            grade,
            strength_of(grade),
            None,
            (body["source"],),
        )
        fitting = [
            row for row in joints if (float(row["size"]), float(row["weight"]), row["grade"]) == (size, weight, grade)
        ]
        several = len({row["connection"] for row in fitting}) < len(fitting)
        for row in fitting:
            outer, inner = float(row["outer"]), float(row["inner"])
            joint = ToolJoint(
                row["connection"], _si(outer, INCH), _si(inner, INCH), _length(row["length"], INCH),
                _length(row["joint_length_ft"], FOOT),
            )  # fmt: skip
            by_size = f" {in_inches(outer)} x {in_inches(inner)}" if several else ""
            yield plain._replace(
                joint=joint, linear_mass=_length(row["linear_weight"], POUND / FOOT),
                connection=row["connection"] + by_size, sources=(*plain.sources, row["source"]),
            )  # fmt: skip
        if not fitting:
            yield plain


def _collars() -> Iterator[Pipe]:
    for row in table("collars"):
        size, bore = float(row["size"]), float(row["bore"])
        strength = COLLAR_STRENGTH if size <= SMALL_COLLAR else WIDE_COLLAR_STRENGTH
        sources = (row["source"], "victor")
        yield Pipe(COLLAR, size, bore, _si(bore, INCH), None, strength, None, sources, connection=row["connection"])


def _casing() -> Iterator[Pipe]:
    couplings = {float(row["size"]): row for row in table("couplings")}
    for row in table("casing"):
        pipe = _threaded(CASING, row)
        if (coupling := couplings.get(pipe.size)) is not None:
            more = (*pipe.sources, coupling["source"])
            pipe = pipe._replace(coupling=_si(float(coupling["outer"]), INCH), sources=more)
        yield pipe


def _tubing() -> Iterator[Pipe]:
    for row in table("tubing"):
        yield _threaded(TUBING, row)


def _threaded(kind: str, row: dict[str, str]) -> Pipe:
    """Casing or tubing, whose nominal weight is that with couplings."""
    weight = float(row["weight"])
    mass = _si(weight, POUND / FOOT)
    return Pipe(kind, float(row["size"]), weight, _si(float(row["inner"]), INCH), None, None, mass, (row["source"],))


def _si(value: float, unit: float) -> float:
    """A printed number in SI, without the rounding error of the product."""
    return round(value * unit, 9)


def _length(cell: str, unit: float) -> float | None:
    return _si(float(cell), unit) if cell else None


def _is(pipe: Pipe, name: PipeName) -> bool:
    """Whether a pipe has all that a name says."""
    sizes = math.isclose(pipe.size, name.size, abs_tol=1e-3) and math.isclose(pipe.second, name.second, abs_tol=1e-3)
    kind = name.kind in (None, pipe.kind)
    grade = name.grade in (None, pipe.grade) or (pipe.kind in (CASING, TUBING) and name.grade in OF_CASING)
    connection = not name.connection or connection_of(name.connection) in {
        connection_of(pipe.connection), connection_of(pipe.connection.split(" ")[0]),
    }  # fmt: skip
    return sizes and kind and grade and connection


def _nearest(name: PipeName, text: str) -> str:
    """The names that are nearest to a text, with its size where there is pipe of it."""
    if name.kind == HEAVY:
        return "which has no heavy-weight pipe, since no page was found that prints its geometry"
    same = [pipe.name for pipe in catalogue() if math.isclose(pipe.size, name.size, abs_tol=1e-3)]
    near = difflib.get_close_matches(text, same or [pipe.name for pipe in catalogue()], n=NAMED, cutoff=0.0)
    return " or ".join(f"'{one}'" for one in near)
