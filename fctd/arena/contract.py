"""The contract of a contact method: the same demands of every method, whoever brings it.

Each demand is a function of a `Trial` that returns nothing where the method keeps it, and a sentence of what is wrong,
and what to do, where it does not.
"""

import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd.arena.errors import AXIAL, ROUNDING, errors_of
from fctd.arena.exact_hole import ExactHole
from fctd.arena.frames import RADIUS, Frame, case_of, frame
from fctd.arena.method import ContactMethod, built, settings_of
from fctd.arrays import Array, Contacts
from fctd.case.errors import InputError
from fctd.case.load import Case

# Vertical, a build of 12°/30 m in a plane, a turn of 8°/30 m in space; the hole narrows within the build.
STATIONS: list[list[float]] = [
    [0, 0, 0], [60, 0, 0], [90, 12, 0], [120, 24, 0], [150, 24, 20], [180, 24, 40], [240, 24, 40],
]  # fmt: skip
SHOE = 105.0  # [m]
SIZES = [(SHOE, 0.3112), (240.0, 0.2159)]
REGIONS = {
    "the straight hole": (5.0, 55.0),
    "the build": (62.0, 118.0),
    "the turn": (122.0, 178.0),
    "the shoe": (SHOE - 2.0, SHOE + 2.0),
    "the first metre": (0.0, 1.0),
    "the last metre": (239.0, 240.0),
}
# Bends all along, nine kilometres away.
FAR: list[list[float]] = [[0.0, 0.0, 0.0], *([1000.0 * k, 60.0, 90.0 if k % 2 else 40.0] for k in range(1, 10))]
COUNT = 120  # points
SAME = 1e-9  # [m]: answers to one question
# The cost of a point in a hole that is 37 times as long may be so many times as large before a remark is made.
SLOWER = 8.0


class Finding(NamedTuple):
    """A demand, and what is wrong; nothing where it is kept.  remark : what does not break the contract."""

    demand: str
    says: str
    remark: bool = False

    @property
    def kept(self) -> bool:
        """Whether nothing is wrong, but for a remark."""
        return not self.says or self.remark


class Trial:
    """A method with options, and its answers in the holes of the contract."""

    def __init__(self, method: type[ContactMethod], options: Mapping[str, Any]) -> None:
        self.method, self.options = method, dict(options)
        self.near = cache(lambda: self.build(case_of("contract", STATIONS, SIZES)))
        self.far = cache(self._build_far)

    def build(self, case: Case) -> ContactMethod:
        """The method for the hole of a case, with its options."""
        return built(self.method, case, self.options)

    def _build_far(self) -> ContactMethod:
        """The method for nine kilometres, which it may refuse in words."""
        try:
            return self.build(case_of("far", FAR, [(9000.0, 0.2159)]))
        except InputError as error:
            raise LeftOutError(f"it refuses a hole of nine kilometres: {error}") from error

    def ask(self, method: ContactMethod, points: Array, radii: Array) -> Contacts:
        """The answers to points; BrokenError where they are none."""
        n, found = len(points), method.query(points.copy(), radii.copy())
        try:
            parts = [np.asarray(part, dtype=float) for part in found]
        except (TypeError, ValueError):
            raise BrokenError(
                f"query returns {type(found).__name__}: return Contacts(penetration, normal, md)"
            ) from None
        if (shapes := [part.shape for part in parts]) != [(n,), (n, 3), (n,)]:
            wanted = f"({n},), ({n}, 3), ({n},)"
            raise BrokenError(
                f"query returns the shapes {', '.join(map(str, shapes))} for {n} points: expected {wanted}"
            )
        hits = Contacts(*parts)
        if (nan := np.isnan(hits.penetration)).any():
            raise BrokenError(
                f"the penetration of {_share(nan)} points is not a number: a point without contact has −inf, or its "
                "clearance below 0"
            )
        touching = hits.penetration > 0
        if not np.isfinite(hits.penetration[touching]).all():
            raise BrokenError("a penetration is infinite: expected the depth of the point in the wall, in metres")
        if not (np.isfinite(hits.normal[touching]).all() and np.isfinite(hits.md[touching]).all()):
            raise BrokenError("the normal or md of a contact is not a number")
        return hits


