"""The sweep file: which keys of a case vary and how, what is computed of each sample, and with which limits.

A number is bare or has its unit, as in a case file; all numbers of one parameter have the same unit.
"""

import os
from collections.abc import Mapping
from decimal import Decimal
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Final, Literal, Self

from pydantic import Field, StrictBool, field_validator, model_validator

from fctd.case import units
from fctd.case.errors import InputError, Table
from fctd.case.from_python import as_written
from fctd.case.operation_names import KindName
from fctd.case.operations import KINDS
from fctd.case.raw_case import checked, read_model, split_key
from fctd.case.spellings import split
from fctd.sweep.limits import LimitSpec
from fctd.sweep.survey_errors import SurveyErrors

Written = float | str
Method = Literal["grid", "list", "random", "latin_hypercube", "sobol", "halton", "saltelli", "morris"]
Distribution = Literal["uniform", "normal", "lognormal", "triangular"]
# Keys that a distribution needs, in the order of its parameters, and whether it may be truncated.
NEEDS: Final[dict[str, tuple[str, ...]]] = {
    "uniform": ("low", "high"),
    "normal": ("mean", "sd"),
    "lognormal": ("median", "log_sd"),
    "triangular": ("low", "mode", "high"),
}
TRUNCATED: Final = ("normal", "lognormal")
# Methods that list values; the others draw from distributions.
LISTED: Final = ("grid", "list")
# Methods whose samples are those of sensitivity indices, which need independent parameters.
INDEPENDENT: Final = ("saltelli", "morris")
MOST_SAMPLES: Final = 10_000_000
Probability = Annotated[float, units.Number(noun="a correlation", at_least=-1.0, at_most=1.0)]
Percentile = Annotated[float, units.Number(noun="a percentile", above=0.0, at_most=99.999)]
PositiveShare = Annotated[float, units.Number(noun="a share", above=0.0, at_most=1.0)]
Samples = Annotated[int, units.Whole(at_least=1, at_most=MOST_SAMPLES)]


class ParameterSpec(Table):
    """A key of the case that varies.

    Listed: ``values``, or ``count`` numbers from ``low`` to ``high``.  Drawn: a ``distribution`` with its numbers, or
    ``values`` that are equally probable.  ``low`` and ``high`` truncate a normal or lognormal distribution; ``log_sd``
    is the standard deviation of the logarithm.
    """

    key: str = Field(description="a key of the case, such as mud.density, friction or friction.open")
    distribution: Distribution | None = None
    low: Written | None = None
    high: Written | None = None
    mean: Written | None = None
    sd: Written | None = None
    median: Written | None = None
    log_sd: units.PositiveRatio | None = None
    mode: Written | None = None
    values: tuple[StrictBool | int | float | str, ...] | None = None
    count: Annotated[int, units.Whole(at_least=2, at_most=MOST_SAMPLES)] | None = None

    @field_validator("key")
    @classmethod
    def _check_key(cls, key: str) -> str:
        if not split_key(key):
            raise InputError("a dotted key of the case, such as mud.density", value=key)
        return key

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.values is not None:
            if not self.values:
                raise InputError("at least one value", key="values", value=[])
            kinds = {"a number" if isinstance(value, int | float) and value is not True and value is not False else
                     "a text" if isinstance(value, str) else "true or false" for value in self.values}  # fmt: skip
            if len(kinds) > 1:
                raise InputError("values of one kind, all numbers, texts or true and false", key="values")
            for other in ("distribution", "count", "low", "high", "mean", "sd", "median", "log_sd", "mode"):
                if getattr(self, other) is not None:
                    raise InputError(f"values or {other}, not both", key=other)
            _ = self.unit  # raises InputError where they differ
            return self
        if self.count is not None:
            self._need(("low", "high"), ("count",), "count")
        elif self.distribution is None:
            raise InputError("values, a distribution, or count with low and high", key="distribution")
        else:
            truncating = ("low", "high") if self.distribution in TRUNCATED else ()
            self._need(NEEDS[self.distribution], truncating, f'distribution "{self.distribution}"')
        self._check_numbers()
        return self

    def _need(self, needed: tuple[str, ...], allowed: tuple[str, ...], what: str) -> None:
        for key in needed:
            if getattr(self, key) is None:
                raise InputError(f"a number, which {what} needs", key=key)
        for key in ("distribution", "low", "high", "mean", "sd", "median", "log_sd", "mode"):
            if getattr(self, key) is not None and key not in (*needed, *allowed, "distribution"):
                raise InputError(f"no {key} beside {what}", key=key)
        if self.count is not None and self.distribution is not None:
            raise InputError("a distribution or a count, not both", key="count")

    def _check_numbers(self) -> None:
        numbers = {
            key: value for key in ("low", "mode", "mean", "median", "high") if (value := self.number(key)) is not None
        }
        _ = self.unit  # raises InputError where they differ
        low, high = numbers.get("low"), numbers.get("high")
        if low is not None and high is not None and not low < high:
            raise InputError(f"more than low, {self.low}", key="high")
        for here, there in pairwise(key for key in ("low", "mode", "high") if key in numbers):
            if not numbers[here] <= numbers[there]:
                raise InputError(f"at least {here}, {getattr(self, here)}", key=there)
        sd = self.number("sd")
        if sd is not None and not sd > 0:
            raise InputError("a standard deviation above 0", key="sd")
        if self.distribution == "lognormal" and not numbers["median"] > 0:
            raise InputError("a median above 0", key="median")
        if self.distribution == "lognormal" and high is not None and not high > 0:
            raise InputError("a number above 0", key="high")

    @property
    def choices(self) -> tuple[bool | int | float | str, ...]:
        """The values, numbers in the parameter's unit; none where it has ``low`` and ``high`` or a distribution."""
        if self.values is None or not self.unit:
            return self.values or ()
        return tuple(split_number(value, "values")[0] for value in self.values)  # texts, as they have a unit

    def number(self, key: str) -> float | None:
        """The number of a key, in the parameter's unit."""
        value = getattr(self, key)
        return None if value is None else split_number(value, key)[0]

    @property
    def unit(self) -> str:
        """The unit of the numbers, "" of bare ones and of other values; InputError where they differ."""
        if self.values is not None:
            if not all(map(_has_unit, self.values)):
                return ""
            written: dict[str, Any] = {f"values[{i}]": value for i, value in enumerate(self.values)}
        else:
            written = {key: getattr(self, key) for key in ("low", "high", "mean", "sd", "median", "mode")}
        of = {key: split_number(value, key)[1] for key, value in written.items() if value is not None}
        first = next(iter(of.values()), "")
        for key, unit in of.items():
            if unit != first:
                expected = f"a number in {first}" if first else "a bare number"
                raise InputError(f"{expected}, the unit of the parameter's other numbers", key=key)
        return first


