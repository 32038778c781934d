"""Weights and torque of geothermal well 16A(78)-32 of Utah FORGE: fitted on twelve reports, predicted on four others.

Split, rules, cases and priors (`validation/parts/forge_16a.py`), the frozen values and the first prediction were
committed in this order.  A short run predicts from the frozen values; a full one also fits again.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import pandas as pd

from fctd.calibration.forward import Forward
from fctd.calibration.gradient import in_pieces
from fctd.calibration.predict import Posterior
from fctd.calibration.rows import Row
from fctd.case.load import Case
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows, time_check
from validation.parts import forge_16a as split
from validation.parts.day_fits import carried_on
from validation.parts.forge_16a_fits import (
    ALONE,
    LINEAR,
    MODELS,
    Frozen,
    chosen,
    fit,
    fits_of,
    freeze,
    posterior_of,
    read_frozen,
)  # fmt: skip
from validation.parts.forge_16a_rounds import changes, second_round
from validation.parts.forge_16a_rows import pumps, report_rows
from validation.parts.forge_16a_strings import POUND_FORCE, Assembly, assemblies, cases, contradictions
from validation.parts.judged_well import CAPTIONS, ONE_FACTOR, SOFT, STIFF, checks_of, judged_tables, which_is_better
from validation.parts.judging import forecast, judge, readings_of
from validation.parts.scatter_fit import fit_times

WELL = "FORGE 16A(78)-32"
APART = f"{WELL}, 8,466 and 9,961 ft"
GROUPS = {WELL: split.JUDGED, APART: split.APART}
# Of the rotating weights [klbf], and of the torque [%].
RESIDUAL, PAPER = 12.0, 10.0
ROTATING = "weight rotating"
# A fit of twelve rows of two assemblies, and with intervals and left-out days [s].
TIMED = ("6507", "6724", "7990", "8391")
FIT_TIME, ALL_TIME = 10.0, 120.0


@dataclass(frozen=True)
class Well:
    """The assemblies, strings and judged rows of the well, and the fits on record."""

    data: Path
    assemblies: Mapping[str, Assembly]
    strings: Mapping[str, Case]
    fits: Mapping[str, Frozen]

    def knows(self, name: str, keys: Sequence[str]) -> tuple[Posterior, Forward]:
        """What a model on record says of rows."""
        model = MODELS[name]
        posterior = posterior_of(self.fits[name], self.strings, self.assemblies, keys, model)
        names = [unknown.name for unknown in posterior.unknowns]
        strings = {key: in_pieces(self.strings[key], names) for key in keys}
        return posterior, model.route(self.rows(keys), strings, posterior.unknowns, posterior.setup)

    def rows(self, keys: Sequence[str]) -> list[Row]:
        """The rows of these depths."""
        return report_rows(self.data, self.strings, keys)


def run(context: Context) -> Outcome:
    """Split, contradictions, parameters, judged rows of three models; in full also the fits again."""
    assert context.data is not None  # the runner has checked that the data are there
    found = assemblies(context.data)
    well = Well(context.data, found, cases(context.data, found), read_frozen())
    picked = {model: chosen(well.fits, model) for model in (STIFF, SOFT, ONE_FACTOR)}
    judged = {name: judged_group(well, picked, name, keys) for name, keys in GROUPS.items()}
    both = {key: pd.concat([tables[key] for tables in judged.values()], ignore_index=True) for key in CAPTIONS}
    tables = {
        "splits": splits(),
        "contradictions": contradictions(found),
        "pumps": pumps(context.data),
        "parameters": pd.concat([parameters(name, one) for name, one in well.fits.items()], ignore_index=True),
        "scatter": scatter(well.fits),
        "forms": forms(well.fits),
        **both,
        "rotating": rotating(both["judged"], predicted(well, picked[STIFF], split.FIT)),
        "other_form": predicted(well, other_form(picked[STIFF]), (*split.JUDGED, *split.APART)),
    }
    checks = [*checks_of(judged[WELL]), *checks_of(judged[APART], "apart, "), *own_checks(tables)]
    if not context.quick:
        more, found_checks = again(context, well, picked[STIFF])
        tables |= more
        named = context.progress(changes(), "second round")
        tables["second_round"] = second_round(context.data, well.strings, found, named)
        checks += found_checks
    return Outcome(
        tables=tables,
        checks=checks,
        notes=notes(judged, tables["forms"], well.fits, picked),
        display={name: caption for name, caption in SHOWN.items() if name in tables},
    )


SHOWN = {
    "splits": "Which rows fit and which judge",
    "contradictions": "Assemblies as they are printed and as they are taken, and what contradicts itself",
    "pumps": "Recorded with and without pumps, not fitted",
    "parameters": "Frozen values with their standard deviations [SI]",
    "scatter": "Scatter from day to day: median and 95 % interval [SI]",
    "forms": "Log density of left-out days, friction of the open hole constant or linear in depth",
    **CAPTIONS,
    "rotating": "Rotating weights: band and residual",
    "repeated": "The fits repeated, against the frozen values",
    "left_out": "The rows that fit, each predicted without its day (N, N m)",
    "second_round": "Second round, thought of after the look: one change each, none of which is judged",
    "other_form": "The same rows by the form of friction over depth that was not chosen",
}


@table_of_rows
def splits() -> Rows:
    """A row for each use."""
    uses = {"fits": split.FIT, "fits the tare alone": split.TARE, "judged": split.JUDGED, "judged apart": split.APART}
    for use, keys in {**uses, "recorded, never fitted": (split.PUMPS,)}.items():
        yield {"use": use, "bit_md_ft": ", ".join(keys)}


@table_of_rows
def parameters(model: str, fitted: Frozen) -> Rows:
    """The unknowns of a model [SI]."""
    for name, (value, sd) in fitted.best.items():
        yield {"model": model, "unknown": name, "value": value, "sd": sd}


@table_of_rows
def scatter(fits: Mapping[str, Frozen]) -> Rows:
    """The standard deviations between days of each model [SI]."""
    for model, one in fits.items():
        for name, (median, low, high) in one.deviations.items():
            yield {"model": model, "deviation": name, "median": median, "low_95": low, "high_95": high}


@table_of_rows
def forms(fits: Mapping[str, Frozen]) -> Rows:
    """Both forms of friction over depth of each model, and which is taken."""
    for model in (STIFF, SOFT, ONE_FACTOR):
        constant, linear = fits[model].score, fits[f"{model}, {LINEAR}"].score
        yield {"model": model, "constant": constant, "linear_in_depth": linear, "taken": chosen(fits, model)}


def other_form(name: str) -> str:
    """The model with the other form of friction over depth."""
    return name.removesuffix(f", {LINEAR}") if name.endswith(LINEAR) else f"{name}, {LINEAR}"


def judged_group(well: Well, picked: Mapping[str, str], name: str, keys: Sequence[str]) -> dict[str, pd.DataFrame]:
    """The tables of rows that are judged together; a forecast beside them is the last reading that fitted."""
    models = {model: well.knows(one, keys) for model, one in picked.items()}
    fitted = well.knows(picked[STIFF], split.FIT)[1]
    return judged_tables(name, models, carried_on(fitted, models[STIFF][1], lambda row: row.day))


def predicted(well: Well, name: str, keys: Sequence[str]) -> pd.DataFrame:
    """The readings of rows with bands and scores, by a stiff string on record."""
    posterior, forward = well.knows(name, keys)
    return judge(WELL, STIFF, forecast(posterior, forward, readings_of(forward)))


@table_of_rows
def rotating(judged: pd.DataFrame, fitted: pd.DataFrame) -> Rows:
    """Rotating weights of the stiff string [klbf]: reading, band, and prediction less reading.

    Those that fit are predicted as on a day that was not seen, with the masses that were known before.
    """
    klbf = POUND_FORCE  # kN
    for use, table in (("", judged), ("fits", fitted)):
        for one in table.query("model == @STIFF and quantity == @ROTATING").to_dict("records"):
            middle = 0.5 * (one["measured_low"] + one["measured_high"])
            yield {
                "use": use or ("judged" if one["well"] == WELL else "judged apart"), "bit_md_ft": one["row"],
                "reading_klbf": middle / klbf, "median_klbf": one["median"] / klbf, "low_95_klbf": one["low_95"] / klbf,
                "high_95_klbf": one["high_95"] / klbf, "in_95": one["in_95"],
                "residual_klbf": (one["median"] - middle) / klbf,
            }  # fmt: skip


def own_checks(tables: Mapping[str, pd.DataFrame]) -> list[Check]:
    """The rotating weights, and the paper's torque."""
    weights = tables["rotating"]
    without = weights[(weights["use"] != "fits") & (weights["bit_md_ft"] != "9961")]
    found = [
        Check("judged rotating weights without 9,961 ft, median absolute residual",
              float(without["residual_klbf"].abs().median()), RESIDUAL, "at_most", "klbf", "a target of this project"),
    ]  # fmt: skip
    for model in (STIFF, SOFT):
        torques = tables["judged"].query("well == @WELL and model == @model and quantity == 'torque'")
        found.append(
            Check(f"torque against measured, largest distance, {model}", float(torques["distance_percent"].max()),
                  PAPER, "at_most", "%", "§6.2, §7: within 10 % of the measured")
        )  # fmt: skip
    return found