class BrokenError(Exception):
    """What is wrong with a method, as a sentence."""


class LeftOutError(Exception):
    """Why a method refuses a hole that it need not take, as a sentence."""


def _share(part: NDArray[Any]) -> str:
    return f"{int(np.sum(part))} of {len(part)}"


@cache
def hole() -> ExactHole:
    """The exact hole of the contract."""
    return ExactHole(case_of("contract", STATIONS, SIZES).wellbore)


@cache
def points(region: str, count: int = COUNT) -> Frame:
    """Points near the wall of a region of that hole."""
    return frame(hole(), count, md=REGIONS[region], seed=7)


def answers(trial: Trial) -> str:
    """Shapes and numbers of the answers, for many points, for one and for none."""
    near = points("the build")
    for count in (COUNT, 1, 0):
        trial.ask(trial.near(), near.places[:count], near.radii[:count])
    return ""


def directions(trial: Trial) -> str:
    """Unit normals from the axis to the wall."""
    for region in ("the straight hole", "the build"):
        near = points(region)
        hits = trial.ask(trial.near(), near.places, near.radii)
        touching = hits.penetration > 0
        lengths = np.linalg.norm(hits.normal[touching], axis=1)
        if not np.allclose(lengths, 1, atol=1e-6):
            return f"normals have lengths from {lengths.min():.3g} to {lengths.max():.3g}: divide them by their lengths"
        inwards = np.sum(hits.normal * near.exact.normal, axis=1)[touching] < 0
        if 2 * np.count_nonzero(inwards) > len(inwards):
            return f"normals of {_share(inwards)} contacts point into the hole: expected from the axis to the wall"
    return ""


def units(trial: Trial) -> str:
    """Penetrations in metres, above 0 in the wall, growing beyond it."""
    near = points("the straight hole")
    hits, exact = trial.ask(trial.near(), near.places, near.radii), near.exact
    deep = exact.penetration > 0.002
    found = hits.penetration[deep]
    if (found <= 0).mean() > 0.5:
        clear = hits.penetration[exact.penetration < -0.002]
        if (clear > 0).mean() > 0.5:
            return "a clear point has a penetration above 0, and one in the wall has none: turn the sign"
        return ""  # contacts are missed, which another demand tells
    ratio = float(np.median(found / exact.penetration[deep]))
    for unit, factor in (("millimetres", 1e3), ("centimetres", 1e2), ("inches", 1 / 0.0254), ("feet", 1 / 0.3048)):
        if 0.8 < ratio / factor < 1.25:
            return f"penetrations are {ratio:.3g} times the exact ones: they seem to be in {unit}, expected metres"
    return ""


def accuracy(trial: Trial) -> str:
    """Penetration and normal within ``error_bound``, and no contact missed or false, in bends, at shoe and ends."""
    said: list[str] = []
    for region in REGIONS:
        near = points(region)
        said += _off(trial.near(), near, trial.ask(trial.near(), near.places, near.radii), region)
    return "; ".join(said[:3])


def _off(method: ContactMethod, near: Frame, hits: Contacts, where: str) -> Iterator[str]:
    """What is beyond the bound of a method at the points of a frame."""
    off = errors_of(method, near, hits)
    for kind, wrong in (("missed", off.missed), ("false", off.false)):
        if wrong.any():
            deepest = 1e3 * float(np.abs(near.exact.penetration[wrong]).max())
            yield f"{_share(wrong)} points in {where} have a {kind} contact, up to {deepest:.3g} mm beyond touching"
    for name, found, bound, unit, scale in (
        ("penetration", np.abs(off.depth), off.bound, "mm", 1e3),
        ("normal", off.angle, off.turn, "°", 180 / np.pi),
    ):
        worst = int(np.nanargmax(np.where(off.known, found - bound, -np.inf)))
        if off.known.any() and found[worst] > bound[worst]:
            yield (
                f"the {name} in {where} is off by {scale * found[worst]:.3g} {unit}, where error_bound allows "
                f"{scale * bound[worst]:.3g} {unit}"
            )
    aside = np.abs(off.md) > near.hole.curvatures(near.md) * near.hole.radii(near.md) * AXIAL + 1e-3
    if (aside & off.known).any():
        yield f"md in {where} is off by up to {np.nanmax(np.abs(off.md)):.3g} m"


