"""The work of one sample: a chart, an equilibrium, a search for segments, or a run in time, as rows of the results.

Every kind of work calls ``tick`` between its iterations or records, which raises ``TooLongError`` when the sample has
used its time.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.message import within
from fctd.model.depths import depth_of, depths_of
from fctd.model.operations import rates_of_all
from fctd.results.columns import LOADS
from fctd.results.doing import does
from fctd.results.notes import codes_of
from fctd.simulation.simulate import Simulation
from fctd.steady.refine import refine
from fctd.steady.torque_drag import chart_rows
from fctd.sweep.spec import WorkSpec

Row = dict[str, Any]
Tick = Callable[[], None]


class TooLongError(RuntimeError):
    """A sample has used its time."""


@dataclass(frozen=True)
class Task:
    """The work with its depths [m], which are those of the sweep's case."""

    spec: WorkSpec
    depths: tuple[float, ...]


def task_of(spec: WorkSpec, case: Case) -> Task:
    """The work of a sweep; raises InputError for depths or rates that the case cannot have."""
    depths = () if spec.depths is None else tuple(depths_of(spec.depths, case, "work.depths"))
    if spec.bit_depth is not None:
        depths = (depth_of(spec.bit_depth, case, "work.bit_depth"),)
    if spec.kind != "simulate":
        rates_of_all(case, spec.operations, spec.speed, spec.rpm, spec.flow)
    elif not case.operations:
        raise InputError('operations of the case, which kind = "simulate" runs', key="work.kind", value="simulate")
    return Task(spec, depths)


def misfit(case: Case, task: Task) -> InputError | None:
    """Why string and hole fit at none of the depths; None where they fit at one, and for work without depths."""
    from fctd.steady.equilibrium import Solver

    if not task.depths:
        return None
    solver, found = Solver(case), list[InputError]()
    for depth in task.depths:
        try:
            solver.lay_out(depth)
        except InputError as error:
            found.append(error)
        else:
            return None
    return found[0]


def chart(case: Case, task: Task, tick: Tick) -> list[Row]:
    """A row for every operation and depth, as of ``fctd chart``."""
    spec = task.spec
    return chart_rows(
        case,
        spec.operations,
        task.depths,
        None,
        spec.speed,
        spec.rpm,
        spec.flow,
        progress=lambda done, total: tick(),
        threads=1,
    )


def equilibrium(case: Case, task: Task, tick: Tick) -> list[Row]:
    """A row for every operation: its loads, and the extremes of its profile."""
    from fctd.steady.equilibrium import Solver

    rates = rates_of_all(case, task.spec.operations, task.spec.speed, task.spec.rpm, task.spec.flow)
    solver, rows = Solver(case), list[Row]()
    laid = solver.lay_out(task.depths[0])
    for kind in task.spec.operations:
        point = solver.solve_string(kind, rates[kind], laid)
        tick()
        none = float("nan")
        row: dict[str, Any] = {"operation": kind, "bit_depth_m": task.depths[0], **does(case, kind, rates[kind])}
        row |= {load.name: load.value(point) if point.answered else none for load in LOADS}
        extremes = {"min_effective_tension_N": none, "max_contact_force_N": none, "max_von_mises_Pa": none}
        if point.answered:
            profile = point.profile
            extremes["min_effective_tension_N"] = float(profile["effective_tension_N"].min())
            extremes["max_contact_force_N"] = float(profile["contact_force_N"].max())
            extremes["max_von_mises_Pa"] = float(profile["von_mises_Pa"].max())
        row |= extremes | point.buckling.columns()
        row |= {"status": str(point.status), "iterations": point.iterations}
        rows.append(row | {"notes": codes_of(point.notes), "reason": point.message or "none"})
    return rows


def refined(case: Case, task: Task, tick: Tick) -> list[Row]:
    """One row: the number of segments that the tolerance needs, and the estimated error."""
    spec = task.spec
    found = refine(
        case, spec.tolerance, spec.operations, task.depths[0], speed=spec.speed, rpm=spec.rpm, flow=spec.flow,
        progress=lambda level: tick(),
    )  # fmt: skip
    return [
        {
            "operation": ", ".join(spec.operations),
            "bit_depth_m": task.depths[0],
            "segments": found.segments,
            "shortest_m": found.shortest,
            "error": found.error,
            "status": str(found.status),
            "reason": found.message or "none",
        }
    ]


def simulated(case: Case, task: Task, tick: Tick) -> list[Row]:
    """A row for every operation of a run: means and swings of its loads, and the severity of stick-slip.

    ``stick_slip_severity`` is half the difference between the fastest and the slowest rotation of the bit over the mean
    rotation of the top, in the last half of an operation: 0 without a swing, 1 where the bit comes to rest.
    """
    simulation = Simulation(case, settling=lambda *_: tick())
    for _ in simulation:
        tick()
    result = simulation.result()
    history, rows = result.history, list[Row]()
    for operation in result.operations.to_dict("records"):
        middle = 0.5 * (operation["start_s"] + operation["end_s"])
        late = history[(history["time_s"] > middle + 1e-6) & (history["time_s"] <= operation["end_s"] + 1e-6)]
        top = float(late["top_rpm"].mean()) if len(late) else 0.0
        swing = 0.5 * float(late["bit_rpm"].max() - late["bit_rpm"].min()) if len(late) else 0.0
        row: Row = {str(name): value for name, value in operation.items()}
        row["stick_slip_severity"] = swing / top if top > 0 else float("nan")
        row["energy_error"] = float(result.run["energy_error"])
        row |= {"status": str(result.status), "reason": result.message or "none"}
        rows.append(row)
    if not rows:
        raise InputError(f"a run that begins ({result.status}: {within(result.message)})")
    return rows


def begin_run(case: Case) -> None:
    """Settle the string of a run and take a step of it, which compiles what runs need."""
    simulation = Simulation(case)
    simulation.start()
    simulation.run.advance(simulation.intervals[0].motion, simulation.run.step)


WORK: Final[Mapping[str, Callable[[Case, Task, Tick], list[Row]]]] = {
    "chart": chart,
    "equilibrium": equilibrium,
    "refine": refined,
    "simulate": simulated,
}
