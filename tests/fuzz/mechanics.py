"""Checks of every answer, computed from the case and the geometry of its hole, not from the solver."""

from collections.abc import Iterator, Mapping
from itertools import pairwise

import numpy as np
import pandas as pd

from fctd import Case, Equilibrium, SimulationResult, Wellbore, find_contacts
from fctd.case.operations import KINDS
from fctd.model.drillstring import String, lay_out
from fctd.model.operations import steady_rates
from fctd.model.pieces import AROUND, FRICTION, TO_MD
from fctd.results.columns import BUCKLED
from fctd.results.status import RunStatus, SteadyStatus

LOADS = (
    "hookload", "surface_torque", "weight_indicator", "drive_torque", "total_contact_force", "sum_r_ft", "sum_r_mu_fn",
    "imbalance",
)  # fmt: skip
# A string without clearance cannot buckle: its limits are infinite.
LIMITS = ["sinusoidal_limit_N", "helical_limit_N"]
EXTENT = [column.name for column in BUCKLED]  # NaN where the string is not buckled
SAME_LENGTH = 1e-6  # [m]


def finite(point: Equilibrium) -> Iterator[str]:
    """Errors of any answer, plausible or not: a status that is not documented, numbers that are not finite."""
    if point.status not in list(SteadyStatus):
        yield f"status {point.status!r}"
        return
    if not point.answered:
        return
    for name in LOADS:
        if not np.isfinite(getattr(point, name)):
            yield f"{name} is {getattr(point, name)}"
    yield from finite_profile(point.profile)


def finite_profile(profile: pd.DataFrame) -> Iterator[str]:
    """Columns of a profile with values that are not finite."""
    for name, column in profile.select_dtypes("number").items():
        bad = column.isna() if name in LIMITS else ~np.isfinite(column)
        if bad.any():
            yield f"{name} is {column[bad].iloc[0]} in row {int(np.argmax(bad))} of the profile"


def steadiness(case: Case, point: Equilibrium) -> Iterator[str]:
    """A plausible string far from buckling, without a bent housing, keeps its balance, and the solver finds it.

    The lower end, which nothing holds, buckles at half the force of a string that goes on (a semi-infinite beam).
    """
    if point.status.acceptable or (point.status == "unstable" and any(c.bend for c in case.string.components)):
        return
    profile, wall = point.profile, case.wellbore
    if point.status == "diverged" and wall.stiffness is not None:
        # A wall of springs lets a contact point through that is pressed with more than stiffness times radius.
        radius = 0.5 * min(interval.diameter for interval in wall.intervals)
        if profile["contact_force_N"].max() > wall.stiffness * radius:
            return
    if not (profile["effective_tension_N"] < -0.5 * profile["sinusoidal_limit_N"]).any():
        yield f"no steady balance, though it is far from buckling ({point.message})"


