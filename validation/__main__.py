"""``python -m validation``: list the studies, or run some of them."""

from typing import Annotated

import typer
from rich.console import Console

from fctd.case.text import degrade_output, printable_lines
from validation.harness import runner, study
from validation.harness.registry import STUDIES

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)


@app.command()
def main(
    names: Annotated[list[str] | None, typer.Argument(metavar="[NAME]...", help="Studies to run.")] = None,
    show: Annotated[bool, typer.Option("--list", help="List the studies and their questions.")] = False,
    every: Annotated[bool, typer.Option("--all", help="Run every study.")] = False,
    reproduce: Annotated[bool, typer.Option("--reproduce", help="Run what `make reproduce` runs.")] = False,
    quick: Annotated[bool, typer.Option("--quick", help="Shorten each study; the checks stay.")] = False,
    force: Annotated[bool, typer.Option("--force", help="Repeat also what is kept and up to date.")] = False,
) -> None:
    """Run studies; each leaves its tables and its verdict in validation/results/NAME/.

    A result is kept, and its study not repeated, until its code, the files it read, a package or the processor
    changes; a quick result is none for a full run, nor the other way round. An interrupted run goes on where it was.

    Exit code 0: each check as recorded in expected.toml or better. 1: worse than recorded, or a study failed.
    2: bad usage. 130: interrupted; what had finished is kept.
    """
    if show:
        for name in STUDIES:
            typer.echo(printable_lines(_line(name)))
        return
    try:
        chosen = _choose(names or [], every, reproduce)
        expected = runner.read_expected(runner.EXPECTED)
        runner.check_results(study.RESULTS)
    except runner.UsageError as error:
        typer.echo(printable_lines(f"error: {error}"), err=True)
        raise typer.Exit(2) from error
    try:
        code = runner.run_all(
            chosen,
            quick=quick,
            force=force,
            data=study.data_folder(),
            expected=expected,
            results=study.RESULTS,
            console=Console(),
        )
    except OSError as error:  # of the results folder: what a study fails at is its own result
        message = f"error: {study.RESULTS}: expected a folder that can be written ({error})"
        typer.echo(printable_lines(message), err=True)
        raise typer.Exit(2) from error
    raise typer.Exit(code)


def _choose(names: list[str], every: bool, reproduce: bool) -> list[str]:
    """The studies asked for, in the order of the registry."""
    for name in names:
        runner.check_name(name)
    chosen = [name for name in STUDIES if every or name in names or (reproduce and runner.is_reproduced(name))]
    if not chosen:
        raise runner.UsageError("nothing to run: name a study, or say --all, --reproduce or --list")
    return chosen


def _line(name: str) -> str:
    """One study in the list."""
    try:
        found = runner.load(name)
    except Exception as error:
        # The list must show the others, and that this one is broken.
        return f"{name:<20} cannot be loaded: {type(error).__name__}: {error}"
    marks = [*(["reproduce"] if found.reproduce else []), *(f"needs {need}" for need in found.needs)]
    return f"{name:<20} {found.question}" + (f"  [{', '.join(marks)}]" if marks else "")


if __name__ == "__main__":
    degrade_output()
    app(prog_name="python -m validation")
