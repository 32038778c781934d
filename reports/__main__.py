"""``python -m reports``: write the page from every result in validation/results."""

import typer
from grimp.exceptions import SourceSyntaxError

from fctd.case.errors import InputError
from fctd.case.text import degrade_output, printable_lines
from fctd.cli.interrupts import as_interrupts
from validation.harness import fingerprint, full_checks, runner, study
from validation.harness.registry import STUDIES

OUT = study.ROOT / "reports" / "out"

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)


@app.callback(invoke_without_command=True)
def main(context: typer.Context) -> None:
    """Write reports/out/index.html and print where it is; exit code 1 when a result could not be read or drawn.

    2: a package is missing, or the folder cannot be written.
    """
    if context.invoked_subcommand is not None:
        return
    try:
        from reports import page
    except ModuleNotFoundError as error:
        typer.echo(f"error: expected the package {error.name} (pip install -e '.[pages]')", err=True)
        raise typer.Exit(2) from error
    try:
        sources = fingerprint.Sources()
    except SourceSyntaxError as error:
        typer.echo(printable_lines(f"error: {error}"), err=True)
        raise typer.Exit(2) from error
    try:
        changes = runner.changes(STUDIES, study.RESULTS, sources)
        questions = {name: found.question for name in STUDIES if (found := runner.loaded(name))}
        problems = page.render(study.RESULTS, STUDIES, OUT, changes, questions=questions, full=full_checks.read())
    except InputError as error:
        typer.echo(printable_lines(f"error: {error}"), err=True)
        raise typer.Exit(2) from error
    for problem in problems:
        typer.echo(printable_lines(problem), err=True)
    typer.echo(printable_lines(f"report: {OUT / 'index.html'}"))
    raise typer.Exit(1 if problems else 0)


@app.command("which-contact")
def which() -> None:
    """Write docs/which_contact.md: which contact method to take for which need, by the stored results."""
    from reports import which_contact

    which_contact.write_guide(study.RESULTS)
    typer.echo(printable_lines(f"guide: {which_contact.GUIDE}"))


if __name__ == "__main__":
    degrade_output()
    with as_interrupts():
        app(prog_name="python -m reports")
