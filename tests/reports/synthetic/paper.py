"""The paper's well, its chain and its scaled section."""

import itertools

import numpy as np
import pandas as pd

OPERATIONS = ("rotate_off_bottom", "trip_out", "trip_in")


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


def well_profile() -> dict[str, pd.DataFrame]:
    md = np.arange(0.0, 4301.0, 50.0)
    inclination = np.interp(md, [1750, 2250, 2450], [0, 58, 90])
    step = np.diff(md, prepend=0.0)
    well = pd.DataFrame(
        {
            "md_m": md,
            "inclination_deg": inclination,
            "departure_m": np.cumsum(step * np.sin(np.radians(inclination))),
            "tvd_m": np.cumsum(step * np.cos(np.radians(inclination))),
        }
    )
    return {"wells": pd.concat(well.assign(variant=name) for name in ("paper-well", "paper-well-b"))}


def curved_chain() -> dict[str, pd.DataFrame]:
    soft = {"rotate_off_bottom": (426.5, 2.39), "trip_out": (472.0, np.nan), "trip_in": (374.0, np.nan)}
    rows, profiles = [], []
    shift = itertools.count()
    for geometry, law, operation in itertools.product(("arcs", "cylinders"), ("paper", "coulomb"), OPERATIONS):
        load, torque = soft[operation]
        percent = 0.3 * next(shift) - 1.2
        rows.append(
            {
                "geometry": geometry,
                "law": law,
                "operation": operation,
                "hookload_kN": load * (1 + percent / 100),
                "torque_kN_m": torque * (1 + 2 * percent / 100),
                "total_contact_force_kN": 118.0 + percent,
                "soft_hookload_kN": load,
                "soft_torque_kN_m": torque,
                "hookload_difference_percent": percent,
                "torque_difference_percent": 2 * percent if torque == torque else np.nan,
                "stiffness_factor": 1 + percent / 100,
            }
        )
    for law, operation in itertools.product(("paper", "coulomb"), OPERATIONS):
        md = np.arange(975.0, 2451.0, 25.0)
        force = np.where(md < 1700, 0.0, 2600 + 900 * np.sin(md / 60) + (300 if law == "paper" else 0))
        side = 180 - (11.3 if law == "coulomb" else 0.0)
        profiles.append(
            pd.DataFrame(
                {
                    "operation": operation,
                    "law": law,
                    "md_m": md,
                    "contact_force_N": force,
                    "contact_angle_deg": np.where(md < 2050, -8.0 if law == "coulomb" else 0.0, side),
                }
            )
        )
    return {"numbers": pd.DataFrame(rows), "profiles": pd.concat(profiles)}


def scaled_section() -> dict[str, pd.DataFrame]:
    time, md = np.linspace(0.2, 25, 125), np.linspace(26, 44, 31)
    models = ("finite elements", "30 segments", "240 segments")
    rise = 1 / (1 + np.exp(8 - time))
    shares = {"guide_low_N": 300.0, "bend_high_N": 950.0, "bit_low_N": 650.0}
    force, string = [], []
    for index, model in enumerate(models):
        parts = {side: size * rise * (1 + 0.02 * index) for side, size in shares.items()}
        force.append(pd.DataFrame({"time_s": time, "total_N": sum(parts.values()), **parts, "model": model}))
        offset = 0.024 * np.sin(md - 26) * (1 - 0.05 * index)
        string.append(
            pd.DataFrame(
                {
                    "above_bit_m": 44 - md,
                    "md_m": md,
                    "horizontal_m": np.maximum(md - 32, 0) ** 2 / 57 + offset,
                    "offset_high_m": offset,
                    "model": model,
                    "clearance_m": 0.025,
                }
            )
        )
    count = np.array([10, 30, 60, 120, 240, 30])
    size = 30.0 / count
    return {
        "force": pd.concat(force),
        "string": pd.concat(string),
        "segments": pd.DataFrame(
            {
                "segments": count,
                "geometry": ["cylinders"] * 5 + ["arcs"],
                "total_rms_percent": 2 * size,
                "displacement_max_percent": 16 * size,
                "displacement_above_end_percent": 9 * size,
                "displacement_rms_percent": 4 * size**2,
            }
        ),
    }
