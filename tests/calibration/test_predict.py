"""Predictions: bands in closed form, scores, and the posterior's file."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fctd.calibration.calibrate import calibrate, predict
from fctd.calibration.predict import Posterior, coverage, crps, posterior_file, predict_rows, read_posterior
from fctd.calibration.rows import Range
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import find_unknowns, parse_fits
from fctd.case.errors import InputError
from tests.calibration.wells import TRUTH, blank_rows, exact_rows, measured_rows, well

CASE = well()
SETUP = Setup.model_validate({"model_error": {"hookload": 20e3}})


def posterior(spread: float = 0.0) -> Posterior:
    unknowns = tuple(find_unknowns(parse_fits(["rig.block_weight"]), Setup(), [CASE]))
    return Posterior(unknowns, np.array([230e3]), np.array([[5e3**2]]), SETUP, {"": {"hookload": spread}})


def test_bands_add_up_unknowns_noise_ranges_and_model() -> None:
    """Normal with the variances of 5, 10 and 20 kN, and of a uniform distribution."""
    from scipy.stats import norm

    for spread in (0.0, 5e3):
        table = predict_rows(posterior(spread), [exact_rows()[-2]], {"": CASE}, samples=100_000)
        sd = np.sqrt(5**2 + 10**2 + 20**2 + (spread / 1e3) ** 2) * 1e3
        (row,) = table.to_dict("records")
        for name, share in (("low95", 0.025), ("low50", 0.25), ("middle", 0.5), ("high50", 0.75), ("high95", 0.975)):
            assert row[name] == pytest.approx(230e3 + sd * norm.ppf(share), abs=0.03 * sd)
        assert (row["predicted"], row["unit"], row["load"]) == (pytest.approx(230e3), "N", "hookload")


def test_measured_rows_are_scored() -> None:
    rows = [replace(exact_rows()[-2], id=str(w), hookload=Range(w - 1e3, w + 1e3)) for w in (232e3, 260e3, 330e3)]
    table = predict_rows(posterior(), [*rows, replace(exact_rows()[-2], hookload=None)], {"": CASE})
    assert table["inside50"].tolist() == [True, False, False, None]
    assert table["inside95"].tolist() == [True, True, False, None]
    assert coverage(table) == {"inside50": (1, 3), "inside95": (2, 3)}
    assert table["distance"].to_numpy()[:3] == pytest.approx([1e3 / 232e3, 29e3 / 260e3, 99e3 / 330e3])
    assert np.isnan(table["crps"].iloc[3])


def test_the_score_of_a_normal_sample_in_closed_form() -> None:
    """Of a normal distribution: σ (z (2Φ(z) − 1) + 2φ(z) − 1/√π) (Gneiting & Raftery 2007)."""
    from scipy.stats import norm

    sample = norm.ppf((np.arange(20_000) + 0.5) / 20_000, 3.0, 2.0)
    for z in (0.0, 1.5):
        expected = 2.0 * (z * (2 * norm.cdf(z) - 1) + 2 * norm.pdf(z) - 1 / np.sqrt(np.pi))
        assert crps(sample, 3.0 + 2.0 * z) == pytest.approx(expected, rel=1e-3)


def test_a_posterior_is_written_and_read(tmp_path: Path) -> None:
    path = posterior_file(tmp_path / "well.toml")
    assert path.name == "well.fit.json"
    posterior(3e3).write(path)
    found = read_posterior(path)
    assert (found.best, found.covariance, found.setup) == (posterior().best, posterior().covariance, SETUP)
    assert found.spread == {"": {"hookload": 3e3}}
    first, again = (predict(CASE, [exact_rows()[-2]], each) for each in (path, found))
    assert first.equals(again)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (None, "fctd calibrate --out writes"),
        ("{", "a posterior as fctd calibrate"),
        ("{}", "unknowns is missing"),
        ("[" * 100_000, "a posterior as fctd calibrate"),
    ],
)
def test_a_posterior_that_cannot_be_used(text: str | None, expected: str, tmp_path: Path) -> None:
    if text is not None:
        (tmp_path / "a.fit.json").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=expected):
        read_posterior(tmp_path / "a.fit.json")
    with pytest.raises(InputError, match="not from a file"):
        predict(CASE, [exact_rows()[-2]])


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("unknowns", [], "unknowns = \\[\\]: expected at least one unknown"),
        ("covariance", [[float("nan")]], "covariance\\[0\\]\\[0\\] = nan"),
        ("covariance", [[-1.0]], "no variance below 0"),
        ("covariance", [[1.0, 0.0]], "1 rows of 1 numbers"),
        ("spread", [1], "spread"),
        ("spread", {"": {"hookload": "wide"}}, "hookload"),
        ("spread", {"": {"hookload": -1.0}}, "hookload"),
        ("setup", {"sources": {"x": {"hookload_noise": "wide"}}}, "setup.sources.x.hookload_noise"),
    ],
)
def test_a_posterior_with_a_value_that_no_calibration_writes(
    key: str, value: object, expected: str, tmp_path: Path
) -> None:
    path = tmp_path / "a.fit.json"
    posterior().write(path)
    path.write_text(json.dumps(json.loads(path.read_text(encoding="utf-8")) | {key: value}), encoding="utf-8")
    with pytest.raises(InputError, match=f"a.fit.json: .*{expected}"):
        read_posterior(path)


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("name", 5, r"unknowns\[0\].name = 5"),
        ("value", None, r"unknowns\[0\].value"),
        ("value", float("inf"), r"unknowns\[0\].value = inf"),
        ("name", "friction[7]", r"unknowns = \"friction\[7\]\": expected friction of intervals that the case has"),
    ],
)
def test_an_unknown_that_no_calibration_writes(key: str, value: object, expected: str, tmp_path: Path) -> None:
    path = tmp_path / "a.fit.json"
    posterior().write(path)
    kept = json.loads(path.read_text(encoding="utf-8"))
    kept["unknowns"][0][key] = value
    path.write_text(json.dumps(kept), encoding="utf-8")
    with pytest.raises(InputError, match=f"a.fit.json: .*{expected}"):
        predict(CASE, [exact_rows()[-2]], path)


def test_values_drawn_have_the_mean_and_deviation_and_keep_to_the_bounds() -> None:
    """Within three of their standard errors, σ/√n and σ/√2n."""
    count = 100_000
    drawn = posterior().sample(count, 0)
    assert drawn.shape == (count, 1)
    assert drawn.mean() == pytest.approx(230e3, abs=3 * 5e3 / np.sqrt(count))
    assert drawn.std() == pytest.approx(5e3, rel=3 / np.sqrt(2 * count))
    unknown = replace(posterior().unknowns[0], low=229e3)
    assert replace(posterior(), unknowns=(unknown,)).sample(1000, 0).min() == 229e3


def test_the_first_section_is_fitted_and_the_deeper_one_predicted() -> None:
    rows = measured_rows(CASE, TRUTH, blank_rows(CASE))
    rows = [rows[2], rows[5], rows[9]]  # turning in the casing and below it, and in slips
    found = calibrate(CASE, rows, ["rig.block_weight"], order="first-section", starts=1)
    assert list(found.left_out.values()) == ["of a deeper hole section: predicted"]
    assert found.predicted is not None
    assert found.predicted["id"].tolist() == ["rotate 1100", "rotate 1100"]
    with pytest.raises(InputError, match="first-section"):
        calibrate(CASE, rows, ["rig.block_weight"], order="first")  # type: ignore[arg-type]