def again(context: Context, well: Well, judged: str) -> tuple[dict[str, pd.DataFrame], list[Check]]:
    """Every fit again, the rows that fit without their day by the judged model, and the time of two assemblies."""
    rows, left_out = [], pd.DataFrame()
    for name in context.progress([ALONE, *MODELS], "fits"):
        fitted = fits_of(well.data, [name])[name]
        if name == judged:
            left_out = fitted.leave_one_out[["id", "load", "low", "high", "predicted", "low95", "high95"]]
        found = freeze(fitted)
        off = {key: abs(found.best[key][0] - value) / sd for key, (value, sd) in well.fits[name].best.items()}
        furthest = max(off, key=lambda key: off[key])
        rows.append({"model": name, "unknown": furthest, "difference_sd": off[furthest]})
    table = pd.DataFrame(rows)
    first, both = two_assemblies(well)
    return {"repeated": table, "left_out": left_out}, [
        Check("frozen values against the fit repeated, largest difference", float(table["difference_sd"].max()), 0.1,
              "at_most", "standard deviations", "the digits of the file, and the last digits of another machine"),
        time_check("processor time of a fit of twelve rows with two assemblies", first, FIT_TIME, "s",
                   "a target of this project"),
        time_check("the same with intervals and every day left out", both, ALL_TIME, "s", "a target of this project"),
    ]  # fmt: skip


