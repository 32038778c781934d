"""``python -m reports``: write the page from every result in validation/results."""

import typer

from reports import page
from validation import runner, study
from validation.registry import STUDIES

OUT = study.ROOT / "reports" / "out"

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)


@app.command()
def main() -> None:
    """Write reports/out/index.html and print where it is; exit code 1 when a result could not be read or drawn."""
    problems = page.render(study.RESULTS, STUDIES, OUT, runner.changes(STUDIES, study.RESULTS))
    for problem in problems:
        typer.echo(problem, err=True)
    typer.echo(f"report: {OUT / 'index.html'}")
    raise typer.Exit(1 if problems else 0)


if __name__ == "__main__":
    app(prog_name="python -m reports")
