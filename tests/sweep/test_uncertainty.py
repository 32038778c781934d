"""From samples to tables: the closed form of a straight inclined string, and datasets that cannot be told of."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.model.section import section_of
from fctd.sweep.chunk import as_table
from fctd.sweep.dataset import Dataset, begin_dataset
from fctd.sweep.design import sample_of
from fctd.sweep.run import prepare
from fctd.sweep.spec import SweepSpec, read_sweep
from fctd.sweep.uncertainty import assess, noise_in

# The hole hardly leaves room beside the pipe: the string hangs on the axis of the hole and lies on its low side, and
# with a clearance c the tension T of the first segments takes some T c / 8 m off the wall.  With 8.5 in of hole that
# is 0.5 % of its load, and as T grows with friction the hook load is not linear in it (by 1.6e-4; as c goes, with it).
INCLINED = """
name = "inclined"
[wellbore]
stations = [[0, 60, 0], [1000, 60, 0]]
intervals = [{to_md = "1000 m", diameter = "5.02 in", friction = 0.2}]
[string]
components = [{name = "pipe", outer_diameter = "5 in", inner_diameter = "4.276 in", segment_length = "10 m"}]
[mud]
density = "1200 kg/m^3"
"""
SWEEP = """
name = "inclined"
case = "inclined.toml"
{head}
[[parameters]]
key = "friction"
distribution = "normal"
mean = 0.25
sd = 0.04
[[parameters]]
key = "rig.block_weight"
distribution = "normal"
mean = "300 kN"
sd = "4 kN"
[work]
operations = ["trip_out"]
depths = [900]
[uncertainty]
percentiles = [2.5, 50, 97.5]
columns = ["hookload_N", "weight_indicator_N"]
"""


def swept(folder: Path, head: str) -> tuple[SweepSpec, Dataset]:
    """A sweep of the straight inclined string, computed in this process."""
    (folder / "inclined.toml").write_text(INCLINED, encoding="utf-8")
    (folder / "sweep.toml").write_text(SWEEP.format(head=head), encoding="utf-8")
    spec = read_sweep(folder / "sweep.toml")
    runner, samples = prepare(spec)
    dataset = begin_dataset(folder / "out", runner.template, samples)
    rows = [row for k in range(len(samples)) for row in runner.rows_of(sample_of(samples, k))]
    dataset.write([as_table(rows)])
    return spec, dataset


def of_friction(spec: SweepSpec, dataset: Dataset) -> tuple[float, float]:
    """Hook load without friction and what a friction factor of 1 adds [N], in closed form: w L cos θ and w L sin θ.

    The wall does not carry the upper half of the first segment, 5 m, which hangs on the top drive.
    """
    case = prepare(spec)[0].template.base
    pipe = section_of(case.string.components[0], case.mud.density)
    return 900.0 * pipe.weight * np.cos(np.radians(60)), 895.0 * pipe.weight * np.sin(np.radians(60))


@pytest.mark.slow
def test_the_hook_load_of_a_straight_inclined_string_is_normal_with_its_friction(tmp_path: Path) -> None:
    from scipy import stats

    count = 300
    spec, dataset = swept(tmp_path, f'method = "random"\nsamples = {count}\nseed = 5')
    found = assess(dataset, spec)
    base, slope = of_friction(spec, dataset)
    table = found.percentiles[found.percentiles["column"] == "hookload_N"].set_index("percentile")
    mean, sd = base + 0.25 * slope, 0.04 * slope
    assert table["mean"].iloc[0] == pytest.approx(mean, abs=4 * sd / np.sqrt(count))
    assert table["sd"].iloc[0] == pytest.approx(sd, rel=4 / np.sqrt(2 * count))
    for percentile in (2.5, 50, 97.5):
        share = percentile / 100
        true = stats.norm.ppf(share, mean, sd)
        error = np.sqrt(share * (1 - share) / count) / stats.norm.pdf(true, mean, sd)
        assert table.loc[percentile, "value"] == pytest.approx(true, abs=3 * error)
    # Between the ends lie 34 samples: their distance has a standard deviation of 17 %.
    assert table.loc[50, "high"] - table.loc[50, "low"] == pytest.approx(4 * error_of_median(count, sd), rel=0.3)
    friction, load = (found.rows[name].to_numpy() for name in ("friction", "hookload_N"))
    fitted = np.polyfit(friction, load, 1)
    assert fitted == pytest.approx([slope, base], rel=2e-4)
    assert np.polyval(fitted, friction) == pytest.approx(load, rel=1e-5)


def error_of_median(count: int, sd: float) -> float:
    """Standard error of the median of normal samples."""
    return sd * np.sqrt(np.pi / (2 * count))


@pytest.mark.slow
def test_sobol_indices_of_a_linear_case_are_its_shares_of_the_variance(tmp_path: Path) -> None:
    """The weight indicator adds the block's weight to a hook load that is linear in the friction factor."""
    spec, dataset = swept(tmp_path, 'method = "saltelli"\nsamples = 256')
    found = assess(dataset, spec)
    _, slope = of_friction(spec, dataset)
    shares = np.array([(0.04 * slope) ** 2, 4e3**2])
    shares /= shares.sum()
    table = found.indices[found.indices["column"] == "weight_indicator_N"].set_index(["measure", "parameter"])["value"]
    for measure in ("S1", "ST"):
        for key, share in zip(("friction", "rig.block_weight"), shares, strict=True):
            assert table[measure, key] == pytest.approx(share, abs=0.02)


