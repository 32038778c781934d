"""The string in its hole: where it touches, in three dimensions and unrolled, over bit depth or time.

    strings = fctd.view.of_chart(case, ["trip_out"], range(1750, 2451, 10))   # or of_run(fctd.open_result(folder))
    fctd.view.save_view(strings, Path("view.html"))
    fctd.view.view_figure(strings, "tension").show()

Needs plotly, which the package installs as its extra ``html``; a still picture (``save_still``) needs a browser and
playwright, the extra ``browser``.
"""

from typing import TYPE_CHECKING

from fctd.public import offer

if TYPE_CHECKING:  # what ``offer`` reads
    from fctd.view.figure import view_figure as view_figure
    from fctd.view.page import save_view as save_view
    from fctd.view.quantities import QUANTITIES as QUANTITIES
    from fctd.view.still import save_still as save_still
    from fctd.view.strings import Strings as Strings, of_chart as of_chart, of_points as of_points, of_run as of_run
else:
    __getattr__, __dir__, __all__ = offer(__name__)
