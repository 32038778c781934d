"""Pictures of mud that flows: pressures and equivalent densities of pumping, surge and swab, the fastest trips."""

from collections.abc import Sequence
from itertools import count
from typing import Final

import numpy as np
import pandas as pd

from fctd.case.load import Case
from fctd.hydraulics.pressures import Circulation
from fctd.plots.depth_panels import Curve, Panel, Panels
from fctd.plots.palette import PALETTE
from fctd.results.unit_systems import Shown, System, in_words, shown

BLACK: Final = list(PALETTE).index("black")
# The pressures of a row, of which the picture has a curve each.
PRESSURES: Final = {
    "standpipe_Pa": "standpipe", "surface_drop_Pa": "surface lines", "bore_drop_Pa": "bore", "tool_drop_Pa": "tools",
    "bit_drop_Pa": "bit", "annulus_drop_Pa": "annulus",
}  # fmt: skip


def losses_panels(table: pd.DataFrame, last: Circulation, units: System, lines: Sequence[str] = ()) -> Panels:
    """Pressures lost against bit depth, and equivalent densities; along the hole where there is one depth.

    table : of ``hydraulics_of``, SI; last : the circulation with the largest flow at its last depth.
    """
    found = table[table["reason"] == "none"]
    metre, bar, density = (shown(name, units) for name in ("bit_depth_m", "standpipe_Pa", "ecd_bit_kg_m3"))
    if found["bit_depth_m"].nunique() < 2:
        laid, circuit = last.laid, last.circuit
        depth = laid.ends * metre.factor
        surface = last.standpipe - last.surface
        pressures = [
            Curve((circuit.inside - circuit.inside[0] + surface) * bar.factor, depth, "in the string", 0),
            Curve(circuit.outside * bar.factor, depth, "in the annulus", 1),
        ]
        dense = [Curve(last.equivalent * density.factor, depth, "equivalent density", 2)]
        label, place = "friction pressure", "measured depth"
    else:
        pressures, dense = [], []
        for dash, flow in enumerate(dict.fromkeys(found["flow_m3_s"].tolist())):
            of = found[found["flow_m3_s"] == flow]
            depth = of["bit_depth_m"].to_numpy(float) * metre.factor
            for colour, (name, words) in enumerate(PRESSURES.items()):
                if (of[name] > 0).any():
                    values = of[name].to_numpy(float) * bar.factor
                    pressures.append(Curve(values, depth, words, colour, dash))
            for colour, (name, words) in enumerate(
                (("ecd_bit_kg_m3", "at the bit"), ("ecd_shoe_kg_m3", "at the shoe"))
            ):
                if of[name].notna().any():
                    values = of[name].to_numpy(float) * density.factor
                    dense.append(Curve(values, depth, f"equivalent density {words}", colour, dash))
            # Without points, for the legend: a flow has a dash.
            dense.append(Curve(np.zeros(0), np.zeros(0), in_words(flow, "flow_m3_s", units), BLACK, dash))
        label, place = "pressure", "bit depth"
    panels = [
        Panel(f"{label}, {bar.label}", pressures),
        Panel(f"density, {density.label}", dense + _window(last, density, metre)),
    ]
    return Panels(last.laid.case.name, list(lines), f"{place}, {metre.label}", panels)


def surge_panels(
    case: Case, surges: pd.DataFrame, fastest: pd.DataFrame | None, units: System, lines: Sequence[str] = ()
) -> Panels:
    """Surge and swab at the bit against bit depth, and the fastest trips where the hole has a window.

    surges : of ``surge_pressures``; fastest : of ``fastest_trips``; both SI.
    """
    metre, bar, speed = (shown(name, units) for name in ("bit_depth_m", "surge_Pa", "speed_m_s"))
    surge, fast = [], []
    colour = count()
    for (kind, end), of in surges[surges["reason"] == "none"].groupby(["operation", "end"], sort=False):
        place = next(colour)
        for dash, rate in enumerate(dict.fromkeys(of["speed_m_s"].tolist())):
            at, words = of[of["speed_m_s"] == rate], f"{kind}, {end} end, {in_words(rate, 'speed_m_s', units)}"
            depth = at["bit_depth_m"].to_numpy(float) * metre.factor
            surge.append(Curve(at["surge_Pa"].to_numpy(float) * bar.factor, depth, words, place, dash))
        if fastest is not None:
            at = fastest[(fastest["operation"] == kind) & (fastest["end"] == end)]
            depth, value = at["bit_depth_m"].to_numpy(float), at["fastest_m_s"].to_numpy(float)
            fast.append(Curve(value * speed.factor, depth * metre.factor, f"{kind}, {end} end, fastest", place, 4))
    panels = [Panel(f"surge at the bit, {bar.label}", surge)]
    panels += [Panel(f"fastest speed within the window, {speed.label}", fast)] if fast else []
    return Panels(case.name, list(lines), f"bit depth, {metre.label}", panels)


def _window(last: Circulation, density: Shown, metre: Shown) -> list[Curve]:
    """Pore and fracture densities of the open hole against measured depth."""
    laid = last.laid
    rows = laid.case.wellbore.window
    if not rows:
        return []
    tvd, md = [row.tvd for row in rows], laid.ends * metre.factor
    sides = {side: np.interp(laid.depth, tvd, [getattr(row, side) for row in rows]) for side in ("pore", "fracture")}
    return [Curve(value * density.factor, md, side, 4 + k, 2) for k, (side, value) in enumerate(sides.items())]