def test_error_bars_of_saltelli_are_those_of_its_independent_samples(tmp_path: Path) -> None:
    """Blocks of four, of which the two in the middle mix the values of the first and the last."""
    spec, dataset = swept(tmp_path, 'method = "saltelli"\nsamples = 16')
    found = assess(dataset, spec)
    ends = found.rows[found.rows["sample"] % 4 % 3 == 0]
    table = found.percentiles
    median = table[(table["column"] == "hookload_N") & (table["percentile"] == 50)]
    assert median["samples"].tolist() == [32]
    assert median["value"].tolist() == [np.median(ends["hookload_N"])]
    assert set(found.probabilities["samples"]) == {32}
    assert len(found.rows) == 64


def test_indices_of_a_result_that_does_not_vary_are_left_out(tmp_path: Path) -> None:
    spec, dataset = swept(tmp_path, 'method = "random"\nsamples = 20')
    both = spec.uncertainty.model_copy(update={"columns": ("hookload_N", "surface_torque_N_m")})
    found = assess(dataset, spec.model_copy(update={"uncertainty": both}))
    assert set(found.indices["column"]) == {"hookload_N"}
    assert found.trouble == ""


def test_the_torque_of_a_string_that_only_slides_is_noise() -> None:
    rows = pd.DataFrame(
        {"operation": ["trip_in", "trip_in", "rotate_off_bottom", "rotate_off_bottom"], "hookload_N": 1e6,
         "surface_torque_N_m": [3.0, -9.0, 9.0, 11.0], "drive_torque_N_m": [500.0, 500.0, 3.0, 4.0]}
    )  # fmt: skip
    columns = ["hookload_N", "surface_torque_N_m", "drive_torque_N_m"]
    expected = {("trip_in", "surface_torque_N_m"), ("rotate_off_bottom", "drive_torque_N_m")}
    assert noise_in(rows, columns) == expected
    assert noise_in(rows.drop(columns="hookload_N"), columns[1:]) == set()


def test_runs_have_no_depth_to_choose(tmp_path: Path) -> None:
    spec, dataset = swept(tmp_path, 'method = "random"\nsamples = 5')
    runs = spec.model_copy(update={"work": spec.work.model_copy(update={"kind": "simulate"})})
    assert np.isnan(assess(dataset, runs).bit_depth)
    with pytest.raises(InputError, match="no depth"):
        assess(dataset, runs, 900.0)


def test_too_few_samples_for_indices_are_said_and_the_rest_is_told(tmp_path: Path) -> None:
    spec, dataset = swept(tmp_path, 'method = "random"\nsamples = 5')
    found = assess(dataset, spec)
    assert found.indices.empty
    assert "at least 12 samples" in found.trouble
    assert len(found.percentiles) == 6


def test_an_incomplete_dataset_and_a_depth_that_is_not_there_are_refused(tmp_path: Path) -> None:
    spec, dataset = swept(tmp_path, 'method = "random"\nsamples = 5')
    with pytest.raises(InputError, match="a depth of the sweep, such as 900 m"):
        assess(dataset, spec, 850.0)
    with pytest.raises(InputError, match="a depth of the sweep, such as 900 m"):
        assess(dataset, spec, 900.0 - 0.51 * 0.3048)
    assert assess(dataset, spec, 900.0 - 0.49 * 0.3048).bit_depth == 900.0  # in whole feet
    dataset.done.discard(3)
    with pytest.raises(InputError, match="1 of 5 are missing"):
        assess(dataset, spec)
