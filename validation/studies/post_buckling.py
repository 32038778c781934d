"""A pipe compressed beyond buckling: onset, snaking, helix, and the force that slides through it, against closed forms.

5 in pipe in 8½ in hole.  Its ends are on the hole's axis, clamped above and hinged below, so shapes are measured in the
half between.  The engine's pipe has its shear and its axial stiffness, and a wall that yields; the closed forms have
none of them, which is 0.3 % of the amplitude.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pandas as pd

from references.buckling import helix, mitchell
from references.buckling.onset import FREE_END, half_wave, snaking_limit
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows
from validation.parts import analytic_helix, half_waves, resolved_rows, wall_limits
from validation.parts.buckled_pipe import BUCKLING, Rig, Turns, UnsettledError, energy, middle, turns_of, wave_of

Number = Any  # a number, or a column of them

ONSET = BUCKLING.onset
LENGTH, LONG = 300.0, 900.0  # [m]: 24 half waves, and for helices, whose turns the ends hold back, 50 turns or more
SEGMENT, FINE = 0.75, 0.5  # [m]: 16 and 25 in a half wave at the onset
INCLINED = np.radians(60.0)
BUILD = np.radians(3.0) / 30.0  # [rad/m]
SNAKING = (1.1, 1.25, 1.4, 1.7)  # times the onset, as are the next
HELICES = (1.5, 1.7, 2.0, 2.5)
ENERGIES = (1.35, 1.4, 1.45, 1.5, 1.55)
HIGHEST, STEP = 2.5, 0.05
PUSHED, FRICTION = 1.5, 0.3  # compression at the lower end, above the helical limit of 1.41
SHARES = (0.25, 0.5, 0.75)  # of the lock-up length
WEIGHTS = (10.0, 20.0, 40.0, 80.0)  # weights on bit over (EI w²)^⅓
SEGMENTS = (3.0, 2.0, 1.5, 1.0, 0.75, 0.5)
HALVED = (2.0, 1.0, 0.5)  # of these, to find the order
ORDER_AT, ORDER_WAVES = 1.25, 19  # times the onset; half waves in the rig
ORDER_LENGTH = 240.0  # [m]
ROD = (2.0,)  # times the onset, where snaking leaves the wall
ROWS = (1.25, 2.0)  # times the onset
ROD_LENGTH, ROD_SEGMENT, ROD_WAVES = 100.0, 1.0, 8  # [m], [m], half waves

# Captions of the tables of the full run.
FULL = {
    "pushed_row": "A row of the helix that slides",
    "locked_rows": "Rows of a helix that no block pushes, the last beyond its lock-up length, with noise by their seed",
    "well": "Hook load of a horizontal well that slides, against the segment length; the last row is resolved",
    "analytic_well": "Hook load of that well on long segments, with and without the helix's wall force",
    "second_route": "One string by a second route",
}


def onsets() -> pd.DataFrame:
    """Compression at which the straight pipe becomes unstable, where it is largest: in a build, in its middle."""
    around = 0.5 * np.degrees(BUILD) * LENGTH
    # At this friction factor the weight along the hole is that of the friction, and the compression is uniform.
    cases: list[tuple[str, float, Rig]] = [
        ("level hole", ONSET, Rig(LENGTH, SEGMENT)),
        ("level hole, free lower end", FREE_END * ONSET, Rig(LENGTH, SEGMENT, held=False)),
        (
            "60° inclined, sliding with friction",
            snaking_limit(BUCKLING, INCLINED),
            Rig(LENGTH, SEGMENT, [(0.0, 60.0, 0.0), (LENGTH, 60.0, 0.0)], 1 / np.tan(INCLINED)),
        ),
        (
            "build of 3° in 30 m",
            snaking_limit(BUCKLING, 0.5 * np.pi, BUILD),
            Rig(LENGTH, FINE, [(0.0, 90 - around, 0.0), (LENGTH, 90 + around, 0.0)]),
        ),
    ]
    rows = []
    for name, exact, rig in cases:
        force, largest = rig.onset(exact)
        rows.append({"case": name, "onset_kN": force * largest / 1e3, "closed_form_kN": exact / 1e3})
    return _compared(pd.DataFrame(rows), "onset_kN", "closed_form_kN")


def snaking(segment: float) -> pd.DataFrame:
    """Snaking of a level pipe under a load that rises, against Mitchell's equation for the same half wave."""
    rig = Rig(LENGTH, segment)
    rig.lay_straight(SNAKING[0] * ONSET)
    rows = []
    for ratio in SNAKING:
        wave = wave_of(rig.settle(ratio * ONSET).profile)
        if wave is None:
            raise UnsettledError(f"no snaking at {ratio:g} times the onset")
        exact = mitchell.snaking(BUCKLING, ratio * ONSET, wave.half_wave)
        rows.append(
            {
                "times_onset": ratio, "half_wave_m": wave.half_wave, "amplitude_deg": wave.amplitude,
                "mitchell_deg": np.degrees(exact.amplitude), "wall_force_N_per_m": wave.wall_force,
                "mitchell_N_per_m": exact.mean_wall_force,
            }
        )  # fmt: skip
    table = _compared(pd.DataFrame(rows), "amplitude_deg", "mitchell_deg")
    return table.assign(wall_force_off_percent=_percent(table["wall_force_N_per_m"], table["mitchell_N_per_m"]))