def clear_points(trial: Trial) -> str:
    """Clearance where the method says that it gives it, else −inf without normal and depth."""
    near = points("the build")
    hits, gives = trial.ask(trial.near(), near.places, near.radii), trial.near().gives_clearance
    clear = hits.penetration <= 0
    if gives and not np.isfinite(hits.penetration[clear]).all():
        return "gives_clearance is true, but a clear point has no clearance: return it, or set gives_clearance to false"
    if not gives and not (hits.penetration[clear] == -np.inf).all():
        return "gives_clearance is false, but a clear point has a finite penetration: return −inf there"
    return ""


def beyond(trial: Trial) -> str:
    """Points deep in the wall, and past both ends of the hole, which goes on straight there."""
    method, near = trial.near(), points("the build", 30)
    depth = 0.08 if method.gives_clearance else 0.7 * RADIUS
    deep = near.places + (depth - near.exact.penetration)[:, None] * near.exact.normal
    there = Frame(near.hole, near.md, deep, near.radii)
    said = list(_off(method, there, trial.ask(method, deep, near.radii), "the build, deep in the wall"))
    for where, md in (("the two metres above the hole", (-2.0, -0.1)), ("the two metres past its end", (240.1, 242.0))):
        past = frame(near.hole, 30, md=md)
        said += _off(method, past, trial.ask(method, past.places, past.radii), where)
    return "; ".join(said[:2])


def own_radii(trial: Trial) -> str:
    """Each point has its own radius."""
    near = points("the turn")
    radii = np.where(np.arange(COUNT) % 2, RADIUS, RADIUS + 0.02)
    mixed = Frame(near.hole, near.md, near.places, radii)
    return "; ".join(_off(trial.near(), mixed, trial.ask(trial.near(), mixed.places, radii), "the turn, two radii"))


def order(trial: Trial) -> str:
    """The answer to a point hangs neither on the other points nor on earlier questions."""
    method, near = trial.near(), points("the build")
    first = trial.ask(method, near.places, near.radii)
    elsewhere = points("the turn")
    trial.ask(method, elsewhere.places, elsewhere.radii)
    again = trial.ask(method, near.places, near.radii)
    turned = np.arange(COUNT)[::-1]
    other_way = trial.ask(method, near.places[turned], near.radii[turned])
    alone = trial.ask(method, near.places[3:4], near.radii[3:4])
    bound = errors_of(method, near, first).bound
    for words, found, of in (
        ("after other points were asked", again, slice(None)),
        ("in another order", other_way, turned),
        ("when it is asked alone", alone, slice(3, 4)),
    ):
        both = np.isfinite(found.penetration) & np.isfinite(first.penetration[of])
        apart = np.abs(found.penetration[both] - first.penetration[of][both])
        allowed = (2 * (bound[of] - ROUNDING) + SAME)[both]
        if (np.isfinite(found.penetration) != np.isfinite(first.penetration[of])).any() or (apart > allowed).any():
            return f"the answer to a point is another one {words}, by up to {1e3 * apart.max(initial=0):.3g} mm"
    return ""


