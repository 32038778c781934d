"""``python -m references``: list contact methods and string engines, and run a case with one of them."""

from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from fctd.arena.contract import examine
from fctd.case.errors import InputError
from fctd.case.load import Case, load_case
from fctd.cli.keeping import AcceptChanges, CheckpointEvery, OptionalCase, Restart, Resume, SaveOptions
from fctd.cli.main import run
from fctd.cli.option_names import naming_options
from fctd.cli.options import CaseFile, Csv, Friction, Out, Overrides, Quiet, changes_of, screen
from fctd.cli.simulate import RunOutput, simulate_file
from fctd.store.run_folder import about_of
from references import contact, engines
from references.contact import REGISTRY, ContactMethod, build, frames
from references.methods.asked import options_of
from references.methods.command import methods_command
from references.registry import absent, label

PROGRAM = "python -m references simulate"

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    help="Compare FCTD with other contact methods in the same loop and with other engines for the same string.",
)


@app.command("list")
def list_command() -> None:
    """List the contact methods and string engines with package, version, description and options."""
    missing: dict[str, None] = {}
    for title, registry in (("contact method", contact.REGISTRY), ("string engine", engines.REGISTRY)):
        table = Table()
        for column in (title, "package", "version", "what it does", "options"):
            table.add_column(column, overflow="fold")
        for name in registry.names():
            try:
                described, version = registry.find(name), registry.installed_version(name)
            except InputError as error:
                table.add_row(name, "–", "cannot be loaded", str(error), "–")
                continue
            options = ", ".join(f"{key}={field.default}" for key, field in described.Options.model_fields.items())
            table.add_row(name, described.distribution, version or "not installed", described.does, options or "–")
            if version is None:
                missing[described.distribution] = None
        screen.print(table)
        for point in registry.shadowed():
            screen.print(f"Plugin {label(point)} is left out: the name {point.name} is taken.")
    for distribution in missing:
        screen.print(f"Package {absent(distribution)}.")


@app.command("simulate")
def simulate_command(
    case_file: OptionalCase = None,
    contact: Annotated[str | None, typer.Option("--contact", metavar="METHOD", help="A method of 'list'.")] = None,
    options: Annotated[
        list[str], typer.Option("--option", metavar="KEY=VALUE", help="An option of the method, e.g. facets=96.")
    ] = [],  # noqa: B006 (typer copies it)
    out: Out = None,
    overrides: Overrides = [],  # noqa: B006
    friction: Friction = None,
    csv: Csv = False,
    checkpoint_every: CheckpointEvery = None,
    resume: Resume = None,
    restart: Restart = False,
    accept_changes: AcceptChanges = False,
    quiet: Quiet = False,
) -> None:
    """Run a case with another contact method in FCTD's loop; friction, force law and step stay the same."""
    keeping = SaveOptions(checkpoint_every, resume, restart, accept_changes)
    about = None if resume is None else about_of(resume)
    if about is not None:
        if contact is not None or options:
            raise InputError("none with --resume: the run has its method", key="--contact", value=contact)
        contact, options = about["options"].get("contact"), about["options"].get("options", [])
    elif contact is None and resume is None:
        raise InputError("a method of 'list'", key="--contact")

    def method(case: Case) -> ContactMethod:
        return build(str(contact), case, **options_of(options))

    more = {"contact": contact, "options": options}
    simulate_file(
        case_file, out, overrides, friction, RunOutput(csv=csv, quiet=quiet), method, keeping=keeping, program=PROGRAM,
        more=more,
    )  # fmt: skip


@app.command("engine")
def engine_command(
    case_file: CaseFile,
    engine: Annotated[str, typer.Option("--engine", metavar="ENGINE", help="An engine of 'list'.")],
    duration: Annotated[float, typer.Option("--duration", help="Simulated time in the engine, s.")] = 2.0,
    start: Annotated[float, typer.Option("--start", help="Time at which FCTD hands over its state, s.")] = 0.0,
    options: Annotated[list[str], typer.Option("--option", metavar="KEY=VALUE", help="An option of the engine.")] = [],  # noqa: B006
    overrides: Overrides = [],  # noqa: B006
    friction: Friction = None,
) -> None:
    """Run a window of a case in another engine; print its final loads and the result of each check."""
    changes = changes_of(overrides, friction)
    case = load_case(case_file, changes)
    run = engines.build(engine, **options_of(options)).run(case, engines.Window(start, duration))
    last = run.history.iloc[-1]
    screen.print(f"{engine}: {run.status}", f"({run.message})" if run.message else "")
    if run.note:
        screen.print(run.note)
    screen.print(f"hook load {last['hookload_N'] / 1e3:.2f} kN, torque {last['surface_torque_N_m'] / 1e3:.3f} kN·m")
    for row in run.checks.itertuples():
        screen.print(f"  {'passed' if row.passed else 'FAILED'}  {row.check}: {row.value:.3g} (at most {row.bound:g})")
    if run.status != "valid":
        raise typer.Exit(1)


app.command("methods")(naming_options(methods_command))


@app.command("check")
def check_command(
    methods: Annotated[list[str], typer.Argument(metavar="METHOD...", help="Methods of 'list', plugins among them.")],
    options: Annotated[
        list[str], typer.Option("--option", metavar="KEY=VALUE", help="An option of the methods, e.g. facets=96.")
    ] = [],  # noqa: B006 (typer copies it)
) -> None:
    """Hold contact methods to their contract: what is wrong, and what to do. Exit code 1 where one breaks it."""
    broken = False
    for name in methods:
        method = contact.method_class(name)
        table = Table("demand", "", "what is wrong", title=name, title_justify="left")
        for found in examine(method, REGISTRY.options(name, options_of(options)).model_dump(exclude_unset=True)):
            word = "remark" if found.remark else "BROKEN"
            table.add_row(found.demand, word if found.says else "kept", found.says)
            broken = broken or not found.kept
        screen.print(table)
    if broken:
        raise typer.Exit(1)


@app.command("frames")
def frames_command(
    out: Annotated[Path, typer.Option("--out", metavar="FILE", help="The Parquet file to write.")],
    count: Annotated[int, typer.Option("--count", min=1, help="Points in each of the four holes.")] = 2000,
) -> None:
    """Write points near the wall of four holes with their exact contacts, for contact methods elsewhere."""
    frames.write(out, count)
    screen.print(f"{out}: {count} points in each of {len(frames.holes())} holes")


if __name__ == "__main__":
    run(app)