@table_of_rows
def helices(segment: float, ratios: Sequence[float]) -> Rows:
    """Helices of a level pipe, each laid with θ' = √(F/2EI) and settled, against the closed forms."""
    rig = Rig(LONG, segment)
    for ratio in ratios:
        force = ratio * ONSET
        rig.wind(force)
        turns = _helix_of(turns_of(rig.settle(force).profile), ratio)
        level = mitchell.helix(BUCKLING, force)
        yield {
            "times_onset": ratio,
            "pitch_m": turns.pitch,
            "pitch_off_percent": _percent(turns.pitch, helix.pitch(BUCKLING, force)),
            "pitch_off_mitchell_percent": _percent(turns.pitch, level.length),
            "wall_force_N_per_m": turns.wall_force,
            "wall_force_off_percent": _percent(turns.wall_force, helix.wall_force(BUCKLING, force)),
            "moment_kN_m": turns.moment / 1e3,
            "moment_off_percent": _percent(turns.moment, helix.bending_moment(BUCKLING, force)),
        }


@table_of_rows
def energies(segment: float, ratios: Sequence[float]) -> Rows:
    """Energy a metre of the helix over that of snaking, each laid at its length of least energy."""
    for ratio in ratios:
        rig, force = Rig(LONG, segment), ratio * ONSET
        rig.wind(force)
        wound = energy(rig, rig.settle(force))
        shape = mitchell.snaking(BUCKLING, force)
        rig.lay(force, shape.waves)
        waved = energy(rig, rig.settle(force))
        exact = mitchell.helix(BUCKLING, force).energy - shape.energy
        yield {"times_onset": ratio, "helix_over_snaking_J_per_m": (wound - waved) / LONG, "mitchell_J_per_m": exact}


@table_of_rows
def paths(segment: float, step: float) -> Rows:
    """A level pipe loaded from straight, unloaded from there, and unloaded from a helix at the highest load."""
    up = np.arange(1.1, HIGHEST + 0.5 * step, step)
    rig = Rig(LENGTH, segment)
    rig.lay_straight(up[0] * ONSET)
    for name, ratios in (("loading", up), ("unloading", up[::-1]), ("unloading from a helix", up[::-1])):
        if "helix" in name:
            rig.wind(HIGHEST * ONSET)
        for ratio in ratios:
            profile = rig.settle(ratio * ONSET).profile
            part = middle(profile)
            turns, wave = turns_of(profile), wave_of(profile)
            yield {
                "path": name, "times_onset": ratio,
                "shape": "helix" if turns is not None else "snaking" if wave is not None else "other",
                "wave_m": turns.pitch if turns is not None else wave.half_wave if wave is not None else np.nan,
                "wall_force_over_weight": part["contact_force_N"].mean() / (segment * BUCKLING.weight),
                "least_wall_force_over_weight": part["contact_force_N"].min() / (segment * BUCKLING.weight),
                "off_wall_percent": 100 * (part["contact_force_N"] <= 0).mean(),
            }  # fmt: skip


