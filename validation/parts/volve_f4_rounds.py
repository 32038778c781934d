"""The second round of well 15/9-F-4: physics and choices thought of after the predictions were looked at, one each."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from fctd.calibration.rows import Row
from fctd.case.load import Case
from fctd.case.string import ComponentSpec
from validation.harness.study import Context, Rows, table_of_rows
from validation.parts.volve_f4 import ABSOLUTE, FIT_B, JUDGED_B
from validation.parts.volve_f4_fits import Frozen, fit, freeze, setup_of_b
from validation.parts.volve_f4_judging import predict
from validation.parts.volve_f4_rows import report_rows

# Another speed of reaming [m/s].
SLOW = 0.05
# Of other 5 in pipe of 19.5 lb/ft [kg/m].
LIGHT = 31.1


@table_of_rows
def second_round(context: Context, data: Path, strings: Mapping[str, Case], rig: Frozen) -> Rows:
    """A row for each change: cased friction, cost of the fit, and what it does to the judged rows."""
    rows = report_rows(data, strings, FIT_B)
    changes: dict[str, tuple[Mapping[str, Case], Sequence[Row]]] = {
        "none": (strings, rows),
        "torques alone": (strings, [replace(row, hookload=None) for row in rows if row.torque]),
        "weights alone": (strings, [replace(row, torque=None) for row in rows if row.hookload]),
        "pipe touches with its body, not its tool joints": (_changed(strings, _slim), rows),
        f"5 in pipe of {LIGHT:g} kg/m": (_changed(strings, _light), rows),
        f"row F4-13r reams at {SLOW:g} m/s": (strings, rows),
    }
    for name in context.progress(changes, "second round"):
        changed, measured = changes[name]
        setup = setup_of_b(rig)
        one = fit(changed, measured, setup, starts=2)
        fitted = freeze(one)
        judged = report_rows(data, changed, JUDGED_B)
        if "reams" in name:
            judged = [_slower(row) for row in judged]
        table = predict(changed, judged, setup, fitted, ABSOLUTE)
        spreads, weights = table[table["quantity"] == "half spread"], table[table["quantity"] != "half spread"]
        yield {
            "change": name, "friction_cased": fitted.best["friction.cased"],
            "standard_deviation": fitted.deviations["friction.cased"],
            "largest_residual_sd": float(one.residuals["in_noise"].abs().max()),
            "bias_hookload_kN": fitted.best["bias.hookload.report"] / 1e3,
            "cost": one.fit.cost,
            "spreads_in_95": f"{int(spreads['in_95'].sum())} of {len(spreads)}",
            "weights_in_95": f"{int(weights['in_95'].sum())} of {len(weights)}",
            "largest_distance_percent": float(spreads["distance_percent"].max()),
        }  # fmt: skip


def _slower(row: Row) -> Row:
    if not (row.rates.spin and row.rates.speed):
        return row
    return replace(row, rates=row.rates._replace(speed=row.direction * SLOW))


def _slim(part: ComponentSpec) -> ComponentSpec:
    return part.model_copy(update={"contact_diameter": part.outer_diameter}) if "drill pipe" in part.name else part


def _light(part: ComponentSpec) -> ComponentSpec:
    return part.model_copy(update={"linear_mass": LIGHT}) if part.name.startswith("5 in") else part


def _changed(strings: Mapping[str, Case], change: Callable[[ComponentSpec], ComponentSpec]) -> dict[str, Case]:
    """The strings with a change of their components."""
    return {
        name: case.model_copy(
            update={
                "string": case.string.model_copy(
                    update={"components": tuple(change(part) for part in case.string.components)}
                )
            }
        )
        for name, case in strings.items()
    }
