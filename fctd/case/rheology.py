"""The flow curve of a mud: its parameters, or readings of a viscometer and the curve through them."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, Any, Final, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike
from pydantic import Field, model_validator
from pydantic_core import CoreSchema, core_schema

from fctd.arrays import Array
from fctd.case import units
from fctd.case.errors import Expects, InputError, Table
from fctd.case.units import YIELD_STRESS, Dimension, Quantity

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler

# The oilfield viscometer (rotor 1, bob 1, spring 1; API RP 13B-1): stress of a degree [Pa], shear rate of 1 rev/min
# [1/s].  With them the plastic viscosity in mPa s is the difference of the readings at 600 and 300.
DEGREE, PER_RPM = 0.511, 511 / 300
RATE_300, RATE_600 = 300 * PER_RPM, 600 * PER_RPM
# Least slope of a curve: a mud that is nearly all yield stress has none.
FLATTEST: Final = 0.1
# Shear rate at which one viscosity stands for a curve [1/s]: that of a string that moves in its annulus.
USUAL_RATE: Final = 100.0
MOST_READING: Final = 1000.0
_SPEED: Final = re.compile(r"[1-9][0-9]{0,2}")  # [rev/min]
_TO_THE_INDEX: Final = re.compile(r"\s*[*.·]?\s*s\s*\^?\s*[nⁿ](?![^\W\d_])")


class Rheology(NamedTuple):
    """τ = τ_y + K γⁿ (Herschel & Bulkley 1926): yield stress [Pa], consistency K [Pa sⁿ], index n; scalars or (n,)."""

    yield_stress: float | Array
    consistency: float | Array
    index: float | Array  # type: ignore[assignment]  # of the curve; nobody searches this tuple

    @classmethod
    def newtonian(cls, viscosity: float | Array) -> Self:
        """A fluid of one viscosity [Pa s]."""
        return cls(0.0, viscosity, 1.0)

    def stress(self, rate: ArrayLike) -> Array:
        """Shear stress [Pa] at shear rates of at least 0 [1/s]."""
        return np.asarray(self.yield_stress + self.consistency * np.asarray(rate, float) ** self.index)

    @property
    def upper_index(self) -> Array:
        """Slope of the curve between 300 and 600 rev/min of the viscometer, RP 13D's n_p; 1 without viscosity."""
        low, high = self.stress(RATE_300), self.stress(RATE_600)
        rise = np.divide(high, low, out=np.full_like(low, RATE_600 / RATE_300), where=low > 0)
        return np.maximum(np.log2(rise), FLATTEST)


class Fit(NamedTuple):
    """A curve through readings of a viscometer: its rule in words, and misfit (n,), fitted less read [degrees]."""

    curve: Rheology
    rule: str
    misfit: tuple[float, ...]


class Readings(Expects):
    """Pydantic annotation for readings of a viscometer [degrees] by speed [rev/min], at least two, which rise."""

    expected = "a table of readings by speed, at least two, such as {600 = 60, 300 = 40}"

    def parse(self, raw: object) -> dict[int, float]:
        """The readings by ascending speed; InputError for what is none, or falls."""
        if not isinstance(raw, Mapping) or len(raw) < 2:
            raise InputError(self.expected, value=raw)
        found = {}
        for key, value in raw.items():
            if not _SPEED.fullmatch(str(key)):
                raise InputError("a speed of the viscometer in rev/min, such as 600", key=str(key), value=value)
            reading = units.Number(noun="a reading in degrees", at_least=0.0, at_most=MOST_READING)
            try:
                found[int(key)] = reading.parse(value)
            except InputError as error:
                raise error.at(str(key)) from None
        found = dict(sorted(found.items()))
        speeds = list(found)
        for below, speed in pairwise(speeds):
            if found[speed] < found[below] or (speed == speeds[-1] and found[speed] == found[below]):
                raise InputError(
                    f"more than {found[below]:g}, the reading at {below} rev/min, as the stress in a mud rises with "
                    "the speed",
                    key=str(speed), value=found[speed],
                )  # fmt: skip
        return found

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_before_validator_function(self.parse, handler(source))

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        reading = {"type": "number", "minimum": 0, "maximum": MOST_READING}
        names = {"pattern": f"^{_SPEED.pattern}$"}
        shape = {"type": "object", "additionalProperties": reading, "propertyNames": names}
        return shape | {"description": self.expected}


@dataclass(frozen=True, kw_only=True)
class ConsistencyNumber(Quantity):
    """A consistency K of τ = K γⁿ: a stress times sⁿ, and a second is one for every n."""

    dimension: Dimension = YIELD_STRESS

    @property
    def expected(self) -> str:
        return "a consistency of 0 to 200 Pa*s^n, such as 0.5, '0.5 Pa*s^n' or '1 lbf*s^n/(100 ft^2)'"

    @property
    def bounded(self) -> str:
        return self.expected

    def read(self, value: object) -> float:
        return super().read(_TO_THE_INDEX.sub("", value) if isinstance(value, str) else value)


Consistency = Annotated[float, ConsistencyNumber(at_least=0.0, at_most=200.0)]


