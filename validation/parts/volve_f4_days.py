"""The second round of well 15/9-F-4, with pairs of friction factors and scatter between days, and priors of others.

``python -m validation.parts.volve_f4_days STAGE ...`` fits a stage and writes its frozen values.
"""

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
import pandas as pd

from fctd.calibration.forward import Forward
from fctd.calibration.predict import read_posterior
from fctd.calibration.result import Calibration
from fctd.calibration.rows import Row
from fctd.calibration.setup import Setup
from fctd.case.load import Case
from validation.harness.study import Check, Context, data_folder
from validation.parts import volve_f4 as split
from validation.parts.day_fits import carried_on, fit_by_day, freeze, furthest, one_factor
from validation.parts.judged_well import ONE_FACTOR, SOFT, STIFF, judged_tables
from validation.parts.judging import Judged, readings_of
from validation.parts.volve_f4_fits import SETUPS, frozen, held_by, setup_of
from validation.parts.volve_f4_judging import judged
from validation.parts.volve_f4_rows import cases, report_rows, series_rows
from validation.parts.volve_f4_soft import SoftForward

FOR_OTHERS: Final = SETUPS / "for_other_wells.toml"
# Spread of friction factors among wells, of their logarithm: in 95 of 100 wells 0.1 to 0.6 (the range of handbooks).
AMONG_WELLS: Final = 0.45


class Split(NamedTuple):
    """Rows that fit, rows that are judged, those of them that are judged on weights, and the setup's name."""

    fit: tuple[str, ...]
    judged: tuple[str, ...]
    absolute: tuple[str, ...]
    setup: str


SPLITS: Final = {
    "A": Split(split.FIT_A, split.JUDGED_A, (), "days_a"),
    "B": Split(split.FIT_B, split.JUDGED_B, split.ABSOLUTE, "days_b"),
}
ROUTES: Final[dict[str, type[Forward]]] = {STIFF: Forward, SOFT: SoftForward, ONE_FACTOR: Forward}


def setup_of_days(name: str, model: str = STIFF) -> Setup:
    """The setup of a split; that of B has the rig's values as priors."""
    setup = setup_of(SPLITS[name].setup, held_by(frozen()["rig"]) if name == "B" else {})
    return one_factor(setup) if model == ONE_FACTOR else setup


def rows_of(data: Path, strings: Mapping[str, Case], ids: Sequence[str]) -> list[Row]:
    """The rows of the reports, and those of the series where it is named."""
    series = series_rows(data, strings) if split.SERIES in ids else []
    return [*series, *report_rows(data, strings, [name for name in ids if name != split.SERIES])]


def fit_of(data: Path, strings: Mapping[str, Case], name: str, model: str = STIFF) -> Calibration:
    """The fit of a split."""
    return fit_by_day(strings, rows_of(data, strings, SPLITS[name].fit), setup_of_days(name, model), ROUTES[model])


def fit_of_all(data: Path, strings: Mapping[str, Case]) -> Calibration:
    """The fit of all rows of the well, of eight days, which judges none of them."""
    ids = dict.fromkeys([*split.FIT_A, *split.STRINGS])
    return fit_by_day(strings, rows_of(data, strings, [*ids]), setup_of_days("A"))


def well_of(name: str) -> str:
    """What the tables call a split, whose rows are judged by themselves."""
    return f"Volve F-4, split {name}"


def frozen_file(name: str, model: str) -> Path:
    """Of the frozen values of a split and a model."""
    return SETUPS / f"days_{name.lower()}_{model.replace(' ', '_')}.fit.json"


def tables_of(data: Path, strings: Mapping[str, Case]) -> dict[str, pd.DataFrame]:
    """The tables of ``judged_tables`` from the frozen values, each split as a well of its own."""
    found = []
    for name, one in SPLITS.items():
        rows = report_rows(data, strings, one.judged)
        posteriors = {model: read_posterior(frozen_file(name, model)) for model in ROUTES}
        models = {
            model: (posterior, ROUTES[model](rows, strings, posterior.unknowns, posterior.setup))
            for model, posterior in posteriors.items()
        }
        first = posteriors[STIFF]
        fitted = Forward(rows_of(data, strings, one.fit), strings, first.unknowns, first.setup)

        def quantities(forward: Forward, absolute: Sequence[str] = one.absolute) -> list[Judged]:
            return judged(forward, absolute)

        def kinds(forward: Forward) -> list[Judged]:
            """Torques by themselves, and all that a report gives."""
            torques = [one for one in readings_of(forward) if one.quantity == "torque"]
            ids = {row.id.rsplit(" ", 1)[0] for row in forward.rows}
            return [*torques, *(one for one in judged(forward, ids) if one.quantity != "torque")]

        carried = carried_on(fitted, models[STIFF][1], lambda row: row.day, kinds)
        found.append(judged_tables(well_of(name), models, carried, quantities))
    return {key: pd.concat([tables[key] for tables in found], ignore_index=True) for key in found[0]}


