"""Predictions of rows with bands, and their scores where the rows are measured."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Final

import numpy as np
import pandas as pd
from pydantic import Field, FiniteFloat

from fctd.arrays import Array
from fctd.calibration.forward import Evaluation, Forward
from fctd.calibration.quadrature import Mixture
from fctd.calibration.rows import Row, days_of
from fctd.calibration.scatter import EFFECTS, At, draw
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import Unknown
from fctd.case.errors import InputError, Table
from fctd.case.input_file import read_text
from fctd.case.load import Case
from fctd.case.message import frame_of
from fctd.case.raw_case import checked
from fctd.store.whole_file import whole_file

SAMPLES: Final = 4000
# Quantiles of the bands: 50 % and 95 %.
BANDS: Final = {"low95": 0.025, "low50": 0.25, "middle": 0.5, "high50": 0.75, "high95": 0.975}
_LARGEST: Final = 8  # MiB


@dataclass(frozen=True)
class Posterior:
    """What a calibration knows: unknowns with their values (k,) and covariance (k, k) [SI], and the setup.

    spread : of each source and load, the root mean square of a uniform distribution over the recorded ranges [SI].
    mixture : with scatter between days, of the unknowns and the deviations; None without.
    """

    unknowns: tuple[Unknown, ...]
    best: Array
    covariance: Array
    setup: Setup
    spread: Mapping[str, Mapping[str, float]]
    mixture: Mixture | None = None

    def sample(self, count: int, seed: int) -> Array:
        """Values (count, k) of a normal distribution, cut at the bounds."""
        rng = np.random.default_rng(seed)
        low, high = (np.array([getattr(unknown, end) for unknown in self.unknowns]) for end in ("low", "high"))
        drawn = rng.multivariate_normal(self.best, self.covariance, count, method="svd")
        return np.clip(drawn, low, high)

    def write(self, path: Path) -> None:
        """Write it as JSON."""
        data = {
            "unknowns": [
                {"name": u.name, "low": u.low, "high": u.high, "size": u.size, "unit": u.unit, "value": value}
                for u, value in zip(self.unknowns, self.best.tolist(), strict=True)
            ],
            "covariance": self.covariance.tolist(),
            "setup": self.setup.model_dump(mode="json", include={"sources", "strings", "model_error", "bit_torque"}),
            "spread": self.spread,
        }
        if self.mixture is not None:
            data["scatter"] = {name: getattr(self.mixture, name).tolist() for name in _KeptScatter.model_fields}
        with whole_file(path) as scratch:
            scratch.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")


class _KeptUnknown(Table):
    """An unknown in the posterior's file."""

    name: str
    low: FiniteFloat
    high: FiniteFloat
    size: FiniteFloat
    unit: str
    value: FiniteFloat


class _KeptScatter(Table):
    """The mixture in the posterior's file (``Mixture``)."""

    weight: list[Annotated[FiniteFloat, Field(gt=0.0)]]
    deviations: list[list[Annotated[FiniteFloat, Field(ge=0.0)]]]
    mean: list[list[FiniteFloat]]
    covariance: list[list[list[FiniteFloat]]]

    def mixture(self, count: int) -> Mixture:
        """What the file holds of ``count`` unknowns; raises InputError for arrays of other shapes."""
        found = Mixture(*(np.array(getattr(self, name), float) for name in type(self).model_fields))
        m = len(self.weight)
        shapes = {"deviations": (m, len(EFFECTS)), "mean": (m, count), "covariance": (m, count, count)}
        for name, shape in shapes.items():
            if getattr(found, name).shape != shape:
                expected = f"{' by '.join(map(str, shape))} numbers, those of {m} nodes"
                raise InputError(expected, key=f"scatter.{name}", value=getattr(self, name))
        if not m or np.linalg.eigvalsh(found.covariance).min() < 0:
            raise InputError("nodes with covariances of the unknowns", key="scatter.covariance", value=self.covariance)
        return replace(found, weight=found.weight / found.weight.sum())


class _Kept(Table):
    """The posterior's file."""

    unknowns: list[_KeptUnknown]
    covariance: list[list[FiniteFloat]]
    setup: Setup
    spread: dict[str, dict[str, Annotated[FiniteFloat, Field(ge=0.0)]]]
    scatter: _KeptScatter | None = None

    def posterior(self) -> Posterior:
        """What the file holds; raises InputError for a matrix that is no covariance of the unknowns."""
        found = [Unknown(u.name, u.low, u.high, u.value, u.size, None, u.unit) for u in self.unknowns]
        count = len(found)
        if not count:
            raise InputError("at least one unknown", key="unknowns", value=[])
        expected = f"a covariance of the unknowns: {count} rows of {count} numbers, symmetric, no variance below 0"
        if [len(row) for row in self.covariance] != [count] * count:
            raise InputError(expected, key="covariance", value=self.covariance)
        sizes = np.array([unknown.size for unknown in self.unknowns])
        scaled = np.array(self.covariance) / np.outer(sizes, sizes)
        rounding = 1e-8 * max(float(np.abs(scaled).max()), 1e-300)
        if np.abs(scaled - scaled.T).max() > rounding or np.linalg.eigvalsh(scaled).min() < -rounding:
            raise InputError(expected, key="covariance", value=self.covariance)
        best = np.array([u.value for u in self.unknowns])
        mixture = None if self.scatter is None else self.scatter.mixture(count)
        return Posterior(tuple(found), best, np.array(self.covariance), self.setup, self.spread, mixture)


def posterior_file(case_file: Path) -> Path:
    """The posterior's file beside a calibrated case."""
    return case_file.with_suffix(".fit.json")


