"""Do samples, percentiles, indices and survey errors of a sweep agree with closed forms?"""

import tempfile
import time
from pathlib import Path

import numpy as np
import pandas as pd

from fctd.model.section import section_of
from fctd.model.survey import along_courses, minimum_curvature
from fctd.steady.torque_drag import chart_rows
from fctd.sweep.chunk import as_table
from fctd.sweep.dataset import Dataset, begin_dataset
from fctd.sweep.design import sample_of, samples_of
from fctd.sweep.indices import indices_of
from fctd.sweep.run import prepare
from fctd.sweep.spec import SweepSpec
from fctd.sweep.survey_errors import SurveyErrors, erred
from fctd.sweep.uncertainty import assess
from validation.cases.wells import drilled_paper_well
from validation.harness.study import (
    Check,
    Context,
    Outcome,
    Rows,
    Study,
    in_columns,
    quartiles_of,
    ratio_check,
    table_of_rows,
)

# A straight inclined hole that hardly leaves room beside the pipe.  With a clearance c the tension T takes some
# T c / 8 m off the wall at the string's top, which is on the axis: 0.5 % of its load in 8.5 in of hole.
LENGTH, INCLINATION, TOP = 900.0, 60.0, 5.0  # [m], [deg], and what hangs on the top drive, half a segment [m]
CASE = """
name = "inclined"
[wellbore]
stations = [[0, 60, 0], [1000, 60, 0]]
intervals = [{to_md = "1000 m", diameter = "5.02 in", friction = 0.2}]
[string]
components = [{name = "pipe", outer_diameter = "5 in", inner_diameter = "4.276 in", segment_length = "10 m"}]
[mud]
density = "1200 kg/m^3"
"""
FRICTION = {"key": "friction", "distribution": "normal", "mean": 0.25, "sd": 0.04}
BLOCK = {"key": "rig.block_weight", "distribution": "normal", "mean": 300e3, "sd": 4e3}
PERCENTILES = (2.5, 97.5)
# Ishigami & Homma (1990) with a = 7, b = 0.1: first-order and total indices.
ISHIGAMI = {
    ("S1", "a"): 0.3139, ("S1", "b"): 0.4424, ("S1", "c"): 0.0, ("ST", "a"): 0.5576, ("ST", "b"): 0.4424,
    ("ST", "c"): 0.2437,
}  # fmt: skip
DEPTHS = 71  # of a timed chart
DEPTH, COURSE, SLANT, AZIMUTH, ERROR = 3000.0, 30.0, 0.9, 0.4, 0.004  # of a surveyed straight well [m], [rad]


def run(context: Context) -> Outcome:
    """The hook load of a straight inclined string, shares of a variance, and the spread of a straight well."""
    with tempfile.TemporaryDirectory(prefix="fctd-sweep-") as folder:
        hookload, load_checks = _hook_loads(Path(folder), 200 if context.quick else 2000)
        linear = _linear_indices(Path(folder), 256 if context.quick else 1024)
    indices = pd.concat([linear, _ishigami()], ignore_index=True)
    charts = pd.DataFrame([_chart(segments, 2 if context.quick else 15) for segments in (61, 500)])
    surveys = 2000 if context.quick else 8000
    spread = _spreads(surveys)
    checks = [
        *load_checks,
        Check("Sobol indices of a linear case, largest difference", _largest(indices, "weight indicator"), 0.02,
              "at_most", "", "closed form: shares of the variance"),
        Check("Sobol indices of Ishigami's function, largest difference", _largest(indices, "Ishigami"), 0.02,
              "at_most", "", "Ishigami & Homma 1990"),
        Check("rows of charts that differ from the same row solved alone, or on two threads",
              int(charts["different_rows"].sum()), 0, "at_most", "", "to the last bit"),
        *(
            ratio_check(f"processor time of a depth in a chart of {DEPTHS} depths, {row['segments']:.0f} segments",
                        quartiles_of(row, "depth_ms"), most, "at_most", "target", "ms")
            for (_, row), most in zip(charts.iterrows(), (0.3, 3.0), strict=True)
        ),
        *(
            ratio_check(f"two threads over one in a chart of {DEPTHS} depths, {row['segments']:.0f} segments",
                        quartiles_of(row, "two_threads_over_one"), 1.8, "at_least", "target; times on the wall")
            for _, row in charts.iterrows()
        ),
        Check("position spread of a straight well, largest difference",
              float(np.abs(spread["found_m"] / spread["closed_m"] - 1).max()), 0.03, "at_most", "",
              "closed form: half of the courses beside a station turn with it"),
    ]  # fmt: skip
    return Outcome(
        tables={"hook_load": hookload, "indices": indices, "spread": spread, "charts": charts},
        checks=checks,
        notes=[
            "The hook load is w L cos θ + μ w (L − 5 m) sin θ with normal μ; sampling errors are those of the mean and "
            "of the quantiles of a normal sample.",
            f"Survey: errors of {np.degrees(ERROR):.2f}° of inclination and azimuth at every station but the first, "
            f"{COURSE:g} m apart; the standard error of a spread is {1 / np.sqrt(2 * surveys):.1%}.",
        ],
        display={
            "hook_load": "Hook load of a straight inclined string with normal friction",
            "indices": "Sobol indices against closed forms",
            "spread": "Spread of the end of a straight well, across it",
            "charts": "Charts of tripping out of the paper's well",
        },
    )


