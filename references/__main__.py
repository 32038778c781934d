"""``python -m references``: the contact methods there are, and the engine's loop with one of them."""

from typing import Annotated, Any

import typer
from rich.table import Table

from fctd.case import Case, parse_override
from fctd.cli import run, simulate_file
from fctd.cli_options import CaseFile, Csv, Friction, Out, Overrides, Quiet, screen
from fctd.errors import InputError
from references import base

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    help="What FCTD is set against: other contact methods in the same loop.",
)


@app.command("list")
def list_command() -> None:
    """Name the contact methods: version, what they do, whether they are installed."""
    table = Table()
    for name in ("method", "package", "version", "what it does", "options"):
        table.add_column(name, overflow="fold")
    for name in base.METHODS:
        method = base.method_class(name)
        options = ", ".join(f"{key}={field.default}" for key, field in method.Options.model_fields.items())
        table.add_row(
            name, method.distribution, base.installed_version(name) or "not installed", method.does, options or "–"
        )
    screen.print(table)


@app.command("simulate")
def simulate_command(
    case_file: CaseFile,
    contact: Annotated[str, typer.Option("--contact", metavar="METHOD", help="A method of 'list'.")],
    options: Annotated[
        list[str], typer.Option("--option", metavar="KEY=VALUE", help="An option of the method, e.g. facets=96.")
    ] = [],  # noqa: B006 (typer copies it)
    out: Out = None,
    overrides: Overrides = [],  # noqa: B006
    friction: Friction = None,
    csv: Csv = False,
    quiet: Quiet = False,
) -> None:
    """Run a case with another contact method in the engine's loop; friction, force law and step stay the same."""

    def method(case: Case) -> base.ContactMethod:
        chosen: dict[str, Any] = {}
        for text in options:
            key, given, _ = text.partition("=")
            if not given:
                raise InputError("KEY=VALUE", key="--option", value=text)
            chosen[key] = parse_override(text)[1]
        return base.build(contact, case, **chosen)

    simulate_file(case_file, out, overrides, friction, csv, quiet, method)


if __name__ == "__main__":
    run(app)
