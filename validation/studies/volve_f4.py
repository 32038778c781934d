"""Off-bottom torque and weights of well 15/9-F-4 of the Volve field: fitted on some rows, predicted on others.

Split, cases, priors and rules of judging (`validation/parts/volve_f4.py`), the frozen values and the first prediction
were committed in this order.  A short run predicts from the frozen values; a full one also fits again, fits the soft
string the same way, and makes the second round, which is not a prediction: it was thought of after the look.  Models
with pairs of friction factors and scatter between days belong to that round; a short run judges their frozen values.
"""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pandas as pd

from fctd import torque_drag
from fctd.calibration.forward import Forward
from fctd.calibration.result import Calibration
from fctd.calibration.rows import Row
from fctd.calibration.unknowns import with_values
from fctd.case.load import Case
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows
from validation.parts import volve_f4 as split
from validation.parts import volve_f4_days as days
from validation.parts.judged_well import CAPTIONS, STIFF, which_is_better
from validation.parts.judged_well import checks_of as checks_of_days
from validation.parts.volve_f4_fits import Frozen, fit_of_b, fit_of_rig, fits_of_a, freeze, frozen, setup_of, setup_of_b
from validation.parts.volve_f4_judging import predict
from validation.parts.volve_f4_laws import spreads
from validation.parts.volve_f4_rounds import second_round
from validation.parts.volve_f4_rows import cases, report_rows, series_rows
from validation.parts.volve_f4_soft import SoftForward

# Correlations of this size and more are listed.
STRONG = 0.9
# Curves: model, depths [m] and rotation [rev/min] of the string of the first section and of the wiper string.
CURVES = {
    split.SERIES_STRING: ("rig", range(1300, 1601, 100), 130.0),
    "volve_f4_wiper": ("B", range(1600, 2751, 230), 20.0),
}


def run(context: Context) -> Outcome:
    """Splits, parameters, predictions of A and B, curves; in full also soft string, refits and the second round."""
    assert context.data is not None  # the runner has checked that the data are there
    data, strings, fits = context.data, cases(context.data), frozen()
    tables = {
        "splits": splits(),
        "parameters": pd.concat([parameters(name, one) for name, one in fits.items()], ignore_index=True),
        "correlations": pd.concat([correlations(name, one) for name, one in fits.items()], ignore_index=True),
        "rows": judge(data, strings, fits),
        "curves": curves(strings, fits),
        "points": points([*series_rows(data, strings), *report_rows(data, strings, tuple(split.STRINGS))]),
    }
    checks = checks_of(tables["rows"], "stiff string")
    judged = days.tables_of(data, strings)
    checks += [check for name in days.SPLITS for check in days_checks(judged, name)]
    tables |= judged
    tables["rows"] = pd.concat([tables["rows"], second_rows(judged["judged"])], ignore_index=True)
    if not context.quick:
        more, found = full(context, data, strings, fits)
        tables |= more
        checks += found
    return Outcome(
        tables=tables,
        checks=checks,
        notes=notes(tables, fits),
        display={
            "splits": "Which rows fit and which judge", "parameters": "Frozen values with 95 % intervals (Hessian)",
            "correlations": f"Correlations of {STRONG:g} and more", "rows": "Measured range and predicted bands",
        }
        | CAPTIONS
        | ({} if context.quick else {name: caption for name, caption in FULL.items() if name in tables}),
    )  # fmt: skip


FULL = {
    "intervals": "Model B fitted again: 95 % intervals by profile likelihood where the Hessian misleads",
    "left_out": "Model B without each of its rows, and its prediction of that row (N, N m)",
    "soft_parameters": "The soft string calibrated the same way",
    "soft_rows": "Measured range and predicted bands, soft string",
    "day_values": "Second round, pairs and days, fitted again (SI)",
    "days_left_out": "Second round, pairs and days, split B without each day, and its prediction of that day (N, N m)",
    "second_round": "Second round, thought of after the look: model B with one change each",
    "laws": "Pick-up minus slack-off of F4-13r, which turns, by two laws of friction at speeds that may be its own",
}