def balance(case: Case, hole: Wellbore, point: Equilibrium) -> Iterator[str]:
    """Errors of a plausible answer.

    Virtual work of sliding the string along its hole: the top carries the weight times the height it would be
    lifted, less the weight on bit, and on the way up more, on the way down less, by what wall and mud hold back.
    Virtual work of turning it: the top gives what wall, mud and bit take.
    """
    string = lay_out(case, point.bit_depth)
    profile, rates = point.profile, steady_rates(case, point.operation)
    length = float(string.length.sum())
    if abs(length - (point.bit_depth - string.top_md)) > SAME_LENGTH:
        yield f"a string of {length} m from {string.top_md} m to the bit at {point.bit_depth} m"
    normal = profile["contact_force_N"].to_numpy()
    if (normal < 0).any():
        yield f"a contact force of {normal.min():.4g} N"
    if not np.isclose(normal.sum(), point.total_contact_force, rtol=1e-9, atol=1e-6):
        yield f"contact forces of {normal.sum():.6g} N in the profile, {point.total_contact_force:.6g} N in all"
    if (profile["von_mises_Pa"] < 0).any() or not profile["contact_angle_deg"].between(0, 360).all():
        yield "a stress below 0, or a contact angle beyond 0 to 360"
    drilling = KINDS[point.operation].on_bottom
    weight_on_bit, bit_torque = (case.bit.weight_on_bit, case.bit.torque) if drilling else (0.0, 0.0)
    if profile["effective_tension_N"].iloc[-1] != -weight_on_bit:
        yield f"a tension of {profile['effective_tension_N'].iloc[-1]} N at the bit"
    yield from _in_the_hole(profile, string, point)

    weight = float(string.weight @ string.length)
    if point.imbalance > 1e-6 * (weight + weight_on_bit):
        yield f"an imbalance of {point.imbalance:.3g} N"
    lifted = hanging_weight(string, hole)
    radius = np.append(0.0, string.contact_radius())
    along, around = _friction(hole, profile)
    holds = along * normal
    full = not rates.spin or case.contact.friction_law == "paper"
    expected = lifted - weight_on_bit
    # Segments are straight where the hole bends: 0.3 % at the most in 2,750 rows, with segments of 9 to 30 m.
    tolerance = 0.006 * (weight + weight_on_bit + holds.sum()) + 100
    if rates.speed:
        # Upwards the wall adds to the hook load, downwards it takes from it; turning, it spends part of itself aside.
        up = -np.sign(rates.speed)
        expected -= rates.speed * (case.mud.axial_damping or 0.0) * length
        least, most = sorted((expected + up * holds.sum() * (1.0 if full else 0.0), expected + up * holds.sum()))
    else:
        least = most = expected
    if not least - tolerance <= point.hookload <= most + tolerance:
        yield f"a hook load of {point.hookload:.6g} N, not {least:.6g} to {most:.6g} N ± {tolerance:.3g} N"

    if point.sum_r_ft > point.sum_r_mu_fn * (1 + 1e-9) + 1e-6:
        yield f"Σ r F_t {point.sum_r_ft:.6g} N*m beyond Σ r μ F_n {point.sum_r_mu_fn:.6g} N*m"
    most = float((radius * around * normal).sum())
    if abs(point.sum_r_mu_fn - most) > 1e-3 * most + 1:
        yield f"Σ r μ F_n {point.sum_r_mu_fn:.6g} N*m, {most:.6g} N*m by the profile"
    taken = point.sum_r_ft + (case.mud.rotational_damping or 0.0) * rates.spin * length + bit_torque
    # A bent string passes its torque on with the cosine of a half bend at every joint.  A bent housing that points
    # elsewhere than its hole bends has to be held there: by its angle times the bending moment at most.
    held = sum(component.bend for component in case.string.components) * profile["bending_moment_N_m"].max()
    slack = 0.005 * (point.sum_r_mu_fn + bit_torque) + held + 30
    if abs(point.surface_torque - taken) > slack:
        yield f"a surface torque of {point.surface_torque:.6g} N*m where {taken:.6g} N*m are taken"
    if rates.spin and point.surface_torque < -slack:
        yield f"a surface torque of {point.surface_torque:.6g} N*m while turning"


def axis(hole: Wellbore) -> Iterator[str]:
    """Errors of the axis of any hole: its path, and contact queries of points on it."""
    md = np.linspace(0.0, hole.total_depth, 40)
    points, tangents = hole.at(md)
    if not np.isfinite(points).all() or np.abs(np.linalg.norm(tangents, axis=1) - 1).max() > 1e-9:
        yield "an axis that is not finite"
        return
    if (np.linalg.norm(np.diff(points, axis=0), axis=1) > np.diff(md) * (1 + 1e-9)).any():
        yield "an axis longer than its measured depth"
    found, wall = find_contacts(hole, points, 0.0), hole.wall_along()
    near = 1e-6 + 1e-9 * hole.total_depth
    if hole.courses is None:
        # A chord is shorter than its arc; where two cylinders overlap the wall is a blend of both.
        chords = np.diff(hole.points, axis=0)
        near += (np.diff(hole.md) - np.linalg.norm(chords, axis=1)).max()
        near += hole.shoe * np.linalg.norm(np.diff(hole.directions, axis=0), axis=1).max()
    off = np.abs(found.penetration + np.interp(md, wall[:, 0], wall[:, 1])).max()
    along = np.abs(found.md - md).max()
    if not (off < near and along < near):
        yield f"a point of the axis found {off:.3g} m beside it and {along:.3g} m along it"


