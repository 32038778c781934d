"""Fits of well 16A(78)-32 and their frozen values: ``python -m validation.parts.forge_16a_fits [MODEL ...]``.

The file is committed before a judged row is read.
"""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
import tomlkit

from fctd.calibration.forward import Forward
from fctd.calibration.gradient import gradient_of, in_pieces
from fctd.calibration.predict import Posterior
from fctd.calibration.quadrature import Mixture
from fctd.calibration.result import Calibration
from fctd.calibration.rows import Row
from fctd.calibration.setup import PriorSpec, Setup, UnknownSpec, read_setup
from fctd.calibration.unknowns import find_unknowns
from fctd.case.load import Case
from validation.cases import FOLDER
from validation.harness.study import data_folder
from validation.parts.day_fits import fit_by_day, one_factor
from validation.parts.forge_16a import FIT, TARE
from validation.parts.forge_16a_rows import report_rows
from validation.parts.forge_16a_strings import Assembly, assemblies, cases
from validation.parts.judged_well import ONE_FACTOR, SOFT, STIFF
from validation.parts.volve_f4_days import FOR_OTHERS
from validation.parts.volve_f4_soft import SoftForward

SETUP: Final = FOLDER / "forge_16a" / "report.toml"
FROZEN: Final = FOLDER / "forge_16a" / "frozen.toml"
LINEAR: Final = "linear in depth"
ALONE: Final = "tare alone"
# Bounds of a mass in standard deviations of its prior.
MASS_BOUNDS: Final = 4.0
# Nodes of a frozen mixture by deviation: those of the fit, put together.
NODES: Final = 8
DIGITS: Final = 6
HEADING: Final = (
    "Well 16A(78)-32: values of the fits and their standard deviations [SI], frozen before a judged row was read.",
    "scatter: median and ends of 95 %.  Nodes of the mixture: friction by its logarithm, others by their size.",
)


@dataclass(frozen=True)
class Model:
    """How strings are solved, and whether friction along and around the hole, and over depth, are of their own."""

    route: type[Forward] = Forward
    pairs: bool = True
    depth: bool = False


# Each model of the study with friction that is constant in an interval and linear in depth: ``chosen`` takes one.
MODELS: Final[dict[str, Model]] = {
    STIFF: Model(),
    f"{STIFF}, {LINEAR}": Model(depth=True),
    SOFT: Model(route=SoftForward),
    f"{SOFT}, {LINEAR}": Model(route=SoftForward, depth=True),
    ONE_FACTOR: Model(pairs=False),
    f"{ONE_FACTOR}, {LINEAR}": Model(pairs=False, depth=True),
}


def setup_of(
    found: Mapping[str, Assembly], keys: Sequence[str], model: Model = MODELS[STIFF], base: Setup | None = None
) -> Setup:
    """A setup, by default ``base_setup``, with the masses of these rows' assemblies, for a model."""
    setup = base_setup() if base is None else base
    unknowns = {name: spec for name, spec in setup.unknowns.items() if model.depth or not gradient_of(name)}
    unknowns |= {f"mass.{found[key].carrier}": _mass(found[key]) for key in keys}
    setup = setup.model_copy(update={"unknowns": unknowns})
    return setup if model.pairs else one_factor(setup)


def base_setup() -> Setup:
    """Unknowns and sources of the reports, with what another well says of friction and of the scatter between days."""
    setup, others = read_setup(SETUP), read_setup(FOR_OTHERS)
    priors = {
        name: setup.unknowns[name].model_copy(update={"prior": spec.prior}) for name, spec in others.unknowns.items()
    }
    return setup.model_copy(update={"unknowns": {**setup.unknowns, **priors}, "scatter": others.scatter})


def _mass(assembly: Assembly) -> UnknownSpec:
    mean, sd = assembly.linear_mass
    low, high = max(mean - MASS_BOUNDS * sd, 0.4 * mean), mean + MASS_BOUNDS * sd
    return UnknownSpec(bounds=(low, high), prior=PriorSpec(mean=mean, sd=sd))


def fit(
    strings: Mapping[str, Case], rows: Sequence[Row], found: Mapping[str, Assembly], model: Model,
    base: Setup | None = None,
) -> Calibration:  # fmt: skip
    """A calibration of rows with scatter between days, from one start."""
    keys = list(dict.fromkeys(row.string for row in rows))
    setup = setup_of(found, keys, model, base)
    pieces = {key: in_pieces(strings[key], setup.unknowns) for key in keys}
    return fit_by_day(pieces, rows, setup, model.route, starts=1)


