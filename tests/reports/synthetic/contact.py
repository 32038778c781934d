"""Geometry of the hole, and cost of contact queries."""

import numpy as np
import pandas as pd


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


def cylinder_error() -> dict[str, pd.DataFrame]:
    length = np.array([0.5, 1.0, 2.0, 5.0, 10.0])
    bound = 1e3 * length**2 / 8 / 286
    return {
        "errors": pd.DataFrame(
            {
                "cylinder_length_m": length,
                "max_penetration_error_mm": 0.97 * bound,
                "rms_penetration_error_mm": 0.5 * bound,
                "max_angle_error_deg": 0.25 * length**2,
                "bound_mm": bound,
            }
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


def contact_operations() -> dict[str, pd.DataFrame]:
    rows = [("paper: one cylinder", 13.0, 2.0), ("engine: PT", 14.0, 0.0), ("FOR-loop", 2050.0, 514.0)]
    return {"operations": pd.DataFrame(rows, columns=["what", "arithmetic", "compare"])}


def contact_accuracy() -> dict[str, pd.DataFrame]:
    rows = [("arcs", 60.0, 0.0, 0.0)]
    for name, cost in (("cylinders", 60.0), ("for_loop", 400.0), ("fcl", 1e4), ("coal", 9e3), ("bullet", 1.2e4)):
        rows += [(name, cost * growth, error, 2.5 * error) for growth, error in ((1.0, 3.0), (1.3, 0.8), (2.0, 0.1))]
    columns = ["method", "ns_per_point", "max_penetration_error_mm", "max_angle_error_deg"]
    return {"cost": pd.DataFrame(rows, columns=columns)}


def contact_swap() -> dict[str, pd.DataFrame]:
    loops = {
        "no contact, compiled": 14.0,
        "cylinders, compiled": 22.0,
        "arcs, compiled": 21.0,
        "FOR-loop, compiled": 160.0,
        "no contact, asked from Python": 130.0,
        "cylinders, from Python": 170.0,
        "fcl, collide, from Python": 1.1e4,
        "fcl, from Python": 9e3,
        "trimesh, from Python": 2e5,
    }
    cost = pd.DataFrame(
        [
            {"segments": n, "loop": loop, "ns_per_segment_step": ns, "ns_low": 0.95 * ns, "ns_high": 1.2 * ns}
            for n in (60, 170)
            for loop, ns in loops.items()
        ]
    )
    depth = np.linspace(1750.0, 2250.0, 400)
    windows = np.arange(1850.0, 2251.0, 100.0)
    torque = 1.73 * ((windows - 1750) / 500) ** 1.5
    return {
        "cost": cost,
        "trip": pd.DataFrame({"bit_depth_m": depth, "sum_r_mu_fn_N_m": 1.73e3 * ((depth - 1750) / 500) ** 1.5}),
        "figure_13": pd.DataFrame(
            {
                "bit_depth_m": windows,
                "fcl_kN_m": 1.003 * torque,
                "FCTD_kN_m": torque,
                "difference_percent": 0.3 + 0.1 * np.sin(windows),
            }
        ),
        "torques": pd.DataFrame(
            {"method": ["cylinders", "arcs", "fcl", "mujoco"], "sum_difference_percent": [0.0, 0.008, 0.21, -0.15]}
        ),
        "facets": pd.DataFrame(
            {
                "facets": [np.nan, 12.0, 24.0, 48.0],
                "wedge_percent": [0.0, 3.5, 0.86, 0.21],
                "sum_difference_percent": [0.0, 2.4, 0.6, 0.14],
            }
        ),
    }


def mesh_torque() -> dict[str, pd.DataFrame]:
    depth = np.array([2000.0, 2125.0, 2250.0])
    steady = np.arange(1750.0, 2251.0, 25.0)
    return {
        "windows": pd.DataFrame(
            {
                "bit_depth_m": depth,
                "FCTD_sum_r_mu_fn_kN_m": 1.7 * ((depth - 1750) / 500) ** 1.5,
                "fcl_sum_r_mu_fn_kN_m": 1.702 * ((depth - 1750) / 500) ** 1.5,
                "sum_r_mu_fn_difference_percent": [0.2, 0.1, 0.2],
                "difference_percent": [-0.2, 1.0, 0.2],
            }
        ),
        "steady": pd.DataFrame(
            {"bit_depth_m": steady, "surface_torque_N_m": 1.7e3 * ((steady - 1750) / 500) ** 1.5},
        ),
    }