@table_of_rows
def pushed(segment: float) -> Rows:
    """Push at the top of a helix that slides through a level hole, at three shares of the lock-up length."""
    force = PUSHED * ONSET
    whole = helix.lock_up_length(BUCKLING, force, FRICTION)
    for share in SHARES:
        length = share * whole
        rig = Rig(length, segment, friction=FRICTION)
        rig.wind(force, lambda above: force / (1 - np.minimum(above, 0.9 * whole) / whole))
        push = -rig.settle(force).hookload
        law, tan = (form(BUCKLING, force, FRICTION, length) for form in (helix.pushed_force, helix.pushed_force_tan))
        yield {
            "length_m": length, "share_of_lock_up_percent": 100 * share, "push_kN": push / 1e3,
            "reciprocal_kN": law / 1e3, "off_percent": _percent(push, law),
            "tan_kN": tan / 1e3, "tan_off_percent": _percent(tan, push),
        }  # fmt: skip


def hanging(segment: float, weights: Sequence[float]) -> pd.DataFrame:
    """Shortening by the helix of a vertical pipe, beyond that of its axial stiffness."""
    rows = []
    for times in weights:
        force = times * BUCKLING.vertical
        length = force / BUCKLING.weight + 150.0  # above the neutral point the pipe hangs straight
        rig = Rig(length, segment, [(0.0, 0.0, 0.0), (length, 0.0, 0.0)])
        rig.wind(force)
        short = rig.shortening(rig.settle(force))
        exact = helix.vertical_shortening(BUCKLING, force)
        rows.append(
            {"times_unit": times, "force_kN": force / 1e3, "shortening_mm": 1e3 * short, "exact_mm": 1e3 * exact}
        )
    return _compared(pd.DataFrame(rows), "shortening_mm", "exact_mm")


@table_of_rows
def second_route() -> Rows:
    """Snaking that leaves the wall, by the engine and as a rod of PyElastica, both from the same straight segments."""
    half = ROD_LENGTH / ROD_WAVES
    for ratio in ROD:
        rig, force = Rig(ROD_LENGTH, ROD_SEGMENT), ratio * ONSET
        rig.lay(force, mitchell.snaking(BUCKLING, force, half).waves, np.zeros_like)
        rod = rig.rest_as_rod(force)
        for name, profile in (("PyElastica", rod), ("engine", rig.settle(force).profile)):
            wave, part = wave_of(profile), middle(profile)
            if wave is None:
                raise UnsettledError(f"no snaking at {ratio:g} times the onset, {name}")
            yield {
                "times_onset": ratio, "route": name, "amplitude_deg": wave.amplitude,
                "half_wave_m": wave.half_wave, "off_wall_percent": 100 * (part["contact_force_N"] <= 0).mean(),
                "wall_force_N_per_m": part["contact_force_N"].mean() / ROD_SEGMENT,
                "shortening_mm": 1e3 * (ROD_LENGTH - np.ptp(profile["md_m"])),
            }  # fmt: skip


def convergence() -> pd.DataFrame:
    """Snaking of a given number of half waves and helix of a given number of turns against the segment length."""
    force, rows = ORDER_AT * ONSET, []
    half = ORDER_LENGTH / ORDER_WAVES
    shape = mitchell.snaking(BUCKLING, force, half)
    for segment in SEGMENTS:
        rig = Rig(ORDER_LENGTH, segment)
        rig.lay(force, shape.waves)
        wave = wave_of(rig.settle(force).profile)
        rig = Rig(0.5 * LONG, segment)
        rig.wind(2 * ONSET)
        turns = _helix_of(turns_of(rig.settle(2 * ONSET).profile), 2.0)
        if wave is None:
            raise UnsettledError(f"no snaking with segments of {segment:g} m")
        rows.append(
            {
                "segment_m": segment, "in_half_wave": wave.half_wave / segment, "amplitude_deg": wave.amplitude,
                "in_turn": turns.pitch / segment, "moment_kN_m": turns.moment / 1e3,
            }
        )  # fmt: skip
    table = pd.DataFrame(rows)
    for column in ("amplitude_deg", "moment_kN_m"):
        # The value of no segment length, by the second order that a chain of rigid segments has.
        coarse, fine = table[column].iloc[-2], table[column].iloc[-1]
        ratio = (table["segment_m"].iloc[-2] / table["segment_m"].iloc[-1]) ** 2
        table[f"{column.split('_')[0]}_off_percent"] = _percent(table[column], fine + (fine - coarse) / (ratio - 1))
    return table


