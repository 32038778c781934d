"""Effects of mud (§5.4): buoyancy of a string, its loads and waves; damping in steady and unsteady motion."""

from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, equilibrium, simulate
from fctd.hydraulics.channel import channel_of
from fctd.hydraulics.circuit import circulate
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.drillstring import lay_out
from fctd.model.mud import resistance
from fctd.model.section import section_of
from fctd.model.wellbore import build_wellbore
from references.soft_string.integration import soft_string
from validation.cases import load, rotation
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows
from validation.parts.long_string import PIPE, chain_frequencies, continuous_frequencies, the_case
from validation.parts.windows import completed, last_seconds

BIT = 2450.0
HANGING = 1700.0  # [m]: all of the string in vertical hole
STEEL = 7850.0  # [kg/m³]
DENSITIES = (0.0, 1200.0, 2000.0)  # [kg/m³] of the mud
VISCOSITIES = (0.0, 0.03, 0.1)  # [Pa s]: none, a common mud, a thick one
RPM, SPEED = 60.0, 0.5  # of rotating; [m/s] of tripping
WINDOW = 5 / 0.233  # [s]: five periods of the first torsional mode
HARDLY, ALLOWED = 1.0, 10.0  # percent: what counts as an influence here; the accuracy that §7 claims


def displaced(case: Case, mud: float) -> float:
    """Hook load [N] of a free string in vertical hole: its weight less the mud's pressure on its ends and shoulders."""
    string = lay_out(case, HANGING)
    parts = [case.string.components[k] for k in string.component]
    area = np.array([np.pi / 4 * (part.outer_diameter**2 - part.inner_diameter**2) for part in parts])
    top = np.concatenate([[0.0], np.cumsum(string.length)])
    weight = GRAVITY * STEEL * float(area @ string.length)
    # Upwards on the bit, downwards on every shoulder where steel widens from above.
    pressed = np.diff(np.append(area, 0.0))
    return weight + mud * GRAVITY * float(pressed @ top[1:])


@table_of_rows
def hanging() -> Rows:
    """A string in vertical hole: hook load by the solver, by the stepper, and from pressures; in three muds."""
    for mud in DENSITIES:
        operations = rotation(HANGING, 5.0, ramp=1.0, rpm=0.1)
        case = load("paper_well", mud__density=mud, operations=operations, record__interval=0.25)
        exact = displaced(case, mud)
        solved = equilibrium(case, "rotate_off_bottom", HANGING).hookload
        stepped = float(last_seconds(simulate(case), 3.0)["hookload_N"])
        yield {
            "mud_kg_per_m3": mud,
            "by_pressures_kN": exact / 1e3,
            "steady_kN": solved / 1e3,
            "stepped_kN": stepped / 1e3,
            "off": max(abs(solved / exact - 1), abs(stepped / exact - 1)),
        }


def buoyed() -> pd.DataFrame:
    """Loads of the paper's well in three muds, over those in air times the buoyancy factor (Eq. 25)."""
    rows = []
    for mud in DENSITIES:
        case = load("paper_well", mud__density=mud)
        row: dict[str, Any] = {"mud_kg_per_m3": mud, "buoyancy_factor": 1 - mud / STEEL}
        turning = equilibrium(case, "rotate_off_bottom", BIT)
        row |= {"torque_kN_m": turning.surface_torque / 1e3, "contact_force_kN": turning.total_contact_force / 1e3}
        for kind, name in (("trip_out", "pick_up"), ("trip_in", "slack_off")):
            row[f"{name}_kN"] = equilibrium(case, kind, BIT).hookload / 1e3
        rows.append(row)
    table = pd.DataFrame(rows)
    columns = ["torque_kN_m", "contact_force_kN", "pick_up_kN", "slack_off_kN"]
    for column in columns:
        air = table[column].iloc[0] * table["buoyancy_factor"]
        table[f"{column.removesuffix('_kN').removesuffix('_kN_m')}_off_percent"] = 100 * (table[column] / air - 1)
    return table


def frequencies() -> dict[str, float]:
    """First frequencies [Hz] of the string with the steel's own mass, and with its density times the factor."""
    operations = rotation(BIT, 1.0, 0.5)
    own, scaled = (
        chain_frequencies(load("paper_well", operations=operations, mud__density=0.0, **changes))
        for changes in ({}, {f"string__components__{k}__density": STEEL * (1 - 1200.0 / STEEL) for k in range(3)})
    )
    return {"own_Hz": float(own[1][0]), "scaled_Hz": float(scaled[1][0])}


