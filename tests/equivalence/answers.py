"""What a case answers, as numbers of the size of one, and how two cases are compared."""

import copy
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
import pandas as pd

from fctd.case.errors import InputError
from fctd.case.load import Case, load_case
from fctd.case.operations import KINDS
from fctd.hydraulics.channel import has_flow_curve
from fctd.hydraulics.pressures import hydraulics_of
from fctd.model.operations import SteadyRates, steady_rates
from fctd.results.status import SteadyStatus
from fctd.steady.balance import ATTEMPTS, LARGEST_TURN
from fctd.steady.continuation import CONVERGED, Pace
from fctd.steady.equilibrium import Solver, lie_along
from fctd.steady.ladder import NEWTON
from fctd.steady.steady_string import Equilibrium
from tests.equivalence.draws import Drawn
from tests.equivalence.holes import Raw

# Bounds: the same numbers come in; they come in another rounding.  Loads are shares of the string's weight, torques of
# the weight times ``ARM``.
EXACT: Final = 0.0
ROUNDING: Final = 1e-6
CLOSER: Final = (1e-3, 1e-2, 1e-1)  # of what Newton's method may leave out of balance, until rounding lets it
LEFT: Final = 1e-5  # by what Newton's method leaves out of balance
TWO_BALANCES: Final = 1e-4
UPRIGHT: Final = 1e-3  # of the hook load, by which a string that leans in vertical hole differs from one that does not
# Stresses and shares of limits hang on single contacts, which the wall holds softly: the iteration leaves them looser.
OF_CONTACTS: Final = 100.0
ARM: Final = 0.1  # [m]
LONG: Final = 60  # iterations of Newton's method, after which rounding alone is left
FLOW: Final = 0.02  # [m³/s], of the hydraulics that are compared
FORCES: Final = ("hookload", "weight_indicator", "total_contact_force", "lift")
TORQUES: Final = ("surface_torque", "drive_torque", "sum_r_ft", "sum_r_mu_fn")
# What numbers of a profile are divided by, where not by weight or torque.
SCALES: Final = {
    "von_mises_Pa": 1e8, "inside_pressure_Pa": 1e7, "outside_pressure_Pa": 1e7, "md_m": 1e3,
}  # fmt: skip
# Columns of a profile that need not agree as closely: directions, of a cylinder and of small things, places of
# contact without force.
LOOSE: Final = ("inclination_deg", "contact_angle_deg", "offset_high_m", "offset_right_m", "clearance_m", "buckling")


class NotApplicableError(Exception):
    """A statement says nothing of this case."""


@dataclass(frozen=True)
class Answers:
    """The steady strings of a case with the bit at a depth [m], found where they are asked for."""

    case: Case
    depth: float
    rates: Mapping[str, SteadyRates] | None = None

    @cached_property
    def solver(self) -> Solver:
        return Solver(self.case)

    @cached_property
    def laid(self) -> Any:
        return self.solver.lay_out(self.depth)

    @cached_property
    def _found(self) -> dict[str, Equilibrium]:
        return {}

    def __getitem__(self, kind: str) -> Equilibrium:
        if kind not in self._found:
            self._found[kind] = self.solver.solve_string(kind, self._rates(kind), self.laid)
        return self._found[kind]

    def _rates(self, kind: str) -> SteadyRates:
        return steady_rates(self.case, kind) if self.rates is None else self.rates[kind]

    def iterated(self, kind: str) -> "Answers":
        """The same where Newton's method goes on until rounding alone is left; of a row of another method, itself."""
        if self[kind].method != NEWTON:
            return self
        for share in CLOSER:
            problem = self.solver.problem(kind, self._rates(kind), self.laid)
            problem.lay_guess()
            left = share * problem.allowed
            code, _ = problem.iterate(Pace(*ATTEMPTS[0], LARGEST_TURN, left, left)._replace(iterations=LONG))
            if code == CONVERGED:
                break
        else:
            return self
        other = Answers(self.case, self.depth, self.rates)
        other._found[kind] = self.solver.answer(problem, CONVERGED, LONG, 0, NEWTON)
        other.__dict__.update(solver=self.solver, laid=self.laid)
        return other

    @cached_property
    def weight(self) -> float:
        """Weight of the string [N], and of what is on its bit."""
        string = self.laid.string
        own = float(np.abs(string.weight) @ string.length)
        return own + self.case.bit.weight_on_bit + self.case.bit.overpull

    @cached_property
    def hydraulics(self) -> dict[str, Any]:
        """Row of ``hydraulics_of``, empty where the mud has no flow curve all along or nothing flows."""
        mud = self.case.mud
        if not has_flow_curve(self.case):
            return {}
        lie = lie_along if mud.eccentricity == "string" else None
        try:
            return dict(hydraulics_of(self.case, FLOW, self.depth, lie).iloc[0])
        except InputError:
            return {}


