"""Every figure draws from the stored tables of its study, with labelled axes and something on them.

After the studies: their results are in validation/results.  Those of rivals are marked so, and are drawn after theirs.
"""

import pytest
from matplotlib import rc_context

from reports import figures
from reports.figures import Figure, style
from validation.harness import store, study
from validation.harness.registry import RIVALS

ALL = [
    pytest.param(name, figure, id=f"{name}-{figure.name}", marks=[pytest.mark.rivals] if name in RIVALS else [])
    for name, those in figures.by_study().items()
    for figure in those
]


@pytest.mark.parametrize(("name", "figure"), ALL)
def test_figure_draws(name: str, figure: Figure) -> None:
    """matplotlib warns, and every warning is an error, where a layout leaves an axes no room."""
    folder = study.RESULTS / name
    with rc_context(style.RC):
        canvas = figure.draw(store.read_tables(folder, store.read(folder)))
        canvas.draw_without_rendering()
    assert figure.caption.endswith(".")
    for ax in canvas.axes:
        assert ax.get_lines() or ax.patches, "an axes without data"
    labels = {label for ax in canvas.axes for label in (ax.get_xlabel(), ax.get_ylabel()) if label}
    assert labels
    without_unit = {label for label in labels if ", " not in label}
    assert without_unit <= {"contact angle", "|residual| / work", "state"}
