"""What pumps take off the hook load, beside what two wells recorded with pumps on and off."""

from pathlib import Path
from typing import Any, Final

import numpy as np
import pandas as pd

from fctd import Case, build_wellbore
from fctd.hydraulics.channel import channel_of
from fctd.hydraulics.circuit import circulate
from fctd.model.drillstring import lay_out
from fctd.monitoring.series import read_series
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows
from validation.parts.f4 import f4
from validation.parts.forge_16a_rows import pumps

POUND_FORCE: Final = 4.4482216152605  # [N]
# Muds whose flow is not recorded, from thin to thick: plastic viscosity [Pa s], yield point [Pa].
MUDS: Final = {"thin": (0.008, 2.0), "thick": (0.035, 12.0)}
# Of the report of well 16A(78)-32 at 5,300 ft, which names neither: mud [kg/m³], flows [m³/s] and the speed of the jets
# that a bit of 8¾ in is run with at most [m/s].
DENSITY, FLOWS, JETS = 1054.0, (0.025, 0.050), 120.0
BIT: Final = 5300 * 0.3048
ON, OFF, IN_SLIPS = 0.02, 0.002, 86 * 9806.65  # flow [m³/s]; weight indicator [N]
STANDING, OFF_BOTTOM, SAME_PLACE = 0.01, 1.0, 1.0  # [m/s], [m], [m]
RESOLUTION: Final = 9806.65  # of the hook load's reading [N]


def forge() -> Case:
    """Pipe of 5 in with 311 m of heavier pipe and collars in 8¾ in hole, cased to 5,110 ft, as the report says."""
    hole = [
        {"to_md": "5110 ft", "diameter": "8.835 in", "friction": 0.2},
        {"to_md": "5400 ft", "diameter": "8.75 in", "friction": 0.3},
    ]
    pipe = {"outer_diameter": "5 in", "contact_diameter": "6.625 in", "segment_length": 30}
    parts = [
        {"name": "collars", "length": "220 ft", "outer_diameter": "6.5 in", "inner_diameter": "2.75 in", "segments": 4},
        {"name": "heavy pipe", "length": "800 ft", **pipe, "inner_diameter": "3 in"},
        {"name": "pipe", **pipe, "inner_diameter": "4.276 in"},
    ]
    wellbore = {"stations": [[0, 0, 0], [1700, 0, 0]], "intervals": hole}
    return Case.model_validate({"name": "16A(78)-32", "wellbore": wellbore, "string": {"components": parts}})


@table_of_rows
def explained(case: Case, bit: float, density: float, flows: tuple[float, ...], jets: tuple[float, ...]) -> Rows:
    """Lift of the annulus and thrust of the jets [kN] in thin and thick mud; jets [m/s] : their speed at each flow."""
    for mud, (viscosity, least) in MUDS.items():
        keys = {"density": density, "rheology": {"plastic_viscosity": viscosity, "yield_point": least}}
        flowing = Case.model_validate(case.model_dump(exclude_unset=True) | {"mud": keys})
        channel = channel_of(flowing, lay_out(flowing, bit), build_wellbore(flowing))
        for flow, speed in zip(flows, jets, strict=True):
            found = circulate(channel, flow)
            inside = flow / (np.pi * float(channel.bore[-1, 0]) ** 2)
            thrust = density * flow * max(speed - inside, 0.0)
            yield {
                "mud": mud, "flow_L_min": 6e4 * flow, "lift_kN": found.lift / 1e3, "jets_kN": thrust / 1e3,
                "in_all_kN": (found.lift + thrust) / 1e3, "friction_at_bit_bar": found.outside[-1] / 1e5,
            }  # fmt: skip