def damping_of(viscosity: float) -> tuple[dict[str, float], tuple[float, float]]:
    """Keys of [mud] for the paper's string at 2450 m, and their total axial force per m/s and torque per rad/s.

    A case has one coefficient per metre; collars have more resistance than pipe, and their share is spread over the
    string.  Along the hole the string displaces mud, which its open bore shares with the annulus.
    """
    case = load("paper_well", mud__density=1200.0, mud__viscosity=viscosity)
    string = lay_out(case, BIT)
    around = resistance(string.of("outer"), 0.5 * case.wellbore.intervals[0].diameter, viscosity)
    axial = circulate(channel_of(case, string, build_wellbore(case)), 0.0, SPEED).lift / SPEED
    turning = float(around @ string.length)
    return {"mud__axial_damping": axial / BIT, "mud__rotational_damping": turning / BIT}, (axial, turning)


def damped(vertical: float | None) -> pd.DataFrame:
    """Steady loads of the paper's well with mud of rising viscosity; ``vertical`` as of ``long_string.the_case``."""
    rows = []
    for viscosity in VISCOSITIES:
        keys, (axial, turning) = damping_of(viscosity)
        case = the_case(vertical, **keys)
        turned = equilibrium(case, "rotate_off_bottom", BIT, rpm=RPM)
        up, down = (equilibrium(case, kind, BIT, speed=SPEED) for kind in ("trip_out", "trip_in"))
        without_mud = soft_string(case, "rotate_off_bottom", BIT, rpm=RPM).surface_torque
        rows.append(
            {
                "vertical_part": "one long segment" if vertical is None else f"segments of {vertical} m",
                "viscosity_Pa_s": viscosity,
                "torque_kN_m": turned.surface_torque / 1e3,
                "pick_up_kN": up.hookload / 1e3,
                "slack_off_kN": down.hookload / 1e3,
                "torque_of_mud_N_m": turning * RPM * np.pi / 30,
                "torque_change_soft_percent": 100 * turning * RPM * np.pi / 30 / without_mud,
                "force_of_mud_N": axial * SPEED,
            }
        )
    table = pd.DataFrame(rows)
    still = table.iloc[0]
    for column in ("torque_kN_m", "pick_up_kN", "slack_off_kN"):
        table[f"{column.partition('_k')[0]}_change_percent"] = 100 * (table[column] / still[column] - 1)
    # Drag is half the difference of hook load between tripping out and in.
    drag = 0.5 * (table["pick_up_kN"] - table["slack_off_kN"])
    table["drag_added_percent"] = 100 * (drag / drag.iloc[0] - 1)
    table["torque_added_over_closed_form"] = (
        1e3 * (table["torque_kN_m"] - still["torque_kN_m"]) / table["torque_of_mud_N_m"]
    )
    return table


