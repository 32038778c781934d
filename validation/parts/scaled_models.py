"""Both models of the scaled curved section, rigid segments and beam finite elements, and their differences."""

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from scipy.interpolate import CubicSpline

from fctd import Case, build_wellbore, simulate
from fctd.arrays import Array
from fctd.model.frames import hole_frame
from references.beams.case import top_of
from references.beams.dynamics import Lowered, generalised_alpha, lower
from references.beams.elements import Beam
from references.beams.planar_hole import PlanarHole
from validation.parts.windows import completed

# Of the finite elements, frozen before any difference was computed (see scaled_section.toml).
HIGH_FREQUENCY = 0.8  # spectral radius of generalised-α: share of the fastest modes left after a step
# The end of the string that is cut finer, and its segments: the edge of the pipe's end dents the wall over 0.12 m.
END, END_SEGMENTS = 0.9, 24  # [m]
# Contacts on one side that are closer than this are one [m].
APART = 1.0
# The edge of the pipe's end dents the wall over a decimetre; points higher up are evaluated separately [m].
ABOVE_END = 0.5
SIDES = ("guide_low", "bend_high", "bit_low")
# Columns printed of the differences between two models.
RMS = ("total", *SIDES)


class Comparable(NamedTuple):
    """Results of one run of either model.

    history : time_s, total_N and a column of force [N] for each of SIDES, means over the record interval.
    string : of points of the string at the end, from the top: above_bit_m along the unstretched string, md_m,
    horizontal_m, and offset_high_m from the axis of the bend.
    contacts : md_m, force_N of each contact at the end, positive on the high side.
    """

    history: pd.DataFrame
    string: pd.DataFrame
    contacts: pd.DataFrame


def finite_elements(case: Case, beam: Beam, step: float, still: bool = False) -> tuple[Comparable, Lowered]:
    """Lower the beam as in the case; ``still``: through equilibria."""
    top, duration = top_of(case)
    interval = case.record.interval
    times = np.append(np.arange(0.0, duration - 1e-6, interval), duration)
    lowered = lower(beam, top, times, step, None if still else generalised_alpha(HIGH_FREQUENCY))
    force = lowered.pressure * beam.wall.dx
    history = history_of(lowered.time, force.reshape(len(times) - 1, -1), lowered.md.reshape(len(times) - 1, -1), case)
    along, numbers = beam.points()
    z, x = lowered.states[-1][numbers[:, :2]].T
    string = _string(case, along[-1] - along, z, x)
    return Comparable(history, string, contact_forces(lowered.md[-1].ravel(), force[-1].ravel())), lowered


def rigid_segments(case: Case) -> tuple[Comparable, dict[str, Any]]:
    """Simulate the case with a profile at every record."""
    start, end = case.operations[0].start_md, case.operations[0].end_md
    # A depth for every record: closer ones share a row.
    apart = 0.5 * case.operations[0].speed * case.record.interval
    wanted = tuple(float(depth) for depth in np.arange(start + apart, end, apart))
    record = case.record.model_copy(update={"profile_at": wanted})
    result = completed(simulate(case.model_copy(update={"record": record})))
    profile = result.profile
    signed = profile["contact_force_N"] * np.sign(profile["offset_high_m"])
    depths = profile["bit_depth_m"].unique()
    rows = [(profile["bit_depth_m"] == depth).to_numpy() for depth in depths]
    at = result.history.set_index("bit_depth_m")["time_s"]
    force, md = np.array([signed[r] for r in rows]), np.array([profile["md_m"][r] for r in rows])
    history = history_of(at.loc[depths].to_numpy(), force, md, case)
    # The first row is the clamp.
    last = profile[rows[-1]].iloc[1:]
    string = shape_of(case, last)
    return Comparable(history, string, contact_forces(last["md_m"].to_numpy(), force[-1][1:])), result.run


def shape_of(case: Case, joints: pd.DataFrame) -> pd.DataFrame:
    """A row of points of the string, from the rows of a profile below the clamp."""
    hole = build_wellbore(case)
    centre, tangent = hole.at(joints["md_m"].to_numpy())
    # Offsets in the profile are from the axes of cylinders.
    points = centre + joints["offset_high_m"].to_numpy()[:, None] * hole_frame(tangent)[0]
    return _string(case, ends_above_bit(case)[::-1], *points[:, [2, 0]].T)


