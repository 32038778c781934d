"""What all commands have in common: ``-h``, ``-o``, ``-q``, ``--version``, and messages about their options."""

from typing import Annotated, Any

import typer
from typer.core import TyperCommand, TyperOption

from fctd.case.text import printable
from fctd.cli.options import units_of_case

HELP = {"help_option_names": ["-h", "--help"]}
# Options that a command needs where it does not go on with an earlier one.
UNLESS_RESUMED = ("operations", "depths")
SHORT = {"--out": "-o", "--quiet": "-q"}
# ``--quiet`` of commands that compute nothing.
Silent = Annotated[bool, typer.Option("--quiet", help="Print warnings and errors alone.")]


class Command(TyperCommand):
    """A command with short names of its options; it says what a missing option accepts, and takes no option twice."""

    def __init__(self, *given: Any, **settings: Any) -> None:
        super().__init__(*given, **settings)
        for option in self._options():
            for name, short in SHORT.items():
                if name in option.opts:
                    option.opts.insert(0, short)

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse the options after a check of their number; ends the command with exit code 2 where it is wrong."""
        given, extra, order = self.make_parser(ctx).parse_args(args=list(args))
        begins = any(option.name == "resume" for option in self._options()) and "resume" not in given
        for option in self._options():
            name = max(option.opts, key=len)
            if order.count(option) > 1 and not option.multiple:
                ctx.fail(f"{name} is given {'twice' if order.count(option) == 2 else f'{order.count(option)} times'}.")
            needed = option.required or (begins and option.name in UNLESS_RESUMED)
            if needed and option.name not in given and "help" not in given:
                ctx.fail(f"Missing option '{name}'. {option.help}")
        if extra and "help" not in given:
            several = "an option takes one value, in quotes where it holds a blank, several apart by commas"
            ctx.fail(f"Got unexpected extra argument(s) ({printable(' '.join(extra))}): {several}")
        return super().parse_args(ctx, args)

    def invoke(self, ctx: Any) -> Any:
        """Run the command, in the units of its case where the command line names none."""
        if getattr(ctx.get_parameter_source("units"), "name", "") == "DEFAULT":
            ctx.params["units"] = units_of_case(ctx.params)
        return super().invoke(ctx)

    def _options(self) -> list[TyperOption]:
        return [option for option in self.params if isinstance(option, TyperOption)]


def _print_version(wanted: bool) -> None:
    if wanted:
        from fctd.mechanics.compile_cache import hash_of_sources
        from fctd.store.origin import versions

        known = versions()
        commit = f"commit {known['commit']}, " if "commit" in known else ""
        typer.echo(f"fctd {known['fctd']} ({commit}sources {hash_of_sources()})")
        raise typer.Exit


def application(
    show_version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print version, commit, and hash of sources."
        ),
    ] = False,
) -> None:
    """Fast contact torque and drag of a stiff drill string."""
