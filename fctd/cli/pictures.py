"""Files that commands write: the suffix says whether one is a table, a picture or a page."""

from collections.abc import Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fctd import plots  # its modules, and what they need, are imported where a picture is drawn
from fctd.case.errors import InputError
from fctd.case.message import frame_of
from fctd.cli.options import check_target
from fctd.plots import DRAWN
from fctd.plots.loads import ChartLook, Compared, Load
from fctd.plots.tracks import SideForce
from fctd.results.unit_systems import System
from fctd.steady.steady_string import Equilibrium
from fctd.store.tables import Rows

if TYPE_CHECKING:
    import pandas as pd

    from fctd.plots.depth_panels import Panels

TABLES = (".csv", ".parquet", ".xlsx")
PAGE = ".html"
PICTURES = (*DRAWN, PAGE)
PICTURE_HELP = f"{', '.join(DRAWN)}, or {PAGE} with values under the pointer"
# Package and extra by suffix, or by option, of the files that need one.
_NEEDS = {
    "--page": ("jinja2", "report"),
    PAGE: ("plotly", "html"),
    ".xlsx": ("xlsxwriter", "excel"),
    **dict.fromkeys(DRAWN, ("matplotlib", "plot")),
}
# A file of an option, and the suffixes that it may have.
File = tuple[Path | None, Sequence[str]]

ShownLoad = Annotated[
    Load | None,
    typer.Option(
        "--load",
        help="In picture and table on the screen: hook load of the string, or the weight indicator's reading; default: "
        "the indicator where the case has rig.block_weight.",
        show_default=False,
    ),
]
ShownSideForce = Annotated[
    SideForce,
    typer.Option("--side-force", help="In pictures of profiles: per length, or per joint of 30 ft."),
]


def check_package(path: Path, key: str) -> None:
    """Raise InputError where the optional package is missing that writes a file of this suffix."""
    of = key if key in _NEEDS else path.suffix.lower()
    if of not in _NEEDS:
        return
    package, extra = _NEEDS[of]
    try:
        import_module(package)
    except ModuleNotFoundError as error:
        expected = f"the package {error.name} for {path.suffix} (pip install {package}, or the extra fctd[{extra}])"
        raise InputError(expected, key=key, value=path) from None


def check_files(files: Mapping[str, File]) -> None:
    """Raise InputError for a file of another suffix, or that cannot be written, before anything is computed.

    files : by option.
    """
    given = {key: path for key, (path, _) in files.items() if path is not None}
    for key, path in given.items():
        check_target(path, key, files[key][1])
    if len({path.resolve() for path in given.values()}) < len(given):
        kind = "table" if path.suffix.lower() in TABLES else "picture"
        raise InputError(f"a file of its own for each {kind}", key=key, value=path)
    for key, path in given.items():
        check_package(path, key)


def draw_chart(
    path: Path,
    chart: "pd.DataFrame | Rows",
    units: System,
    case: Compared,
    look: ChartLook,
    refresh: float | None = None,
) -> list[Path]:
    """Write a chart; the arguments are those of ``chart_figure``, and of ``save_page``.  Returns the files."""
    chart = frame_of(chart)
    if path.suffix.lower() == PAGE:
        return plots.save_page(plots.chart_page(chart, units, case, look), path, refresh)
    return plots.save(plots.chart_figure(chart, units, case, look), path)


def draw_profiles(path: Path, points: Sequence[Equilibrium], **options: Any) -> list[Path]:
    """Write profiles; options : of ``profile_figure``.  Returns the files."""
    if path.suffix.lower() == PAGE:
        return plots.save_page(plots.profile_page(points, **options), path)
    return plots.save(plots.profile_figure(points, **options), path)


def draw_panels(path: Path, panels: "Panels") -> list[Path]:
    """Write curves against depth in panels.  Returns the files."""
    if path.suffix.lower() == PAGE:
        return plots.save_page(plots.panels_page(panels), path)
    return plots.save(plots.panels_figure(panels), path)
