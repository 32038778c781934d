"""``fctd app``: a live page for a case, in the user's browser."""

from contextlib import suppress
from pathlib import Path
from typing import Annotated

import typer

from fctd.case.errors import InputError
from fctd.case.load import load_case
from fctd.case.text import printable
from fctd.cli.base_command import Silent
from fctd.cli.options import messages, screen, units_option
from fctd.results.unit_systems import System


def app_command(
    case_file: Annotated[
        Path | None,
        typer.Argument(
            metavar="CASE", help="Case file (TOML); without it the page that was shown last.", show_default=False
        ),
    ] = None,
    port: Annotated[
        int | None,
        typer.Option("--port", min=1024, max=65535, help="Port of the address; default: that of the last time."),
    ] = None,
    new_token: Annotated[
        bool, typer.Option("--new-token", help="A new secret in the address; earlier addresses lead nowhere.")
    ] = False,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open the page in a browser.")] = True,
    units: Annotated[System, units_option("Units of the page")] = "si",
    quiet: Silent = False,
) -> None:
    """Show a case on a page of this machine: charts and string follow its sliders."""
    try:
        import dash  # noqa: F401
        import waitress  # noqa: F401
    except ModuleNotFoundError as error:
        expected = f"the package {error.name} (pip install dash waitress, or the extra fctd[app])"
        raise InputError(expected, key="app") from None
    from fctd.app.home import Home
    from fctd.app.server import serving
    from fctd.app.sessions import Source

    source = None
    if case_file is not None:
        case = load_case(case_file)  # read as by all commands; the page gets the text and the survey
        survey = case.wellbore.survey
        name = "" if survey is None else written_survey(case_file)
        source = Source(case_file.read_text("utf-8-sig"), name, b"" if survey is None else survey.read_bytes())
    home = Home.open()
    if new_token:
        home.new_token()
    with serving(home, units, port) as server:
        address = server.begin(source)
        if not quiet:
            screen.print(f"The page: {printable(address)}", soft_wrap=True)
            screen.print("It is for this user of this machine alone. Ctrl-C ends it.")
        if browser and not server.show(address):
            messages.print("no browser opens by itself: open the address in one")
        with suppress(KeyboardInterrupt):
            server.run()


def written_survey(case_file: Path) -> str:
    """The survey of a case as its file names it."""
    from fctd.case.load import read_raw

    return str(read_raw(case_file)["wellbore"]["survey"])