def base(drawn: Drawn) -> Answers:
    """The answers of the drawn case itself, kept for all statements."""
    kept = drawn.__dict__.setdefault("_answers", [])
    if not kept:
        kept.append(Answers(drawn.case, drawn.depth))
    return kept[0]


def changed(drawn: Drawn, change: Callable[[Raw], None]) -> Case:
    """The case of the drawn tables after a change of their copy."""
    raw = copy.deepcopy(drawn.raw)
    change(raw)
    return load_case(raw)


def plain(point: Equilibrium) -> bool:
    """Whether a row has one balance that small changes keep: it is steady and not buckled."""
    return point.status in (SteadyStatus.CONVERGED, SteadyStatus.LOCKED_UP) and point.buckling.mode == "none"


def same(
    drawn: Drawn,
    case: Case | Answers,
    within: float = EXACT,
    *,
    kinds: Sequence[str] = (),
    loads_only: bool = False,
    but: Sequence[str] = (),
) -> None:
    """Raise AssertionError where the rows of another case are not those of the drawn one within a bound.

    kinds : of operation that are compared, by default ``some_kinds``.
    loads_only : whether stresses, shares of limits, profiles and hydraulics may differ; but : names of numbers, or
    their beginnings, that may.  Within ``EXACT`` buckled rows agree too, and their status and notes; within others
    only rows that are ``plain``.
    """
    here, there = base(drawn), case if isinstance(case, Answers) else Answers(case, drawn.depth)
    compared, kinds = 0, kinds or some_kinds(drawn)
    for k, kind in enumerate(kinds):
        one, other = here[kind], there[kind]
        if within == EXACT:
            assert (one.status, one.message) == (other.status, other.message), f"{kind}: {one.status}, {other.status}"
        elif not (plain(one) and plain(other)):
            assert not (plain(one) or plain(other)) or borderline(one, other), f"{kind}: {one.status}, {other.status}"
            continue
        compared += 1
        full = not loads_only and k == drawn.index % len(kinds)

        def compare(*both: Answers, bound: float = within, kind: str = kind, full: bool = full) -> None:
            mine, others = (without(numbers(of, kind, loads_only, full), but) for of in both)
            apart(mine, others, bound, f"{kind}: ")

        to_rounding(compare, kind, here, there) if within == ROUNDING else compare(here, there)
        if within == EXACT and not loads_only:
            assert [note.code for note in one.notes] == [note.code for note in other.notes], f"{kind}: notes"
    if not loads_only:
        mine, others = (without(hydraulic_numbers(of), but) for of in (here, there))
        apart(mine, others, within, "hydraulics: ")
    if not compared:
        raise NotApplicableError


def to_rounding(compare: Callable[..., None], kind: str, one: Answers, other: Answers) -> None:
    """Raise AssertionError where rows of an operation are not equal within rounding.

    Newton's method ends with a force and a moment of 1e-7 of the weight [N, N m] out of balance at each body, which add
    up along the string: 0.1 N m at the top of 58 segments.  Rows that differ by more than rounding are iterated on, and
    have ``LEFT`` where rounding ends that before.  Rows of other rungs of the ladder may be two balances: a string that
    turns in straight hole climbs its wall, and rounding says how far up it comes to rest.
    """
    try:
        compare(one, other)
    except AssertionError:
        if {one[kind].method, other[kind].method} != {NEWTON}:
            return compare(one, other, bound=TWO_BALANCES)
        closer = one.iterated(kind), other.iterated(kind)
        return compare(*closer, **({"bound": LEFT} if one in closer or other in closer else {}))


def some_kinds(drawn: Drawn, count: int = 3) -> tuple[str, ...]:
    """So many kinds of operation, others with the next index."""
    kinds = [*KINDS, *KINDS]
    return tuple(kinds[drawn.index % len(KINDS) :][:count])


