"""Compare contact methods and engines on any well: errors and cost of a point in its hole, and loads of its string."""

import subprocess
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from datetime import date

import numpy as np
from numpy.typing import NDArray

from fctd.arena.frames import Frame, frame
from fctd.arena.method import ContactMethod
from fctd.arena.result import Comparison, Counts, Row
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.mechanics.faults import UnstableError
from fctd.steady.counts import ends_of
from fctd.steady.refine import refine
from references import contact, engines, packages
from references.contact.reference_hole import EXACT, hole_of
from references.contact.tube_mesh import MeshMethod
from references.engines import StepOptions, StringEngine, gate
from references.engines.own import Fctd
from references.methods import asked
from references.methods.in_hole import POINTS, contract_of, costs, errors
from references.methods.loop import (
    OVERRUN,
    OverrunError,
    Swapped,
    Tell,
    failed_checks,
    loads_of,
    mean_forces,
    step_cost,
    timed_run,
)
from references.methods.stopping import remembering
from references.methods.window import WHOLE, Plan, plan_of
from references.timing.footprint import measured_apart
from references.timing.stopwatch import machine

BUDGET, QUICK = 300.0, 60.0  # [s] by the clock; the longest of a quick comparison
OWN = "fctd"  # the engine with its own arcs, with which others are compared
ARCS = "arcs"  # the row of them as a contact method, if there is one
CALL = 1000  # points of a call in the race, at most; as many as the string has contact points
TOLERANCE = 0.01  # of the counts of segments that suffice
FOR_LOADS = 0.5  # share of the budget that contract and memory leave to the loads
SPENT = "the budget is spent"
MESHES = "a mesh, which has frames alone in a quick comparison"
# Called with what is done, how many of it, and of how many.
Progress = Callable[[str, float, float], object]


def compare_methods(
    case: Case, methods: Iterable[asked.Wanted] = (asked.ALL,), engine: Iterable[asked.Wanted] = (), *,
    operation: str | None = None, budget: float = BUDGET, quick: bool = False,
    segments: str | Sequence[int] | None = None, progress: Progress = lambda *_: None,
) -> Comparison:  # fmt: skip
    """Compare contact methods and engines on the hole, string and operation of a case.

    methods, engine : names, texts "name,key=value", or pairs of name and options; "all" stands for all that are
    installed.  operation : its number in the case, from 1, or its kind.  budget : wall-clock time [s] in which work
    may begin: errors and costs, contract and memory in its first half, and loads, the cheapest first, that are expected
    to fit what is left.  quick : a first look, of a minute: meshes have no loads, the contract no long holes, and
    memory is not measured.  segments : a range of counts, as of ``fctd.refine``, over which the loads of the window's
    operation are found beside all that, by the engine's own steady string.

    Ctrl-C ends it with the rows so far.  Raises InputError for a case that cannot be simulated, and for an unknown name
    or option; whatever else fails is a row with its reason.
    """
    began = time.perf_counter()
    progress("the engine's own loads", 0, 1)
    ends = None if segments is None else ends_of(segments)
    rows, missing = asked.rows_of("contact", methods)
    more, absent = asked.rows_of("engine", engine)
    preset = preset_of(case, operation, quick=quick)
    others = [row for row in more if row.name != OWN or row.options]
    comparing = Comparing(preset, rows, others, min(budget, QUICK) if quick else budget, quick, progress)
    comparing.began = began
    comparison = comparing.comparison
    comparison.digest = case.digest
    if missing + absent:
        comparison.notes.append(f"not installed, and so left out: {', '.join(dict.fromkeys(missing + absent))}")
    try:
        with remembering() as again:
            comparing.again = again
            comparing.compare()
            if ends is not None and preset.plan is not None:
                comparing.count(preset.plan, ends)
    except KeyboardInterrupt:
        comparison.interrupted = True
        for row in comparison.rows:
            if row.loads is None and not row.loads_reason and row.status in ("measured", "not run"):
                row.loads_reason = "interrupted"
    comparison.seconds = time.perf_counter() - began
    return comparison


@dataclass(frozen=True)
class Preset:
    """What is measured.

    case, near : a hole, and points near its wall for errors and costs; reference : of the errors.  regions : names (n,)
    of the parts of the hole in which the points lie.  sizes : points of a call.  contract, memory : whether methods
    are held to the contract; the rows whose memory is measured.  plan : of the loads, None where there are none; meshes
    : whether meshes have loads.
    """

    case: Case
    near: Frame
    reference: str = EXACT
    regions: NDArray[np.str_] | None = None
    sizes: tuple[int, ...] = (CALL,)
    contract: bool = False
    memory: Callable[[Row], bool] = lambda _: False
    plan: Plan | None = None
    meshes: bool = True