def shapes(segment: float) -> pd.DataFrame:
    """The middle of a snaking and of a helically buckled pipe, for a picture."""
    tables = []
    for name, ratio in (("snaking", 1.4), ("helix", 2.0)):
        rig, force = Rig(LENGTH, segment), ratio * ONSET
        if name == "helix":
            rig.wind(force)
        else:
            rig.lay(force, mitchell.snaking(BUCKLING, force).waves)
        part = middle(rig.settle(force).profile)
        columns = part[["md_m", "angle_deg", "offset_high_m", "offset_right_m", "contact_force_N"]]
        tables.append(columns.assign(shape=name, times_onset=ratio, md_m=part["md_m"] - part["md_m"].iloc[0]))
    return pd.concat(tables, ignore_index=True)


def run(context: Context) -> Outcome:
    """All rigs; the short way with longer segments and fewer loads."""
    segment = 1.0 if context.quick else SEGMENT
    wound, compared = (HELICES[1::2], ENERGIES[1::2]) if context.quick else (HELICES, ENERGIES)
    parts: list[tuple[str, Callable[[], pd.DataFrame]]] = [
        ("onset", onsets),
        ("snaking", lambda: snaking(FINE)),
        ("helix", lambda: helices(segment, wound)),
        ("energies", lambda: energies(segment, compared)),
        ("paths", lambda: paths(SEGMENT, STEP)),
        ("pushed", lambda: pushed(segment)),
        ("hanging", lambda: hanging(segment, WEIGHTS[:3] if context.quick else WEIGHTS)),
        ("convergence", convergence),
        ("shapes", lambda: shapes(segment)),
        ("half_waves", lambda: half_waves.laid(context.quick)),
        ("rows", lambda: resolved_rows.level_rows(*ROWS)),
        ("half_waves_of_rows", lambda: half_waves.taken(context.quick)),
        ("analytic_pushed", lambda: analytic_helix.pushed_rows(PUSHED, FRICTION, SHARES)),
    ]
    if not context.quick:
        parts += [
            ("pushed_row", lambda: resolved_rows.pushed_row(PUSHED, FRICTION, SHARES[0])),
            ("locked_rows", lambda: pd.concat(context.apart(_locked_rows, resolved_rows.DRAWS), ignore_index=True)),
            ("well", resolved_rows.well_rows),
            ("analytic_well", analytic_helix.well_rows),
            ("second_route", second_route),
        ]
    tables = {name: part() for name, part in context.progress(parts, "rigs")}
    return Outcome(
        tables=tables,
        checks=_checks(tables),
        notes=[
            f"5 in pipe in 8½ in hole; onset in a level hole {ONSET / 1e3:.1f} kN, half wave there "
            f"{half_wave(BUCKLING):.1f} m. The ends are on the hole's axis, clamped above and hinged below; shapes are "
            "measured in the half between them.",
            "Friction acts at the pipe's axis here, as in the closed forms: its moment at the pipe's surface turns a "
            "helix about the hole's axis without end.",
            f"Mitchell's equation holds up to {mitchell.wall_contact_limit():.3g} times the onset. Beyond it, "
            "snaking leaves the wall at its turning points; the full run compares it with a Cosserat rod of PyElastica "
            "there.",
            half_waves.note(tables["half_waves"]),
        ],
        display={
            "onset": "Onset of buckling",
            "snaking": "Snaking against Mitchell's equation for the same half wave",
            "helix": "Helix of a level pipe against the closed forms",
            "energies": "Which shape has less energy",
            "pushed": "Force through a helix that slides, with the tan law of the planning tools",
            "hanging": "Shortening of vertical tubing by its helix",
            "convergence": "Segment length, against the value of none",
            "half_waves": "Half waves that a level pipe keeps, over that of least energy, and those of the equation",
            "rows": "Rows of a level pipe of long segments, with its buckling resolved",
            "half_waves_of_rows": "Snaking of such rows at the half wave that each takes",
            "analytic_pushed": "Force through a level pipe of long segments, with and without the helix's wall force",
        }
        | {name: caption for name, caption in FULL.items() if name in tables},
    )


