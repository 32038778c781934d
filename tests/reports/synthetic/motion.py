"""Strings in motion: energy, waves, other engines, speed."""

import itertools

import numpy as np
import pandas as pd


def energy_ledger() -> dict[str, pd.DataFrame]:
    fraction = np.array([1.0, 0.5, 0.25, 0.125])
    closure = pd.concat(
        pd.DataFrame(
            {
                "case": case,
                "step_s": 4e-3 * fraction,
                "step_fraction": fraction,
                "work_J": 1e6,
                "residual_J": 1e6 * size * fraction**order,
                "relative_residual": sign * size * fraction**order,
            }
        )
        for case, size, order, sign in (
            ("free fall", 2e-5, 2, 1),
            ("sliding, law paper", 3e-4, 1, -1),
            ("rotating, law coulomb", 8e-5, 1, 1),
        )
    )
    ledger = pd.DataFrame(
        {"case": "free fall", "step_fraction": 1.0, "term": ["kinetic", "gravity"], "energy_J": [1e6, -1e6]}
    )
    return {"ledger": ledger, "closure": closure}


def cylinder_ringing() -> dict[str, pd.DataFrame]:
    depths = np.arange(1895.0, 2450.0, 0.125)
    rise = np.exp(-(((depths - 2230) / 50) ** 2))
    names = {"the case's own": 15.0, "arcs": 0.2, "19 collars of 10.5 m": 2.0}
    swing = pd.concat(
        pd.DataFrame({"changed": name, "bit_depth_m": depths, "swing_kN": size * rise * np.sin(2 * np.pi * depths)})
        for name, size in names.items()
    )
    coarse = depths[::80]
    expected = {"bit_depth_m": coarse, "first_frequency_Hz": 1100 / coarse, "swing_kN": 12 * rise[::80]}
    runs = {"changed": list(names), "swing_kN": list(names.values()), "at_m": 2230.0, "frequency_Hz": [0.495, 0.6, 0.5]}
    return {"swing": swing, "expected": pd.DataFrame(expected), "runs": pd.DataFrame(runs)}


def long_segment() -> dict[str, pd.DataFrame]:
    time = np.linspace(0, 20, 200)
    histories = pd.concat(
        pd.DataFrame(
            {
                "time_s": time,
                "surface_torque_N_m": 2e3 * (1 - np.cos(1.5 * time * (1 + 0.01 * k))),
                "hookload_N": 8e5 + 5e4 * np.cos(2.8 * time * (1 + 0.01 * k)),
                "operation": operation,
                "ramp_s": ramp,
                "vertical": vertical,
            }
        )
        for operation, ramp in itertools.product(("rotate_off_bottom", "trip_in"), (2.0, 20.0))
        for k, vertical in enumerate(("long", "cut", "cut twice as fine"))
    )
    frequencies = pd.DataFrame(
        {"kind": kind, "continuous_Hz": scale * mode, "long_off_percent": mode**2 - 4.0, "cut_off_percent": 0.01 * mode}
        for kind, scale in (("axial", 0.9), ("torsional", 0.5))
        for mode in (1.0, 2.0, 3.0)
    )
    return {"histories": histories, "frequencies": frequencies}


def mud_effects() -> dict[str, pd.DataFrame]:
    time = np.linspace(0, 200, 2000)
    return {
        "histories": pd.concat(
            pd.DataFrame(
                {
                    "time_s": time,
                    "surface_torque_N_m": 2.4e3 + 1.6e3 * np.exp(-rate * time) * np.sin(1.46 * time),
                    "viscosity_Pa_s": viscosity,
                }
            )
            for viscosity, rate in ((0.0, 0.0), (0.03, 0.005), (0.1, 0.018))
        )
    }


def real_survey() -> dict[str, pd.DataFrame]:
    time = np.linspace(0, 600, 1200)
    md = np.arange(400.0, 3510.0, 30.0)
    return {
        "history": pd.DataFrame(
            {
                "time_s": time,
                "surface_torque_N_m": 9e3 * (1 - np.exp(-time / 20)) + 150 * np.sin(time / 3),
                "hookload_N": 9.1e5 - 2e4 * (1 - np.exp(-time / 20)) + 2e3 * np.sin(time / 3),
            }
        ),
        "profiles": pd.DataFrame(
            {
                "md_m": md,
                "contact_force_N": np.maximum(0, 2000 + 2500 * np.sin(md / 90)),
                "contact_angle_deg": (190 + 40 * np.sin(md / 300)) % 360,
            }
        ),
    }


def engines_agree() -> dict[str, pd.DataFrame]:
    names = ["FCTD", "Bullet", "MuJoCo, default"]
    md = np.arange(1700.0, 2450.0, 25.0)
    kinds = ["rotate_off_bottom", "trip_out"]
    return {
        "chain": pd.DataFrame(
            {
                "operation": kind,
                "hole": hole,
                "engine": name,
                "status": "valid" if k < 2 else "invalid",
                "hookload_off_percent": 0.3 * k,
                "torque_off_percent": -2.0 * k if kind == kinds[0] else np.nan,
            }
            for hole, kind in (("planar", kinds[0]), ("planar", kinds[1]), ("turning", kinds[0]))
            for k, name in enumerate(names)
        ),
        "profiles": pd.concat(
            pd.DataFrame(
                {"operation": kinds[0], "hole": "planar", "engine": name, "md_m": md}
                | {"contact_force_N": 5e3 * (md > 1750) + 9 * k}
            )
            for k, name in enumerate(names)
        ),
        "friction": pd.DataFrame(
            {"engine": name, "azimuth_deg": azimuth, "lean_deg": k * azimuth}
            | {"two_directions_lean_deg": 1.1 * azimuth if k == 1 else np.nan}
            for azimuth in (0.0, 15.0, 30.0)
            for k, name in enumerate(names)
        ),
    }


def speed() -> dict[str, pd.DataFrame]:
    names = ["FCTD", "FCL in our loop", "Bullet", "MuJoCo ball chain"]
    return {
        "times": pd.DataFrame(
            {
                "state": state,
                "segments": segments,
                "step": step,
                "engine": name,
                "ms_per_simulated_s": segments / 60 * 10.0 ** (k + len(step) / 10),
            }
            for state in ("no contact", "contact")
            for segments in (60, 170)
            for step in ("own step", "equal step")
            for k, name in enumerate(names)
            if state == "no contact" or "ball" not in name
        ),
        "scaling": pd.DataFrame({"segments": [60.0, 1000.0, 10_000.0], "ns_least": [31.0, 33.0, 36.0]}),
    }