def fit_of_tare(data: Path, strings: Mapping[str, Case], found: Mapping[str, Assembly]) -> Calibration:
    """Block weight and its scatter from the rotating weights of the nearly vertical rows alone, which friction hardly
    changes.  The masses are those that are taken: the scatter holds their errors."""
    rows = [
        replace(row, torque=None) for row in report_rows(data, strings, TARE) if row.operation == "rotate_off_bottom"
    ]
    setup = base_setup()
    setup = setup.model_copy(update={"unknowns": {"rig.block_weight": setup.unknowns["rig.block_weight"]}})
    return fit_by_day({key: strings[key] for key in TARE}, rows, setup, starts=1)


@dataclass(frozen=True)
class Frozen:
    """A fit on record: value and standard deviation [SI] by unknown; median, low and high of the deviations by name.

    score : sum over the days of the log density that a fit without the day gives them; names, mixture : of what judged
    rows share with those that fit; spread : of the recorded ranges [SI].
    """

    best: dict[str, tuple[float, float]]
    deviations: dict[str, tuple[float, float, float]]
    score: float
    rows: tuple[str, ...]
    names: tuple[str, ...]
    mixture: Mixture
    spread: dict[str, dict[str, float]]


def freeze(fitted: Calibration) -> Frozen:
    """What of a fit goes on record: masses of assemblies that it alone has are left out of the mixture."""
    assert fitted.scattered is not None
    table = fitted.intervals
    sd = np.sqrt(np.diag(table.covariance)).tolist()
    names = [unknown.name for unknown in fitted.unknowns]
    kept = [k for k, name in enumerate(names) if not name.endswith(" ft")]
    mixture = fitted.scattered.fit.mixture
    mixture = Mixture(
        mixture.weight, mixture.deviations, mixture.mean[:, kept], mixture.covariance[:, kept][:, :, kept]
    )
    return Frozen(
        {name: (value, s) for (name, value), s in zip(fitted.values.items(), sd, strict=True)},
        {one["name"]: (one["value"], one["low"], one["high"]) for one in fitted.scattered.deviations},
        fitted.scattered.score,
        tuple(fitted.forward.rows[k].id for k in fitted.fit.used),
        tuple(names[k] for k in kept),
        together(mixture),
        {source: dict(loads) for source, loads in fitted.posterior.spread.items()},
    )


def together(mixture: Mixture) -> Mixture:
    """The mixture with few nodes: those with deviations between the same quantiles become one of their moments."""
    bins = np.zeros((len(mixture.weight), mixture.deviations.shape[1]), int)
    for e, of in enumerate(mixture.deviations.T):
        order = np.argsort(of, kind="stable")
        share = np.empty(len(of))
        share[order] = np.cumsum(mixture.weight[order]) - 0.5 * mixture.weight[order]
        # Nodes with one deviation stay together.
        first = {value: share[of == value].mean() for value in np.unique(of)}
        bins[:, e] = [min(int(NODES * first[value]), NODES - 1) for value in of]
    parts = []
    for one in np.unique(bins, axis=0):
        here = (bins == one).all(axis=1)
        weight = mixture.weight[here]
        share = weight / weight.sum()
        mean = share @ mixture.mean[here]
        off = mixture.mean[here] - mean
        covariance = np.einsum("m,mkl->kl", share, mixture.covariance[here]) + (share * off.T) @ off
        parts.append((weight.sum(), np.sqrt(share @ mixture.deviations[here] ** 2), mean, covariance))
    return Mixture(*(np.array([part[i] for part in parts]) for i in range(4)))