def ordered(points: Mapping[str, Equilibrium]) -> Iterator[str]:
    """Hook loads of operations at one depth that are not in the order of their motions."""
    sound = {kind: point for kind, point in points.items() if point.status.acceptable}
    chain = [kind for kind in ("trip_in", "rotate_off_bottom", "back_ream", "trip_out") if kind in sound]
    for lower, upper in pairwise(chain):
        a, b = sound[lower], sound[upper]
        slack = 0.01 * max(abs(a.hookload), abs(b.hookload)) + 500
        if a.hookload > b.hookload + slack:
            yield f"a hook load of {a.hookload:.6g} N in {lower}, of {b.hookload:.6g} N in {upper}"


def run(case: Case, result: SimulationResult) -> Iterator[str]:
    """Errors of a short run of a plausible case."""
    if result.status not in list(RunStatus):
        yield f"status {result.status!r}"
    if result.status != "completed":
        return
    history, profile = result.history, result.profile
    for name, table in (("history", history), ("ledger", result.energy)):
        numbers = table.select_dtypes("number").drop(columns=EXTENT, errors="ignore")
        if not np.isfinite(numbers).all(axis=None):
            yield f"a number of the {name} is not finite"
    yield from finite_profile(profile)
    end = case.operations[-1].end_md
    if abs(history["bit_depth_m"].iloc[-1] - end) > 1e-3:
        yield f"a run that ends at {history['bit_depth_m'].iloc[-1]} m, not at {end} m"
    if abs(history["bit_md_m"].iloc[-1] - end) > 0.005 * end + 1:
        yield f"a bit at {history['bit_md_m'].iloc[-1]} m along the hole when {end} m deep"
    string = lay_out(case, end)
    weight = float(string.weight @ string.length)
    if not -weight <= history["hookload_N"].mean() <= 3 * weight:
        yield f"a hook load of {history['hookload_N'].mean():.6g} N of a string that weighs {weight:.6g} N"


def hanging_weight(string: String, hole: Wellbore) -> float:
    """Weight of a string along its hole [N]: buoyed weight times the vertical extent of every segment."""
    ends = string.top_md + np.concatenate([[0.0], np.cumsum(string.length)])
    return float(string.weight @ np.diff(hole.at(ends)[0][:, 2]))


def _friction(hole: Wellbore, profile: pd.DataFrame) -> list[np.ndarray]:
    """Friction factors along and around the hole (n,) beside the rows of a profile."""
    wall = hole.wall_along()
    return [np.interp(profile["md_m"], wall[:, TO_MD], wall[:, column]) for column in (FRICTION, AROUND)]


def _in_the_hole(profile: pd.DataFrame, string: String, point: Equilibrium) -> Iterator[str]:
    """Rows that are not at their place along the hole, or have a contact force without reaching the wall."""
    md = profile["md_m"].to_numpy()
    if len(md) != string.segments + 1:
        yield f"{len(md)} rows of a string of {string.segments} segments"
    if (np.diff(md) <= 0).any():
        yield f"measured depth falls at row {int(np.argmax(np.diff(md) <= 0)) + 1} of the profile"
    # Steel stretches by some metres at most.
    if abs(md[-1] - point.bit_depth) > 0.005 * point.bit_depth + 1:
        yield f"a bit at {md[-1]:.6g} m along the hole when {point.bit_depth:.6g} m deep"
    offset, touching = np.hypot(profile["offset_high_m"], profile["offset_right_m"]), profile["contact_force_N"] > 0
    beyond = (offset - profile["clearance_m"]).to_numpy()
    # In an overlap the offset stands across a blend of two cylinders, and its parts across one direction: these are
    # shorter by the square of the angle between them.
    allowed = 1e-9 + 1e-6 * profile["clearance_m"].to_numpy()
    if (beyond < -allowed)[touching].any() or (beyond > allowed)[~touching][1:].any():
        yield "a contact force without contact, or contact without a force"
