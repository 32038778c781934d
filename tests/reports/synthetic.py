"""Invented tables with the columns of the studies' own, for the pictures of the first screen and two pages.

A function for each study, by the study's name; ``.ci/test_figures.py`` draws every figure from the studies' tables.
"""

import itertools

import numpy as np
import pandas as pd

OPERATIONS = ("rotate_off_bottom", "trip_out", "trip_in")


def overlap() -> dict[str, pd.DataFrame]:
    s = np.linspace(0, 30, 601)
    wave = 900 + 400 * np.cos(2 * np.pi * s / 10)
    joint = np.abs((s + 5) % 10 - 5) < 0.25
    return {
        "drag": pd.concat(
            [
                pd.DataFrame({"s_m": s, "overlap": 0.2, "contact_force_N": wave, "direction_deg": 0.2 * s + np.sin(s)}),
                pd.DataFrame(
                    {
                        "s_m": s,
                        "overlap": 0.0,
                        "contact_force_N": np.where(joint, 0.0, wave),
                        "direction_deg": 2 * np.floor((s + 5) / 10),
                    }
                ),
            ]
        )
    }


def ownership() -> dict[str, pd.DataFrame]:
    return {
        "owners": pd.DataFrame(
            {
                "well": ["paper-well", "build to 120°"],
                "max_tangent_difference_deg": [90.0, 120.0],
                "points": [10_000, 10_000],
                "wrong_owner_percent": [0.0, 42.1],
            }
        )
    }


def contact_accuracy() -> dict[str, pd.DataFrame]:
    rows = [("arcs", 60.0, 0.0, 0.0)]
    for name, cost in (("cylinders", 60.0), ("for_loop", 400.0), ("fcl", 1e4), ("coal", 9e3), ("bullet", 1.2e4)):
        rows += [(name, cost * growth, error, 2.5 * error) for growth, error in ((1.0, 3.0), (1.3, 0.8), (2.0, 0.1))]
    cost = pd.DataFrame(rows, columns=["method", "point_ns", "max_error_mm", "max_angle_deg"])
    return {"cost": cost.assign(point_ns_low=0.9 * cost["point_ns"], point_ns_high=1.1 * cost["point_ns"])}


def paper_well() -> dict[str, pd.DataFrame]:
    def drive(depths, scale):
        return pd.concat(
            pd.DataFrame(
                {
                    "variant": variant,
                    "bit_depth_m": depths,
                    "hookload_N": 3.5e5 - 40 * (depths - 1750) * scale,
                    "surface_torque_N_m": scale * torque * ((depths - 1750) / 700) ** 2,
                    "sum_r_mu_fn_N_m": 1.02 * scale * torque * ((depths - 1750) / 700) ** 2,
                    "sum_r_ft_N_m": scale * torque * ((depths - 1750) / 700) ** 2,
                    "contact_count": 30,
                    "total_contact_force_N": 1e5,
                }
            )
            for variant, torque in (("paper-well", 3200.0), ("paper-well-b", 3500.0))
        )

    profiles = []
    for variant, operation, bit in itertools.product(
        ("paper-well", "paper-well-b"), ("trip_in", "rotate_off_bottom"), (1800.0, 2100.0, 2450.0)
    ):
        md = np.concatenate([np.arange(bit - 1700, bit - 200, 37.5), np.arange(bit - 200, bit + 1, 10.0)])
        bent = np.interp(md, [1750, 2250, 2450], [0, 58, 90])
        force = np.where(bent > 0, 2500 + 2000 * np.sin(md / 17), np.maximum(0, 300 * np.sin(md / 40)))
        profiles.append(
            pd.DataFrame(
                {
                    "variant": variant,
                    "operation": operation,
                    "bit_depth_m": bit,
                    "md_m": md,
                    "contact_force_N": force,
                    "contact_angle_deg": np.where(md < 2150, 2.0, 172.0),
                    "offset_high_m": np.where(md < 2150, 0.057, -0.057) * (force > 0),
                    "clearance_m": np.full_like(md, 0.057),
                    "effective_tension_N": 100 * (bit - md),
                    "inclination_deg": bent,
                }
            )
        )
    runs = pd.DataFrame(
        {
            "run": ["paper-well", "paper-well, 120 segments"],
            "segments": [61, 121],
            "step_s": [2.4e-3, 1.2e-3],
            "steps": [583_000, 1_166_000],
            "simulated_s": [1400.0, 1400.0],
            "wall_s": [11.2, 43.7],
            "real_time_factor": [125.0, 32.0],
            "energy_error": [3.1e-7, 7.9e-8],
            "status": ["converged", "converged"],
        }
    )
    return {
        "trip_in": drive(np.linspace(1750, 2450, 300), 1.0),
        "rotating": drive(np.linspace(1750, 2450, 15), 0.93),
        "profiles": pd.concat(profiles),
        "runs": runs,
    }