def _has_unit(value: Written | bool) -> bool:
    """Whether a value is a number with its unit, and no other text of the case, such as a name."""
    try:
        found = split(value) if isinstance(value, str) else None
    except InputError:
        return False
    return found is not None and len(found.unit.split()) == 1


def split_number(value: Written, key: str) -> tuple[float, str]:
    """Number and unit, "" of a bare number; raises InputError for another text, or a number that is not finite."""
    if isinstance(value, str):
        found = split(value)
        if found is None:
            raise InputError("a number, or a number with its unit such as '1200 kg/m^3'", key=key, value=value)
        return float(found.number), found.unit.strip()
    if not abs(Decimal(value)).is_finite():
        raise InputError("a finite number", key=key, value=value)
    return float(value), ""


class CorrelationSpec(Table):
    """Correlation of two parameters, of their normal scores."""

    keys: tuple[str, str] = Field(description="a list of two keys of parameters")
    coefficient: Probability


BitDepth = units.MeasuredDepth | Literal["td", "shoe"]


class WorkSpec(Table):
    """What is computed of each sample: a steady ``chart``, an ``equilibrium``, a ``refine`` search, or ``simulate``.

    ``operations`` and ``depths`` are those of ``fctd chart``, ``bit_depth`` and ``tolerance`` those of the other
    commands; ``simulate`` runs the case's operations, of which the last tells the severity of stick-slip.
    """

    kind: Literal["chart", "equilibrium", "refine", "simulate"] = "chart"
    operations: tuple[KindName, ...] = ()
    depths: str | tuple[BitDepth, ...] | None = None
    bit_depth: BitDepth | None = None
    speed: units.PositiveSpeed | None = None
    rpm: units.PositiveRpm | None = None
    flow: units.Flow | None = None
    tolerance: PositiveShare = 0.01

    @model_validator(mode="after")
    def _check(self) -> Self:
        allowed = {
            "chart": ("operations", "depths", "speed", "rpm", "flow"),
            "equilibrium": ("operations", "bit_depth", "speed", "rpm", "flow"),
            "refine": ("operations", "bit_depth", "speed", "rpm", "flow", "tolerance"),
            "simulate": (),
        }[self.kind]
        for key in sorted(self.model_fields_set - {"kind"}):
            if getattr(self, key) is not None and key not in allowed:
                raise InputError(f'no {key} beside kind = "{self.kind}"', key=key)
        if self.kind != "simulate" and not self.operations:
            raise InputError(f"a list of kinds of operation, of {', '.join(KINDS)}", key="operations")
        if self.kind == "chart" and self.depths is None:
            raise InputError("bit depths, '1750:2450:10' or a list", key="depths")
        if self.kind in ("equilibrium", "refine") and self.bit_depth is None:
            raise InputError("a bit depth such as '2450 m'", key="bit_depth")
        return self


class UncertaintySpec(Table):
    """What ``fctd uncertainty`` tells: ``percentiles`` of which ``columns``, and ``limits``."""

    percentiles: tuple[Percentile, ...] = (5.0, 50.0, 95.0)
    columns: tuple[str, ...] = ()
    limits: tuple[LimitSpec, ...] = ()