def decay(quick: bool) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Decay of the twisting of a rotating string: rate by viscosity, measured and of its first mode; histories."""
    length = 65.0 if quick else 200.0
    rows, frames = [], []
    for viscosity in VISCOSITIES:
        keys, (_, turning) = damping_of(viscosity)
        case = load("paper_well", operations=rotation(BIT, length, ramp=2.0), record__interval=0.1, **keys)
        history = completed(simulate(case)).history[["time_s", "surface_torque_N_m"]].assign(viscosity_Pa_s=viscosity)
        frames.append(history)
        rows.append(
            {"viscosity_Pa_s": viscosity, "rate_per_s": decay_rate(history), "mode_per_s": mode_rate(case, turning)}
        )
    table = pd.DataFrame(rows)
    table["added_per_s"] = table["rate_per_s"] - table["rate_per_s"].iloc[0]
    return table, pd.concat(frames, ignore_index=True)


def decay_rate(history: pd.DataFrame) -> float:
    """Decay rate [1/s] of the swing of the torque, from its size in windows of five periods."""
    late = history[history["time_s"] > 10.0]
    window = ((late["time_s"] - 10.0) // WINDOW).astype(int)
    swing = late.groupby(window)["surface_torque_N_m"].std()
    whole = late.groupby(window)["time_s"].agg(np.ptp) > 0.95 * WINDOW
    swing = swing[whole]
    return -float(np.polyfit(WINDOW * np.arange(len(swing)), np.log(swing.to_numpy()), 1)[0])


def mode_rate(case: Case, turning: float) -> float:
    """The same for the first torsional mode of the continuous string, cΣφ²/(2ΣJφ²), given its total damping [N m s]."""
    collar, pipe = (section_of(component, 0.0) for component in case.string.components[:2])
    assert case.string.components[0].length is not None
    below = case.string.components[0].length
    w = 2 * np.pi * continuous_frequencies(case)[1][0]
    md = np.linspace(0.0, BIT, 4901)
    speed = [np.sqrt(part.GJ / part.axial_inertia) for part in (pipe, collar)]
    joint = BIT - below
    shape = np.where(
        md < joint,
        np.sin(w * md / speed[0]) / np.sin(w * joint / speed[0]),
        np.cos(w * (BIT - md) / speed[1]) / np.cos(w * below / speed[1]),
    )
    inertia = np.where(md < joint, pipe.axial_inertia, collar.axial_inertia)
    return float(turning / BIT * (shape**2).sum() / (2 * (inertia * shape**2).sum()))


def run(context: Context) -> Outcome:
    """Buoyancy of a free string and in torque and drag, damping in steady and unsteady motion."""
    free, muds, tones = hanging(), buoyed(), frequencies()
    cut, long = damped(PIPE), damped(None)
    rates, histories = decay(context.quick)
    common = cut[cut["viscosity_Pa_s"] == 0.03].iloc[0]
    air = muds.iloc[0]
    loads = ["torque_kN_m", "contact_force_kN", "pick_up_kN", "slack_off_kN"]
    left_out = 100 * (air[loads].to_numpy(float) / muds.iloc[1][loads].to_numpy(float) - 1)
    damping = cut.loc[cut["viscosity_Pa_s"] == 0.03, cut.filter(like="_change_percent").columns].abs().to_numpy()
    off = muds.filter(like="_off_percent").abs().to_numpy()
    thick = rates.iloc[-1]
    return Outcome(
        tables={
            "hanging": free,
            "buoyed": muds,
            "damped": pd.concat([cut, long]),
            "decay": rates,
            "histories": histories,
        },
        checks=[
            Check("hook load of a free string in mud against pressures on its ends and shoulders, largest difference",
                  float(free["off"].max()), 1e-6, "at_most", "", "Archimedes"),
            Check("loads in mud over loads in air times the buoyancy factor, largest departure",
                  float(off.max()), HARDLY, "at_most", "%",
                  "Eq. 25; loads of a string are proportional to its weight, except those from bending stiffness"),
            Check("smallest change of hook load or torque without buoyancy", float(left_out.min()), ALLOWED, "at_least",
                  "%", "§5.4: its inclusion is essential; 10 % is the accuracy that §7 claims; mud of 1200 kg/m³"),
            Check("frequency that scaling the density itself adds, mud of 1200 kg/m³",
                  100 * (tones["scaled_Hz"] / tones["own_Hz"] - 1), HARDLY, "at_most", "%",
                  "§5.4 multiplies the density; the full mass of the steel governs waves; closed form 1/√BF − 1"),
            *(
                Check(f"torque that damping adds over c Ω L, {name}, largest departure",
                      100 * float(table["torque_added_over_closed_form"].iloc[1:].sub(1).abs().max()), HARDLY,
                      "at_most", "%", "closed form")
                for name, table in (("short segments", cut), ("long segment", long))
            ),
            Check("largest change of hook load or torque by damping", float(damping.max()), HARDLY, "at_least", "%",
                  "§5.4: viscosity influences torque and drag; 1 % counts as an influence; mud of 30 mPa s"),
            Check("drag that damping adds, mud of 30 mPa s at 0.5 m/s", float(common["drag_added_percent"]), HARDLY,
                  "at_least", "%", "§5.4: viscosity influences torque and drag; 1 % counts as an influence"),
            Check("decay rate of twisting in mud of 100 mPa s over that of the first mode",
                  float(thick["added_per_s"] / thick["mode_per_s"]), (0.9, 1.1), "within", "",
                  "closed form of the continuous string"),
        ],
        notes=[
            "The engine reduces the weight by buoyancy and keeps the steel's mass for inertia. §5.4 multiplies the "
            "density of the pipe by the buoyancy factor; if that density is used for inertia as well, every wave is "
            "faster by 1/√BF.",
            "The column torque change soft is a second route to the change of torque: the closed form c Ω L over the "
            "torque of the soft string, which has no damping.",
            "Damping is that of Newtonian mud in a concentric annulus: 30 mPa s is a common mud, 100 mPa s a thick "
            "one. Along the hole it is the drag of the mud that the open string displaces at 0.5 m/s. The paper prints "
            "no coefficients.",
            "Coulomb's friction hardly damps a string that rotates along its whole length, since the friction torque "
            "does not grow with speed: without mud the twisting keeps swinging, with mud it decays within a minute "
            "or two.",
        ],
        display={
            "hanging": "A free string in vertical hole",
            "buoyed": "Loads of the paper's well in mud, and their difference from loads in air times the buoyancy "
            "factor",
            "damped": "Steady loads with the damping of the mud",
            "decay": "Decay rate of twisting, measured and of the first mode",
        },
    )  # fmt: skip


STUDY = Study("mud_effects", "How do buoyancy and damping of the mud change loads and waves?", run, reproduce=True)
