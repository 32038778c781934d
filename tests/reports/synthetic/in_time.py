"""Strings in time: trips, drilling, drives, stick-slip, whirl and friction that sticks."""

import itertools

import numpy as np
import pandas as pd


def trips() -> dict[str, pd.DataFrame]:
    depth = np.linspace(300.0, 2900.0, 10)
    return {
        "strokes": pd.concat(
            pd.DataFrame(
                {
                    "well": well,
                    "operation": kind,
                    "bit_depth_m": depth[::order],
                    "steady_hookload_kN": (0.2 + 0.02 * order) * depth[::order],
                    "hookload_kN": (0.2 + 0.02 * order) * depth[::order] + 0.3,
                    "off_percent_of_weight": 0.05 * order,
                }
            )
            for well in ("one", "another")
            for kind, order in (("trip_in", 1), ("trip_out", -1))
        )
    }


def stick_slip() -> dict[str, pd.DataFrame]:
    drives = {"stiff": 1.6, "speed_control": 1.59, "impedance": 0.45}
    time = np.arange(80.0, 120.0, 0.05)
    return {
        "thresholds": pd.DataFrame(
            {"weight_on_bit_kN": weight, "drive": drive, "linear_rpm": rpm * weight, "engine_rpm": 1.002 * rpm * weight}
            for weight in (75.0, 100.0, 150.0)
            for drive, rpm in drives.items()
        ),
        "cycles": pd.concat(
            pd.DataFrame({"time_s": time, "bit_rpm": np.maximum(0, 80 + 120 * np.sin(rate * time)), "by": by})
            for by, rate in (("engine", 1.36), ("ODE", 1.37))
        ),
    }


def sticking() -> dict[str, pd.DataFrame]:
    return {
        "belt": pd.DataFrame(
            {"law": law, "step_ms": step, "period_off_percent": 5e-3 * step, "amplitude_off_percent": 1e-2 * step}
            for law, step in itertools.product(("karnopp", "stribeck"), (1.8, 3.6, 7.3))
        ),
        "overpull": pd.DataFrame(
            {"static_over_kinetic": ratio, "overpull_kN": 600 + 80 * ratio, "all_at_once_kN": 607 * ratio}
            for ratio in (1.0, 1.5, 2.0, 3.0)
        ),
    }


def whirl() -> dict[str, pd.DataFrame]:
    speeds = np.array([3.9, 4.2, 4.4])
    time = np.linspace(0, 2, 200)
    return {
        "critical_speed": pd.DataFrame(
            {
                "rad_per_s": speeds,
                "radius_mm": speeds**2 / (21.6 - speeds**2),
                "critical_rad_per_s": np.sqrt(21.6),
                "rotor_rad_per_s": 4.65,
            }
        ),
        "paths": pd.concat(
            pd.DataFrame(
                {"time_s": time, "x_m": 0.025 * np.cos(rate * time), "y_m": 0.025 * np.sin(rate * time), "of": of}
            )
            for of, rate in (("FCTD", -20.3), ("planar rotor", -20.4))
        ),
    }


def tortuosity() -> dict[str, pd.DataFrame]:
    kinds = ("trip_out", "trip_in", "rotate_off_bottom")
    return {
        "apparent_friction": pd.DataFrame(
            {"amplitude_mm": amplitude, "wavelength_m": wavelength, "seed": seed}
            | {
                f"{kind}_friction": 0.2 + amplitude**2 / wavelength / (900 + 50 * k + seed)
                for k, kind in enumerate(kinds)
            }
            for amplitude, wavelength in ((5.0, 10.0), (10.0, 10.0), (20.0, 10.0), (20.0, 20.0), (20.0, 40.0))
            for seed in range(3)
        )
    }


def drilling() -> dict[str, pd.DataFrame]:
    strength = np.array([300.0, 240.0, 200.0, 800.0])
    depth = np.arange(500.0, 3001.0, 250.0)
    return {
        "drilling": pd.DataFrame(
            {
                "driller": ["block at 0.006 m/s", "block at 0.009 m/s", "block at 0.012 m/s", "autodriller"],
                "drilling_strength_MPa": strength,
                "specific_energy_MPa": 64.1 + 0.6 * strength,
                "by_the_law_MPa": 64 + 0.6 * strength,
            }
        ),
        "speed": pd.DataFrame({"depth_m": depth, "real_time_factor": 3e5 / depth}),
    }


def top_drive() -> dict[str, pd.DataFrame]:
    frequency = np.geomspace(0.05, 2.0, 30)
    reflected = (1j * frequency + 0.05) / (1j * frequency + 0.3)
    return {
        "reflection": pd.concat(
            pd.DataFrame(
                {
                    "frequency_Hz": frequency,
                    "drive": drive,
                    "exact_real": reflected.real,
                    "exact_imaginary": reflected.imag,
                    "measured_real": reflected.real + 1e-3,
                    "measured_imaginary": reflected.imag - 1e-3,
                }
            )
            for drive in ("no inertia", "compensated", "full inertia")
        )
    }


def spin_up() -> dict[str, pd.DataFrame]:
    time = np.linspace(0, 40, 400)
    built = np.minimum(np.sqrt(time), 2.7)
    return {
        "torque": pd.DataFrame({"time_s": time, "torque_kN_m": built + 0.05 * np.sin(time), "closed_form_kN_m": built})
    }