class SweepSpec(Table):
    """A sweep file.

    ``case`` is relative to it, or, from Python, the tables of a case; ``set`` has keys and values for all samples.
    ``samples`` is the number of a drawn method; of ``saltelli`` it is the base number, a power of 2, and of ``morris``
    the number of trajectories.
    ``time_limit`` [s] is for one sample.  With ``bad_samples`` "rows" a sample whose values no case can have is a row
    with the reason; with "refuse" the sweep does not begin.  ``file`` is the file that the sweep was read from.
    """

    name: str = Field(description="a name in quotes")
    case: Path | dict[str, Any] = Field(description="the name of a case file, relative to the sweep file")
    method: Method
    samples: Samples | None = None
    seed: units.Seed = 0
    time_limit: units.PositiveTime = 600.0
    bad_samples: Literal["refuse", "rows"] = "refuse"
    set: dict[str, Any] = Field(default_factory=dict)
    parameters: tuple[ParameterSpec, ...] = ()
    correlations: tuple[CorrelationSpec, ...] = ()
    survey: SurveyErrors | None = None
    tortuosity_seeds: StrictBool = False
    work: WorkSpec = Field(description="a table [work]")
    uncertainty: UncertaintySpec = UncertaintySpec()
    file: Path | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        keys = [parameter.key for parameter in self.parameters]
        for i, key in enumerate(keys):
            if key in keys[:i]:
                raise InputError("one parameter for each key", key=f"parameters[{i}].key", value=key)
            if key in self.set:
                raise InputError("a key that set does not have", key=f"parameters[{i}].key", value=key)
        if self.method in LISTED:
            self._check_listed()
        else:
            self._check_drawn()
        for i, pair in enumerate(self.correlations):
            for k, key in enumerate(pair.keys):
                if key not in keys or pair.keys[1 - k] == key:
                    raise InputError(
                        "two parameters of the sweep", key=f"correlations[{i}].keys", value=list(pair.keys)
                    )
            if any({*pair.keys} == {*other.keys} for other in self.correlations[:i]):
                raise InputError("one correlation of each pair", key=f"correlations[{i}].keys", value=list(pair.keys))
        return self

    def _check_listed(self) -> None:
        if not self.parameters:
            raise InputError("at least one table [[parameters]]", key="parameters")
        for i, parameter in enumerate(self.parameters):
            if parameter.distribution is not None:
                expected = f'values, or count with low and high, beside method = "{self.method}"'
                raise InputError(expected, key=f"parameters[{i}].distribution", value=parameter.distribution)
        counts = [len(p.values) if p.values is not None else p.count or 0 for p in self.parameters]
        if self.samples is not None:
            raise InputError(
                f'no samples beside method = "{self.method}", whose values give their number', key="samples"
            )
        if self.correlations:
            raise InputError(f'no correlations beside method = "{self.method}"', key="correlations")
        if self.method == "list" and len({*counts}) > 1:
            told = ", ".join(map(str, counts))
            raise InputError(f"as many values of each parameter (these are {told})", key="parameters")

    def _check_drawn(self) -> None:
        if self.samples is None:
            raise InputError(f'the number of samples, which method = "{self.method}" needs', key="samples")
        if not self.parameters and self.survey is None and not self.tortuosity_seeds:
            raise InputError(
                "at least one table [[parameters]], a table [survey], or tortuosity_seeds", key="parameters"
            )
        for i, parameter in enumerate(self.parameters):
            if parameter.count is not None:
                expected = f'a distribution or values beside method = "{self.method}"'
                raise InputError(expected, key=f"parameters[{i}].count", value=parameter.count)
        if self.method not in INDEPENDENT:
            return
        if len(self.parameters) < 2:
            raise InputError(f'at least two parameters beside method = "{self.method}"', key="parameters")
        if self.correlations:
            expected = f'no correlations beside method = "{self.method}", whose indices need independent parameters'
            raise InputError(expected, key="correlations")
        size = self.samples * (len(self.parameters) + (2 if self.method == "saltelli" else 1))
        if size > MOST_SAMPLES:
            expected = f"a number with which the design has at most {MOST_SAMPLES} samples (it has {size})"
            raise InputError(expected, key="samples", value=self.samples)
        if self.method == "saltelli" and self.samples & (self.samples - 1):
            raise InputError("a power of 2, as Sobol's sequence needs", key="samples")


def read_sweep(source: str | os.PathLike[str] | Mapping[str, Any]) -> SweepSpec:
    """The sweep of a TOML file, or of its tables; its case is then a path from the current folder.

    In place of a path, tables may hold those of a case, or a ``Case``.  Raises InputError, which names file, key and
    value.
    """
    if isinstance(source, Mapping):
        return checked(SweepSpec, as_written(source), {})
    if not isinstance(source, str | os.PathLike):
        raise InputError("the path of a sweep file, or a dict of its tables", key="sweep", value=source)
    path = Path(source)
    spec = read_model(SweepSpec, path, "a sweep file", context={})
    if not isinstance(spec.case, Path):
        raise InputError("the name of a case file in quotes", key="case", value=spec.case, file=path)
    return spec.model_copy(update={"case": path.parent / spec.case, "file": path})
