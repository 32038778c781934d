"""Numbers of segments."""

import numpy as np
import pandas as pd

OPERATIONS = ("rotate_off_bottom", "trip_out", "trip_in")


def segment_count() -> dict[str, pd.DataFrame]:
    counts, lengths = np.array([5, 20, 60, 160, 640]), np.array([0.25, 1.0, 5.0, 20.0])
    wells = ("paper-well", "4.5°/30 m", "catenary", "scaled-section")
    frames = [
        pd.DataFrame(
            {
                "well": well,
                "segments": counts,
                "reference": 640 if well == "scaled-section" else 5120,
                "torque_percent": np.nan if well == "scaled-section" else 50 / counts,
                **{f"{name}_percent": 30 / counts**1.5 for name in ("hookload", "contact", "bend_moment", "moment")},
                "cost_ms": 0.5 + counts / 60,
            }
        )
        for well in wells
    ]
    frames[0].loc[1, ["torque_percent", "cost_ms"]] = np.nan  # no answer
    steps = np.array([15, 60, 120, 240])
    cylinders = [
        pd.DataFrame(
            {
                "well": well,
                "cylinder_length_m": lengths,
                "miss_mm": lengths**2,
                "clearance_mm": 25.0,
                "contact_percent": 1e-3 * lengths**2,
                "moment_percent": 0.1 * lengths**2,
            }
        )
        for well in wells
    ]
    return {
        "counts": pd.concat(frames),
        "stepped": pd.concat(
            pd.DataFrame({"well": well, "segments": steps, "ms_per_simulated_s": [1, 2, 5, last]})
            for well, last in (("paper-well", np.nan), ("4.5°/30 m", 17.0))
        ),
        "cylinders": pd.concat(cylinders),
    }


def refine() -> dict[str, pd.DataFrame]:
    count = np.array([30, 60, 120, 240])
    return {
        "layouts": pd.concat(
            pd.DataFrame(
                {
                    "well": well,
                    "layout": layout,
                    "segments": count,
                    "torque_percent": size * 20 / count,
                    "hookload_percent": size * 9 / count,
                }
            )
            for well in ("johancsik3", "S-well")
            for layout, size in (("uniform", 1.0), ("graded", 0.4))
        ),
        "landed": pd.DataFrame(
            {
                "well": "johancsik3",
                "tolerance_percent": 1.0,
                "asked": "graded",
                "layout": layout,
                "operation": operation,
                "segments": 128,
                "estimate_percent": 0.6,
                "hookload_off_percent": 0.1,
                "torque_off_percent": 0.3,
            }
            for layout in ("uniform", "graded")
            for operation in OPERATIONS
        ),
    }


refine_real = refine
