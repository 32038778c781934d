"""Steady strings: charts, soft and stiff, laws, walls."""

import itertools

import numpy as np
import pandas as pd

OPERATIONS = ("rotate_off_bottom", "trip_out", "trip_in")


def _chart() -> pd.DataFrame:
    depth = np.arange(500.0, 2500.0, 100.0)
    kinds = ["trip_in", "trip_out", "rotate_off_bottom", "drill_rotating"]
    return pd.concat(
        pd.DataFrame(
            {
                "operation": kind,
                "friction": 0.2,
                "bit_depth_m": depth,
                "hookload_N": (200 + 20 * k) * depth,
                "surface_torque_N_m": 3 * depth * (k > 1),
                "total_contact_force_N": 30 * depth,
                "hookload_low_N": np.nan,
                "hookload_high_N": np.nan,
                "buckling": ["none"] * (len(depth) - 1) + ["helical"],
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


def broomstick() -> dict[str, pd.DataFrame]:
    return {"chart": pd.concat(_chart().assign(friction=factor) for factor in (0.1, 0.3))}


def real_chart() -> dict[str, pd.DataFrame]:
    return {"chart": _chart().assign(geometry="arcs")}


def ladder() -> dict[str, pd.DataFrame]:
    rows = [
        ("helix, turns", "steady", 0.3),
        ("capstan", "steady", 0.1),
        ("capstan", "stepper", 3.0),
        ("elastica", "steady", np.nan),
    ]
    return {"rungs": pd.DataFrame(rows, columns=["rung", "by", "error_over_bound"])}


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


def beam_in_hole() -> dict[str, pd.DataFrame]:
    segment = np.array([0.1, 0.5, 1.0])
    return {
        "beams": pd.concat(
            pd.DataFrame({"beam": beam, "segment_m": segment, "off_percent": sign * segment**2})
            for beam, sign in (("cantilever", 1.0), ("pendulum", -0.3))
        )
    }


def post_buckling() -> dict[str, pd.DataFrame]:
    md, ratio = np.arange(0.0, 120.0), np.linspace(1.1, 2.5, 8)
    waves = [
        pd.DataFrame(
            {
                "shape": shape, "times_onset": 1.4, "md_m": md, "angle_deg": (angle + 180) % 360 - 180,
                "offset_high_m": -0.04 * np.cos(np.radians(angle)), "offset_right_m": 0.04 * np.sin(np.radians(angle)),
            }
        )
        for shape, angle in (("snaking", 40 * np.sin(md / 4)), ("helix", 20 * md))
    ]  # fmt: skip
    length = np.array([400.0, 800.0, 1200.0])
    return {
        "shapes": pd.concat(waves, ignore_index=True),
        "paths": pd.concat(
            pd.DataFrame({"path": path, "times_onset": ratio, "wall_force_over_weight": ratio**power})
            for path, power in (("loading", 1.0), ("unloading from a helix", 2.0))
        ),
        "pushed": pd.DataFrame(
            {"length_m": length, "push_kN": 0.7 * length, "reciprocal_kN": 0.71 * length, "tan_kN": length}
        ),
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
    return {"curves": curves, "points": points, "rows": rows}


def robust_rows() -> dict[str, pd.DataFrame]:
    classes = ["2 in coiled tubing", "5 in drill pipe", "13 3/8 in casing"]
    ends = ["converged", "converged", "unstable", "under_resolved", "locked_up"]
    return {"rows": pd.DataFrame([{"class": name, "status": end} for name in classes for end in ends])}