def splits() -> pd.DataFrame:
    """A row for each split and use."""
    uses = {
        ("A", "fits"): split.FIT_A, ("A", "judged"): split.JUDGED_A, ("B", "fits the rig"): split.FIT_RIG,
        ("B", "fits friction and masses"): split.FIT_B, ("B", "judged"): split.JUDGED_B,
    }  # fmt: skip
    return pd.DataFrame([{"split": a, "use": b, "rows": ", ".join(rows)} for (a, b), rows in uses.items()])


def parameters(model: str, fitted: Frozen) -> pd.DataFrame:
    """The unknowns of a model with the ends of their 95 % intervals [SI]."""
    sd = fitted.deviations
    return pd.DataFrame(
        [
            {"model": model, "unknown": name, "value": value, "low_95": value - 1.96 * sd[name],
             "high_95": value + 1.96 * sd[name]}
            for name, value in fitted.best.items()
        ]
    )  # fmt: skip


def correlations(model: str, fitted: Frozen) -> pd.DataFrame:
    """The pairs of a model whose correlation is strong."""
    names = list(fitted.best)
    pairs = [(one, other) for i, one in enumerate(names) for other in names[:i]]
    found = [(one, other, fitted.correlation(one, other)) for one, other in pairs]
    return pd.DataFrame(
        [(model, other, one, value) for one, other, value in found if abs(value) >= STRONG],
        columns=["model", "one", "other", "correlation"],
    )


def judge(
    data: Path, strings: Mapping[str, Case], fits: Mapping[str, Frozen], route: type[Forward] = Forward
) -> pd.DataFrame:
    """The judged rows of both splits."""
    found = []
    for model, fitted in fits.items():
        if model == "rig":
            continue
        ids = split.JUDGED_B if model == "B" else split.JUDGED_A
        setup = setup_of_b(fits["rig"]) if model == "B" else setup_of("first_section")
        absolute = split.ABSOLUTE if model == "B" else ()
        table = predict(strings, report_rows(data, strings, ids), setup, fitted, absolute, route)
        found.append(table.assign(model=model))
    return pd.concat(found, ignore_index=True)


def checks_of(rows: pd.DataFrame, string: str) -> list[Check]:
    """The numbers of the two splits."""
    torques, last = rows.query("model == 'A' and quantity == 'torque'"), rows.query("model == 'B'")
    spreads = last.query("quantity == 'half spread'")
    return [
        Check(f"off-bottom torque against measured, largest distance, model A, {string}",
              float(torques["distance_percent"].max()), 10, "at_most", "%", "§6.2, §7: within 10 % of the measured"),
        Check(f"half spreads of model B within their 95 % band, {string}", float(spreads["in_95"].mean()), 0.95,
              "at_least", "", "what the band claims"),
        Check(f"half spread of up and down weight, largest distance, model B, {string}",
              float(spreads["distance_percent"].max()), 10, "at_most", "%", "the paper's 10 % of torque"),
        Check(f"weights of F4-07 within their 95 % band, model B, {string}",
              float(last[last["quantity"].str.startswith("weight")]["in_95"].mean()), 0.95, "at_least", "",
              "what the band claims"),
    ]  # fmt: skip


def of_split(judged: Mapping[str, pd.DataFrame], name: str) -> dict[str, pd.DataFrame]:
    """The tables of one split of the models with pairs and days."""
    well = days.well_of(name)
    return {key: judged[key][judged[key]["well"] == well] for key in CAPTIONS}


def days_checks(judged: Mapping[str, pd.DataFrame], name: str) -> list[Check]:
    """The numbers of a split with pairs and days."""
    one, called = of_split(judged, name), f"second round, split {name}, "
    rows = one["judged"].query("model == @STIFF and quantity == 'torque'")
    found = checks_of_days(one, called)
    if len(rows):
        found.append(
            Check(f"{called}off-bottom torque against measured, largest distance",
                  float(rows["distance_percent"].max()), 10, "at_most", "%", "§6.2, §7: within 10 % of the measured")
        )  # fmt: skip
    return found