def _checks(tables: dict[str, pd.DataFrame]) -> list[Check]:
    """The numbers with bounds."""
    onset, waves, turns, sliding, hung = (tables[name] for name in ("onset", "snaking", "helix", "pushed", "hanging"))
    checks = [
        Check(f"onset, {name}", abs(off), 1.0, "at_most", "%", "Dawson & Paslay 1984; He & Kyllingstad 1995")
        for name, off in zip(onset["case"], onset["off_percent"], strict=True)
    ]
    checks += [
        Check(
            f"amplitude of snaking at {ratio:g} times the onset",
            abs(off),
            half_waves.ALLOWED,
            "at_most",
            "%",
            half_waves.SOURCE,
        )
        for ratio, off in zip(waves["times_onset"], waves["off_percent"], strict=True)
    ]
    for what, source in (("pitch", "Lubinski et al. 1962"), ("wall_force", "Mitchell 1986"), ("moment", "rF/2")):
        worst = float(turns[f"{what}_off_percent"].abs().max())
        checks.append(Check(f"helix, {what.replace('_', ' ')}", worst, 3.0, "at_most", "%", source))
    checks += [
        Check(f"push through {share:g} % of the lock-up length", abs(off), 3.0, "at_most", "%", "reciprocal law")
        for share, off in zip(sliding["share_of_lock_up_percent"], sliding["off_percent"], strict=True)
    ]
    checks.append(
        Check("the tan law exceeds the push by at least", float(sliding["tan_off_percent"].min()), 0.0, "at_least", "%",
              "it adds the weight, which averages out over a turn")
    )  # fmt: skip
    checks += [
        Check(f"shortening at {times:g} (EI w²)^⅓", abs(off), 2.0, "at_most", "%", "Lubinski et al. 1962, asymptotic")
        for times, off in zip(hung["times_unit"], hung["off_percent"], strict=True)
        if times >= 40
    ]
    energy_of = tables["energies"]
    equal = float(np.interp(0.0, -energy_of["helix_over_snaking_J_per_m"], energy_of["times_onset"]))
    exact = mitchell.equal_energy_ratio()
    checks.append(
        Check("equal energy of helix and snaking, times the onset", equal, (0.97 * exact, 1.03 * exact), "within", "",
              "Mitchell's equation, within 3 %")
    )  # fmt: skip
    table = tables["convergence"].set_index("segment_m")
    for column in ("amplitude_deg", "moment_kN_m"):
        coarse, middling, fine = table.loc[list(HALVED), column]
        order = float(np.log2((coarse - middling) / (middling - fine)))
        name = f"order of convergence, {column.split('_')[0]}"
        checks.append(Check(name, order, (1.7, 2.5), "within", "", "a chain of rigid segments: second order"))
    for part in (resolved_rows, half_waves, wall_limits, analytic_helix):
        checks += part.checks(tables)
    if "second_route" in tables:
        routes = tables["second_route"].set_index(["route", "times_onset"])
        other, own = routes.loc["PyElastica"], routes.loc["engine"]
        for column in ("amplitude_deg", "wall_force_N_per_m"):
            worst = float(_percent(own[column], other[column]).abs().max())
            name = f"engine against PyElastica, {column.split('_')[0]}"
            checks.append(Check(name, worst, 3.0, "at_most", "%", "a second route for one string"))
    return checks


def _locked_rows(seed: int | None) -> pd.DataFrame:
    """A draw of these rows."""
    return resolved_rows.locked_rows(seed, PUSHED, FRICTION, SHARES)


def _percent(value: Number, exact: Number) -> Number:
    """Difference in percent of the exact value."""
    return 100 * (value / exact - 1)


def _compared(table: pd.DataFrame, value: str, exact: str) -> pd.DataFrame:
    """The table with the difference of two columns."""
    return table.assign(off_percent=100 * (table[value] / table[exact] - 1))


def _helix_of(turns: Turns | None, ratio: float) -> Turns:
    """The turns, or an error where the pipe has none."""
    if turns is None:
        raise UnsettledError(f"no helix at {ratio:g} times the onset")
    return turns


STUDY = Study(
    "post_buckling",
    "Does a pipe that buckles do so at the right force, into the right shape, and with the right wall force?",
    run,
    reproduce=True,
)