class RheologySpec(Table):
    """Parameters of a mud's flow curve: `plastic_viscosity` [Pa*s] and `yield_point` [Pa] (Bingham), or `consistency`
    [Pa*s^n], `index` and `yield_stress` [Pa] (power law, or Herschel & Bulkley with a yield stress)."""

    plastic_viscosity: units.Viscosity | None = None
    yield_point: units.YieldStress | None = None
    consistency: Consistency | None = None
    index: units.FlowIndex | None = None
    yield_stress: units.YieldStress | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        bingham, power = ("plastic_viscosity", "yield_point"), ("consistency", "index")
        either = f"{' and '.join(bingham)}, or {' and '.join(power)}"
        of_power = any(getattr(self, key) is not None for key in (*power, "yield_stress"))
        for key in power if of_power else bingham:
            if getattr(self, key) is None:
                raise InputError(either, key=key)
        if of_power and (beside := [key for key in bingham if getattr(self, key) is not None]):
            raise InputError(f"{either}, not both", key=beside[0])
        return self

    @property
    def curve(self) -> Rheology:
        """The flow curve."""
        if self.consistency is None:
            return Rheology(self.yield_point or 0.0, self.plastic_viscosity or 0.0, 1.0)
        return Rheology(self.yield_stress or 0.0, self.consistency, self.index or 1.0)


class FlowSpec(Table):
    """What a mud's flow follows: one of `viscosity`, `rheology` and `fann`."""

    viscosity: units.Viscosity | None = None
    rheology: RheologySpec | None = Field(default=None, description="a table of parameters")
    fann: Annotated[dict[int, float], Readings()] | None = None

    @model_validator(mode="after")
    def _check_one(self) -> Self:
        given = [key for key in ("viscosity", "rheology", "fann") if getattr(self, key) is not None]
        if len(given) > 1:
            raise InputError(f"{given[0]} or {given[1]}, not both", key=given[1])
        return self

    @cached_property
    def fit(self) -> Fit | None:
        """The curve through the readings of a viscometer, None without them."""
        return None if self.fann is None else fit(self.fann)

    @property
    def curve(self) -> Rheology | None:
        """The flow curve, None where nothing says it."""
        if self.fit is not None:
            return self.fit.curve
        if self.rheology is not None:
            return self.rheology.curve
        return None if self.viscosity is None else Rheology.newtonian(self.viscosity)

    @property
    def resists(self) -> bool:
        """Whether the mud has a flow curve, and one with stress."""
        if self.viscosity is not None:  # without a curve to make, as every row of a chart asks
            return self.viscosity > 0
        curve = self.curve
        return curve is not None and bool(max(curve[:2]) > 0)


def fit(readings: Mapping[int, float]) -> Fit:
    """The curve through readings [degrees] by speed [rev/min].

    Two readings make a Bingham mud, as on a mud report.  Those at 600, 300, 6 and 3 make one of Herschel & Bulkley by
    the rule of RP 13D: yield stress 2 θ3 − θ6, the rest through θ600 and θ300.  All others, and readings of which the
    rule makes no mud, are fitted by least squares, with an index of at most 1.
    """
    speeds, read = np.array(list(readings), float), np.array(list(readings.values()))
    curve, rule = None, "least squares"
    if {600, 300, 6, 3} <= readings.keys():
        curve, rule = _by_rule(readings), "RP 13D's rule"
    if curve is None:
        curve, rule = _least_squares(speeds, read), "a Bingham mud" if len(read) == 2 else "least squares"
    misfit = curve.stress(PER_RPM * speeds) / DEGREE - read
    return Fit(curve, rule, tuple(misfit.tolist()))


def _by_rule(readings: Mapping[int, float]) -> Rheology | None:
    """RP 13D's curve; None where it is flatter than a mud's or steeper than a Newtonian fluid's."""
    least = max(2 * readings[3] - readings[6], 0.0)
    if readings[300] <= least:
        return None
    index = math.log2((readings[600] - least) / (readings[300] - least))
    if not FLATTEST <= index <= 1.0:
        return None
    return Rheology(DEGREE * least, DEGREE * (readings[300] - least) / RATE_300**index, index)


def _least_squares(speeds: Array, read: Array) -> Rheology:
    from scipy.optimize import minimize_scalar, nnls  # slow to import, and few cases need them

    def solved(index: float) -> tuple[Array, float]:
        """Stresses of the yield stress and of the rest at the highest speed, and what is left of the readings."""
        columns = np.column_stack([np.ones(len(speeds)), (speeds / speeds[-1]) ** index])
        stresses, left = nnls(columns, DEGREE * read)
        return stresses, left

    index = 1.0
    if len(read) > 2:
        flatter = minimize_scalar(lambda n: solved(n)[1], bounds=(FLATTEST, 1.0), method="bounded").x
        index = min((float(flatter), 1.0), key=lambda n: solved(n)[1])
    least, most = solved(index)[0].tolist()
    return Rheology(least, most / (PER_RPM * float(speeds[-1])) ** index, index)
