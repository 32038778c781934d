"""Friction that holds in time: strings in the slips, slow and fast pulls, and strings that turn, by the defaults."""

from collections.abc import Iterable
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, Equilibrium, equilibrium, simulate
from fctd.mechanics.law_names import NAMES
from fctd.mechanics.topdrive import GRAVITY
from validation.cases import load, rotation, trip
from validation.harness.study import Check, Context, Outcome, Study

PIPE = {"name": "pipe", "outer_diameter": 0.127, "inner_diameter": 0.1086, "contact_diameter": 0.16828}
NINE = {"md": "Measured Depth ( ft )", "inc": "Inclination ( deg )", "azi": "Azimuth Grid ( deg )"}
# Survey, bit depth at which the slips are set [m], columns of the survey.
WELLS: dict[str, tuple[str, float, dict[str, str] | None]] = {
    "well 9": ("wellpathpy_well9_horizontal_reference.csv", 2300.0, NINE),
    "ISCWSA reference": ("iscwsa_reference_well.csv", 2800.0, None),
    "K05-ENC-05-S1": ("nlog_K05-ENC-05-S1.csv", 4000.0, None),
}
IN_SLIPS, FROM = 300.0, 10.0  # [s]: how long the string hangs there, and from when on its load is to stay
# Builds to 40°, then to 60° while it turns by 120°.
BENDS = [[0, 0, 0], [200, 0, 0], [600, 40, 0], [1000, 60, 60], [1400, 60, 120]]
# Speed [m/s] and way [m] of a pull: it breaks the string loose, and then slides for half a minute and more.
PULLS = {0.001: 0.4, 0.003: 0.5, 0.01: 0.8, 0.05: 3.0, 0.3: 14.0}
WITHIN = 20.0  # [s] after the ramp within which the waves of the start have decayed


def slid(case: Case, kind: str, depth: float) -> tuple[Equilibrium, float]:
    """The steady string that slides, and its drag [N]: what the same string without friction carries less."""
    smooth = [interval.model_copy(update={"friction": 0.0}) for interval in case.wellbore.intervals]
    wellbore = case.wellbore.model_copy(update={"intervals": tuple(smooth)})
    free = equilibrium(case.model_copy(update={"wellbore": wellbore}), operation=kind, bit_depth=depth)
    steady = equilibrium(case, operation=kind, bit_depth=depth)
    return steady, abs(steady.hookload - free.hookload)


def in_slips(context: Context) -> Iterable[dict[str, Any]]:
    """Rows of trips into public wells that end in the slips: how far the load below them moves."""
    assert context.data is not None  # the runner has checked that the data are there
    runs = [(well, law) for well in WELLS for law in NAMES]
    for well, law in context.progress(runs[:2] if context.quick else runs, "in the slips"):
        file, depth, columns = WELLS[well]
        case = load(
            "nlog_k05",
            wellbore__survey=context.data / "surveys" / file,
            wellbore__columns=columns,
            wellbore__geometry="arcs",
            wellbore__intervals__0__to_md=depth + 20,
            string__components__0__length=depth + 10,
            string__components__0__segments=None,
            string__components__0__segment_length=20.0,
            mud__viscosity=None,
            contact__friction_law=law,
            rig__feed="stands",
            rig__connection_time=60.0 if context.quick else IN_SLIPS,
            operations=trip(depth - 30, depth + 5, 0.5, 5.0),
        )
        history = simulate(case).history
        hanging = history[history["in_slips"]]
        since = hanging["time_s"] - hanging["time_s"].iloc[0]
        load_ = hanging["hookload_N"][since > FROM].to_numpy()
        _, drag = slid(case, "trip_in", depth)
        yield {
            "well": well,
            "law": law,
            "drag_kN": drag / 1e3,
            "load_kN": load_[0] / 1e3,
            "moved_percent": 100 * np.abs(load_ - load_[0]).max() / drag,
        }


