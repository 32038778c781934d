"""What a sweep's samples say: percentiles and their convergence, probabilities, and the influence of each parameter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from fctd.case.errors import InputError, naming
from fctd.case.message import quantity
from fctd.sweep.dataset import Dataset
from fctd.sweep.indices import indices_of
from fctd.sweep.percentiles import columns_of, convergence_table, percentile_table
from fctd.sweep.probabilities import probability_table
from fctd.sweep.spec import SweepSpec

if TYPE_CHECKING:
    import pandas as pd


# Least standard deviation of a result with indices, over its mean or one SI unit: below is rounding.
SPREAD: Final = 1e-5
# A torque below this share of the hook load, in metres, is what the solver leaves out of balance [N m over N]: each
# body balances within 1e-7 of the string's weight, and a hundred of them add up.
OUT_OF_BALANCE: Final = 1e-5
# A depth may be asked for as a whole number of feet: half a foot [m].
ROUNDED: Final = 0.1524


@dataclass(frozen=True, repr=False)
class Uncertainty:
    """Tables of ``assess``.

    columns : that they tell of; percentiles, convergence : see percentiles.py; probabilities : see probabilities.py;
    indices : a row for every operation, column, parameter and measure at the depth of the indices, with value and
    error; bit_depth [m] : of the indices, NaN where rows have none; trouble : why there are no indices, or "";
    noise : operations and columns whose torque is 0 but for what the solver leaves out of balance.
    """

    spec: SweepSpec
    rows: pd.DataFrame
    columns: list[str]
    percentiles: pd.DataFrame
    probabilities: pd.DataFrame
    indices: pd.DataFrame
    convergence: pd.DataFrame
    bit_depth: float
    trouble: str
    noise: frozenset[tuple[str, str]]


def assess(dataset: Dataset, spec: SweepSpec, bit_depth: float | None = None) -> Uncertainty:
    """What the samples of a dataset say; bit_depth [m] : of the indices, by default the last.

    Raises InputError for an incomplete dataset, for columns that it does not have, and for another depth.
    """
    import pandas as pd

    if dataset.missing:
        expected = "a sweep whose samples all have rows: run fctd sweep again, which goes on with it"
        raise InputError(expected, value=f"{len(dataset.missing)} of {len(dataset.samples)} are missing")
    rows = dataset.rows()
    if spec.work.kind == "simulate":
        rows = rows.drop(columns=["bit_depth_m"], errors="ignore")
    if "operation" not in rows:
        raise InputError("a sweep of which a sample has an answer", value=dataset.folder)
    apart, count = independent(rows, spec, len(dataset.samples))
    with naming(spec.file):
        columns = columns_of(rows, spec.uncertainty.columns)
        probabilities = probability_table(apart, spec.uncertainty.limits, count)
    depth, at = _at(rows, bit_depth)
    found, trouble, noise = [], "", noise_in(rows, columns)
    for operation, group in at.groupby("operation", sort=True):
        for name in columns:
            values = group.set_index("sample")[name]
            if (operation, name) in noise or not values.std() > SPREAD * max(abs(values.mean()), 1.0):
                continue
            try:
                indices = indices_of(spec, dataset.samples, values)
            except InputError as error:
                trouble = str(error)
                continue
            found += [{"operation": operation, "column": name, **index._asdict()} for index in indices]
    return Uncertainty(
        spec,
        rows,
        columns,
        percentile_table(apart, columns, spec.uncertainty.percentiles),
        probabilities,
        pd.DataFrame(found, columns=["operation", "column", "parameter", "measure", "value", "error"]),
        convergence_table(apart, columns, spec.uncertainty.percentiles),
        depth,
        trouble,
        noise,
    )


def independent(rows: pd.DataFrame, spec: SweepSpec, samples: int) -> tuple[pd.DataFrame, int]:
    """Rows of samples that are drawn independently, and the number of those samples.

    Of a block of Saltelli's design only the first and the last sample are; the others share their values with them, and
    counted as samples of their own they would make error bars too narrow.
    """
    if spec.method != "saltelli":
        return rows, samples
    length = len(spec.parameters) + 2
    return rows[(rows["sample"] % length).isin([0, length - 1])], 2 * samples // length


def first_operation(rows: pd.DataFrame, wanted: str | None) -> str:
    """The operation of a picture of one: the one that is wanted, else the sweep's first."""
    return wanted or str(rows["operation"].dropna().iloc[0])


def noise_in(rows: pd.DataFrame, columns: Sequence[str]) -> frozenset[tuple[str, str]]:
    """Operations and columns with a torque that is noise, as of a string that only slides."""
    if "hookload_N" not in rows:
        return frozenset()
    torques = [name for name in columns if name.endswith("_torque_N_m")]
    return frozenset(
        (str(operation), name)
        for operation, group in rows.groupby("operation")
        for name in torques
        if group[name].abs().max() < OUT_OF_BALANCE * group["hookload_N"].abs().max()
    )


def _at(rows: pd.DataFrame, bit_depth: float | None) -> tuple[float, pd.DataFrame]:
    """The depth of the indices, and its rows."""
    if "bit_depth_m" not in rows:
        if bit_depth is not None:
            raise InputError("no depth, as rows of runs have none", key="bit_depth", value=quantity(bit_depth, "m"))
        return float("nan"), rows
    depths = rows["bit_depth_m"].dropna().unique()
    wanted = float(max(depths)) if bit_depth is None else bit_depth
    depth = float(min(depths, key=lambda other: abs(other - wanted)))
    if abs(depth - wanted) > ROUNDED:
        raise InputError(
            f"a depth of the sweep, such as {quantity(depth, 'm')}", key="bit_depth", value=quantity(wanted, "m")
        )
    return depth, rows[rows["bit_depth_m"] == depth]
