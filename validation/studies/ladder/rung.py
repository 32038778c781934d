"""A rung: a number with an exact or published answer, what of the engine is compared with it, and how near it must be.

A rung's case is made of tables, as a case file has them, so that a fault enters through a key of the case.
"""

import copy
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple

import numpy as np
import pandas as pd

from fctd import Case, Equilibrium, equilibrium
from fctd.case.load import make_case
from fctd.case.raw_case import apply_override
from fctd.results.status import SteadyStatus
from references.buckling.onset import Pipe

Tables = dict[str, Any]
Quantity = Callable[[Case], float]
By = Literal["steady", "stepper"]

GRAVITY = 9.80665  # [m/s²]
MUD = 1200.0  # [kg/m³]


class NoAnswerError(RuntimeError):
    """The engine has no number to compare; the message says why."""


@dataclass(frozen=True)
class Rung:
    """A number that is known, and what gives it.

    formula : with its source.  tables : of the case, by the length of its segments [m].  exact, found : the number by
    the formula and by each solver, in ``unit``.  cuts : lengths of segments [m]; those of the second meet their
    neighbours', or the ends of the hole's bends, exactly.  bound : largest error [%] of the exact number, or of
    ``scale`` where that is given; ``why`` says why a bound is above 1 %.
    refined : three lengths, each half of the one before, from which the order is observed; ``order`` : its range.
    long : left out of the quick study.
    """

    name: str
    formula: str
    tables: Callable[[float], Tables]
    exact: Quantity
    found: Mapping[By, Quantity]
    unit: str
    cuts: tuple[float, float]
    bound: float = 1.0
    scale: Quantity | None = None
    why: str = ""
    refined: tuple[float, float, float] | None = None
    order: tuple[float, float] | None = None
    long: bool = field(default=False, kw_only=True)

    def __post_init__(self) -> None:
        if (self.bound > 1.0) != bool(self.why):
            raise ValueError(f"{self.name}: a bound above 1 %, and no other, says why")
        if (self.refined is None) != (self.order is None):
            raise ValueError(f"{self.name}: an order is observed on three lengths of segments")

    def case(self, cut: float, changes: Mapping[str, Any] | None = None) -> Case:
        """The case with segments of a length [m], and with keys changed as ``--set`` changes them."""
        return case_of(self.tables(cut), changes)

    def error(self, exact: float, found: float, case: Case) -> float:
        """Error of a number [%]."""
        return 100 * (found - exact) / abs(self.scale(case) if self.scale else exact)


class Section(NamedTuple):
    """Of a component per metre: EA, EI, GJ, κGA [N, N m²], mass [kg/m], buoyed weight [N/m], J [kg m], steel [m²].

    From the keys of the case alone, by the formulae of textbooks and not by the engine.
    """

    EA: float
    EI: float
    GJ: float
    shear: float
    mass: float
    weight: float
    inertia: float
    steel: float


def section(case: Case, component: int = 0) -> Section:
    """The section of a component of a case, counted from the bit; κGA is a key of the case or NaN."""
    part = case.string.components[component]
    outer, inner = part.outer_diameter, part.inner_diameter
    steel, polar = np.pi / 4 * (outer**2 - inner**2), np.pi / 32 * (outer**4 - inner**4)
    young, shear = part.youngs_modulus, part.youngs_modulus / (2 + 2 * part.poisson_ratio)
    mass = part.linear_mass or part.density * steel
    return Section(
        EA=part.axial_stiffness or young * steel,
        EI=part.bending_stiffness or 0.5 * young * polar,
        GJ=part.torsional_stiffness or shear * polar,
        shear=part.shear_stiffness or float("nan"),
        mass=mass,
        weight=mass * GRAVITY * (1 - case.mud.density / part.density),
        inertia=mass * (outer**2 + inner**2) / 8,
        steel=steel,
    )


def pipe_of(case: Case, component: int = 0) -> Pipe:
    """A component as the closed forms of buckling take it: EI, buoyed weight, clearance in the first interval."""
    found, part = section(case, component), case.string.components[component]
    return Pipe(found.EI, found.weight, 0.5 * (case.wellbore.intervals[0].diameter - part.contact_diameter))


def case_of(tables: Tables, changes: Mapping[str, Any] | None = None) -> Case:
    """The case of tables with keys changed, as ``load_case`` makes it from a file."""
    raw = copy.deepcopy(tables)
    for key, value in (changes or {}).items():
        apply_override(raw, key, value)
    return make_case(raw, None)


def steady(case: Case, kind: str, depth: float | None = None, **rates: float) -> Equilibrium:
    """A steady string with its bit at a depth [m], by default the end of its hole; NoAnswerError without loads."""
    point = equilibrium(case, kind, case.depths[1] if depth is None else depth, **rates)
    if point.status not in (SteadyStatus.CONVERGED, SteadyStatus.UNDER_RESOLVED, SteadyStatus.LOCKED_UP):
        raise NoAnswerError(f"{point.status}: {point.message}")
    if not np.isfinite(point.hookload):
        raise NoAnswerError(f"{point.status} without loads: {point.message}")
    return point


def measure(rung: Rung, by: By, cut: float, changes: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """A row of one rung by one solver at one length of segments [m]; the exact number is that of the unchanged case."""
    case, said = rung.case(cut), ""
    exact = rung.exact(case)
    try:
        found = rung.found[by](rung.case(cut, changes))
    except NoAnswerError as reason:
        found, said = float("nan"), str(reason)
    return {
        "rung": rung.name, "by": by, "segment_m": cut, "exact": exact, "found": found, "unit": rung.unit,
        "error_percent": rung.error(exact, found, case), "bound_percent": rung.bound, "says": said,
    }  # fmt: skip


def observed_order(rung: Rung, by: By) -> float:
    """Order p of the error c hᵖ from three lengths of segments, each half of the one before; NaN without one."""
    assert rung.refined is not None
    values = [measure(rung, by, cut)["found"] for cut in rung.refined]
    coarse, fine = np.diff(values)
    return float(np.log2(abs(coarse / fine))) if fine else float("nan")


def worst_first(table: pd.DataFrame) -> pd.DataFrame:
    """Rows by their error over the bound, those without a number before all."""
    share = (table["error_percent"] / table["bound_percent"]).abs()
    found: pd.DataFrame = table.assign(error_over_bound=share).sort_values(
        "error_over_bound", ascending=False, na_position="first", kind="stable", ignore_index=True
    )
    return found