def pulls(context: Context) -> Iterable[dict[str, Any]]:
    """Rows of pulls through a build and turn at several speeds and segment lengths against the steady string."""
    lengths = (20.0,) if context.quick else (5.0, 10.0, 20.0)
    speeds = (0.01, 0.3) if context.quick else tuple(PULLS)
    runs = [(length, speed) for length in lengths for speed in speeds]
    for length, speed in context.progress(runs, "pulls"):
        end = 1340.0 - PULLS[speed]
        case = Case.model_validate(
            {
                "name": "pulled",
                "wellbore": {
                    "stations": BENDS, "geometry": "arcs",
                    "intervals": [{"to_md": 1400.0, "diameter": 0.2159, "friction": 0.25}],
                },
                "string": {"components": [{**PIPE, "segment_length": length}]},
                "mud": {"density": 1200.0},
                "rig": {"feed": "stands"},
                "record": {"interval": 0.25},
                "operations": trip(1340.0, end, speed, 5.0),
            }
        )  # fmt: skip
        result = simulate(case)
        history, steady_end = result.history, float(result.history["time_s"].iloc[-1]) - 5.0
        mass = 7850 * np.pi / 4 * (0.127**2 - 0.1086**2)
        below = history["hookload_N"] - mass * GRAVITY * history["block_position_m"]
        time, period = history["time_s"], float(result.operations["hookload_period_s"].iloc[0])
        whole = max(int(10.0 / period), 2) * period
        late = below[(time > steady_end - whole) & (time <= steady_end)]
        # Slow pulls stretch the string for longer than the ramp before all of it slides.
        loose = float(time[below > 0.98 * late.mean()].iloc[0])
        settled = below[(time > max(loose, 5.0) + WITHIN - whole) & (time <= max(loose, 5.0) + WITHIN)]
        steady, drag = slid(case, "trip_out", end)
        yield {
            "segments_m": length,
            "speed_m_per_s": speed,
            "steady_kN": steady.hookload / 1e3,
            "drag_kN": drag / 1e3,
            "mean_kN": late.mean() / 1e3,
            "off_hookload_percent": 100 * (late.mean() / steady.hookload - 1),
            "off_drag_percent": 100 * (late.mean() - steady.hookload) / drag,
            "deviation_percent": 100 * float((settled if len(settled) > 2 else late).std()) / steady.hookload,
            "flutters": "flutter" in {note.code for note in result.notes},
        }


def turns(context: Context) -> Iterable[dict[str, Any]]:
    """Rows of strings that turn in a bend against the steady torque."""
    runs = [(severity, rpm) for severity in (5.0, 10.0) for rpm in (60.0, 120.0, 180.0)]
    for severity, rpm in context.progress(runs[-1:] if context.quick else runs, "turning"):
        build = 300 + 90 / severity * 30
        case = Case.model_validate(
            {
                "name": "turned",
                "wellbore": {
                    "stations": [[0, 0, 0], [300, 0, 0], [build, 90, 0], [build + 300, 90, 0]], "geometry": "arcs",
                    "intervals": [{"to_md": build + 300, "diameter": 0.2159, "friction": 0.25}],
                },
                "string": {"components": [{**PIPE, "segment_length": 10.0}]},
                "mud": {"density": 1200.0},
                "operations": rotation(build + 250, 60.0 if context.quick else 120.0, 20.0, rpm),
            }
        )  # fmt: skip
        (row,) = simulate(case).operations.to_dict("records")
        steady = equilibrium(case, operation="rotate_off_bottom", bit_depth=build + 250, rpm=rpm)
        torque = row["surface_torque_mean_N_m"]
        yield {
            "severity_deg_per_30m": severity,
            "rpm": rpm,
            "steady_N_m": steady.surface_torque,
            "mean_N_m": torque,
            "off_percent": 100 * (torque / steady.surface_torque - 1),
        }


def run(context: Context) -> Outcome:
    """The three tables, and the worst row of each."""
    hung, pulled, turned = (pd.DataFrame(rows(context)) for rows in (in_slips, pulls, turns))
    source = "target of this project"
    return Outcome(
        tables={"slips": hung, "pulls": pulled, "turns": turned},
        checks=[
            Check("load below the slips from 10 s on, largest move over the drag",
                  float(hung["moved_percent"].max()), 0.5, "at_most", "%", f"{source}: friction holds what rests"),
            Check("hook load of pulls against the steady string, largest difference",
                  float(pulled["off_hookload_percent"].abs().max()), 1.0, "at_most", "%", source),
            Check("drag of pulls against the steady string, largest difference",
                  float(pulled["off_drag_percent"].abs().max()), 2.0, "at_most", "%", source),
            Check("standard deviation of the hook load 20 s after the string slides, largest over the hook load",
                  float(pulled["deviation_percent"].max()), 1.0, "at_most", "%", source),
            Check("pulls that flutter", float(pulled["flutters"].sum()), 0.0, "at_most", "", source),
            Check("torque of turning strings against the steady one, largest difference",
                  float(turned["off_percent"].abs().max()), 0.3, "at_most", "%",
                  f"{source}: damping of the shape in space takes nothing of it"),
        ],
        notes=[
            "Settings are the defaults. Hook loads of pulls are those at the rotary table: without the pipe above it.",
            "Means of pulls are over whole axial periods of the last ten seconds at full speed.",
        ],
        display={
            "slips": "Load below the slips, five minutes after a trip in",
            "pulls": "Hook load of pulls through a build and turn",
            "turns": "Torque of strings that turn in a bend of 90°",
        },
    )  # fmt: skip


STUDY = Study(
    "kept_friction", "Does friction in time hold what rests, and carry what slides or turns?", run, needs=("data",)
)