def swept(folder: Path, raw: dict[str, object]) -> tuple[SweepSpec, Dataset]:
    """A sweep of the inclined string, computed in this process."""
    folder.mkdir()
    (folder / "inclined.toml").write_text(CASE, encoding="utf-8")
    work = {"operations": ["trip_out"], "depths": [LENGTH]}
    tells = {"percentiles": PERCENTILES, "columns": ["hookload_N", "weight_indicator_N"]}
    given = {"name": "inclined", "case": folder / "inclined.toml", "work": work, "uncertainty": tells}
    spec = SweepSpec.model_validate(given | raw)
    runner, samples = prepare(spec)
    dataset = begin_dataset(folder / "out", runner.template, samples)
    rows = [row for k in range(len(samples)) for row in runner.rows_of(sample_of(samples, k))]
    dataset.write([as_table(rows)])
    return spec, dataset


def closed_form(spec: SweepSpec) -> tuple[float, float]:
    """Hook load without friction, and what a friction factor of 1 adds [N]."""
    case = prepare(spec)[0].template.base
    weight, slant = section_of(case.string.components[0], case.mud.density).weight, np.radians(INCLINATION)
    return LENGTH * weight * np.cos(slant), (LENGTH - TOP) * weight * np.sin(slant)


def _hook_loads(folder: Path, count: int) -> tuple[pd.DataFrame, list[Check]]:
    from scipy import stats

    spec, dataset = swept(folder / "loads", {"method": "random", "samples": count, "parameters": [FRICTION], "seed": 5})
    found = assess(dataset, spec)
    base, slope = closed_form(spec)
    mean, sd = base + FRICTION["mean"] * slope, FRICTION["sd"] * slope  # type: ignore[operator]
    told = found.percentiles[found.percentiles["column"] == "hookload_N"].set_index("percentile")
    rows = [{"of": "mean", "found_N": told["mean"].iloc[0], "closed_N": mean, "sampling_error_N": sd / np.sqrt(count)}]
    for percentile in PERCENTILES:
        share = percentile / 100
        true = stats.norm.ppf(share, mean, sd)
        error = np.sqrt(share * (1 - share) / count) / stats.norm.pdf(true, mean, sd)
        row = {"found_N": told["value"][percentile], "closed_N": true, "sampling_error_N": error}
        rows.append({"of": f"{percentile:g} %", **row})
    table = pd.DataFrame(rows)
    off = (table["found_N"] - table["closed_N"]).abs() / table["sampling_error_N"]
    loads, friction = (found.rows[name].to_numpy() for name in ("hookload_N", "friction"))
    each = float(np.abs(loads / (base + friction * slope) - 1).max())
    return table, [
        Check("hook load of a sample against the closed form, largest difference", each, 1e-3, "at_most", "",
              "closed form of a straight inclined string"),
        Check("mean hook load, difference over its sampling error", float(off.iloc[0]), 3, "at_most", "",
              "closed form; three standard errors"),
        Check("ends of the 95 % band, difference over their sampling error, larger", float(off.iloc[1:].max()), 3,
              "at_most", "", "closed form; three standard errors"),
    ]  # fmt: skip


def _linear_indices(folder: Path, count: int) -> pd.DataFrame:
    """Of the weight indicator, which adds the block's weight to a hook load that is linear in the friction."""
    raw: dict[str, object] = {"method": "saltelli", "samples": count, "parameters": [FRICTION, BLOCK], "seed": 1}
    spec, dataset = swept(folder / "indices", raw)
    shares = np.array([(FRICTION["sd"] * closed_form(spec)[1]) ** 2, BLOCK["sd"] ** 2])  # type: ignore[operator]
    table = assess(dataset, spec).indices
    found = table[table["column"] == "weight_indicator_N"].set_index(["measure", "parameter"])["value"]
    return pd.DataFrame(
        {"case": "weight indicator", "measure": measure, "parameter": key, "found": found[measure, key],
         "closed": share}
        for measure in ("S1", "ST")
        for key, share in zip(("friction", "rig.block_weight"), shares / shares.sum(), strict=True)
    )  # fmt: skip


