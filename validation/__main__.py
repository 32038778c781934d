"""``python -m validation``: list the studies, or run some of them."""

from typing import Annotated

import typer
from rich.console import Console

from validation import record, runner
from validation.registry import STUDIES
from validation.study import data_folder

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)


@app.command()
def main(
    names: Annotated[list[str] | None, typer.Argument(metavar="[NAME]...", help="Studies to run.")] = None,
    show: Annotated[bool, typer.Option("--list", help="List the studies and their questions.")] = False,
    every: Annotated[bool, typer.Option("--all", help="Run every study.")] = False,
    reproduce: Annotated[bool, typer.Option("--reproduce", help="Run what `make reproduce` runs.")] = False,
    quick: Annotated[bool, typer.Option("--quick", help="Shorten each study; the checks stay.")] = False,
) -> None:
    """Run studies; each leaves its tables and its verdict in validation/results/NAME/.

    Exit code 0: each check as recorded in expected.toml or better. 1: worse than recorded, or a study failed.
    2: bad usage. 130: interrupted; what had finished is kept.
    """
    if show:
        for name in STUDIES:
            typer.echo(_line(name))
        return
    try:
        chosen = _choose(names or [], every, reproduce)
        expected = runner.read_expected(runner.EXPECTED)
    except runner.UsageError as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from error
    code = runner.run_all(
        chosen,
        quick=quick,
        data=data_folder(),
        expected=expected,
        results=record.RESULTS,
        console=Console(),
    )
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
        study = runner.load(name)
    except Exception as error:
        # The list must show the others, and that this one is broken.
        return f"{name:<20} cannot be loaded: {type(error).__name__}: {error}"
    marks = [*(["reproduce"] if study.reproduce else []), *(f"needs {need}" for need in study.needs)]
    return f"{name:<20} {study.question}" + (f"  [{', '.join(marks)}]" if marks else "")


if __name__ == "__main__":
    app(prog_name="python -m validation")
