"""Results in notebooks and at the prompt: short, with units, escaped."""

import sys

import numpy as np
import pytest

from fctd import equilibrium, simulate
from fctd.case.errors import InputError
from fctd.results.display import html_table, load_rows, picture
from tests.cases import make_case


def test_loads_have_labels_and_units() -> None:
    assert load_rows({"hookload_N": 803_000.0, "surface_torque_N_m": float("nan")}, "si") == {
        "hook load": "803.0 kN",
        "surface torque": "–",
    }


def test_texts_are_escaped() -> None:
    table = html_table("a <b> & c", {"<i>": "1 < 2"})
    assert "a &lt;b&gt; &amp; c" in table
    assert "<th>&lt;i&gt;</th>" in table
    assert "1 &lt; 2" in table


def test_an_equilibrium() -> None:
    point = equilibrium(make_case(), "trip_out", 900)
    assert repr(point).startswith("Equilibrium(trip_out, bit at 900 m: converged, hook load ")
    assert len(repr(point)) < 120
    assert "weight indicator" in point._repr_html_()
    assert "–" in repr(point.without_loads())


def test_a_simulation() -> None:
    rotate = {"kind": "rotate_off_bottom", "at_md": 900, "duration": 2.0, "rpm": 60.0, "ramp_time": 1.0}
    result = simulate(make_case(operations=[rotate]))
    assert repr(result) == "SimulationResult('test': completed, 2 records, rotate_off_bottom at 900.0 m)"
    hookload = float(result.history["hookload_N"].iloc[-1])
    assert f"{hookload / 1e3:.1f} kN" in result._repr_html_()
    assert np.isfinite(hookload)


def test_results_draw_themselves() -> None:
    """Notebooks show what a method ``plot`` returns."""
    point = equilibrium(make_case(), "trip_out", "td", friction=0.3)
    assert point.case.wellbore.intervals[0].friction == 0.3
    drawn = point.plot("field")
    assert drawn._repr_png_().startswith(b"\x89PNG")
    assert "ft" in drawn.figure.axes[0].get_ylabel()


def test_a_picture_whose_package_is_missing_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.delitem(sys.modules, "fctd.plots.profile", raising=False)
    with pytest.raises(InputError, match=r"expected the package matplotlib \(pip install 'fctd\[plot\]'\)"):
        picture("profile_figure", [])


def test_a_case() -> None:
    assert repr(make_case()) == str(make_case()) == "Case('test')"
