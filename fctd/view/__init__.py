"""The string in its hole: where it touches, in three dimensions and unrolled, over bit depth or time.

    strings = fctd.view.of_chart(case, ["trip_out"], range(1750, 2451, 10))   # or of_run(fctd.open_result(folder))
    fctd.view.save_view(strings, Path("view.html"))
    fctd.view.view_figure(strings, "tension").show()

Needs plotly, which the package installs as its extra ``html``; a still picture (``save_still``) needs a browser and
playwright, the extra ``browser``.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fctd.view.figure import view_figure
    from fctd.view.page import save_view
    from fctd.view.quantities import QUANTITIES
    from fctd.view.still import save_still
    from fctd.view.strings import Strings, of_chart, of_points, of_run

_HOMES = {
    "QUANTITIES": "quantities",
    "Strings": "strings",
    "of_chart": "strings",
    "of_points": "strings",
    "of_run": "strings",
    "save_still": "still",
    "save_view": "page",
    "view_figure": "figure",
}
__all__ = ["QUANTITIES", "Strings", "of_chart", "of_points", "of_run", "save_still", "save_view", "view_figure"]


def __getattr__(name: str) -> Any:
    """A public name, from the module that has it."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    """The public names."""
    return sorted(__all__)
