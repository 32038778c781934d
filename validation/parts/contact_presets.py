"""Presets of the runner that compares contact methods, and the tables that studies make of its results."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import pandas as pd

from fctd import Case, InputError
from fctd.arena.result import Comparison, Row
from references import contact
from references.methods.asked import Wanted, every_setting
from references.methods.compare import Comparing, Preset, preset_of
from references.methods.window import WHOLE
from validation.harness.study import Check, Context, Rows, table_of_rows

TOO_SLOW = "trimesh"  # milliseconds a point: minutes for the seconds of simulation that a load needs
FULL_ONLY = ("bullet", "mujoco", TOO_SLOW)  # methods that quick runs leave out
# Columns of a setting in fronts, beside its costs.
FRONTS = [
    "setting", "method", "series", "missed_percent", "max_error_mm", "rms_error_mm", "max_angle_deg", "pieces",
    "memory_MB", "build_s",
]  # fmt: skip
# Those of the table that is printed, of calls with one point and with a thousand.
PRINTED = [
    "setting", "single_us", "ns_1000", "ns_1000_low", "ns_1000_high", "arcs_1000", "arcs_1000_low", "arcs_1000_high",
    "rms_error_mm", "max_error_mm", "max_angle_deg",
]  # fmt: skip
# Short name, column of ``Loads`` and its unit.
LOADS = (("torque", "surface_torque_N_m", "N_m"), ("sum", "sum_r_mu_fn_N_m", "N_m"), ("hookload", "hookload_N", "N"))
ROUNDING = 1e-6  # a load below it is none, in its unit or in a thousand of it
NEAR = 200  # points for errors and costs beside loads


def compared(preset: Preset, rows: Sequence[Row], context: Context) -> Comparing:
    """The comparison of a preset, and the methods that were built for it by their labels."""
    comparing = Comparing(preset, list(rows), quick=context.quick)
    comparing.compare()
    return comparing


def in_loop(case: Case, methods: Iterable[Wanted], context: Context) -> Comparison:
    """Loads of the first operation of a case, with methods at their defaults or with options in the engine's loop.

    The window of a quick run is a single period of the slowest vibration at least.
    """
    preset = preset_of(case, periods=1 if context.quick else WHOLE)
    preset = replace(preset, near=preset.near.part(slice(0, NEAR)), contract=False, memory=lambda _: False)
    return compared(preset, every_setting(methods, defaults=True), context).comparison


@table_of_rows
def loads(found: Comparison) -> Rows:
    """Loads of each method, their differences from those of the engine's own arcs in percent, and how a run failed."""
    own = found.rows[0].loads
    assert own is not None
    for row in found.rows:
        if row.status == "not installed":
            continue
        of = row.loads if row.loads is not None and row.loads.status == "valid" else None
        line: dict[str, object] = {"setting": row.label, "method": row.name}
        for short, column, unit in LOADS:
            value, first = (None if each is None else getattr(each, column) for each in (of, own))
            line[f"{column.removesuffix(unit)}k{unit}"] = float("nan") if value is None else 1e-3 * value
            line[f"{short}_difference_percent"] = _off(value, first)
        said = "" if row.loads is None else row.loads.message
        yield line | {"failed": "" if of else said or row.loads_reason or row.reason}


@table_of_rows
def windows(found: Mapping[str, Comparison], method: str) -> Rows:
    """Loads of windows at several depths, with a method and with the engine's cylinders; differences; why none."""
    for of in found.values():
        rows = loads(of).set_index("method").to_dict("index")
        theirs, own = rows[method], rows["cylinders"]
        assert of.window is not None
        line: dict[str, object] = {"bit_depth_m": of.window.to_md_m, "window_s": of.window.duration_s}
        for short, name, unit in LOADS:
            column = f"{name.removesuffix(unit)}k{unit}"
            line |= {f"{method}_{column}": theirs[column], f"FCTD_{column}": own[column]}
            line[f"{short}_difference_percent"] = _off(theirs[column], own[column])
        yield line | {"failed": "; ".join(filter(None, (own["failed"], theirs["failed"])))}