def pairs(folder: Path) -> tuple[dict[str, Any], float, float]:
    """Rows of the series with a standing block off bottom, by flow; flow [m³/s] and standpipe pressure [Pa]."""
    path = folder / "timeseries_12.25in_2007-10-23.csv"
    series = read_series(path)
    pressure = 1e3 * pd.read_csv(path)["Average Standpipe Pressure kPa"].median()
    speed = series["block_position_m"].diff() / series["time_s"].diff()
    off_bottom = series["hole_depth_m"] - series["bit_depth_m"] > OFF_BOTTOM
    standing = series[(speed.abs() < STANDING) & off_bottom & (series["weight_indicator_N"] > IN_SLIPS)]
    on, off = standing[standing["flow_m3_s"] > ON], standing[standing["flow_m3_s"] < OFF]
    places = off["bit_depth_m"].round().unique()
    beside = [on[(abs(on["bit_depth_m"] - depth) < SAME_PLACE) & (on["rpm"] < 1)] for depth in places]
    there = pd.concat(beside)
    found = {
        "rows": len(standing), "pumps_on": len(on), "pumps_off": len(off),
        "pumps_off_without_rotation": int((off["rpm"] < 1).sum()),
        "places_with_both_without_rotation": sum(bool(len(one)) for one in beside),
        "off_less_on_kN": (off["weight_indicator_N"].median() - there["weight_indicator_N"].median()) / 1e3,
    }  # fmt: skip
    return found, float(on["flow_m3_s"].median()), float(pressure)


def run(context: Context) -> Outcome:
    """Nothing is fitted: muds and nozzles that the wells do not record span what is usual."""
    assert context.data is not None  # the runner has checked that the data are there
    recorded = pumps(context.data).set_index("pumps")[["pick_up_klbf", "slack_off_klbf"]]
    differences = (recorded.loc["off"] - recorded.loc["on"]) * POUND_FORCE  # [kN]
    of_forge = explained(forge(), BIT, DENSITY, FLOWS, (0.5 * JETS, JETS))
    counted, flow, pressure = pairs(context.data / "volve-15-9-F-4")
    density = 1400.0
    fastest = float(np.sqrt(2 * pressure / density))  # had the bit all of the standpipe's pressure
    of_f4 = explained(f4(context.data / "volve-15-9-F-4"), 1543.0, density, (flow,), (fastest,))
    least, most = float(of_f4["lift_kN"].min()), float(of_f4["in_all_kN"].max())
    return Outcome(
        tables={"forge": of_forge, "f4": of_f4, "series": pd.DataFrame([counted])},
        checks=[
            Check("16A(78)-32: least recorded difference of pumps on and off over the most that lift and jets explain",
                  float(differences.to_numpy(float).min()) / float(of_forge["in_all_kN"].max()), 1.2, "at_most", "",
                  "a model of the flow explains what is recorded"),
            Check("15/9-F-4: places where the string stands without rotation, with pumps on and off",
                  counted["places_with_both_without_rotation"], 10, "at_least", "", "a pair that tells the lift"),
            Check("15/9-F-4: most that pumps can take off the hook load, over the resolution of its reading",
                  1e3 * most / RESOLUTION, 3.0, "at_least", "", "a difference that the sensor shows"),
        ],
        notes=[
            f"In 16A(78)-32 pick-up and slack-off fell by {differences.max():.0f} and {differences.min():.0f} kN with "
            f"pumps. Lift and jets explain {of_forge['in_all_kN'].min():.0f} to {of_forge['in_all_kN'].max():.0f} kN, "
            "for any mud, flow and nozzles that are usual: the rest has another cause, and nothing is fitted to it.",
            f"In 15/9-F-4 pumps take {least:.0f} to {most:.0f} kN off at 1,543 m, by annulus alone and with jets that "
            "have all of the standpipe pressure; the hook load is read to 9.8 kN, and flow goes with motion. In the "
            f"one place with both, {counted['off_less_on_kN']:.0f} kN more are read with pumps off.",
        ],
        display={
            "forge": "What pumps take off the hook load of 16A(78)-32 at 5,300 ft",
            "f4": "What pumps take off the hook load of 15/9-F-4 at 1,543 m",
            "series": "Rows of 15/9-F-4 with a standing block off bottom",
        },
    )  # fmt: skip


STUDY = Study("pumps_on_and_off", "Does the lift of flowing mud show in recorded hook loads?", run, needs=("data",))