def plain_input(trial: Trial) -> str:
    """Points that are not contiguous in memory; they stay what they are."""
    near = points("the turn")
    wide = np.zeros((COUNT, 6))
    wide[:, ::2] = near.places
    given, radii = wide[:, ::2], near.radii.copy()
    trial.near().query(given, radii)
    if not (np.array_equal(given, near.places) and np.array_equal(radii, near.radii)):
        return "query changes the points or radii that it is given: copy what it writes to"
    found = np.asarray(trial.near().query(given, radii)[0], dtype=float)
    if not np.array_equal(found, trial.ask(trial.near(), near.places, near.radii).penetration):
        return "points that are not contiguous in memory have other answers: np.ascontiguousarray helps"
    return ""


def threads(trial: Trial) -> str:
    """Two methods in two threads have the answers of one."""
    near = points("the build")
    alone = trial.ask(trial.near(), near.places, near.radii)

    def ask(_: int) -> Contacts:
        method = trial.build(case_of("contract", STATIONS, SIZES))
        return trial.ask(method, near.places, near.radii)

    with ThreadPoolExecutor(2) as pool:
        for found in pool.map(ask, range(2)):
            if not np.allclose(found.penetration, alone.penetration, atol=SAME):
                return "built and asked in two threads at once, it has other answers: it shares what it writes to"
    return ""


def far_away(trial: Trial) -> str:
    """Nine kilometres from the origin the errors are those at the surface."""
    there = frame(ExactHole(case_of("far", FAR, [(9000.0, 0.2159)]).wellbore), COUNT, md=(8300.0, 8990.0), seed=7)
    return "; ".join(_off(trial.far(), there, trial.ask(trial.far(), there.places, there.radii), "the ninth kilometre"))


def options(trial: Trial) -> str:
    """Every value that the method proposes for its options can be built and answers."""
    for chosen in settings_of(trial.method):
        try:
            method = built(trial.method, case_of("contract", STATIONS, SIZES), chosen)
        except InputError as error:
            return f"its own setting {chosen} is refused: {error}"
        near = points("the build", 20)
        trial.ask(method, near.places, near.radii)
    return ""


def search(trial: Trial) -> str:
    """A search that does not begin at the top for each point."""
    near = points("the turn")
    there = frame(ExactHole(case_of("far", FAR, [(9000.0, 0.2159)]).wellbore), COUNT, md=(8300.0, 8990.0), seed=7)
    short, long = (_cost(method, each) for method, each in ((trial.near(), near), (trial.far(), there)))
    if long > SLOWER * short:
        times = f"{long / short:.1f} times as much in a hole 37 times as long"
        return f"a point costs {times}: keep the place of each point, or search a tree"
    return ""


def _cost(method: ContactMethod, near: Frame) -> float:
    """Processor time of the fastest of some queries [s]."""
    taken = []
    for _ in range(5):
        given = near.places.copy(), near.radii.copy()
        began = time.process_time()
        method.query(*given)
        taken.append(time.process_time() - began)
    return max(min(taken[1:]), 1e-6)


Demand = Callable[[Trial], str]
DEMANDS: tuple[Demand, ...] = (
    answers, directions, units, accuracy, clear_points, beyond, own_radii, order, plain_input, threads, far_away,
    options, search,
)  # fmt: skip
REMARKS: tuple[Demand, ...] = (search,)


def held(demand: Demand, trial: Trial) -> Finding:
    """What a demand finds; whatever a method raises is a finding."""
    words = (demand.__doc__ or "").rstrip(".")
    try:
        return Finding(words, demand(trial), demand in REMARKS)
    except BrokenError as error:
        return Finding(words, str(error))
    except LeftOutError as error:
        return Finding(words, str(error), remark=True)
    except Exception as error:  # of a method from anywhere
        return Finding(words, f"it raises {type(error).__name__}: {error}")


def examine(method: type[ContactMethod], chosen: Mapping[str, Any] = {}) -> Iterator[Finding]:
    """The findings of all demands of a method with options, as each is made.

    Raises InputError where the method refuses to be built: for an option, or for a package that is not installed.
    """
    trial = Trial(method, chosen)
    try:
        trial.near()
    except InputError:
        raise
    except Exception:  # a finding of every demand
        pass
    for demand in DEMANDS:
        yield held(demand, trial)