def ends_above_bit(case: Case) -> Array:
    """Distance of every end of a segment from the bit along the unstretched string, from the bit up [m]."""
    cut = [np.full(part.segments or 0, (part.length or 0.0) / (part.segments or 1)) for part in case.string.components]
    return np.append(0.0, np.cumsum(np.concatenate(cut[:-1])))


def cut_at_the_end(case: Case) -> Case:
    """The case with as many segments, those of its last metre shorter."""
    pipe, above = case.string.components
    assert pipe.length is not None
    assert pipe.segments is not None
    end = pipe.model_copy(update={"name": "end of the pipe", "length": END, "segments": END_SEGMENTS})
    rest = pipe.model_copy(update={"length": pipe.length - END, "segments": pipe.segments - END_SEGMENTS})
    string = case.string.model_copy(update={"components": (end, rest, above)})
    return case.model_copy(update={"string": string})


def _string(case: Case, above: Array, z: Array, x: Array) -> pd.DataFrame:
    axis = _hole(case).axis(np.stack([z, x]))
    return pd.DataFrame({"above_bit_m": above, "md_m": axis.md, "horizontal_m": x, "offset_high_m": axis.offset})


def _hole(case: Case) -> PlanarHole:
    return PlanarHole(case.wellbore.trajectory)


def history_of(time: Array, force: Array, md: Array, case: Case) -> pd.DataFrame:
    """Total contact force and its share on each side, given signed forces (times, points) [N] at md [m]."""
    bend = _hole(case).md[1]
    shares = (force < 0) & (md < bend), force > 0, (force < 0) & (md >= bend)
    columns = {side: (np.abs(force) * share).sum(axis=1) for side, share in zip(SIDES, shares, strict=True)}
    total = np.abs(force).sum(axis=1)
    return pd.DataFrame({"time_s": time, "total_N": total, **{f"{s}_N": f for s, f in columns.items()}})


def contact_forces(md: Array, force: Array) -> pd.DataFrame:
    """Contacts in order of depth: where on one side points with force follow each other closely."""
    touching = np.flatnonzero(force)
    breaks = [0]
    for k, (i, j) in enumerate(pairwise(touching), start=1):
        if force[i] * force[j] < 0 or md[j] - md[i] > APART:
            breaks.append(k)
    parts = np.split(touching, breaks[1:])
    rows = [{"md_m": np.average(md[p], weights=force[p]), "force_N": force[p].sum()} for p in parts if len(p)]
    return pd.DataFrame(rows, columns=["md_m", "force_N"])


def differences(model: Comparable, truth: Comparable, clearance: float) -> dict[str, float]:
    """Differences between two models: correlation and RMS of force, displacement, contact positions."""
    here, there = model.history, truth.history
    both = {}
    for name in RMS:
        column = f"{name}_N"
        expected = np.interp(here["time_s"], there["time_s"], there[column])
        difference = here[column].to_numpy() - expected
        both[f"{name}_rms_percent"] = 100 * float(np.sqrt(np.mean(difference**2)) / expected.max())
    expected = np.interp(here["time_s"], there["time_s"], there["total_N"])
    return {
        "correlation": float(np.corrcoef(here["total_N"], expected)[0, 1]),
        **both,
        **displacements(model.string, truth.string, clearance),
        "contacts": len(model.contacts),
        "position_difference_m": _apart(model.contacts, truth.contacts),
    }


def displacements(string: pd.DataFrame, true: pd.DataFrame, clearance: float) -> dict[str, float]:
    """Horizontal distance between equal points of two strings, over the clearance."""
    known = true.iloc[::-1]  # a spline between the nodes of the finite elements
    horizontal = CubicSpline(known["above_bit_m"], known["horizontal_m"])(string["above_bit_m"])
    away = 100 * (string["horizontal_m"] - horizontal).abs() / clearance
    return {
        "displacement_max_percent": float(away.max()),
        "displacement_above_end_percent": float(away[string["above_bit_m"] >= ABOVE_END].max()),
        "displacement_rms_percent": float(np.sqrt((away**2).mean())),
        "displacement_bit_percent": float(away.iloc[-1]),
    }


def _apart(found: pd.DataFrame, true: pd.DataFrame) -> float:
    """Largest distance from a contact of one model to the next one of the other on the same side, either way [m]."""
    worst = 0.0
    for a, b in ((found, true), (true, found)):
        for md, force in zip(a["md_m"], a["force_N"], strict=True):
            same = b[b["force_N"] * force > 0]
            worst = max(worst, float((same["md_m"] - md).abs().min()) if len(same) else np.inf)
    return worst
