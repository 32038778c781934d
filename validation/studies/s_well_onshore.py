"""Weights of an onshore S-well: fitted at its six shallowest depths, predicted at the seven deeper ones.

Split, rules, priors and models (`validation/parts/s_well.py`), the frozen values and the first prediction were
committed in this order.  The well has no torque.  A short run predicts from the frozen values; a full one
also fits again.
"""

import pandas as pd

from fctd.calibration.forward import Forward
from fctd.calibration.predict import read_posterior
from validation.harness.study import Check, Context, Outcome, Study
from validation.parts import s_well
from validation.parts.day_fits import carried_on, furthest
from validation.parts.judged_well import CAPTIONS, STIFF, checks_of, which_is_better


def run(context: Context) -> Outcome:
    """The judged weights by stiff and soft string and by one factor; in full also the fits."""
    assert context.data is not None  # the runner has checked that the data are there
    case = s_well.case_of(context.data)
    tables = s_well.tables_of(context.data, case)
    checks = checks_of(tables)
    display = dict(CAPTIONS)
    if not context.quick:
        again = {model: s_well.fit_of(context.data, case, model) for model in context.progress(s_well.ROUTES, "fits")}
        off = {model: furthest(one, read_posterior(s_well.frozen_file(model))) for model, one in again.items()}
        tables["parameters"] = pd.concat([one.table.assign(model=model) for model, one in again.items()])
        tables["left_out"] = again[STIFF].leave_one_out[["id", "low", "high", "predicted", "low95", "high95"]]
        display |= {
            "parameters": "Fitted values with 95 % intervals (SI)",
            "left_out": "The fitted rows, each predicted without its day (N)",
        }
        checks.append(
            Check("frozen values against the fit repeated, largest difference", max(off.values()), 0.1, "at_most",
                  "standard deviations", "a target of this project")
        )  # fmt: skip
    return Outcome(tables, checks, notes(context, tables), display)


def notes(context: Context, tables: dict[str, pd.DataFrame]) -> list[str]:
    """What the well can say, with the numbers of this run."""
    assert context.data is not None
    case, first = s_well.case_of(context.data), read_posterior(s_well.frozen_file(STIFF))
    known, judged = (
        Forward(s_well.measured_rows(context.data, case, depths), {"": case}, first.unknowns, first.setup)
        for depths in ((*s_well.FIT, *s_well.JUDGED), s_well.JUDGED)
    )
    before = carried_on(known, judged, lambda row: row.bit_depth)
    rows = tables["judged"].query("model == @STIFF")
    out = rows[~rows["in_95"]]
    missed = [
        f"{row} {quantity} ({error:+.0f} kN predicted less read)"
        for row, quantity, error in zip(out["row"], out["quantity"], out["error"], strict=True)
    ]
    middle = 0.5 * (rows["measured_low"] + rows["measured_high"])
    keys = zip(rows["row"], rows["quantity"], strict=True)
    off = [abs(before[key] - value) for key, value in zip(keys, middle, strict=True)]
    return [
        which_is_better(tables),
        f"{len(out)} of {len(rows)} readings lie outside their band: {', '.join(missed)}. The rotating weight rises "
        "by 13 and 18 kN to 4001 and 4317 ft, where the added pipe weighs 30 and 25 kN in mud, and by 58 to 5009 ft, "
        "where it weighs 30; pick-up and slack-off do not follow it. That points to what was read while the string "
        "turned, such as with the bit on bottom, and not to its mass; nothing recorded tells. Nothing was changed "
        "after this look.",
        f"The readings of the depth before, which the forecasts do not use, are {sum(off) / len(off):.2f} kN off.",
        "The well has no torque, so that its pair of factors is one factor; what one factor says is one number for "
        "casing and hole.",
        "The source prints 1267 lb/ft for the collars, which is not physical; 147 is of their diameters and was used.",
        "Its readings have no date: each depth is taken as a day. That they were measured is the author's word. "
        "Survey, string and weights: DonRio106/TnD_model_test, MIT.",
    ]  # fmt: skip


STUDY = Study(
    "s_well_onshore",
    "Do six shallow depths of a public S-well predict the weights of the seven deeper ones?",
    run,
    needs=("data",),
)