def posterior_of(
    frozen: Frozen, strings: Mapping[str, Case], found: Mapping[str, Assembly], keys: Sequence[str], model: Model
) -> Posterior:
    """What a frozen fit knows of other rows: with the masses of their assemblies as they were known before."""
    setup = setup_of(found, keys, model)
    unknowns = tuple(find_unknowns({}, setup, [strings[key] for key in keys]))
    own = [k for k, unknown in enumerate(unknowns) if unknown.name not in frozen.names]
    at = [unknowns[k] for k in own]
    count, m = len(unknowns), len(frozen.mixture.weight)
    place = [[unknown.name for unknown in unknowns].index(name) for name in frozen.names]
    mean, covariance = np.zeros((m, count)), np.zeros((m, count, count))
    mean[:, place] = frozen.mixture.mean
    covariance[np.ix_(range(m), place, place)] = frozen.mixture.covariance
    best = np.zeros(count)
    best[place] = [frozen.best[name][0] for name in frozen.names]
    for k, unknown in zip(own, at, strict=True):
        assert unknown.prior is not None
        best[k] = unknown.prior.mean
        mean[:, k] = unknown.prior.mean / unknown.size
        covariance[:, k, k] = (unknown.prior.sd / unknown.size) ** 2
    mixture = Mixture(frozen.mixture.weight, frozen.mixture.deviations, mean, covariance)
    return Posterior(unknowns, best, np.diag(np.zeros(count)), setup, frozen.spread, mixture)


def read_frozen() -> dict[str, Frozen]:
    """The fits on record by model, and the tare."""
    if not FROZEN.is_file():
        return {}
    stored = tomlkit.parse(FROZEN.read_text(encoding="utf-8")).unwrap()
    return {name: _frozen(one) for name, one in stored.items()}


def _frozen(one: Mapping[str, Any]) -> Frozen:
    k = len(one["names"])
    half = np.array(one["covariance"])
    covariance = np.zeros((len(half), k, k))
    rows, columns = np.triu_indices(k)
    covariance[:, rows, columns] = covariance[:, columns, rows] = half
    weight = np.array(one["weight"])
    mixture = Mixture(weight / weight.sum(), np.array(one["deviations"]), np.array(one["mean"]), covariance)
    return Frozen(
        {name: tuple(pair) for name, pair in one["values"].items()},
        {name: tuple(three) for name, three in one["scatter"].items()},
        one["score"], tuple(one["rows"]), tuple(one["names"]), mixture, one["spread"],
    )  # fmt: skip


def write_frozen(fits: Mapping[str, Frozen]) -> None:
    """Write the file, with ``DIGITS`` digits."""

    def short(values: Any) -> list[Any]:
        return [short(v) if np.ndim(v) else float(f"{v:.{DIGITS}g}") for v in values]

    document = tomlkit.document()
    for line in HEADING:
        document.add(tomlkit.comment(line))
    for name, one in fits.items():
        upper = np.triu_indices(len(one.names))
        table = tomlkit.table()
        table["score"] = round(one.score, 3)
        table["values"] = {key: short(pair) for key, pair in one.best.items()}
        table["scatter"] = {key: short(three) for key, three in one.deviations.items()}
        table["spread"] = {source: {load: short([v])[0] for load, v in of.items()} for source, of in one.spread.items()}
        table["rows"] = list(one.rows)
        table["names"] = list(one.names)
        for key, values in (
            ("weight", one.mixture.weight), ("deviations", one.mixture.deviations), ("mean", one.mixture.mean),
            ("covariance", [c[upper] for c in one.mixture.covariance]),
        ):  # fmt: skip
            array = tomlkit.array()
            array.extend(short(values))
            table[key] = array.multiline(True)
        document[name] = table
    FROZEN.write_text(tomlkit.dumps(document), encoding="utf-8")


def chosen(fits: Mapping[str, Frozen], model: str) -> str:
    """Of a model's two fits, friction constant or linear in depth, the one that predicts left-out days better."""
    return max((model, f"{model}, {LINEAR}"), key=lambda name: fits[name].score)


def fits_of(data: Path, models: Sequence[str]) -> dict[str, Calibration]:
    """The fits of these models, the tare among them."""
    found = assemblies(data)
    strings = cases(data, found)
    rows = report_rows(data, strings, FIT)
    return {
        name: fit_of_tare(data, strings, found) if name == ALONE else fit(strings, rows, found, MODELS[name])
        for name in models
    }


if __name__ == "__main__":
    folder = data_folder()
    assert folder is not None, "the public data folder is missing"
    for name in sys.argv[1:] or (ALONE, *MODELS):
        (fitted,) = fits_of(folder, [name]).values()
        print(name, fitted.table.round(4).to_string(), fitted.residuals.round(2).to_string(), sep="\n", flush=True)
        write_frozen(read_frozen() | {name: freeze(fitted)})
