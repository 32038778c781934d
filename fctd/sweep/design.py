"""The samples of a sweep: points of a unit cube by the sweep's method, and the values that they stand for."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.sweep.spec import LISTED, MOST_SAMPLES, ParameterSpec, SweepSpec

if TYPE_CHECKING:
    import pandas as pd

Value = float | str

# Levels of a Morris design: its points are the middles of their cells, so that no distribution is asked for its end.
LEVELS: Final = 4
# Least distance of a drawn point from the ends of the unit interval.
_EDGE: Final = 1e-12


def samples_of(spec: SweepSpec) -> pd.DataFrame:
    """A row for each sample: ``sample``, from 0, and a column for each key, numbers in the unit of the parameter.

    Equal specs give equal samples.  Raises InputError for a grid of too many samples, for correlations that no random
    numbers have, and where SALib is missing for ``saltelli`` and ``morris``.
    """
    import pandas as pd

    keys = [parameter.key for parameter in spec.parameters]
    if spec.method in LISTED:
        counts = [len(parameter.choices) or parameter.count or 0 for parameter in spec.parameters]
        size = prod(counts) if spec.method == "grid" else counts[0]
        if size > MOST_SAMPLES:
            raise InputError(f"a grid of at most {MOST_SAMPLES} samples", key="parameters", value=f"{size:.7g} samples")
        number, columns = np.arange(size), {}
        for parameter, count in zip(reversed(spec.parameters), reversed(counts), strict=True):
            columns[parameter.key] = pd.Series(_listed(parameter)).take(number % count).reset_index(drop=True)
            number = number // count if spec.method == "grid" else number  # the last parameter varies fastest
        table = pd.DataFrame({key: columns[key] for key in keys})
    else:
        cube = unit_cube(spec)
        table = pd.DataFrame({p.key: drawn(p, cube[:, k]) for k, p in enumerate(spec.parameters)})
        table = table.reindex(range(len(cube)))
    table.insert(0, "sample", np.arange(len(table)))
    return table


class Sample(NamedTuple):
    """A sample's number, and its values by the key that each is of."""

    number: int
    by_key: dict[str, Value]


def sample_of(samples: pd.DataFrame, number: int) -> Sample:
    """A row of the table of samples."""
    row = {str(key): samples[key].iloc[number] for key in samples.columns if key != "sample"}
    return Sample(number, {key: value.item() if hasattr(value, "item") else value for key, value in row.items()})


def problem_of(spec: SweepSpec) -> dict[str, Any]:
    """The problem of SALib: parameters of the unit cube."""
    keys = [parameter.key for parameter in spec.parameters]
    return {"num_vars": len(keys), "names": keys, "bounds": [[0.0, 1.0]] * len(keys)}


def unit_cube(spec: SweepSpec) -> Array:
    """Points (n, k) of the unit cube, of uniform marginals, by a method that draws; see ``samples_of``."""
    from scipy.stats import qmc

    count, k = spec.samples or 0, len(spec.parameters)
    if spec.method == "saltelli":
        from SALib.sample import sobol

        return np.asarray(sobol.sample(problem_of(spec), count, calc_second_order=False, seed=spec.seed))
    if spec.method == "morris":
        return morris_points(spec)
    if k == 0:
        return np.empty((count, 0))
    if spec.method == "random":
        points = np.random.default_rng(spec.seed).random((count, k))
    elif spec.method == "latin_hypercube":
        points = qmc.LatinHypercube(k, rng=spec.seed).random(count)
    elif spec.method == "halton":
        points = qmc.Halton(k, rng=spec.seed).random(count)
    else:  # the first points of a whole power of 2: scipy warns of another number
        points = qmc.Sobol(k, rng=spec.seed).random_base2(int(np.ceil(np.log2(count))))[:count]
    return _correlated(points, spec)


def morris_points(spec: SweepSpec) -> Array:
    """Trajectories of Morris on the middles of four levels, ((k + 1) samples, k)."""
    from SALib.sample import morris

    levels = np.asarray(morris.sample(problem_of(spec), spec.samples, num_levels=LEVELS, seed=spec.seed))
    return (levels * (LEVELS - 1) + 0.5) / LEVELS


def _correlated(points: Array, spec: SweepSpec) -> Array:
    """Points whose normal scores are correlated as the sweep says."""
    from scipy import stats

    if not spec.correlations:
        return points
    keys = [parameter.key for parameter in spec.parameters]
    matrix = np.eye(len(keys))
    for pair in spec.correlations:
        i, j = map(keys.index, pair.keys)
        matrix[i, j] = matrix[j, i] = pair.coefficient
    try:
        factor = np.linalg.cholesky(matrix)
    except np.linalg.LinAlgError:
        pairs = ", ".join(f"{' and '.join(pair.keys)} {pair.coefficient:g}" for pair in spec.correlations)
        expected = "correlations above -1 and below 1 that random numbers can have together"
        raise InputError(expected, key="correlations", value=pairs) from None
    scores = stats.norm.ppf(np.clip(points, _EDGE, 1 - _EDGE)) @ factor.T
    return np.asarray(stats.norm.cdf(scores))


def _listed(parameter: ParameterSpec) -> list[Any]:
    if parameter.choices:
        return list(parameter.choices)
    low, high = parameter.number("low"), parameter.number("high")
    assert low is not None
    assert high is not None
    return [float(value) for value in np.linspace(low, high, parameter.count or 0)]


def drawn(parameter: ParameterSpec, points: Array) -> list[Any] | Array:
    """The values of a parameter at points (n,) of the unit interval, by the inverse of its distribution."""
    points = np.clip(points, _EDGE, 1 - _EDGE)
    if parameter.choices:
        count = len(parameter.choices)
        return [parameter.choices[int(k)] for k in np.minimum(points * count, count - 1)]
    law = _law(parameter)
    if parameter.distribution in ("normal", "lognormal"):
        low, high = parameter.number("low"), parameter.number("high")
        ends = [0.0 if low is None else law.cdf(low), 1.0 if high is None else law.cdf(high)]
        if not ends[0] < ends[1]:
            expected = f"low and high between which the {parameter.distribution} distribution has numbers"
            raise InputError(expected, key="parameters", value=parameter.key)
        points = ends[0] + points * (ends[1] - ends[0])
    return np.asarray(law.ppf(points), float)


def _law(parameter: ParameterSpec) -> Any:
    """The distribution before it is truncated, of scipy."""
    from scipy import stats

    of = {key: parameter.number(key) or 0.0 for key in ("low", "high", "mean", "sd", "median", "mode")}
    match parameter.distribution:
        case "uniform":
            return stats.uniform(of["low"], of["high"] - of["low"])
        case "normal":
            return stats.norm(of["mean"], of["sd"])
        case "lognormal":
            return stats.lognorm(parameter.log_sd or 0.0, scale=of["median"])
        case _:
            width = of["high"] - of["low"]
            return stats.triang((of["mode"] - of["low"]) / width, of["low"], width)