def two_assemblies(well: Well) -> tuple[list[float], list[float]]:
    """Processor times [s] of a fit of twelve rows of two assemblies, and with intervals and left-out days.

    The strings of the curve (6,507 and 6,724 ft) and of the tangent (7,990 and 8,391 ft) are taken as one each.
    """
    of = {"6507": "6507", "6724": "6507", "7990": "8391", "8391": "8391"}
    rows = [replace(row, string=of[row.string]) for row in well.rows(TIMED)]
    return fit_times(lambda: fit(well.strings, rows, well.assemblies, MODELS[STIFF]))


def notes(
    judged: Mapping[str, Mapping[str, pd.DataFrame]], shapes: pd.DataFrame, fits: Mapping[str, Frozen],
    picked: Mapping[str, str],
) -> list[str]:  # fmt: skip
    """What the numbers say, with those of this run."""
    klbf = 1e3 * POUND_FORCE

    def of(model: str, name: str, unit: float = 1.0, digits: int = 2) -> str:
        value, sd = fits[model].best[name]
        return f"{value / unit:.{digits}f} ± {sd / unit:.{digits}f}"

    stiff = picked[STIFF]
    wide = judged[WELL]["widths"].query("model == @STIFF")
    alone = fits[ALONE].deviations["scatter.hookload"]
    rows = shapes.set_index("model").loc[STIFF]
    found = [
        "Retrospective: others have looked at this well. The readings of the judged rows were read after the fit was "
        "committed; of 9,961 ft it was known that its rotating weight lies below its neighbours.",
        f"Tare (block, hook and drive) of all rows: {of(stiff, 'rig.block_weight', klbf, 1)} klbf. Of the rotating "
        f"weights at 5,042 to 6,016 ft alone {of(ALONE, 'rig.block_weight', klbf, 1)} klbf, which scatter from day to "
        f"day by {alone[0] / klbf:.1f} klbf ({alone[1] / klbf:.1f} to {alone[2] / klbf:.1f}).",
        "Friction of the stiff string, along and around the hole: "
        + "; ".join(
            f"{kind} {of(stiff, f'friction.{kind}.axial')} and {of(stiff, f'friction.{kind}.rotational')}"
            for kind in ("cased", "open")
        )
        + f". Log density of left-out days: {rows['constant']:.1f} constant, {rows['linear_in_depth']:.1f} linear in "
        f"depth.",
        *(f"{name}: {which_is_better(tables)}" for name, tables in judged.items()),
        "Whether a torque was read on or off the bottom is unknown: a half of the torque of a bit, 3 ± 2 kN m, is part "
        "of its prediction, and its scatter part of the band.",
        "Bands are wide: pick-up minus slack-off has a 95 % band of "
        f"{wide['width'].median():.1f} times its reading, which the scatter of friction between days forces "
        "by itself. Nearly vertical rows, whose drag differs tenfold from day to day, make it large: the rows below "
        "them alone give 0.2 in place of 0.36 (second round).",
        "At 9,961 ft (grade B) the rotating weight lies 49 klbf below its prediction and 70 below the middle of "
        "pick-up and slack-off of the same report: it is misread, or its string is not the listed one. Were the twelve "
        "stands that its list lacks drill pipe, it would hang 27 klbf less.",
        "Rotation is not recorded, and pumps are for one depth alone: there, pumps change both weights by 15 to 20 "
        "klbf, more than the lift of pressure, so that a part of the scatter between days may be theirs.",
        "Data: Utah FORGE, US DOE Geothermal Data Repository, submission 1283, CC BY 4.0.",
    ]  # fmt: skip
    return found


STUDY = Study(
    "forge_16a",
    "Do twelve reports of a geothermal well predict weights and torque of four later ones?",
    run,
    needs=("data",),
    timed=True,
)
