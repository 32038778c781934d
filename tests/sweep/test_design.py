"""Samples: their number, their distributions and correlations, and that a seed gives them again."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.errors import InputError
from fctd.sweep.design import drawn, morris_points, sample_of, samples_of
from fctd.sweep.spec import ParameterSpec, SweepSpec, read_sweep
from validation.parts.small_sweep import WORK, sweep_file

UNIFORM = {"key": "mud.density", "distribution": "uniform", "low": 1000, "high": 1200}


def spec_of(method: str, parameters: list[dict[str, object]], samples: int | None = None, **more: object) -> SweepSpec:
    work = {"operations": ["trip_out"], "depths": "600:900:100"}
    raw = {"name": "a", "case": "well.toml", "method": method, "parameters": parameters, "work": work, **more}
    return SweepSpec.model_validate(raw | ({} if samples is None else {"samples": samples}))


def test_a_grid_has_all_combinations_and_the_last_key_varies_first() -> None:
    table = samples_of(spec_of("grid", [{"key": "friction", "low": 0.1, "high": 0.3, "count": 3},
                                        {"key": "bit.weight_on_bit", "values": ["10 kN", "20 kN"]}]))  # fmt: skip
    assert table.columns.tolist() == ["sample", "friction", "bit.weight_on_bit"]
    assert table["friction"].tolist() == pytest.approx([0.1, 0.1, 0.2, 0.2, 0.3, 0.3])
    assert table["bit.weight_on_bit"].tolist() == [10, 20] * 3


def test_a_list_takes_values_side_by_side() -> None:
    table = samples_of(spec_of("list", [{"key": "a", "values": [1, 2]}, {"key": "b", "low": 0, "high": 4, "count": 2}]))
    assert table[["a", "b"]].to_numpy().tolist() == [[1, 0], [2, 4]]


@pytest.mark.parametrize("method", ["random", "latin_hypercube", "sobol", "halton", "saltelli", "morris"])
def test_a_seed_gives_the_same_samples_again_and_another_seed_others(method: str) -> None:
    parameters = [UNIFORM, {"key": "friction", "distribution": "normal", "mean": 0.3, "sd": 0.1}]
    one, two, other = (samples_of(spec_of(method, parameters, 16, seed=seed)) for seed in (1, 1, 2))
    pd.testing.assert_frame_equal(one, two)
    assert not one.equals(other)
    # Saltelli needs n (k + 2) samples, Morris n (k + 1).
    assert len(one) == {"saltelli": 64, "morris": 48}.get(method, 16)
    assert one["mud.density"].between(1000, 1200).all()


@pytest.mark.parametrize(
    ("given_numbers", "law"),
    [
        ({"distribution": "uniform", "low": 2, "high": 5}, ("uniform", 2, 3)),
        ({"distribution": "normal", "mean": 3, "sd": 2}, ("norm", 3, 2)),
        ({"distribution": "normal", "mean": 3, "sd": 2, "low": 2, "high": 7}, ("truncnorm", -0.5, 2, 3, 2)),
        ({"distribution": "lognormal", "median": 3, "log_sd": 0.4}, ("lognorm", 0.4, 0, 3)),
        ({"distribution": "triangular", "low": 1, "mode": 2, "high": 5}, ("triang", 0.25, 1, 4)),
    ],
)
def test_drawn_values_have_their_distribution(given_numbers: dict[str, object], law: tuple[str, float]) -> None:
    """By the test of Kolmogorov and Smirnov: all points of a grid of the unit interval differ by its step at most."""
    from scipy import stats  # slow to import

    name, *arguments = law
    cdf = getattr(stats, name)(*arguments).cdf
    points = (np.arange(4000) + 0.5) / 4000
    values = drawn(ParameterSpec.model_validate({"key": "a", **given_numbers}), points)
    assert stats.kstest(np.asarray(values, float), cdf).statistic <= 1 / 4000 + 1e-9


def test_drawn_values_of_a_list_are_equally_probable() -> None:
    table = samples_of(spec_of("latin_hypercube", [{"key": "a", "values": ["x", "y", "z"]}], 300))
    assert table["a"].value_counts().to_dict() == {"x": 100, "y": 100, "z": 100}


@given(st.floats(-0.95, 0.95))
def test_correlated_normal_pairs_have_their_coefficient(coefficient: float) -> None:
    normal = {"distribution": "normal", "mean": 1, "sd": 2}
    pair = [{"keys": ["a", "b"], "coefficient": coefficient}]
    spec = spec_of("random", [{"key": "a", **normal}, {"key": "b", **normal}], 4000, correlations=pair)
    table = samples_of(spec)
    # Five standard errors of a correlation of 4,000 draws.
    assert np.corrcoef(table["a"], table["b"])[0, 1] == pytest.approx(
        coefficient, abs=5 * (1 - coefficient**2) / 63 + 1e-9
    )
    assert table["b"].std() == pytest.approx(2, rel=0.06)


def test_points_of_morris_are_the_middles_of_four_cells() -> None:
    """No distribution is asked for its ends; each step of a trajectory goes half-way along one axis."""
    spec = spec_of("morris", [UNIFORM, {"key": "friction", "low": 0, "high": 1, "distribution": "uniform"}], 20)
    points = morris_points(spec)
    np.testing.assert_allclose(np.unique(points.round(12)), [0.125, 0.375, 0.625, 0.875])
    steps = np.diff(points.reshape(20, 3, 2), axis=1)
    np.testing.assert_allclose(np.sort(np.abs(steps), axis=2), np.broadcast_to([0.0, 0.5], steps.shape), atol=1e-12)


def test_correlations_that_contradict_each_other_are_refused(tmp_path: Path) -> None:
    normal = {"distribution": "normal", "mean": 1, "sd": 2}
    pairs = [
        {"keys": keys, "coefficient": 0.9 * sign} for keys, sign in ((["a", "b"], 1), (["b", "c"], 1), (["a", "c"], -1))
    ]
    spec = spec_of("random", [{"key": key, **normal} for key in "abc"], 10, correlations=pairs)
    with pytest.raises(InputError, match="that random numbers can have together"):
        samples_of(spec)


def test_bounds_without_a_share_of_the_distribution_are_refused() -> None:
    with pytest.raises(InputError, match='parameters = "a": expected low and high between which the normal'):
        drawn(
            ParameterSpec.model_validate({"key": "a", "distribution": "normal", "mean": 0, "sd": 1, "low": 90}),
            np.zeros(1),
        )


def test_a_grid_of_too_many_samples_is_refused() -> None:
    axes = [{"key": key, "low": 0, "high": 1, "count": 100_000} for key in "ab"]
    with pytest.raises(InputError, match="a grid of at most"):
        samples_of(spec_of("grid", axes))


def test_a_survey_alone_may_vary(tmp_path: Path) -> None:
    spec = read_sweep(sweep_file(tmp_path, 'method = "random"\nsamples = 5', '[survey]\ntool = "mwd"\n' + WORK))
    assert samples_of(spec).columns.tolist() == ["sample"]
    assert len(samples_of(spec)) == 5


def test_a_sample_is_a_row_of_the_table() -> None:
    """A whole number stays one beside numbers that are none."""
    segments = {"key": "string.components[0].segments", "values": [10, 20, 30, 40, 50]}
    table = samples_of(spec_of("random", [UNIFORM, segments], 5))
    sample = sample_of(table, 3)
    assert sample == (3, {key: table[key].iloc[3] for key in ("mud.density", "string.components[0].segments")})
    assert [type(value) for value in sample.by_key.values()] == [float, int]