def _ishigami() -> pd.DataFrame:
    """Through the design and the indices of a sweep whose parameters stand for those of the function."""
    keys = [{"key": key, "distribution": "uniform", "low": -np.pi, "high": np.pi} for key in "abc"]
    work = {"operations": ["trip_out"], "depths": [LENGTH]}
    raw = {"name": "Ishigami", "case": "none.toml", "method": "saltelli", "samples": 4096, "parameters": keys}
    spec = SweepSpec.model_validate(raw | {"work": work})
    samples = samples_of(spec)
    a, b, c = (samples[key].to_numpy(float) for key in "abc")
    values = pd.Series(np.sin(a) + 7 * np.sin(b) ** 2 + 0.1 * c**4 * np.sin(a), index=samples["sample"])
    found = {(index.measure, index.parameter): index.value for index in indices_of(spec, samples, values)}
    return pd.DataFrame(
        {"case": "Ishigami", "measure": measure, "parameter": key, "found": found[measure, key], "closed": closed}
        for (measure, key), closed in ISHIGAMI.items()
    )


def _largest(indices: pd.DataFrame, case: str) -> float:
    part = indices[indices["case"] == case]
    return float((part["found"] - part["closed"]).abs().max())


@table_of_rows
def _spreads(count: int) -> Rows:
    """Of random and systematic errors: standard deviations of the end, in the vertical plane and sideways."""
    md = np.arange(0.0, DEPTH + 1, COURSE)
    true = np.column_stack([md, np.full_like(md, SLANT), np.full_like(md, AZIMUTH)])
    tangent = np.array([np.sin(SLANT) * np.cos(AZIMUTH), np.sin(SLANT) * np.sin(AZIMUTH), np.cos(SLANT)])
    sideways = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0.0])
    # A station turns half of the courses on its sides; the first one is known.
    lengths = np.full(len(md) - 1, COURSE)
    lengths[-1] /= 2
    for kind, length in {"random": np.sqrt((lengths**2).sum()), "systematic": lengths.sum()}.items():
        errors = SurveyErrors.model_validate({f"{kind}_inclination": ERROR, f"{kind}_azimuth": ERROR})
        ends = [_end(erred(true, errors, np.random.default_rng(seed))) for seed in range(count)]
        off = np.array(ends) - _end(true)
        for name, towards, scale in (
            ("in the vertical plane", np.cross(sideways, tangent), 1.0), ("sideways", sideways, np.sin(SLANT)),
        ):  # fmt: skip
            row = {"found_m": float((off @ towards).std()), "closed_m": ERROR * length * scale}
            yield {"errors": kind, "across": name, **row}


def _chart(segments: int, times: int) -> dict[str, float]:
    """The rows of a chart against each of them alone and on two threads, and times of both, which take turns."""
    case = drilled_paper_well(segments)
    depths = [1750.0 + 10.0 * k for k in range(DEPTHS)]
    rows = chart_rows(case, "trip_out", depths, threads=1)
    alone = [chart_rows(case, "trip_out", [depth], threads=1)[0] for depth in depths]
    both = chart_rows(case, "trip_out", depths, threads=2)
    taken: list[float] = []
    walls: dict[int, list[float]] = {1: [], 2: []}
    for _ in range(times):
        for threads, spent in walls.items():
            began, own = time.perf_counter(), time.thread_time()
            chart_rows(case, "trip_out", depths, threads=threads)
            spent.append(time.perf_counter() - began)
            if threads == 1:
                taken.append(time.thread_time() - own)
    # NaN is no number's equal: rows are compared as they are written.
    different = sum(len({repr(row), repr(one), repr(two)}) > 1 for row, one, two in zip(rows, alone, both, strict=True))
    measured = {"depth_ms": 1e3 * np.array(taken) / DEPTHS, "two_threads_over_one": np.divide(walls[1], walls[2])}
    return {"segments": segments, **in_columns(measured), "different_rows": different,
            "iterations": float(np.mean([row["iterations"] for row in rows]))}  # fmt: skip


def _end(stations: np.ndarray) -> np.ndarray:
    return np.asarray(along_courses(minimum_curvature(stations), np.array([DEPTH]))[0][0])


STUDY = Study("sweep", "Do percentiles, indices and survey errors of a sweep agree with closed forms?", run, timed=True)