def without(found: dict[str, Any], but: Sequence[str]) -> dict[str, Any]:
    """Numbers but those whose names begin so."""
    return {name: value for name, value in found.items() if not name.startswith(tuple(but))}


def borderline(one: Equilibrium, other: Equilibrium) -> bool:
    """Whether two rows lie on both sides of a limit of buckling, or of lock-up, that rounding crosses.

    So does an upright string on the axis of its hole, an unstable balance beside the one to which any side force takes
    it: their loads hardly differ.
    """
    if not (one.answered and other.answered):
        return False
    if SteadyStatus.UNSTABLE in (one.status, other.status):
        return abs(one.hookload - other.hookload) < UPRIGHT * abs(one.hookload)
    return 0.999 < max(one.buckling.excess, other.buckling.excess) < 1.001


def numbers(answers: Answers, kind: str, loads_only: bool, full: bool) -> dict[str, Any]:
    """Numbers of a row, of the size of one; full : with its profile."""
    point, weight = answers[kind], answers.weight
    found: dict[str, Any] = {name: getattr(point, name) / weight for name in FORCES}
    found |= {name: getattr(point, name) / (weight * ARM) for name in TORQUES}
    if loads_only:
        return found
    for k, share in enumerate(point.shares[:, 0]):
        found[f"share {k}"] = share / max(1.0, abs(share))
    if full and point.answered:
        found |= of_profile(point.profile, weight)
    return found


def of_profile(profile: pd.DataFrame, weight: float) -> dict[str, Any]:
    """Columns of a profile, of the size of one."""
    found = {}
    for name in profile.columns:
        if name in LOOSE or name.endswith("_limit_N"):
            continue  # limits are infinite without clearance
        scale = SCALES.get(name, weight * ARM if name.endswith("N_m") else weight)
        found[f"profile {name}"] = profile[name].to_numpy(float) / scale
    return found


def hydraulic_numbers(answers: Answers) -> dict[str, Any]:
    """Numbers of a row of hydraulics, of the size of one; ``lift_N`` of the weight."""
    scales = {"Pa": 1e7, "kg_m3": 1e3, "W": 1e6, "N": answers.weight, "m_s": 100.0}
    found = {}
    for name, value in answers.hydraulics.items():
        unit = next((unit for unit in scales if name.endswith(f"_{unit}")), None)
        if unit is not None:
            found[name] = value / scales[unit]
    return found


def apart(one: Mapping[str, Any], other: Mapping[str, Any], within: float, at: str = "") -> None:
    """Raise AssertionError for the numbers that differ most, if by more than a bound."""
    assert one.keys() == other.keys(), f"{at}{sorted(one.keys() ^ other.keys())}"
    worst = max(differences(one, other), default=(0.0, ""))
    assert worst[0] <= within, f"{at}{worst[1]} (apart by {worst[0]:.2g}, bound {within:g})"


def differences(one: Mapping[str, Any], other: Mapping[str, Any]) -> Iterator[tuple[float, str]]:
    """How far numbers of one name are apart, infinitely where one is not a number; with their words."""
    for name, mine in one.items():
        a, b = np.atleast_1d(mine), np.atleast_1d(other[name])
        if a.shape != b.shape:
            yield math.inf, f"{name} has {len(a)} and {len(b)} rows"
            continue
        if (np.isnan(a) != np.isnan(b)).any():
            yield math.inf, f"{name} is not a number in one"
            continue
        gap = np.nan_to_num(np.abs(a - b), nan=0.0)
        if name.startswith(("share", "profile")):
            gap = gap / OF_CONTACTS
        row = int(np.argmax(gap))
        yield float(gap[row]), f"{name} {a[row]:.9g} and {b[row]:.9g}" + (f" in row {row}" if len(a) > 1 else "")


def alike(one: Answers, other: Answers, kinds: Sequence[str], within: float, *, loads_only: bool = False) -> None:
    """Raise AssertionError where rows of two cases, neither the drawn one, differ by more than a bound."""
    compared = [kind for kind in kinds if plain(one[kind]) or plain(other[kind])]
    for kind in compared:
        mine, others = (numbers(of, kind, loads_only, not loads_only) for of in (one, other))
        apart(mine, others, within, f"{kind}: ")
    if not compared:
        raise NotApplicableError
