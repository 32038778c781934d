"""The command line, also ``python -m fctd``: the application, and ``fctd simulate CASE``."""

import re
import sys
from collections.abc import Callable
from pathlib import Path

import typer
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.table import Table

from fctd.case import Case
from fctd.cli_compile import compile_command, telling
from fctd.cli_options import (
    BAD_INPUT,
    FAILED,
    INTERRUPTED,
    CaseFile,
    Csv,
    Friction,
    Out,
    Overrides,
    Quiet,
    messages,
    read_case,
    screen,
    spare_sources,
)
from fctd.cli_refine import refine_command
from fctd.cli_steady import chart_command, equilibrium_command
from fctd.errors import InputError
from fctd.results import TABLES, SimulationResult
from fctd.simulate import simulate
from fctd.wall_query import WallQuery

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    help="Fast contact torque and drag of a stiff drill string.",
)


@app.command("simulate")
def simulate_command(
    case_file: CaseFile,
    out: Out = None,
    overrides: Overrides = [],  # noqa: B006 (typer copies it)
    friction: Friction = None,
    csv: Csv = False,
    quiet: Quiet = False,
) -> None:
    """Run the operations of a case and write history, profile and energy tables."""
    simulate_file(case_file, out, overrides, friction, csv, quiet)


def simulate_file(
    case_file: Path,
    out: Path | None,
    overrides: list[str],
    friction: float | None,
    csv: bool,
    quiet: bool,
    contact: Callable[[Case], WallQuery] | None = None,
) -> None:
    """What ``simulate`` does; ``contact`` builds another contact method for the case (see fctd.simulate)."""
    case = read_case(case_file, overrides, friction)
    method = None if contact is None else contact(case)
    folder = out or Path(re.sub(r"[^\w.-]+", "-", f"{case.name}-result"))
    try:  # before hours of computing, not after
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"a folder that can be written ({error.strerror})", key="--out", value=folder) from None
    for name in TABLES:
        spare_sources(case, folder / f"{name}.csv" if csv else None, "--out")
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.completed:.0f}/{task.total:.0f} s simulated, {task.fields[factor]} × real time"),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=messages, disable=quiet, transient=True) as bar:
        task = bar.add_task("compiling, settling", total=1.0, factor="–")

        def show(now: float, total: float, factor: float) -> None:
            bar.update(task, description=case.name, total=total, completed=now, factor=f"{factor:.0f}")

        result = simulate(case, progress=show, contact=method)
    try:  # files first, since whoever reads the screen may close it; the screen also where a file fails
        written = result.save(folder, csv=csv)
    finally:
        _summarise(result)
    screen.print(f"Written: {', '.join(str(p) for p in written)}", soft_wrap=True, highlight=False)
    if result.status == "interrupted":
        raise typer.Exit(INTERRUPTED)
    if result.status != "completed":
        raise typer.Exit(FAILED)


def _summarise(result: SimulationResult) -> None:
    """Print the state at the end and the numbers of the run."""
    if result.message:
        messages.print(f"[bold]{result.status}[/bold]: {result.message}", highlight=False, soft_wrap=True)
    if len(result.history):
        last = result.history.iloc[-1]
        table = Table(title=f"{result.case.name}: {last['operation']}, bit at {last['bit_depth_m']:.1f} m")
        for name in ("hook load kN", "surface torque kN·m", "Σ r μ F_n kN·m", "contact force kN", "contacts"):
            table.add_column(name, justify="right")
        table.add_row(
            f"{last['hookload_N'] / 1e3:.1f}",
            f"{last['surface_torque_N_m'] / 1e3:.3f}",
            f"{last['sum_r_mu_fn_N_m'] / 1e3:.3f}",
            f"{last['total_contact_force_N'] / 1e3:.1f}",
            f"{last['contact_count']}",
        )
        screen.print(table)
    run = result.run
    screen.print(
        f"{run['segments']} segments, step {1e3 * run['step_s']:.3g} ms, {run['steps']} steps, "
        f"{run['simulated_s']:.0f} s simulated in {run['wall_s']:.2f} s "
        f"({run['real_time_factor']:.0f} × real time), "
        f"energy error {run['energy_error']:.1e}",
        highlight=False, soft_wrap=True,
    )  # fmt: skip


app.command("equilibrium")(equilibrium_command)
app.command("chart")(chart_command)
app.command("refine")(refine_command)
app.command("compile")(compile_command)


def main() -> None:
    """Entry point."""
    run(app)


def run(commands: typer.Typer) -> None:
    """Run a command line: one line for bad input or a file that cannot be written, no traceback."""
    try:
        with telling():
            commands()
    except InputError as error:
        messages.print(str(error), style="bold", highlight=False, markup=False, soft_wrap=True)
        sys.exit(BAD_INPUT)
    except OSError as error:  # a disk that is full, a folder that has gone meanwhile
        messages.print(str(error), style="bold", highlight=False, markup=False, soft_wrap=True)
        sys.exit(BAD_INPUT)
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
