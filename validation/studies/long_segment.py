"""The vertical part of the paper's well as one long segment (§6.2), against the same part cut like the rest."""

from typing import Any

import numpy as np
import pandas as pd

from fctd import equilibrium, simulate
from fctd.arrays import Array
from fctd.model.operations import rad_per_s
from references.soft_string.torsion import twisted
from validation.cases import rotation, trip
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows
from validation.parts.long_string import BIT, MODES, PIPE, chain_frequencies, continuous_frequencies, the_case
from validation.parts.windows import completed

CHANGE = 1.0  # percent: what counts as "no change" here
RAMPS = (2.0, 20.0)  # [s]
WATCHED = 20.0  # [s] of a start-up
RPM, INTERVAL = 60.0, 0.05  # [1/min] reached; [s] of which torques are means
TWIST_STEP = 0.002  # [s], of the disc model
# Operations with their weight on bit [N].
STEADY = [("trip_in", 0.0), ("trip_out", 0.0), ("rotate_off_bottom", 0.0)] + [
    (kind, weight) for weight in (50e3, 200e3) for kind in ("drill_rotating", "drill_sliding")
]


@table_of_rows
def steady(depths: tuple[float, ...]) -> Rows:
    """Steady loads of both strings."""
    for depth in depths:
        for kind, weight in STEADY:
            row: dict[str, Any] = {"operation": kind, "bit_depth_m": depth, "weight_on_bit_kN": weight / 1e3}
            points = {}
            for name, length in (("long", None), ("cut", PIPE)):
                case = the_case(length, bit__weight_on_bit=weight, bit__torque=3e3)
                points[name] = point = equilibrium(case, kind, depth)
                row |= {
                    f"{name}_status": point.status,
                    f"{name}_hookload_kN": point.hookload / 1e3,
                    f"{name}_torque_kN_m": point.surface_torque / 1e3,
                }
            long, cut = points["long"], points["cut"]
            largest = max(abs(cut.surface_torque), 1.0)
            row["difference_percent"] = 100 * max(
                abs(long.hookload / cut.hookload - 1), abs(long.surface_torque - cut.surface_torque) / largest
            )
            # The long segment ends at the first contact point of its string.
            row["least_tension_of_long_kN"] = float(long.profile["effective_tension_N"].iloc[1]) / 1e3
            yield row


def frequencies() -> pd.DataFrame:
    """Lowest frequencies of the continuous string and of both chains."""
    truth = continuous_frequencies(the_case(None, operations=rotation(BIT, 10.0, 1.0)))
    long, cut = (chain_frequencies(the_case(c, operations=rotation(BIT, 10.0, 1.0))) for c in (None, PIPE))
    rows = [
        {
            "kind": kind,
            "mode": mode + 1,
            "continuous_Hz": truth[k][mode],
            "long_Hz": long[k][mode],
            "cut_Hz": cut[k][mode],
            "long_off_percent": 100 * (long[k][mode] / truth[k][mode] - 1),
            "cut_off_percent": 100 * (cut[k][mode] / truth[k][mode] - 1),
        }
        for k, kind in enumerate(("axial", "torsional"))
        for mode in range(MODES)
    ]
    return pd.DataFrame(rows)


def start_ups(context: Context) -> pd.DataFrame:
    """Histories of starts from rest with both strings."""
    frames = []
    for ramp in context.progress(RAMPS, "start-ups"):
        starts = {
            "rotate_off_bottom": rotation(BIT, WATCHED, ramp, RPM),
            "trip_in": trip(BIT - 0.5 * (WATCHED - 0.5 * ramp), BIT, 0.5, ramp),
        }
        for kind, operations in starts.items():
            for name, length in (("long", None), ("cut", PIPE), ("cut twice as fine", 0.5 * PIPE)):
                case = the_case(length, operations=operations, record__interval=INTERVAL)
                result = completed(simulate(case))
                columns = result.history[["time_s", "hookload_N", "surface_torque_N_m"]]
                frames.append(columns.assign(operation=kind, ramp_s=ramp, vertical=name))
    return pd.concat(frames, ignore_index=True)


def twisting(ramps: tuple[float, ...]) -> dict[float, float]:
    """Largest difference of the torque of each start [% of its span] in a model of discs with dry friction."""
    found = {}
    for ramp in ramps:

        def angle(time: Array, ramp: float = ramp) -> Array:
            u = np.minimum(time / ramp, 1.0)
            return rad_per_s(RPM) * (ramp * (u**3 - 0.5 * u**4) + np.maximum(time - ramp, 0.0))

        long, fine = (
            twisted(the_case(length), BIT, angle, WATCHED, TWIST_STEP).reshape(-1, round(INTERVAL / TWIST_STEP)).mean(1)
            for length in (None, 0.5 * PIPE)
        )
        found[ramp] = 100 * float(np.abs(long - fine).max() / np.ptp(fine))
    return found


