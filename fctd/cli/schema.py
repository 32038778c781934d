"""``fctd schema``: the case file as JSON Schema."""

import json
from pathlib import Path
from typing import Annotated

import typer

from fctd.case.schema import case_schema
from fctd.cli.base_command import Silent
from fctd.cli.options import check_target, print_written
from fctd.store.whole_file import whole_file


def schema_command(
    out: Annotated[
        Path | None,
        typer.Option("--out", metavar="FILE", help="A file, .json; default: the screen.", show_default=False),
    ] = None,
    quiet: Silent = False,
) -> None:
    """Write the JSON Schema of the case file, with which editors complete keys and mark wrong ones."""
    check_target(out, "--out", (".json",))
    text = json.dumps(case_schema(), indent=2, ensure_ascii=False) + "\n"
    if out is None:
        typer.echo(text, nl=False)
        return
    with whole_file(out) as scratch:
        scratch.write_text(text, encoding="utf-8")
    if not quiet:
        print_written([out])