def second_rows(judged: pd.DataFrame) -> pd.DataFrame:
    """The stiff string's judged rows with pairs and days, as those of models A and B."""
    stiff = judged[judged["model"] == STIFF]
    model = stiff["well"].str[-1] + ", second round: pairs and days"
    return stiff.drop(columns=["well", "day", "error"]).assign(model=model)


def curves(strings: Mapping[str, Case], fits: Mapping[str, Frozen]) -> pd.DataFrame:
    """Readings of the rig over bit depth: the string of the first section, and the wiper string."""
    parts = []
    for name, (model, depths, rpm) in CURVES.items():
        values = {key: value for key, value in fits[model].best.items() if not key.startswith("bias.")}
        case = with_values(strings[name], values)
        strokes = torque_drag(case, ["trip_in", "trip_out"], [*depths])
        turning = torque_drag(case, "rotate_off_bottom", [*depths], rpm=rpm)
        parts += [chart.assign(string=name) for chart in (strokes, turning)]
    return pd.concat(parts, ignore_index=True)


@table_of_rows
def points(rows: Sequence[Row]) -> Rows:
    """The measured loads with a depth [kN, kN m]."""
    for row in rows:
        for load, of in (("hookload", row.hookload), ("torque", row.torque)):
            if of is not None and row.has_string:
                yield {
                    "row": row.id, "source": row.source, "operation": row.operation, "load": load,
                    "bit_depth_m": row.bit_depth, "rad_per_s": row.rates.spin,
                    "low": of.low / 1e3, "high": of.high / 1e3,
                }  # fmt: skip


def full(
    context: Context, data: Path, strings: Mapping[str, Case], fits: Mapping[str, Frozen]
) -> tuple[dict[str, pd.DataFrame], list[Check]]:
    """Refits, leave-one-out, the soft string, the second round."""
    stages: dict[str, Callable[[], dict[str, Calibration]]] = {
        "A": lambda: fits_of_a(data, strings),
        "rig": lambda: {"rig": fit_of_rig(data, strings)},
        "B": lambda: {"B": fit_of_b(data, strings, fits["rig"])},
    }
    again: dict[str, Calibration] = {}
    for name in context.progress(stages, "fits"):
        again |= stages[name]()
    off = {name: furthest(freeze(found), fits[name]) for name, found in again.items()}
    soft = {name: freeze(found) for name, found in fits_of_a(data, strings, SoftForward).items()}
    soft["rig"] = freeze(fit_of_rig(data, strings, SoftForward))
    soft["B"] = freeze(fit_of_b(data, strings, soft["rig"], SoftForward))
    soft_rows = judge(data, strings, soft, SoftForward)
    day_tables, day_checks = days.refitted(context, data, strings)
    left = again["B"].leave_one_out[["id", "load", "low", "high", "predicted", "off"]]
    torque = left[left["load"] == "torque"]
    beyond = (torque["predicted"] - torque["high"]).clip(lower=0) + (torque["low"] - torque["predicted"]).clip(lower=0)
    distance = 100 * beyond / (0.5 * (torque["low"] + torque["high"]))
    checks = [
        Check("off-bottom torque against measured, largest distance, model B without the row", float(distance.max()),
              10, "at_most", "%", "§6.2, §7: within 10 % of the measured"),
        Check("frozen values against the fit repeated, largest difference", max(off.values()), 1, "at_most",
              "standard deviations", "the loss of the tool grew from one standard deviation to three meanwhile"),
        *checks_of(soft_rows, "soft string"),
        *day_checks,
    ]  # fmt: skip
    tables = {
        "repeated": pd.DataFrame({"model": [*off], "difference_sd": [*off.values()]}),
        "intervals": again["B"].table,
        "left_out": left,
        "soft_parameters": pd.concat([parameters(name, one) for name, one in soft.items()], ignore_index=True),
        "soft_rows": soft_rows,
        "second_round": second_round(context, data, strings, fits["rig"]),
        "laws": spreads(data, strings),
        **day_tables,
    }
    return tables, checks


