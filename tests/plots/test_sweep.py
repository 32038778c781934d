"""Pictures of sweeps: bands, tornado and map show the numbers of their tables."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from fctd import plots
from fctd.case.errors import InputError
from fctd.sweep.chunk import as_table
from fctd.sweep.dataset import begin_dataset
from fctd.sweep.run import prepare
from fctd.sweep.spec import read_sweep
from fctd.sweep.uncertainty import Uncertainty, assess
from tests.plots.made import texts_that_overlap
from validation.parts.small_sweep import PARAMETERS, WORK, sweep_file

GRID = """
[[parameters]]
key = "friction"
low = 0.1
high = 0.4
count = 4
[[parameters]]
key = "bit.weight_on_bit"
low = "10 kN"
high = "30 kN"
count = 3
"""


def made(
    folder: Path, head: str = 'method = "random"\nsamples = 40\n', body: str = PARAMETERS, torque: float = 5e3
) -> Uncertainty:
    """A sweep with made-up loads, linear in the first parameter."""
    spec = read_sweep(sweep_file(folder, head, body + WORK))
    runner, samples = prepare(spec)
    dataset = begin_dataset(folder / "out", runner.template, samples)
    first = samples[next(iter(runner.template.units))]
    rows = [
        {"sample": k, "operation": "trip_out", "bit_depth_m": depth, "hookload_N": 1e3 * depth * (1 + first.iloc[k]),
         "surface_torque_N_m": torque, "buckling": "none", "status": "converged"}
        for k in range(len(samples)) for depth in (600.0, 900.0)
    ]  # fmt: skip
    dataset.write([as_table(rows)])
    return assess(dataset, spec)


@pytest.mark.slow
def test_bands_are_those_of_the_percentiles(tmp_path: Path) -> None:
    found = made(tmp_path)
    figure = plots.bands_figure(found)
    hookload, torque = figure.axes
    assert (hookload.get_xlabel(), torque.get_xlabel()) == ("hook load (string), kN", "surface torque, kN·m")
    table = found.percentiles
    middle = table[(table["column"] == "hookload_N") & (table["percentile"] == 50)]["value"].to_numpy() / 1e3
    assert any(np.allclose(line.get_xdata(), middle) for line in hookload.lines)
    assert texts_that_overlap(figure) == []
    assert plots.bands_figure(found, "field").axes[0].get_xlabel() == "hook load (string), klbf"


def test_what_the_solver_leaves_out_of_balance_is_not_drawn_as_torque(tmp_path: Path) -> None:
    """The string only slides: its torque is 0 but for 3 N·m beside a hook load of up to 1.4 MN."""
    (axes,) = plots.bands_figure(made(tmp_path, torque=3.0)).axes
    assert axes.get_xlabel() == "hook load (string), kN"


def test_a_tornado_has_its_bars_in_order(tmp_path: Path) -> None:
    figure = plots.tornado_figure(made(tmp_path))
    (axes,) = figure.axes
    assert [label.get_text() for label in axes.get_yticklabels()] == ["mud density", "friction factor, open hole"]
    widths = [bar.get_width() for bar in axes.patches]
    assert abs(widths[0]) < 0.1 < 0.99 < widths[1]
    assert texts_that_overlap(figure) == []


def test_effects_of_morris_have_the_unit_of_the_result(tmp_path: Path) -> None:
    """The hook load is 900 kN (1 + friction): a step of 2/3 is from the eighth to five eighths of its distribution."""
    from scipy import stats

    found = made(tmp_path, 'method = "morris"\nsamples = 8\n')
    (si,), (field,) = (plots.tornado_figure(found, units=units).axes for units in ("si", "field"))
    assert si.get_title(loc="left") == "hook load (string): mean absolute effect (Morris), kN"
    assert field.get_title(loc="left") == "hook load (string): mean absolute effect (Morris), klbf"
    low, high = (max(bar.get_width() for bar in axes.patches) for axes in (field, si))
    assert high == pytest.approx(4.4482216 * low)
    step = 0.05 * (stats.norm.ppf(0.625) - stats.norm.ppf(0.125))
    assert high == pytest.approx(900 * step / (2 / 3), rel=1e-3)  # the distribution is truncated at 4 deviations


def test_pictures_of_one_operation_show_the_first_of_the_sweep(tmp_path: Path) -> None:
    found = made(tmp_path)
    other = pd.concat([found.rows, found.rows.assign(operation="back_ream")], ignore_index=True)
    indices = pd.concat([found.indices.assign(operation="back_ream"), found.indices], ignore_index=True)
    both = replace(found, rows=other, indices=indices)
    for figure in (plots.tornado_figure(both), plots.map_figure(both, ["friction.open", "mud.density"], "hookload_N")):
        assert figure.texts[-1].get_text().startswith("picking up, bit at 900 m")
    with pytest.raises(InputError, match="an operation of the sweep"):
        plots.map_figure(found, ["friction.open", "mud.density"], "hookload_N", "trip_in")


def test_bands_say_how_many_rows_are_to_be_doubted(tmp_path: Path) -> None:
    found = made(tmp_path)
    doubtful = replace(found, rows=found.rows.assign(status="under_resolved"))
    assert "80 of 80 rows under resolved" in plots.bands_figure(doubtful).texts[-1].get_text()


def test_a_map_has_a_cell_for_every_sample_of_a_grid_and_points_for_others(tmp_path: Path) -> None:
    found = made(tmp_path, 'method = "grid"\n', GRID)
    figure = plots.map_figure(found, ["friction", "bit.weight_on_bit"], "hookload_N")
    axes, bar = figure.axes
    (mesh,) = axes.collections
    values = np.asarray(mesh.get_array()).reshape(3, 4)
    assert values[0] == pytest.approx([900 * (1 + friction) for friction in (0.1, 0.2, 0.3, 0.4)])
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("friction factor", "weight on bit, kN")
    assert bar.get_ylabel() == "hook load (string), kN"
    (tmp_path / "drawn").mkdir()
    points = plots.map_figure(made(tmp_path / "drawn"), ["friction.open", "mud.density"], "hookload_N")
    assert len(points.axes[0].collections[0].get_offsets()) == 40


def test_pictures_that_samples_do_not_allow_are_refused(tmp_path: Path) -> None:
    found = made(tmp_path, 'method = "random"\nsamples = 4\n')
    with pytest.raises(InputError, match="at least 12 samples"):
        plots.tornado_figure(found)
    with pytest.raises(InputError, match="two parameters with numbers"):
        plots.map_figure(found, ["friction.open", "rig.block_weight"], "hookload_N")
    with pytest.raises(InputError, match="two parameters with numbers"):
        plots.map_figure(found, ["mud.density", "mud.density"], "hookload_N")
    one = found.percentiles[found.percentiles["bit_depth_m"] == 900]
    with pytest.raises(InputError, match="several depths"):
        plots.bands_figure(Uncertainty(**{**vars(found), "percentiles": one}))