def refitted(context: Context, data: Path, strings: Mapping[str, Case]) -> tuple[dict[str, pd.DataFrame], list[Check]]:
    """The fits repeated: values, difference from the frozen ones, and the torques of split B without their days."""
    values, off, again = [], {}, {}
    for name, model in context.progress([(name, model) for name in SPLITS for model in ROUTES], "pairs and days"):
        again[name, model] = one = fit_of(data, strings, name, model)
        values.append(one.table.assign(split=name, model=model))
        off[f"{name}, {model}"] = furthest(one, read_posterior(frozen_file(name, model)))
    left = again["B", STIFF].leave_one_out[["id", "load", "low", "high", "predicted", "low95", "high95", "off"]]
    torque = left[left["load"] == "torque"]
    beyond = (torque["predicted"] - torque["high"]).clip(lower=0) + (torque["low"] - torque["predicted"]).clip(lower=0)
    distance = 100 * beyond / (0.5 * (torque["low"] + torque["high"]))
    tables = {"day_values": pd.concat(values, ignore_index=True), "days_left_out": left}
    return tables, [
        Check("second round, split B, off-bottom torque without its day, largest distance", float(distance.max()), 10,
              "at_most", "%", "§6.2, §7: within 10 % of the measured"),
        Check("second round, frozen values against the fit repeated, largest difference", max(off.values()), 0.1,
              "at_most", "standard deviations", "a target of this project"),
    ]  # fmt: skip


def write_for_others(found: Calibration, file: Path = FOR_OTHERS) -> None:
    """What the well says of other wells, as a setup: log-normal friction factors, and scatter between days.

    A factor of another well has the median of this one, the spread among wells and its own uncertainty.
    """
    assert found.scattered is not None
    lines = [
        "# What well 15/9-F-4, all rows of it, says of others; `python -m validation.parts.volve_f4_days all`",
        "# writes it.  Friction factors have the spread among wells of handbooks and their own uncertainty added in",
        "# squares; the scatter between days is that of this well.",
    ]
    table = found.table.set_index("name")
    for name, row in table.iterrows():
        if str(name).startswith("friction."):
            own = np.log(row["high"] / row["low"]) / 3.92
            variance = AMONG_WELLS**2 + own**2
            mean = row["value"] * np.exp(0.5 * variance)
            lines += ["", f'[unknowns."{name}"]  # {row["value"]:.3f} ({row["low"]:.3f} to {row["high"]:.3f}) here',
                      f"prior = {{ mean = {mean:.4g}, sd = {mean * np.sqrt(np.expm1(variance)):.4g} }}"]  # fmt: skip
    friction, weight = table.loc["scatter.friction"], table.loc["scatter.hookload"]
    lines += [
        "", "[scatter]",
        f"friction = {friction['value']:.4g}  # {friction['low']:.3f} to {friction['high']:.3f} here",
        f'hookload = "{weight["value"] / 1e3:.4g} kN"  # {weight["low"] / 1e3:.1f} to {weight["high"] / 1e3:.1f} here',
    ]  # fmt: skip
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    folder = data_folder()
    assert folder is not None, "the public data folder is missing"
    own = cases(folder)
    for stage in sys.argv[1:]:
        if stage == "all":
            fitted_all = fit_of_all(folder, own)
            print(fitted_all.table.to_string())
            write_for_others(fitted_all)
        else:
            for kind in ROUTES:
                calibrated = fit_of(folder, own, stage, kind)
                print(stage, kind, calibrated.table.to_string(), sep="\n", flush=True)
                freeze(calibrated, frozen_file(stage, kind))
