"""The quantities of a profile in the units of its panels; for pictures and pages."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, Literal, NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.systems import FORCE_PER_LENGTH, JOINT_FORCE
from fctd.plots.palette import BUCKLED
from fctd.results.columns import COLUMNS
from fctd.results.profile import JOINT, edges_of
from fctd.results.unit_systems import Shown, System, shown
from fctd.steady.steady_string import Equilibrium

if TYPE_CHECKING:
    import pandas as pd


SideForce = Literal["length", "joint"]

# The panels, by column of the profile.
TRACKS: Final = (
    "inclination_deg",
    "effective_tension_N",
    "torque_N_m",
    "contact_force_N",
    "bending_moment_N_m",
    "von_mises_Pa",
    "offset_high_m",
    "offset_right_m",
)
# A buckling limit is shown where it comes as near to the loads as this share of their span.
NEAR: Final = 0.6
# Least span of an axis, as a share of the largest tension for forces and times this lever [m] for moments.
LEAST: Final = {"effective_tension_N": 0.01, "torque_N_m": 2e-3, "bending_moment_N_m": 1e-3}
LEAST_STRESS: Final = 1e6  # [Pa]
AIR: Final = 0.05  # of the span of an axis, beyond the values
# Values along at most this share of the strings do not set a scale, where they exceed the others by this factor.
PEAK, CUT = 0.01, 1.5
WITH_PEAKS: Final = ("contact_force_N", "bending_moment_N_m")


class Track(NamedTuple):
    """A quantity of a string in the units of its panel, by measured depth (n,)."""

    md: Array
    value: Array


def lengths_of(md: Array) -> Array:
    """Length of string (n,) that belongs to contact points at depths (n,): half way to their neighbours."""
    return np.diff(edges_of(md))


def scale_of(values: Array, lengths: Array) -> float:
    """The largest magnitude that a scale shows, of values (n,) along lengths (n,) of string.

    It follows the length, not the number of contact points: those at a bit are many, and close together.
    """
    size = np.abs(values)
    order = np.argsort(size)[::-1]
    above = np.cumsum(lengths[order])
    reached = float(size[order][np.searchsorted(above, PEAK * above[-1], side="right").clip(max=len(size) - 1)])
    most = float(size.max())
    return most if most <= CUT * reached or reached == 0.0 else reached


def side_force(profile: pd.DataFrame, force: SideForce) -> Array:
    """Side force per length [N/m] or per joint of 30 ft [N] of each row of a profile.

    The force of a contact point belongs to the string half way to its neighbours.
    """
    per_length = profile["contact_force_N"].to_numpy(float) / lengths_of(profile["md_m"].to_numpy(float))
    return per_length * (JOINT if force == "joint" else 1.0)


def side_force_unit(units: System, force: SideForce) -> Shown:
    """How to show a side force."""
    if force == "length":
        return FORCE_PER_LENGTH.shown(units)
    factor, unit = JOINT_FORCE.shown(units)
    return Shown(factor, f"{unit} per {'30 ft' if units == 'field' else '9.14 m'}")


def label_of(column: str, units: System, force: SideForce) -> tuple[str, str]:
    """Name and unit of a panel."""
    if column == "contact_force_N":
        return f"side force per {force}", side_force_unit(units, force).label
    return COLUMNS[column].label, shown(column, units).label


def values_of(point: Equilibrium, column: str, units: System, force: SideForce) -> Track:
    """A quantity of a string in the units of its panel."""
    profile = point.profile
    md = profile["md_m"].to_numpy(float) * shown("md_m", units).factor
    if column == "contact_force_N":
        return Track(md, side_force(profile, force) * side_force_unit(units, force).factor)
    if COLUMNS[column].across:
        high, right = point.offsets.T
        return Track(md, (high if column == "offset_high_m" else right) * shown(column, units).factor)
    return Track(md, profile[column].to_numpy(float) * shown(column, units).factor)


def stretches(profile: pd.DataFrame) -> list[tuple[int, int, str]]:
    """First and last row, and mode, of every run of rows that are buckled alike."""
    mode = profile["buckling"].to_numpy(str)
    starts = np.flatnonzero(np.append(True, mode[1:] != mode[:-1]))
    ends = np.append(starts[1:], len(mode)) - 1
    return [(int(a), int(b), str(mode[a])) for a, b in zip(starts, ends, strict=True) if mode[a] in BUCKLED]


def limits_near(answers: Sequence[Equilibrium], units: System) -> dict[str, Track]:
    """The buckling limits of the first string that come near the loads, compression to the left, with their depths."""
    factor = shown("effective_tension_N", units).factor
    loads = np.concatenate([point.profile["effective_tension_N"].to_numpy(float) for point in answers]) * factor
    reach = loads.min() - NEAR * max(float(np.ptp(loads)), 1e-9)
    profile = answers[0].profile
    md = profile["md_m"].to_numpy(float) * shown("md_m", units).factor
    near = {}
    for mode in BUCKLED:
        limit = -profile[f"{mode}_limit_N"].replace(np.inf, np.nan).to_numpy(float) * factor
        limit = np.where(limit >= reach, limit, np.nan)
        if np.isfinite(limit).any():
            near[mode] = Track(md, limit)
    return near


def depth_ends(points: Sequence[Equilibrium], units: System) -> tuple[float, float]:
    """Lower and upper end of the axis of depths of some strings, in its units."""
    bit = points[0].bit_depth * shown("bit_depth_m", units).factor
    return 1.01 * bit, -0.005 * bit


def limits_of_track(
    answers: Sequence[Equilibrium], column: str, units: System, force: SideForce, near: dict[str, Track]
) -> tuple[float, float]:
    """Ends of the axis of a panel, in its units; near : of ``limits_near``.

    The axes of torque and side force begin at 0, that of tension has 0 and the buckling limits, and no axis is so short
    that it shows the noise of the solver.
    """
    largest = max(float(point.profile["effective_tension_N"].abs().max()) for point in answers)
    factor = shown(column, units).factor
    least = (LEAST_STRESS if column == "von_mises_Pa" else LEAST.get(column, 0.0) * largest) * factor
    values = [values_of(point, column, units, force).value for point in answers]
    if column in WITH_PEAKS:
        lengths = np.concatenate([lengths_of(point.profile["md_m"].to_numpy(float)) for point in answers])
        most = scale_of(np.concatenate(values), lengths)
        values = [np.clip(value, -most, most) for value in values]
    if COLUMNS[column].across:
        clearance = np.concatenate([point.profile["clearance_m"].to_numpy(float) for point in answers]) * factor
        values += [-clearance, clearance]
    if column == "effective_tension_N":
        values += [np.zeros(1), np.array([np.nanmax(limit.value) for limit in near.values()])]
    if column == "torque_N_m":
        values.append(np.array([0.0, least]))
    if column == "contact_force_N":
        values.append(np.zeros(1))
    joined = np.concatenate(values)
    low, high = float(joined.min()), float(joined.max())
    lacking = max(least - (high - low), 0.0) / 2
    air = AIR * max(high - low, least) or 1.0  # nothing but zeros
    return 0.0 if column == "contact_force_N" else low - lacking - air, high + lacking + air


def peaks_of(
    answers: Sequence[Equilibrium], column: str, units: System, force: SideForce, ends: tuple[float, float]
) -> list[tuple[Equilibrium, float, float]]:
    """Strings whose values lie beyond the end of the axis of a panel, with depth and value of the largest.

    ends : of ``limits_of_track``.
    """
    found = []
    for point in answers if column in WITH_PEAKS else ():
        md, value = values_of(point, column, units, force)
        k = int(np.argmax(value))
        if value[k] > ends[1]:
            found.append((point, float(md[k]), float(value[k])))
    return found
