"""``fctd view SOURCE``: the string in its hole, as a page."""

import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated

import typer

from fctd.case.errors import InputError
from fctd.case.text import file_name
from fctd.cli import quantities
from fctd.cli.job import Job
from fctd.cli.keeping import case_of, how_far
from fctd.cli.options import (
    FAILED,
    Friction,
    Overrides,
    Quiet,
    Units,
    check_target,
    messages,
    print_written,
    refuse_sources,
)
from fctd.cli.pictures import check_package
from fctd.cli.quantities import Given, quantity
from fctd.cli.steady import (
    DEPTHS_HELP,
    Flow,
    ResolveBuckling,
    Rpm,
    Speed,
    file_option,
    kinds_option,
    read_drive,
    read_kinds,
)
from fctd.model.depths import usual_depths
from fctd.results.tables import open_result, result_files
from fctd.results.unit_systems import System
from fctd.simulation.run_saver import kept_so_far
from fctd.store.run_folder import about_of, run_path
from fctd.view.quantities import QUANTITIES, quantity_of
from fctd.view.strings import Strings, of_chart, of_run

USUAL = ("trip_out", "rotate_off_bottom", "trip_in")
DEPTHS = 40  # of a view without --depths
MOST_SIDEWAYS = 1e5  # a clearance of 10 cm is then as wide as a well is deep


def view_command(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="RESULT|CASE", help="Case file (TOML), or the folder of fctd simulate.", show_default=False
        ),
    ],
    operations: Annotated[list[str], kinds_option(f"; default of a case: {','.join(USUAL)}")] = [],  # noqa: B006
    depths: Annotated[
        Given | None,
        quantity(
            quantities.DEPTHS,
            "FROM:TO:STEP",
            f"{DEPTHS_HELP} Default of a case: {DEPTHS} depths from the last shoe to the end of the hole.",
        ),
    ] = None,
    colour: Annotated[
        str,
        typer.Option(
            "--colour",
            metavar="QUANTITY",
            help=f"Quantity whose colours the string has at first: {', '.join(QUANTITIES)}.",
        ),
    ] = "side_force",
    exaggeration: Annotated[
        float | None,
        typer.Option(
            "--sideways",
            metavar="X",
            min=1.0,
            max=MOST_SIDEWAYS,
            show_default=False,
            help="How many times as large offsets and clearance are drawn; default: a round number that shows them.",
        ),
    ] = None,
    speed: Speed = None,
    rpm: Rpm = None,
    flow: Flow = None,
    friction: Friction = None,
    resolve_buckling: ResolveBuckling = None,
    overrides: Overrides = [],  # noqa: B006 (typer copies it)
    out: Annotated[Path | None, file_option("--out", "The page, .html; default: CASE-NAME-view.html.")] = None,
    png: Annotated[
        Path | None, file_option("--png", "A still picture of the page, .png, drawn by a browser of this machine.")
    ] = None,
    units: Units = "si",
    quiet: Quiet = False,
) -> None:
    """Show where the string touches its hole: a page with the string in three dimensions over bit depth or time."""
    quantity_of(colour, "--colour")
    check_target(out, "--out", (".html",))
    check_target(png, "--png", (".png",))
    check_package(Path("view.html"), "view")
    given = {
        "--operation": operations, "--depths": depths, "--speed": speed, "--rpm": rpm, "--flow": flow,
        "--friction": friction, "--set": overrides, "--resolve-buckling": resolve_buckling,
    }  # fmt: skip
    told: list[str] = []
    if source.is_dir() or about_of(source) is not None:
        strings = _of_run(source, given)
    else:
        job = Job(source, overrides, friction, resolve_buckling, units=units, quiet=quiet)
        kinds, drive = read_kinds(operations, USUAL), read_drive(speed, rpm, flow, units)
        wanted = usual_depths(job.case, DEPTHS) if depths is None else depths.depths(job.case, units)
        job.warn(kinds, **drive)
        with job.bar() as show:
            strings = of_chart(job.case, kinds, wanted, **drive, progress=show)
        told = job.told
    if strings.left_out:
        messages.print(f"warning: {strings.left_out}", markup=False, soft_wrap=True)
        told = [*told, strings.left_out]
    _write(strings, out, png, colour, units, exaggeration, told)
    if strings.left_out:
        raise typer.Exit(FAILED)


def _of_run(folder: Path, given: Mapping[str, object]) -> Strings:
    """The strings of a run, or of what one that has not ended has kept; options of a case are refused."""
    for key, value in given.items():
        if value not in (None, []):
            expected = "a case file in place of the folder, as the run is already computed"
            raise InputError(expected, key=key, value=value)
    about = about_of(folder)
    if about is None and not any((folder / name).exists() for name in result_files(csv=False)):
        raise InputError("a case file, or the folder of a result of fctd simulate", value=folder)
    if about is None or folder.exists():
        result = open_result(folder)
        if about is not None:
            messages.print(f"this is the result before; there is a run that has not ended: {how_far(folder)}")
        return of_run(result)
    if about["command"] != "simulate":
        raise InputError(
            f"the result of fctd simulate, or its run: this is one of fctd {about['command']}", value=folder
        )
    return of_run(kept_so_far(run_path(folder), case_of(run_path(folder), about)))


def _write(
    strings: Strings, out: Path | None, png: Path | None, colour: str, units: System, exaggeration: float | None,
    told: Sequence[str],
) -> None:  # fmt: skip
    from fctd.view.page import save_view  # plotly is slow to import
    from fctd.view.still import save_still

    for key, path in {"--out": out, "--png": png}.items():
        refuse_sources(strings.case, path, key)

    def save(path: Path) -> list[Path]:
        return save_view(strings, path, colour, units, exaggeration=exaggeration, warnings=told)

    written: list[Path] = []
    try:
        if png is None or out is not None:
            written += save(out or Path(file_name(strings.case.name, "-view.html")))
        if png is not None:
            with tempfile.TemporaryDirectory() as folder:
                written += save_still(written[0] if written else save(Path(folder) / "view.html")[0], png)
    finally:
        print_written(written)