def furthest(again: Frozen, fitted: Frozen) -> float:
    """Largest difference of a repeated fit from the frozen one, in standard deviations of the frozen one."""
    return max(abs(again.best[key] - value) / fitted.deviations[key] for key, value in fitted.best.items())


def notes(tables: Mapping[str, pd.DataFrame], fits: Mapping[str, Frozen]) -> list[str]:
    """What the data can say, with the numbers of this run."""

    def value(model: str, name: str, unit: float = 1.0, digits: int = 2) -> str:
        one = fits[model]
        return f"{one.best[name] / unit:.{digits}f} ± {one.deviations[name] / unit:.{digits}f}"

    torques = tables["rows"].query("model == 'A' and quantity == 'torque'")
    pair = fits["A"].correlation("friction.cased", "rig.torque_offset")
    found = [
        "What the series says well (± one standard deviation): the block weighs "
        f"{value('rig', 'rig.block_weight', 1e3, 0)} kN in slips; rotating up against rotating down gives a sheave "
        f"efficiency of {value('rig', 'rig.sheave_efficiency', 1, 3)}; 60 against 130 rev/min give "
        f"{value('rig', 'rig.torque_per_rpm', 1, 0)} N m of torque a rev/min.",
        "What it does not say is cased friction: in all of its rows the same 1351 m of string lie in casing, so that "
        "friction there and the torque offset have nearly the same effect. Model A has a cased factor of "
        f"{value('A', 'friction.cased')} with a torque offset of {value('A', 'rig.torque_offset', 1e3, 1)} kN m, "
        f"correlation {pair:.2f}; 60 rev/min alone gives {value('A, 60 rpm alone', 'friction.cased')} and 130 rev/min "
        f"{value('A, 130 rpm alone', 'friction.cased')}. It predicts {torques['median'].min():.0f} to "
        f"{torques['median'].max():.0f} kN m where {torques['measured_low'].min():.0f} to "
        f"{torques['measured_high'].max():.0f} were recorded.",
        "No judged row of model B has a recorded torque with rotation, so B is judged on weights; its torque is tested "
        "by leaving a row out. No row judges open-hole friction: every bit of the 8 1/2 in section stood in casing.",
        f"The frozen mass of the wiper assembly, {fits['B'].best['mass.wiper assembly']:.0f} kg/m, is at its lower "
        "bound: the string as it is described is heavier than what hung on the hook.",
        "Not in the model, and not tried: the lift of running pumps (the reports record no pressure), drag of scraper "
        "springs, cuttings, friction that depends on the sliding speed.",
        "The frozen values are those of a loss that is linear beyond one standard deviation; the tool's is now linear "
        "beyond three, and a repeated fit differs (table repeated).",
        "The author of the split had seen the series and the torques of F4-06 and F4-10 before the first commit, and "
        "no weight of a daily report.",
        "Data: Volve data village, Equinor and partners: surveys, daily drilling reports, and a 4-second series by way "
        "of a public redistribution; non-commercial, share-alike, attribution.",
    ]
    found += [
        f"Second round with pairs and scatter between days, split {name}: {which_is_better(of_split(tables, name))}"
        for name in days.SPLITS
    ]
    if "second_round" in tables:
        by = tables["second_round"].set_index("change")["friction_cased"]
        found.insert(
            2, f"One friction factor does not fit both loads: torques alone give {by['torques alone']:.2f}, weights "
            f"alone {by['weights alone']:.2f} (second round).",
        )  # fmt: skip
    return found


STUDY = Study(
    "volve_f4",
    "Does a calibration on some measured rows of a public well predict the others?",
    run,
    needs=("data",),
)
