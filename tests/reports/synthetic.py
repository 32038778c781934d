"""Invented tables with the columns and roughly the sizes of the studies' own, to draw figures from."""

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


def overlap() -> dict[str, pd.DataFrame]:
    s = np.linspace(0, 30, 601)
    wave = 900 + 400 * np.cos(2 * np.pi * s / 10)
    joint = np.abs((s + 5) % 10 - 5) < 0.25
    return {
        "drag": pd.concat(
            [
                pd.DataFrame(
                    {"s_m": s, "overlap": True, "contact_force_N": wave, "direction_deg": 0.2 * s + np.sin(s)}
                ),
                pd.DataFrame(
                    {
                        "s_m": s,
                        "overlap": False,
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


def _chart() -> pd.DataFrame:
    depth = np.arange(500.0, 2500.0, 100.0)
    kinds = ["trip_in", "trip_out", "rotate_off_bottom", "drill_rotating"]
    return pd.concat(
        pd.DataFrame(
            {
                "operation": kind,
                "bit_depth_m": depth,
                "hookload_N": (200 + 20 * k) * depth,
                "surface_torque_N_m": 3 * depth * (k > 1),
                "status": ["converged"] * (len(depth) - 1) + ["unstable"],
            }
        )
        for k, kind in enumerate(kinds)
    )


def steady_state() -> dict[str, pd.DataFrame]:
    compared = pd.DataFrame(
        {
            "operation": ["trip_in", "rotate_off_bottom"],
            "bit_depth_m": [2000.0, 2000.0],
            "hookload_stepped_kN": [400.0, 480.0],
            "torque_stepped_kN_m": [0.0, 6.0],
        }
    )
    return {"chart": _chart(), "compared": compared}


def soft_limit() -> dict[str, pd.DataFrame]:
    return {
        "ladder": pd.DataFrame(
            {
                "string": ["as it is", "as it is", "soft", "soft"],
                "operation": ["pick-up", "rotation"] * 2,
                "hookload_off_percent": [0.5, 0.1, 0.02, 0.01],
                "torque_off_percent": [0.0, 1.2, 0.0, 0.1],
            }
        )
    }


def beam_in_hole() -> dict[str, pd.DataFrame]:
    segment = np.array([0.1, 0.5, 1.0])
    return {
        "beams": pd.concat(
            pd.DataFrame({"beam": beam, "segment_m": segment, "off_percent": sign * segment**2})
            for beam, sign in (("cantilever", 1.0), ("pendulum", -0.3))
        )
    }


def real_chart() -> dict[str, pd.DataFrame]:
    return {"chart": _chart().assign(geometry="arcs")}


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


def refine_real() -> dict[str, pd.DataFrame]:
    return refine()


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


def contact_operations() -> dict[str, pd.DataFrame]:
    rows = [("paper: one cylinder", 13.0, 2.0), ("engine: PT", 14.0, 0.0), ("FOR-loop", 2050.0, 514.0)]
    return {"operations": pd.DataFrame(rows, columns=["what", "arithmetic", "compare"])}


def rock_stiffness() -> dict[str, pd.DataFrame]:
    stiffness = 10.0 ** np.arange(3, 11)
    return {
        "summary": pd.DataFrame(
            {
                "stiffness_N_per_m": stiffness,
                "without_answer": (stiffness < 1e5).astype(int),
                "loads_change_percent": 1e4 / stiffness,
                "contact_force_change_percent": 2e4 / stiffness,
                "penetration_of_clearance": 4e5 / stiffness,
                "step_ms": np.minimum(1.5, 1.5e4 / np.sqrt(stiffness)),
            }
        )
    }


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


def soft_stiff_map() -> dict[str, pd.DataFrame]:
    cells = itertools.product(("5 in pipe", "collar"), (10.0, 30.0, 60.0), (5.0, 50.0), OPERATIONS)
    table = pd.DataFrame(
        {
            "string": string,
            "severity_deg_per_100ft": severity,
            "clearance_mm": clearance,
            "operation": operation,
            "contact_force_percent": severity / clearance**0.5 - 3.0,
        }
        for string, severity, clearance, operation in cells
    )
    return {"map": table, "light": table}


def friction_laws() -> dict[str, pd.DataFrame]:
    ratio = np.logspace(-2, 2, 17)
    around = 1 / np.hypot(1, ratio)
    parts = {"paper": (0 * ratio + 48, 0 * ratio + 3), "coulomb": (48 * ratio * around, 3 * around)}
    return {
        "straight": pd.concat(
            pd.DataFrame(
                {
                    "law": law,
                    "axial_over_tangential": ratio,
                    "drag_kN": drag,
                    "drag_closed_form_kN": drag,
                    "torque_kN_m": torque,
                    "torque_closed_form_kN_m": torque,
                }
            )
            for law, (drag, torque) in parts.items()
        )
    }


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


def broomstick() -> dict[str, pd.DataFrame]:
    return {"chart": pd.concat(_chart().assign(friction=factor) for factor in (0.1, 0.3))}


STUDIES = {
    function.__name__: function
    for function in (
        paper_well,
        well_profile,
        contact_operations,
        rock_stiffness,
        long_segment,
        soft_stiff_map,
        friction_laws,
        mud_effects,
        mesh_torque,
        broomstick,
        curved_chain,
        cylinder_ringing,
        scaled_section,
        energy_ledger,
        overlap,
        cylinder_error,
        ownership,
        steady_state,
        soft_limit,
        beam_in_hole,
        segment_count,
        refine,
        refine_real,
        contact_accuracy,
        contact_swap,
        engines_agree,
        speed,
        real_survey,
        real_chart,
    )
}