def read_posterior(path: Path) -> Posterior:
    """The posterior of a file; raises InputError for a file that cannot be used."""
    try:
        text = read_text(path, _LARGEST, "the posterior beside the case, which fctd calibrate --out writes,")
        return checked(_Kept, json.loads(text)).posterior()
    except InputError as error:
        raise error.in_file(path) from None
    except (ValueError, RecursionError) as error:
        raise InputError(f"a posterior as fctd calibrate --out writes it ({error})", file=path) from None


def predict_rows(
    posterior: Posterior, rows: Sequence[Row], strings: Mapping[str, Case], samples: int = SAMPLES, seed: int = 0
) -> pd.DataFrame:
    """A row for each reading that a row can have, with bands, and scores where it was measured.

    Columns: id, string, operation, bit_depth_m, speed_m_s, rpm, flow_m3_s, weight_on_bit_N, load, unit,
    predicted (at the calibrated values), the quantiles of ``BANDS``, reason (why there is no prediction, or none); low
    and high of the recorded range, inside50 and inside95 (of its middle, None where not measured), crps [SI] and
    distance (from the range over its middle, 0 inside).

    The readings are taken as linear in the unknowns, whose values are drawn from a normal distribution cut at their
    bounds; to each are added the source's noise, a uniform distribution as wide as its recorded ranges, and the
    declared error of the model, both normal and independent.  With scatter the days are such as were not fitted, and
    the rows of a day share its effects.
    """
    forward = Forward(rows, strings, posterior.unknowns, posterior.setup)
    at = forward.evaluate(posterior.best)
    table = []
    drawn = _draws(posterior, forward, at, samples, seed)
    for i, (reading, values) in enumerate(zip(forward.readings, drawn, strict=True)):
        row = rows[reading.row]
        low, high = reading.range.low, reading.range.high
        bands = dict(zip(BANDS, np.quantile(values, list(BANDS.values())).tolist(), strict=True))
        table.append(
            {
                "id": row.id, "string": row.string, "operation": row.operation, "bit_depth_m": row.bit_depth,
                **row.does(strings[row.string]), "load": reading.load,
                "unit": "N" if reading.load == "hookload" else "N*m", "predicted": at.value[i], **bands,
                "reason": at.reasons.get(reading.row, "none"), "low": low, "high": high,
                **_scores(values, bands, reading.range.middle, low, high, float(at.value[i])),
            }
        )  # fmt: skip
    return frame_of(table)


def draw_readings(
    posterior: Posterior, forward: Forward, samples: int = SAMPLES, seed: int = 0, *, noise: bool = True
) -> Array:
    """The draws (n, samples) [SI] of the readings of a forward model, which has the unknowns of the posterior.

    noise : whether they are what the source would record; without it they are what the string and the rig make.
    """
    draws = _draws if noise else _without_noise
    return np.array([*draws(posterior, forward, forward.evaluate(posterior.best), samples, seed)])


def _draws(posterior: Posterior, forward: Forward, at: Evaluation, samples: int, seed: int) -> Iterator[Array]:
    """Draws of each reading (samples,)."""
    drawn = _without_noise(posterior, forward, at, samples, seed)
    rng = np.random.default_rng([seed, 1])
    for reading, values in zip(forward.readings, drawn, strict=True):
        spread = posterior.spread.get(forward.rows[reading.row].source, {})
        uniform = np.sqrt(3) * spread.get(reading.load, 0.0)
        other = np.hypot(reading.noise, getattr(posterior.setup.model_error, reading.load))
        noisy = values + other * rng.normal(size=samples)
        yield noisy + uniform * rng.uniform(-1, 1, samples)


def _without_noise(posterior: Posterior, forward: Forward, at: Evaluation, samples: int, seed: int) -> Iterable[Array]:
    """Draws of each reading (samples,) for drawn unknowns, on days that were not fitted."""
    if posterior.mixture is None:
        off = posterior.sample(samples, seed) - posterior.best
        return [value + off @ slopes for value, slopes in zip(at.value, at.slopes, strict=True)]
    _, day = days_of(forward.rows)
    of_reading = np.array([day[reading.row] for reading in forward.readings], np.int64)
    linear = At(at.value, at.slopes, forward.gains(posterior.best))
    rng = np.random.default_rng(seed)
    return draw(posterior.unknowns, posterior.mixture, posterior.best, linear, of_reading, rng, samples)


def _scores(
    values: Array, bands: Mapping[str, float], middle: float, low: float, high: float, at: float
) -> dict[str, Any]:
    if np.isnan(middle) or np.isnan(at):
        return {"inside50": None, "inside95": None, "crps": np.nan, "distance": np.nan}
    off = max(at - high, low - at, 0.0)
    return {
        "inside50": bands["low50"] <= middle <= bands["high50"],
        "inside95": bands["low95"] <= middle <= bands["high95"],
        "crps": crps(values, middle),
        "distance": off / abs(middle) if middle else np.nan,
    }


def crps(values: Array, measured: float) -> float:
    """Continuous ranked probability score of a sample (n,), E|X − y| − E|X − X′|/2 (Gneiting & Raftery 2007)."""
    x = np.sort(values)
    n = len(x)
    between = 2 * float(x @ (2 * np.arange(n) - n + 1)) / n**2
    return float(np.abs(x - measured).mean() - 0.5 * between)


def coverage(table: pd.DataFrame) -> dict[str, tuple[int, int]]:
    """How many of the measured readings lie inside each band, and how many there are."""
    scored = table[table["inside95"].notna()]
    return {name: (int(scored[name].astype(bool).sum()), len(scored)) for name in ("inside50", "inside95")}
