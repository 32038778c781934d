"""Influence of parameters: Ishigami's function, a linear result, regressions, and samples without an answer."""

import numpy as np
import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.sweep.design import samples_of
from fctd.sweep.indices import Index, indices_of
from fctd.sweep.spec import SweepSpec
from tests.sweep.test_design import spec_of

PI = [{"key": key, "distribution": "uniform", "low": -np.pi, "high": np.pi} for key in "abc"]


def found(spec: SweepSpec, samples: pd.DataFrame, values: np.ndarray) -> dict[tuple[str, str], Index]:
    result = pd.Series(values, index=samples["sample"])
    return {(index.measure, index.parameter): index for index in indices_of(spec, samples, result)}


def test_sobol_indices_of_ishigamis_function() -> None:
    """Closed form with a = 7 and b = 0.1 (Ishigami & Homma 1990)."""
    spec = spec_of("saltelli", PI, 4096)
    samples = samples_of(spec)
    a, b, c = (samples[key].to_numpy(float) for key in "abc")
    index = found(spec, samples, np.sin(a) + 7 * np.sin(b) ** 2 + 0.1 * c**4 * np.sin(a))
    wanted = {("S1", "a"): 0.3139, ("S1", "b"): 0.4424, ("S1", "c"): 0.0, ("ST", "a"): 0.5576, ("ST", "b"): 0.4424,
              ("ST", "c"): 0.2437}  # fmt: skip
    for key, value in wanted.items():
        assert index[key].value == pytest.approx(value, abs=0.02)
        assert index[key].error < 0.06


def test_sobol_indices_of_a_linear_result_are_its_shares_of_the_variance() -> None:
    """Also where some blocks have no answer."""
    normal = {"distribution": "normal", "mean": 1}
    spec = spec_of("saltelli", [{"key": "a", **normal, "sd": 1}, {"key": "b", **normal, "sd": 2}], 1024)
    samples = samples_of(spec)
    values = np.array(3 * samples["a"] + samples["b"], float)
    values[[5, 900]] = np.nan
    index = found(spec, samples, values)
    for measure in ("S1", "ST"):
        assert index[measure, "a"].value == pytest.approx(9 / 13, abs=0.02)
        assert index[measure, "b"].value == pytest.approx(4 / 13, abs=0.02)


def test_effects_of_morris_are_the_slopes_over_the_unit_cube() -> None:
    """Levels are the middles of four cells, a step of two of them is half of the range of a uniform parameter.

    SALib's step is 2/3 of its levels, which is half of the distribution: three quarters of the slope.
    """
    spec = spec_of("morris", PI[:2], 8)
    samples = samples_of(spec)
    values = np.array(2 * samples["a"] - samples["b"], float)
    values[4] = np.nan  # a trajectory less
    index = found(spec, samples, values)
    assert index["mu_star", "a"].value == pytest.approx(0.75 * 2 * 2 * np.pi)
    assert index["mu_star", "b"].value == pytest.approx(0.75 * 2 * np.pi)
    assert index["sigma", "a"].value == pytest.approx(0, abs=1e-9)


def test_a_regression_explains_a_linear_result_and_its_ranks_a_monotonic_one() -> None:
    spec = spec_of("latin_hypercube", PI[:2], 400)
    samples = samples_of(spec)
    a, b = (samples[key].to_numpy(float) for key in "ab")
    linear = found(spec, samples, 2 * a - b)
    assert linear["R2", ""].value == pytest.approx(1)
    assert linear["SRC", "a"].value == pytest.approx(2 / np.sqrt(5), abs=0.03)
    assert linear["SRC", "b"].value == pytest.approx(-1 / np.sqrt(5), abs=0.03)
    bent = found(spec, samples, np.exp(4 * a))
    assert bent["R2", ""].value < 0.5
    assert bent["R2_rank", ""].value == pytest.approx(1)
    noisy = found(spec, samples, a + np.random.default_rng(1).normal(size=400))
    assert abs(noisy["SRC", "b"].value) < 1.5 * noisy["SRC", "b"].error


def test_errors_of_a_regression_on_one_parameter_are_those_of_its_slope() -> None:
    """1.96 standard errors, as scipy has them of the standardised values."""
    from scipy import stats

    spec = spec_of("random", PI[:1], 30)
    samples = samples_of(spec)
    values = samples["a"].to_numpy(float) + np.random.default_rng(1).normal(size=30)
    index = found(spec, samples, values)["SRC", "a"]
    line = stats.linregress(stats.zscore(samples["a"]), stats.zscore(values))
    assert (index.value, index.error) == pytest.approx((line.slope, 1.96 * line.stderr))


@pytest.mark.parametrize(("method", "count"), [("saltelli", 8), ("morris", 6), ("random", 40)])
def test_too_few_answers_are_said(method: str, count: int) -> None:
    spec = spec_of(method, PI[:2], count)
    samples = samples_of(spec)
    with pytest.raises(InputError, match="at least"):
        indices_of(spec, samples, pd.Series([1.0, 2.0], index=[0, 1]))
