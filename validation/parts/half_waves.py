"""Snaking at the half wave that the pipe takes: its amplitude against Mitchell's equation, and which half waves stand.

At one compression snaking stands in a band of half waves (references/buckling/band.py), and its amplitude differs over
the band by a third and more.  So an amplitude is compared at the half wave that is measured, not at that of the least
energy.  Waves come in and leave at the pipe's ends, so that the band is that of the equation with its ends
(references/buckling/ends.py): the pipe here has them on the axis of its hole.
"""

from itertools import product

import numpy as np
import pandas as pd

from references.buckling import ends, mitchell
from references.buckling.band import band
from validation.harness.study import Check, Rows, table_of_rows
from validation.parts.buckled_pipe import BUCKLING, ENDS, Rig, middle, wave_of
from validation.parts.resolved_rows import JOINT, LENGTH, amplitude_at, resolved

ALLOWED, SOURCE = 1.5, "Mitchell 1988, at the half wave taken"  # largest difference of an amplitude [%]
RATIOS = (1.1, 1.25, 1.4)  # times the onset, where snaking has the lower energy
HOLES = (0.1556, 0.2159, 0.3111)  # [m]: 6⅛, 8½ and 12¼ in
OWN_SEGMENTS = (JOINT, 2.0, 0.35)  # of the case [m]; the engine cuts them where they are longer than it needs
SHARES = np.arange(0.68, 1.5, 0.04)  # of the half wave of least energy, in which the pipe is laid
IN_HALF_WAVE = 25  # segments
NEAR = 0.05  # share of a half wave: this near the ends of the band the pipe may keep a shape


@table_of_rows
def laid(quick: bool) -> Rows:
    """A level pipe laid in half waves of several lengths: whether it keeps them, and its amplitude."""
    for ratio in RATIOS[1:2] if quick else RATIOS:
        force = ratio * BUCKLING.onset
        best, (shortest, longest) = mitchell.snaking(BUCKLING, force).length, band(BUCKLING, force)
        for share in SHARES[::2] if quick else SHARES:
            try:
                shape = mitchell.snaking(BUCKLING, force, share * best)
            except mitchell.NoShapeError:
                continue  # such half waves do not buckle
            rig = Rig(LENGTH, shape.length / IN_HALF_WAVE)
            rig.lay(force, shape.waves)
            wave = wave_of(rig.settle(force).profile)
            is_steady = rig.problem.unstable_modes() == 0
            half = np.nan if wave is None else wave.half_wave
            of_equation = {
                name: BUCKLING.wave
                * ends.taken(ratio, shape.length / BUCKLING.wave, LENGTH / BUCKLING.wave, name == "clamped")
                for name in ("hinged", "clamped")
            }
            yield {
                "times_onset": ratio, "laid_over_least": share, "taken_over_least": half / best,
                "band_from": shortest / best, "band_to": longest / best, "on_wall": bool(shape.wall_force.min() > 0),
                "kept": is_steady and _is_kept(half, shape.length),
                "clamped_keeps": _is_kept(of_equation["clamped"], shape.length),
                **{f"{name}_over_least": length / best for name, length in of_equation.items()},
                "amplitude_deg": np.nan if wave is None else wave.amplitude,
                "mitchell_deg": amplitude_at(BUCKLING, force, half),
            }  # fmt: skip


@table_of_rows
def taken(quick: bool) -> Rows:
    """Rows of a level pipe with its buckling resolved: the half wave each takes, and its amplitude."""
    holes, ratios = (HOLES[1:2], RATIOS[1:2]) if quick else (HOLES, RATIOS)
    for hole, ratio, segment in product(holes, ratios, OWN_SEGMENTS):
        rig = Rig(LENGTH, segment, hole=hole)
        force = ratio * rig.pipe.onset
        point = resolved(rig, force)
        wave, least = wave_of(point.profile), mitchell.snaking(rig.pipe, force)
        half, amplitude = (np.nan, np.nan) if wave is None else (wave.half_wave, wave.amplitude)
        exact = amplitude_at(rig.pipe, force, half)
        yield {
            "clearance_mm": 1e3 * rig.pipe.clearance, "times_onset": ratio, "own_segment_m": segment,
            "status": str(point.status), "shape": point.shape, "half_wave_m": half,
            "over_least_energy": half / least.length,
            "in_half_wave": half / float(middle(point.profile)["md_m"].diff().mean()),
            "amplitude_deg": amplitude, "mitchell_deg": exact, "off_percent": 100 * (amplitude / exact - 1),
            "off_least_energy_percent": 100 * (amplitude / np.degrees(least.amplitude) - 1),
        }  # fmt: skip


def checks(tables: dict[str, pd.DataFrame]) -> list[Check]:
    """Amplitudes at the half waves taken, and the half waves that stand."""
    waves, rows = tables["half_waves"], tables["half_waves_of_rows"]
    # Where the shape of the equation would need a wall that pulls it is none of a pipe.
    waves = waves[waves["on_wall"]]
    share, low, high, kept = (waves[name] for name in ("laid_over_least", "band_from", "band_to", "kept"))
    beyond = (share < (1 - NEAR) * low) | (share > (1 + NEAR) * high)
    off = 100 * (waves["amplitude_deg"] / waves["mitchell_deg"] - 1).abs()
    cut = rows["own_segment_m"] > min(OWN_SEGMENTS)
    return [
        Check("half waves beyond the band that the pipe keeps", float((beyond & kept).sum()), 0.0, "at_most", "",
              "second variation of Mitchell's energy"),
        Check("half waves that stand between clamped ends and that the pipe leaves",
              float((waves["clamped_keeps"] & ~kept).sum()), 0.0, "at_most", "", "Mitchell's energy with ends"),
        Check("amplitude over the band, largest difference", float(off[kept].max()), ALLOWED, "at_most", "%", SOURCE),
        Check("amplitude of rows cut by the engine, largest difference",
              float(rows.loc[cut, "off_percent"].abs().max()), ALLOWED, "at_most", "%", SOURCE),
        Check(f"amplitude of rows with segments of {min(OWN_SEGMENTS):g} m, largest difference",
              float(rows.loc[~cut, "off_percent"].abs().max()), ALLOWED, "at_most", "%", SOURCE),
    ]  # fmt: skip


def note(waves: pd.DataFrame) -> str:
    """Which half waves the pipe keeps, beside the band of a pipe without ends."""
    found = []
    for ratio, part in waves.groupby("times_onset"):
        kept = part.loc[part["kept"], "taken_over_least"]
        low, high = part["band_from"].iloc[0], part["band_to"].iloc[0]
        found.append(f"{kept.min():.2f} to {kept.max():.2f} ({low:.2f} to {high:.2f}) at {ratio:g} times the onset")
    return (
        f"Snaking stands in a band of half waves. Laid in others, a pipe of {LENGTH:g} m with its ends on the hole's "
        "axis keeps, over that of least energy and with the band of a pipe without ends in brackets: "
        f"{', '.join(found)}. Where an end is no passage of the wave, waves come in and leave there."
    )


def _is_kept(half_wave: float, laid: float) -> bool:
    """Whether the middle of the pipe has as many half waves as were laid, by less than a half."""
    return (1 - 2 * ENDS) * LENGTH * abs(1 / half_wave - 1 / laid) < 0.5
