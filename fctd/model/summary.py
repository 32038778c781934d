"""What a case says, in numbers to compare with a well plan: path, string in the hole, clearances, segments."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fctd.arrays import first_largest
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.text import counted
from fctd.mechanics.topdrive import GRAVITY
from fctd.model import survey
from fctd.model.drillstring import String, lay_out
from fctd.model.fluids import fluids_of
from fctd.model.section import buoyed, section_of
from fctd.model.string_in_hole import check_end, check_fit
from fctd.model.wellbore import build_wellbore


class Path(NamedTuple):
    """The path of a hole: stations; depth (measured), vertical_depth, departure from the wellhead [m].

    inclination, its depth inclination_at; dogleg [rad/m], the greatest of a course, and its ends [m].
    """

    stations: int
    depth: float
    vertical_depth: float
    departure: float
    inclination: float
    inclination_at: float
    dogleg: float
    dogleg_from: float
    dogleg_to: float


class Part(NamedTuple):
    """A component in the hole: from_md (upper end), to_md [m]; mass [kg/m]; air, buoyed : weight [N].

    clearances (intervals,) [m] : from the wall to its widest part, all around; negative where it is too wide.
    """

    name: str
    from_md: float
    to_md: float
    mass: float
    air: float
    buoyed: float
    clearances: tuple[float, ...]


@dataclass(frozen=True)
class Summary:
    """A case with the bit as deep as hole and string allow: path; bit_depth [m]; parts from the top to the bit.

    air, buoyed : weight of the string [N].
    """

    case: Case
    path: Path
    bit_depth: float
    parts: tuple[Part, ...]

    @property
    def air(self) -> float:
        """Weight of the string in air [N]."""
        return sum(part.air for part in self.parts)

    @property
    def buoyed(self) -> float:
        """Weight of the string in mud [N]."""
        return sum(part.buoyed for part in self.parts)

    @property
    def buoyancy_factor(self) -> float:
        """Weight in mud over weight in air; 1 − ρ/ρ_steel where all of the string is of one density."""
        return self.buoyed / self.air

    def string(self) -> String:
        """The string with its segments at the end of the hole, or, where it does not fit there, of the operations.

        Raises InputError where it fits at neither.
        """
        try:
            return self._string_at(self.bit_depth)
        except InputError:
            deepest = max((max(o.start_md, o.end_md) for o in self.case.operations), default=self.bit_depth)
            if deepest >= self.bit_depth:
                raise
        return self._string_at(deepest)

    def _string_at(self, bit_depth: float) -> String:
        string = lay_out(self.case, bit_depth)
        hole = build_wellbore(self.case)
        check_fit(string, hole, bit_depth)
        check_end(string, hole)
        return string


def summarise(case: Case) -> Summary:
    """The summary of a case; raises InputError for a survey or a hole that cannot be used."""
    return Summary(case, _path(case, case.depths[1]), case.deepest, tuple(_parts(case, case.deepest)))


def segments_in_words(case: Case, string: String, metre: float = 1.0, label: str = "m") -> str:
    """Number and lengths of segments in a line; metre : what a metre is in the unit of the label."""
    shortest, longest = metre * string.length.min(), metre * string.length.max()
    span = f"{longest:.3g}" if np.isclose(shortest, longest, rtol=1e-3) else f"{shortest:.3g} to {longest:.3g}"
    chosen = any(part.cut_by_default for part in case.string.components)
    why = ", by default short in bends and near the bit" if chosen else ""
    segments = counted(string.segments, "segment")
    return f"{segments} of {span} {label} with the bit at {metre * string.bit_depth:.1f} {label}{why}"


def _path(case: Case, depth: float) -> Path:
    stations = case.wellbore.trajectory
    (north, east, down) = build_wellbore(case).at(np.array([depth]))[0][0]
    steepest = first_largest(stations[:, 1])
    rate = survey.dogleg(stations) / np.diff(stations[:, 0])
    k = first_largest(rate)
    return Path(
        len(stations), depth, float(down), float(np.hypot(north, east)), float(stations[steepest, 1]),
        float(stations[steepest, 0]), float(rate[k]), float(stations[k, 0]), float(stations[k + 1, 0]),
    )  # fmt: skip


def _parts(case: Case, bit_depth: float) -> list[Part]:
    """Components in the hole from the top down."""
    below, found, fluids = bit_depth, [], fluids_of(case, bit_depth)
    for part in case.string.components:
        length = min(part.length if part.length is not None else np.inf, below - case.string.top_md)
        if length <= 0:
            break
        section = section_of(part, case.mud.density)
        clearances = tuple(0.5 * (i.diameter - part.contact_diameter) for i in case.wellbore.intervals)
        weight = section.weight
        if fluids is not None:
            above = bit_depth - np.array([below - length, below])
            inside, outside = fluids.densities(above[:1], above[1:])
            weight = float(buoyed(section.mass, section.density, section.inner, outside[0], inside[0]))
        air = section.mass * GRAVITY * length
        found.append(Part(part.name, below - length, below, section.mass, air, weight * length, clearances))
        below -= length
    return found[::-1]