def volve_f4() -> dict[str, pd.DataFrame]:
    depth = np.arange(500.0, 2700.0, 200.0)
    curves = pd.concat(
        pd.DataFrame(
            {
                "string": "12 1/4 in", "operation": kind, "bit_depth_m": depth,
                "weight_indicator_N": (300 + 20 * k) * depth, "drive_torque_N_m": 3 * depth,
            }
        )
        for k, kind in enumerate(OPERATIONS)
    )  # fmt: skip
    points = pd.DataFrame(
        {
            "load": ["torque", "hookload", "hookload"],
            "operation": ["rotate_off_bottom", "rotate_off_bottom", "trip_out"],
            "source": ["series", "series", "report"],
            "rad_per_s": [13.6, 13.6, 0.0],
            "low": [7.0, 1200.0, 1500.0],
            "high": [8.0, 1250.0, 1500.0],
            "bit_depth_m": [1400.0, 1400.0, 2650.0],
        }
    )
    rows = pd.DataFrame(
        {
            "row": ["F4-06", "F4-07", "F4-07"],
            "model": ["A", "A", "B"],
            "quantity": ["torque", "half spread", "half spread"],
            "low_95": [4.0, 80.0, 85.0], "low_50": [6.0, 100.0, 95.0],
            "high_50": [9.0, 120.0, 115.0], "high_95": [12.0, 140.0, 130.0],
            "measured_low": [7.0, 132.0, 132.0], "measured_high": [7.0, 132.0, 132.0],
        }
    )  # fmt: skip
    return {"curves": curves, "points": points, "rows": rows, **judged_well("Volve F-4, split A")}


def judged_well(well: str) -> dict[str, pd.DataFrame]:
    """The tables of a judged well: a weight that lies in its bands, and a torque beside them."""
    models = ["stiff string", "soft string", "one factor"]
    readings = [("F4-07", "weight up", "kN", 1460.0, 1450.0, 30.0), ("F4-06", "torque", "kN m", 7.0, 19.0, 6.0)]
    judged = pd.DataFrame(
        [
            {"well": well, "model": model, "day": "2008-03-06", "row": row, "quantity": quantity, "unit": unit,
             "measured_low": read - 0.5, "measured_high": read + 0.5, "median": middle + k,
             "low_50": middle + k - width / 2, "high_50": middle + k + width / 2,
             "low_95": middle + k - width, "high_95": middle + k + width, "in_50": unit == "kN", "in_95": unit == "kN",
             "distance_percent": 0.6 if unit == "kN" else 164.0, "crps": 1.0 + k, "error": middle + k - read}
            for row, quantity, unit, read, middle, width in readings
            for k, model in enumerate(models)
        ]
    )  # fmt: skip
    every = {
        "well": well, "readings": 1, "days": 1, "in_50": 1, "coverage_95": 1.0, "coverage_low": 0.5,
        "coverage_high": 1.0, "compatible": True, "crps_carried_on": 3.0, "bias": -0.5,
    }  # fmt: skip
    scores = pd.DataFrame(
        [
            every | {"model": model, "unit": unit, "in_95": int(unit == "kN"), "crps": 1.0 + k}
            for unit in ("kN", "kN m")
            for k, model in enumerate(models)
        ]
    )
    widths = pd.DataFrame(
        [
            {"well": well, "model": model, "row": "F4-07", "difference_kN": 265.0, "width": 0.5, "scatter_width": 0.4,
             "ratio": 1.25}
            for model in models
        ]
    )  # fmt: skip
    return {"judged": judged, "scores": scores, "widths": widths}


def scaled_section() -> dict[str, pd.DataFrame]:
    time = np.linspace(0.0, 10.0, 21)
    force = pd.concat(
        pd.DataFrame({"time_s": time, "total_N": scale * 1e3 * time, "model": model})
        for scale, model in ((1.0, "beam"), (0.98, "30 segments"))
    )
    return {"force": force}


STUDIES = {of.__name__: of for of in (overlap, ownership, contact_accuracy, paper_well, volve_f4, scaled_section)}
