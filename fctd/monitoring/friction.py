"""Apparent friction factors: the factor with which the steady string has the reading of a stretch."""

from dataclasses import dataclass, fields
from typing import Final

import numpy as np

from fctd.case.errors import InputError, nearest
from fctd.case.message import quantity
from fctd.case.units import FORCE, FRICTION, TORQUE, Dimension, Quantity
from fctd.monitoring.chart import Chart
from fctd.monitoring.stretches import ROTATING, Stretch

# Of a reading that tells the factor no better than this, nothing is inferred: all factors of a hole lie within.
WIDEST = 0.5
TWO_SIDED_95 = 1.96
HIGHEST: Final = 5.0  # factor: `FRICTION` admits no more in a case


@dataclass(frozen=True)
class Uncertainty:
    """Standard deviations: of repeated readings, hook load [N] and torque (share of the reading), and of what is held.

    cased : of the friction factor of the other kind of interval; block_weight [N], torque_offset [N m].
    """

    hook_load: float = 9.80665e3
    torque: float = 0.04
    cased: float = 0.0
    block_weight: float = 0.0
    torque_offset: float = 0.0


# A reading without noise would outweigh all others in the baselines of the alarms.
LEAST: Final = {"hook_load": 1.0, "torque": 1e-4}
# A torque near 0 has the noise of the torque that this factor gives: a share of 0 would be none.
LEAST_FACTOR: Final = 0.05

_DIMENSIONS: dict[str, Dimension] = {"hook_load": FORCE, "block_weight": FORCE, "torque_offset": TORQUE}


def parse_uncertainty(texts: list[str], key: str) -> Uncertainty:
    """Standard deviations of texts such as "hook_load=1 t", "torque=4%", "cased=0.02" and "torque_offset=0.3 kN*m"."""
    names = [field.name for field in fields(Uncertainty)]
    found: dict[str, float] = {}
    for text in texts:
        name, sign, value = (part.strip() for part in text.partition("="))
        if not sign or name not in names:
            raise InputError(
                f"{nearest(name, names, 'quantity')}, such as 'hook_load=1 t' or torque=4%", key=key, value=text
            )
        try:
            if name in _DIMENSIONS:
                found[name] = Quantity(dimension=_DIMENSIONS[name], at_least=0.0).parse(value)
            else:
                percent = value.endswith("%")
                found[name] = FRICTION.parse(float(value.rstrip("% ")) * (0.01 if percent else 1.0))
            if found[name] < LEAST.get(name, 0.0):
                raise ValueError
        except (InputError, ValueError):
            dimension = _DIMENSIONS.get(name)
            expected = (
                "a number or a percentage" if dimension is None else f"{dimension.noun} such as {dimension.example}"
            )
            if name in LEAST:
                least = quantity(LEAST[name], "N") if name in _DIMENSIONS else f"{LEAST[name]:g}"
                expected += f", at least {least}: every reading has noise"
            raise InputError(expected, key=f"{key} {name}", value=value) from None
    return Uncertainty(**found)


@dataclass(frozen=True)
class Apparent:
    """A stretch with its friction factor.

    factor : NaN where none is inferred, for the reason in ``left_out``.  noise : standard deviation of the factor by
    the reading alone.  low, high : 95 % band by the reading and by what is held.  lift [N] : that the flow takes off
    the hook load, which the factor is without.
    """

    stretch: Stretch
    factor: float
    noise: float
    low: float
    high: float
    left_out: str
    lift: float = 0.0


def apparent(stretch: Stretch, chart: Chart, uncertainty: Uncertainty) -> Apparent:
    """The friction factor of a stretch."""

    def none(why: str) -> Apparent:
        nan = float("nan")
        return Apparent(stretch, nan, nan, nan, nan, why)

    mode = stretch.mode
    if stretch.left_out or mode == "in_slips":
        return none(stretch.left_out or "hangs in the slips")
    depth = stretch.bit_depth
    if not chart.case.depths[0] < depth <= chart.deepest:
        return none("bit depth outside the case's hole")
    rotating = mode in ROTATING
    reading = stretch.torque if rotating else stretch.hook_load
    if np.isnan(reading.median):
        return none("no reading")
    relief = chart.relief(mode, depth, stretch.flow)
    if not np.isfinite(relief).all():
        return none("no steady string at this depth with this flow")
    gauge, torque = chart.at_rest(
        mode, depth, stretch.flow, stretch.rpm, gauge=stretch.hook_load.median, torque=stretch.torque.median
    )
    found = chart.invert(mode, depth, torque if rotating else gauge, stretch.rpm)
    if found is None:
        return none("no steady string at this depth")
    if rotating:
        least = LEAST_FACTOR / abs(found.per_reading) if found.per_reading else 0.0
        spread, held = uncertainty.torque * max(abs(reading.median), least), uncertainty.torque_offset
    else:
        spread, held = uncertainty.hook_load, uncertainty.block_weight
    noise = abs(found.per_reading) * float(np.hypot(spread, reading.error))
    if not noise < WIDEST:
        # The noise of a torque is a share of it, so that of a torque in a wrong unit is large, too.
        if rotating and noise * HIGHEST < WIDEST * found.factor:
            return none(f"a friction factor above {HIGHEST:g}: check the unit of the torque")
        return none("the reading does not depend on this friction factor enough")
    cased = chart.by_held(mode, depth) * uncertainty.cased if uncertainty.cased > 0 else 0.0
    total = float(np.sqrt(noise**2 + found.per_reading**2 * (held**2 + cased**2)))
    low, high = (found.factor + sign * TWO_SIDED_95 * total for sign in (-1, 1))
    return Apparent(stretch, found.factor, noise, low, high, "", relief.lift)
