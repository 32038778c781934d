"""The tables and checks by which a well is judged, the same for each: stiff and soft string, and one friction factor.

Tables of a study: ``judged`` (a row for each model and quantity), ``scores`` (for each model and kind of load),
``widths`` (for each model and pick-up minus slack-off).  The page of three wells reads them.
"""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, Final

import pandas as pd

from fctd.calibration.forward import Forward
from fctd.calibration.predict import Posterior
from validation.harness.study import Check
from validation.parts.judging import LEVEL, Judged, forecast, judge, readings_of, summarise, widths

# The models that are calibrated on the same rows; the first is the one that is judged.
STIFF, SOFT, ONE_FACTOR = MODELS = ("stiff string", "soft string", "one factor")
CAPTIONS: Final = {
    "judged": "Every judged reading: recorded range, band, in or out",
    "scores": "Coverage of 95 % bands with its interval by resampling days, CRPS and bias",
    "widths": "95 % width of pick-up minus slack-off over the reading, beside what scatter between days alone forces",
}
KINDS: Final = {"kN": "weights", "kN m": "torques"}
WIDEST = 1.3  # times the width that scatter alone forces
TARGET: Final = "a target of this project"


def judged_tables(
    well: str,
    models: Mapping[str, tuple[Posterior, Forward]],
    carried: Mapping[tuple[str, str], float],
    quantities: Callable[[Forward], Iterable[Judged]] = readings_of,
) -> dict[str, pd.DataFrame]:
    """The three tables; models : posterior and forward model of the judged rows of each of ``MODELS``.

    carried : the last reading that fitted [kN, kN m], by id and quantity; quantities : which are judged.
    """
    judged, scores, wide = [], [], []
    for model, (posterior, forward) in models.items():
        found = forecast(posterior, forward, quantities(forward))
        judged.append(judge(well, model, found))
        scores.append(summarise(found, judged[-1], carried))
        wide.append(widths(posterior, forward).assign(well=well, model=model))
    parts = {"judged": judged, "scores": scores, "widths": wide}
    return {name: pd.concat(tables, ignore_index=True) for name, tables in parts.items()}


def checks_of(tables: Mapping[str, pd.DataFrame], called: str = "") -> list[Check]:
    """The numbers of the stiff string: count outside, width, and scores beside the simpler forecasts.

    called : what the names of the checks begin with, where a study has several.
    """
    scores: dict[tuple[str, str], dict[Any, Any]] = {
        (row["model"], row["unit"]): row for row in tables["scores"].to_dict("records")
    }
    wide = tables["widths"].query("model == @STIFF")
    found = []
    for unit, kind in KINDS.items():
        if (STIFF, unit) not in scores:
            continue
        one, plain = scores[STIFF, unit], scores[ONE_FACTOR, unit]
        least = min(one["probability_of_as_few_outside"], one["probability_of_as_many_outside"])
        name = f"{called}{kind}: "
        found += [
            Check(f"{name}probability of so many outside their 95 % band, the rarer side", float(least), LEVEL / 2,
                  "at_least", "", "two-sided 1 %, under the fitted correlation"),
            Check(f"{name}CRPS over that of one friction factor", float(one["crps"] / plain["crps"]), 1.0,
                  "at_most", "", TARGET),
        ]  # fmt: skip
        if pd.notna(one["crps_carried_on"]):
            found.append(
                Check(f"{name}CRPS over that of the last reading carried on",
                      float(one["crps"] / one["crps_carried_on"]), 1.0, "at_most", "", TARGET)
            )  # fmt: skip
    ratio, name = float(wide["width"].median() / wide["scatter_width"].median()), f"{called}pick-up minus slack-off: "
    found.append(
        Check(f"{name}median 95 % width over that of the scatter between days", ratio, WIDEST, "at_most", "", TARGET)
    )  # fmt: skip
    return found


def which_is_better(tables: Mapping[str, pd.DataFrame]) -> str:
    """A sentence on stiff and soft string, and on one factor, by CRPS."""
    crps = tables["scores"].set_index(["unit", "model"])["crps"]
    parts = []
    for unit, kind in KINDS.items():
        if unit not in crps.index.get_level_values("unit"):
            continue
        of = crps[unit]
        best = "stiff" if of[STIFF] < of[SOFT] else "soft"
        parts.append(
            f"{kind}: {of[STIFF]:.2f} {unit} of the stiff string, {of[SOFT]:.2f} of the soft string, calibrated the "
            f"same way, and {of[ONE_FACTOR]:.2f} of one factor; of the two strings the {best} one is better"
        )
    return f"CRPS of {'. Of '.join(parts)}."
