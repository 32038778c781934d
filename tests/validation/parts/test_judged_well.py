"""The checks of a judged well, and which model has the better score."""

import pandas as pd

from validation.parts.judged_well import MODELS, checks_of, which_is_better


def tables(crps: list[float], few: float = 0.5, many: float = 0.7) -> dict[str, pd.DataFrame]:
    """Scores of weights by model, and widths of which the median is 1.25 times that of the scatter."""
    scores = pd.DataFrame(
        {
            "model": MODELS, "unit": "kN", "crps": crps, "crps_carried_on": 10.0,
            "probability_of_as_few_outside": few, "probability_of_as_many_outside": many,
        }
    )  # fmt: skip
    widths = pd.DataFrame({"model": [MODELS[0]] * 3, "width": [0.4, 0.5, 9.0], "scatter_width": [0.3, 0.4, 0.5]})
    return {"judged": pd.DataFrame(), "scores": scores, "widths": widths}


def test_the_stiff_string_is_checked_against_the_simpler_forecasts() -> None:
    found = {check.name: check for check in checks_of(tables([4.0, 3.0, 5.0], many=0.004), "split B, ")}
    assert {name: check.verdict for name, check in found.items()} == {
        "split B, weights: probability of so many outside their 95 % band, the rarer side": "missed",
        "split B, weights: CRPS over that of one friction factor": "met",
        "split B, weights: CRPS over that of the last reading carried on": "met",
        "split B, pick-up minus slack-off: median 95 % width over that of the scatter between days": "met",
    }
    assert found["split B, weights: CRPS over that of one friction factor"].value == 0.8


def test_a_soft_string_that_is_better_is_named() -> None:
    assert "of the two strings the soft one is better" in which_is_better(tables([4.0, 3.0, 5.0]))
    assert "of the two strings the stiff one is better" in which_is_better(tables([2.0, 3.0, 5.0]))
