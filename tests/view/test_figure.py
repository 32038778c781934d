"""The view as a figure of plotly: each string a frame, names as they stand."""

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.view.figure import view_figure
from tests.view.made import DEPTHS, strings


def test_frames_change_the_string_and_texts_are_escaped() -> None:
    made = strings()
    figure = view_figure(made, "tension", "field")
    assert len(figure.frames) == 2 * len(DEPTHS) == len(figure.layout.sliders[0].steps)
    (first, last) = (frame.data[3] for frame in (figure.frames[0], figure.frames[-1]))
    assert first.name == last.name == figure.data[3].name == "string"
    assert len(last.x) == len(made.snapshots[-1].offset) > len(first.x)
    np.testing.assert_allclose(
        last.line.color, made.snapshots[-1].columns["effective_tension_N"] / 4448.2216152605, rtol=1e-6
    )
    np.testing.assert_array_equal(figure.data[3].x, last.x)
    assert "<a href" not in figure.layout.title.text
    assert "&lt;a href" in figure.layout.title.text
    assert last.x.dtype == np.float32


def test_an_unknown_quantity_is_refused() -> None:
    with pytest.raises(InputError, match="one of the quantities"):
        view_figure(strings(), "weight")