def _off(value: float | None, first: float | None) -> float:
    """Difference in percent; nan where there is none, as of a torque that is rounding alone."""
    return float("nan") if value is None or not first or abs(first) < ROUNDING else 100 * (value / first - 1)


@table_of_rows
def regions(found: Comparison) -> Rows:
    """Errors of each setting in each region."""
    for row in found.rows:
        for each in row.regions:
            yield {"setting": row.label, "method": row.name} | each.model_dump()


def settings(found: Comparison) -> pd.DataFrame:
    """A row for each setting that was measured, with the columns of ``Comparison.flat`` in the units of figures.

    series : the method with what of its options is no number, a line of its own in figures.
    """
    table = pd.DataFrame(found.flat()).assign(series=[_series(row) for row in found.rows])
    table = table[table["status"] == "measured"].rename(columns={"name": "method"})
    return table.assign(
        max_error_mm=1e3 * table["largest_penetration_m"], rms_error_mm=1e3 * table["rms_penetration_m"],
        max_angle_deg=table["largest_angle_deg"], missed_percent=100 * table["missed"] / table["points"],
    ).reset_index(drop=True)  # fmt: skip


@table_of_rows
def by_size(found: Comparison, sizes: Sequence[int]) -> Rows:
    """Time of a point of each setting in calls of each size, with quartiles, and in points of the engine's own arcs.

    Columns: ns_SIZE, arcs_SIZE, each with _low and _high, and measured_SIZE, False where a call of fewer points stands
    for a size that was left out since it takes too long.
    """
    for row in found.rows:
        if row.status != "measured" or not row.costs:
            continue
        line: dict[str, object] = {"setting": row.label, "method": row.name}
        for size in sizes:
            cost = max((each for each in row.costs if each.points <= size), key=lambda each: each.points)
            for name, of in (("ns", cost.point_ns), ("arcs", cost.arcs)):
                values = (of.median, of.low, of.high) if of is not None else (float("nan"),) * 3
                line |= dict(zip((f"{name}_{size}", f"{name}_{size}_low", f"{name}_{size}_high"), values, strict=True))
            line[f"measured_{size}"] = cost.points == size
        yield line


def is_default(row: Row) -> bool:
    """Whether the options of a row are what its method takes by itself; False for options that are none."""
    try:
        chosen = contact.REGISTRY.options(row.name, row.options)
    except InputError:
        return False
    return chosen == type(chosen)()


def _series(row: Row) -> str:
    words = [f"{key}={value}" for key, value in row.options.items() if isinstance(value, str | bool)]
    return ", ".join([row.name, *words])


def left_out(found: Comparison) -> tuple[pd.DataFrame, list[str]]:
    """Settings that are refused or fail with the reason, and the names that are not installed."""
    bad = [
        {"setting": row.label, "why": f"{row.status}: {row.reason}"}
        for row in found.rows
        if row.status in ("refused", "failed")
    ]
    missing = [row.name for row in found.rows if row.status == "not installed"]
    return pd.DataFrame(bad, columns=["setting", "why"]), list(dict.fromkeys(missing))


def bounds(found: Comparison) -> list[Check]:
    """Whether errors stay within what the geometry of each method allows."""
    rows = [each for row in found.rows for each in row.regions]

    def worst(name: str) -> float:
        return max((getattr(each, name) or 0.0 for each in rows), default=float("nan"))

    return [
        Check("largest error of penetration over its geometric bound", worst("depth_over_bound"), 1.0,
              "at_most", "", "sagitta of facets r(1 − cos π/n), of chords and rings κℓ²/8, and 2 % at their ends"),
        Check("largest error of the normal over its geometric bound", worst("angle_over_bound"), 1.0,
              "at_most", "", "half a facet, half a chord, and the bound above over the distance from the axis"),
        Check("missed contacts deeper than the geometric bound", 1e3 * worst("missed_beyond_m"), 1e-3,
              "at_most", "mm", "the same formulas"),
    ]  # fmt: skip