@table_of_rows
def start_up_differences(histories: pd.DataFrame) -> Rows:
    """Largest difference from the finest string within the start-up, over the span of its reading."""
    for (kind, ramp), both in histories.groupby(["operation", "ramp_s"], sort=False):
        column = "surface_torque_N_m" if kind == "rotate_off_bottom" else "hookload_N"
        parts = {name: part[column].to_numpy() for name, part in both.groupby("vertical")}
        truth = parts["cut twice as fine"]
        span = truth.max() - truth.min()
        row: dict[str, Any] = {"operation": kind, "ramp_s": ramp, "reading": column.rpartition("_N")[0]}
        for name in ("long", "cut"):
            row[f"{name}_difference_percent"] = 100 * float(np.abs(parts[name] - truth).max()) / span
            row[f"{name}_mean_difference_percent"] = 100 * abs(parts[name].mean() - truth.mean()) / span
        yield row


def run(context: Context) -> Outcome:
    """Steady loads, frequencies, start-ups."""
    loads = steady((BIT,) if context.quick else (1900.0, 2200.0, BIT))
    tones, histories = frequencies(), start_ups(context)
    differences = start_up_differences(histories)
    turns, alone = differences["operation"] == "rotate_off_bottom", twisting(RAMPS[:1] if context.quick else RAMPS)
    differences["long_twisting_alone_percent"] = differences["ramp_s"].map(alone).where(turns)
    first, high = tones["mode"] == 1, tones["mode"] == MODES
    turning = differences[turns].set_index("ramp_s")["long_difference_percent"]
    return Outcome(
        tables={"steady": loads, "frequencies": tones, "start_up": differences, "histories": histories},
        checks=[
            Check("steady hook load and torque, long segment against short ones, largest difference",
                  float(loads["difference_percent"].max()), CHANGE, "at_most", "%",
                  "§6.2 uses one segment for vertical hole; 1 % counts as no change here"),
            Check("least tension of the long segment, up to 200 kN on the bit",
                  float(loads["least_tension_of_long_kN"].min()), 0.0, "at_least", "kN",
                  "pipe in tension in vertical hole cannot buckle, so one segment loses no lateral deflection"),
            Check("first frequencies, long segment against the continuous string, largest difference",
                  float(tones.loc[first, "long_off_percent"].abs().max()), CHANGE, "at_most", "%",
                  "§6.2, applied to the slowest swings; closed form of the continuous string"),
            Check("fourth frequencies, long segment against the continuous string, largest difference",
                  float(tones.loc[high, "long_off_percent"].abs().max()), CHANGE, "at_most", "%",
                  "§6.2, applied to waves; closed form of the continuous string"),
            Check("torque of a start in 20 s, long segment, largest difference", float(turning[RAMPS[1]]), CHANGE,
                  "at_most", "%", "§6.2, applied to slow starts; over the span of the torque"),
            Check("torque of a start in 2 s, long segment, largest difference", float(turning[RAMPS[0]]), CHANGE,
                  "at_most", "%", "§6.2, applied to quick starts; over the span of the torque"),
            Check("mean torque and hook load of starts, long segment, largest difference",
                  float(differences["long_mean_difference_percent"].max()), CHANGE, "at_most", "%",
                  "§6.2; over the span of the reading"),
        ],
        notes=[
            f"With the bit at {BIT:.0f} m the long segment reaches from the surface to 750 m. It has the springs and "
            "half the weight of the pipe it stands for, at its lower end: weight and stretch are exact. In the paper "
            "half the mass is there too, and a wave crosses it instantly; here its slowest standing waves have most of "
            "it (fctd/mechanics/waves.py).",
            "Differences of start-ups are from the string whose vertical part has segments of 18.75 m; the column "
            "for 37.5 m gives the effect of the segment length alone. Neither resolves the ripple of a trip's hook "
            "load, which arises where joints of the string slide over the seams between cylinders.",
            "The column long twisting alone is the difference of the torque of a rotating start with the paper's "
            "segment: discs on torsion springs with dry friction, whose limits come from the soft string, with masses "
            "lumped differently from the engine's bodies; no contact, no bending, no axial motion. There the long "
            "segment has half its inertia at its end, as in the paper, and no waves within.",
            "The long segment touches the wall only at its lower end. It cannot show buckling or whirl, which press "
            "vertical pipe against the wall; in compression it is stiffer than the pipe.",
        ],
        display={
            "steady": "Steady loads: one long segment, and the vertical part cut into 37.5 m",
            "frequencies": "Lowest frequencies",
            "start_up": "Starts from rest: largest and mean difference over the span of the reading",
        },
    )  # fmt: skip


STUDY = Study("long_segment", "Which loads does one long segment for the vertical part change?", run, reproduce=True)
