"""A chart: the rows of the table, notes with their place, both systems of units, its picture; an equilibrium."""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import fctd
from fctd.results.columns import TABLES
from fctd.results.notes import codes_of
from tests.cases import make_case

EXAMPLE = Path(__file__).parents[2] / "examples" / "my_well.toml"
# Drill pipe of weak steel, which picking up with much friction overloads.
WEAK = {"string.components[2].yield_strength": "200 MPa"}


@pytest.fixture(scope="module")
def chart() -> fctd.Chart:
    return fctd.chart(fctd.load_case(EXAMPLE, WEAK), ["trip_in", "trip_out"], "shoe:td:500", [0.1, 0.5])


def test_its_table_is_that_of_torque_drag_whose_docstring_has_each_column(chart: fctd.Chart) -> None:
    told = re.findall(r"^- (\w+): .", fctd.torque_drag.__doc__ or "", re.M)
    assert told == list(chart.rows) == [column.name for column in TABLES["chart"]]
    profile = list(fctd.equilibrium(chart.case, "trip_in", "td").profile)
    assert profile == [column.name for column in TABLES["profile"] if column.name in profile]
    pd.testing.assert_frame_equal(
        chart.table, fctd.torque_drag(chart.case, ["trip_in", "trip_out"], [1500, "2000 m", 2500, "td"], [0.1, 0.5])
    )


def test_every_note_of_a_row_is_an_object_with_its_place(chart: fctd.Chart) -> None:
    told = chart.table.set_index(["operation", "friction_label", "bit_depth_m"])["notes"]
    assert {"yield", "tensile_capacity"} <= {note.code for note in chart.notes}
    for key, cell in told.items():
        notes = [note for note in chart.notes if (note.operation, note.friction, note.bit_depth) == key]
        assert codes_of(notes) == cell
        assert all(note.text and note.place is not None and note.place < note.bit_depth for note in notes)


def test_it_is_shown_in_either_system_of_units(chart: fctd.Chart) -> None:
    field = chart.to_units("field")
    assert field.table.attrs == chart.table.attrs | {"units": "field"}
    np.testing.assert_allclose(field.table["bit_depth_ft"] * 0.3048, chart.table["bit_depth_m"])
    assert "hook load (klbf)" in field._repr_html_()
    assert "hook load (kN)" in field.to_units("si")._repr_html_()
    assert repr(field) == "Chart('my well', 16 rows: trip_in, trip_out)"


def test_it_draws_itself(chart: fctd.Chart, tmp_path: Path) -> None:
    picture = chart.to_units("field").plot(margins=fctd.limits_of(chart.case, "trip_out", bit_depths=["shoe", "td"]))
    texts = {text.get_text() for axes in picture.figure.axes for text in (axes.xaxis.label, axes.yaxis.label)}
    assert "bit depth, ft" in texts
    assert picture._repr_png_().startswith(b"\x89PNG")
    assert picture.save(tmp_path / "chart.svg") == [tmp_path / "chart.svg"]
    for name in ("chart.html", "chart"):
        with pytest.raises(fctd.InputError, match=r"expected a file name that ends in \.png, \.svg or \.pdf"):
            picture.save(tmp_path / name)
    assert [path.name for path in tmp_path.iterdir()] == ["chart.svg"]


def test_units_and_loads_that_nobody_knows_are_refused(chart: fctd.Chart) -> None:
    with pytest.raises(fctd.InputError, match='units = "ft": expected "si" or "field"'):
        chart.to_units("ft")  # type: ignore[arg-type]
    with pytest.raises(fctd.InputError, match='load = "torque": expected "string" or "indicator"'):
        chart.plot(load="torque")


def test_an_equilibrium() -> None:
    point = fctd.equilibrium(make_case(), "trip_out", 900)
    assert repr(point).startswith("Equilibrium(trip_out, bit at 900 m: converged, hook load ")
    assert len(repr(point)) < 120
    assert "weight indicator" in point._repr_html_()
    assert "–" in repr(point.without_loads())
    field = fctd.equilibrium(make_case(units="field"), "trip_out", 914.4)
    assert repr(field).startswith("Equilibrium(trip_out, bit at 3000 ft: converged, hook load ")
    assert "klbf" in repr(field)


def test_an_equilibrium_draws_itself() -> None:
    """Notebooks show what a method ``plot`` returns."""
    point = fctd.equilibrium(make_case(), "trip_out", "td", friction=0.3)
    assert point.case.wellbore.intervals[0].friction == 0.3
    drawn = point.plot("field")
    assert drawn._repr_png_().startswith(b"\x89PNG")
    assert "ft" in drawn.figure.axes[0].get_ylabel()