def preset_of(case: Case, operation: str | None = None, *, quick: bool = False, periods: int = WHOLE) -> Preset:
    """All that can be measured on the hole, string and operation of a case; see ``compare_methods``."""
    plan = plan_of(case, operation, periods)
    hole, reference = hole_of(plan.case)
    near = frame(hole, POINTS, radius=float(np.median(plan.own_radii)))
    return Preset(
        plan.case, near, reference, sizes=(min(plan.described.segments, CALL),), contract=True,
        memory=lambda _: not quick, plan=plan, meshes=not quick,
    )  # fmt: skip


class Comparing:
    """A comparison that is being made; ``comparison`` has what is known so far."""

    def __init__(
        self, preset: Preset, methods: list[Row], others: Sequence[Row] = (), budget: float = np.inf,
        quick: bool = False, progress: Progress = lambda *_: None,
    ) -> None:  # fmt: skip
        self.preset, self.methods, self.engines, self.quick, self._tell = preset, methods, others, quick, progress
        self.budget, self.began = budget, time.perf_counter()
        self.again: Callable[[], None] = lambda: None  # raises a Ctrl-C that a library has caught
        self.built: dict[str, ContactMethod] = {}
        self.build_s: dict[str, float] = {}  # by the clock, with imports
        self.busy = 1.0  # time by the clock over that of the processor, on a machine that others use
        plan, rows = preset.plan, [*methods, *others]
        if plan is not None:
            self.md = plan.own.profile["md_m"].to_numpy(float)[1:]
            about = packages.about(OWN)
            self.own = Row(kind="engine", name=OWN, package=OWN, version=about.version, licence=about.licence)
            rows.insert(0, self.own)
        self.comparison = Comparison(
            case=preset.case.name, digest=preset.case.digest, reference=preset.reference,
            window=None if plan is None else plan.described, md_m=[] if plan is None else self.md.tolist(), rows=rows,
            budget_s=budget, quick=quick, units=preset.case.system, date=date.today().isoformat(), machine=machine(),
            notes=[] if plan is None else list(plan.notes),
        )  # fmt: skip

    def compare(self) -> None:
        """Fill the rows: what is cheap first."""
        if self.preset.plan is not None:
            self._own_loads(self.preset.plan)
        asked = [row for row in self.methods if row.status == "not run"]
        for k, row in enumerate(asked):
            self.progress(f"{row.label}: errors", k, len(asked))
            self._frames(row)
        able = [row for row in asked if row.label in self.built]
        self.progress("cost of a point", 0, 1)
        began, worked = time.perf_counter(), time.process_time()
        found, self.comparison.kernel_ns = costs(self.built, self.preset.near, self.preset.sizes, ARCS)
        self.busy = max((time.perf_counter() - began) / max(time.process_time() - worked, 1e-9), 1.0)
        for row in able:
            row.costs = found[row.label]
        held = [row for row in asked if self.preset.contract and row.status in ("measured", "failed")]
        for k, row in enumerate(held):
            self.progress(f"{row.label}: contract", k, len(held))
            self._contract(row)
        weighed = [row for row in able if self.preset.memory(row)]
        for k, row in enumerate(weighed):
            self.progress(f"{row.label}: memory", k, len(weighed))
            self._memory(row)
        if self.preset.plan is not None:
            self._loops(self.preset.plan, able)

    def count(self, plan: Plan, ends: tuple[int, int]) -> None:
        """The loads of the window's operation over a range of counts; a note says why there are none."""
        moved = plan.case.operations[0]
        self.progress("numbers of segments", 0, 1)
        try:
            found = refine(plan.case, TOLERANCE, moved.kind, max(moved.start_md, moved.end_md), segments=ends)
        except InputError as error:
            self.comparison.notes.append(f"no range of counts of segments: {error}")
            return
        assert found.orders is not None
        steps = found.steps[found.steps["stage"] == "counts"]
        tables = {"steps": steps.to_dict("records"), "orders": found.orders.to_dict("records")}
        self.comparison.counts = Counts.model_validate({"tolerance": TOLERANCE, **tables})

    def progress(self, what: str, done: float, total: float) -> None:
        """Tell what is done; raises a Ctrl-C that a library has caught."""
        self.again()
        self._tell(what, done, total)

    @property
    def left(self) -> float:
        """Time of the budget that is left [s]."""
        return self.budget - (time.perf_counter() - self.began)

    @property
    def loads_wait(self) -> bool:
        """Whether what is left of the budget is for the loads."""
        return self.left < FOR_LOADS * self.budget

    def _own_loads(self, plan: Plan) -> None:
        """The loads of the engine's own wall, and the processor time [s] of such a run."""
        began, engine = time.process_time(), Fctd(StepOptions())
        run, stepper = timed_run(plan, engine)
        self.own.predicted_s = self.alone = time.process_time() - began
        self.forces = mean_forces(stepper)
        self.shared = failed_checks(run)
        self.own.loads = loads_of(run, stepper, self.forces, self.md, self.shared)
        self.own.status = "measured"
        self.own.broken = _broken(engine)

    def _frames(self, row: Row) -> None:
        """Build a method, and find its errors in this hole; whatever it raises is a reason."""
        if self.left < 0:
            row.loads_reason = SPENT
            return
        try:
            began = time.perf_counter()
            method = contact.build(row.name, self.preset.case, **row.options)
            self.build_s[row.label] = time.perf_counter() - began
            row.pieces = int(method.pieces)
            row.errors, row.regions = errors(method, self.preset.near, self.preset.regions)
            if row.errors.points < len(self.preset.near.md):
                row.remarks.append(f"errors of the first {row.errors.points} points alone, since it is slow")
        except InputError as error:
            row.status, row.reason = "refused", str(error)
        except Exception as error:  # of a method from anywhere
            row.status, row.reason = "failed", f"{type(error).__name__}: {error}"
        else:
            self.built[row.label], row.status = method, "measured"

    def _contract(self, row: Row) -> None:
        """Hold a method to the contract."""
        if self.loads_wait:
            row.remarks.append("not held to the contract: half of the budget is spent")
            return
        found = contact.REGISTRY.options(row.name, row.options).model_dump(exclude_unset=True)
        row.broken, remarks = contract_of(contact.method_class(row.name), found, quick=self.quick)
        row.remarks += remarks

    def _memory(self, row: Row) -> None:
        """Memory and time of building a method, in a process of its own."""
        if row.cost is None:
            return
        if self.loads_wait:
            row.remarks.append("memory was not measured: half of the budget is spent")
            return
        if 2 * self.build_s[row.label] > self.left:
            row.remarks.append(f"memory was not measured: it took {self.build_s[row.label]:.3g} s to build")
            return
        try:
            row.memory_MB, row.build_s = measured_apart(row.name, self.preset.case, row.options)
        except (subprocess.CalledProcessError, TypeError, ValueError) as error:
            row.remarks.append(f"memory was not measured: {type(error).__name__} in a process of its own")

    def _loops(self, plan: Plan, able: list[Row]) -> None:
        """Loads, the cheapest first, while the expected time fits the budget."""
        steps, points = plan.described.steps, len(self.md)
        waiting: list[Row] = []
        for row in able:
            if not self.preset.meshes and isinstance(self.built[row.label], MeshMethod):
                row.loads_reason = MESHES
            elif row.cost is None:
                row.status, row.reason = "failed", "it raised an error where its points were timed"
            else:
                row.predicted_s = self.alone + 1e-9 * row.cost.point_ns.median * points * steps
                waiting.append(row)
        for k, row in enumerate(self.engines):
            if row.status == "not run":
                self.progress(f"{row.label}: gate", k, len(self.engines))
                if self._hold(plan, row):
                    waiting.append(row)
        waiting.sort(key=lambda row: row.predicted_s or 0.0)
        for k, row in enumerate(waiting):
            expected = self.busy * (row.predicted_s or 0.0)
            if expected > self.left:
                left = max(self.left, 0.0)
                row.loads_reason = f"expected to take {expected:.3g} s by the clock, and {left:.3g} s are left"
                continue

            def tell(share: float, label: str = row.label, done: int = k) -> None:
                self.progress(f"{label}: loads", done + share, len(waiting))

            self._loads(plan, row, tell)

    def _hold(self, plan: Plan, row: Row) -> bool:
        """Hold an engine to the gate, and time some of its steps; False where it cannot run the case."""
        if self.left < 0:
            row.loads_reason = SPENT
            return False
        try:
            engine = engines.build(row.name, **row.options)
            row.predicted_s = self.alone + step_cost(plan, engine)
            row.broken = _broken(engine)
        except InputError as error:
            row.status, row.reason = "refused", str(error)
            return False
        except Exception as error:  # of an engine from anywhere
            row.status, row.reason = "failed", f"{type(error).__name__}: {error}"
            return False
        row.status = "measured"
        return True

    def _loads(self, plan: Plan, row: Row, tell: Tell) -> None:
        """The loads of a method or an engine over the window."""
        try:
            engine: StringEngine = (
                Swapped(self.built[row.label]) if row.kind == "contact" else engines.build(row.name, **row.options)
            )
            run, stepper = timed_run(plan, engine, tell, OVERRUN * (row.predicted_s or np.inf) + 1.0)
        except InputError as error:
            row.loads_reason = str(error)
            row.status = "refused" if row.kind == "engine" else row.status
        except UnstableError as error:
            row.loads_reason, row.status = str(error), "failed"
        except OverrunError as error:
            row.loads_reason = f"stopped: {error}, expected {row.predicted_s:.3g} s for all"
        except Exception as error:  # of a method or an engine from anywhere
            row.loads_reason = f"{type(error).__name__}: {error}"
            row.status = "failed"
        else:
            row.loads = loads_of(run, stepper, self.forces, self.md, self.shared)


def _broken(engine: StringEngine) -> list[str]:
    """The rules of the gate that an engine breaks."""
    return [str(rule) for rule in gate.examine(engine) if not rule.passed]
