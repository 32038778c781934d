"""``calibrate``: unknowns of a case from measured rows; ``predict``: bands of the readings of other rows."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any, Final, Literal, get_args

import numpy as np
import pandas as pd

from fctd.calibration.days import fit_scatter
from fctd.calibration.fit import LOSSES, Loss
from fctd.calibration.fit import fit as fit_rows
from fctd.calibration.forward import Forward
from fctd.calibration.gradient import gradient_of, in_pieces
from fctd.calibration.identify import refuse as refuse_undetermined
from fctd.calibration.identify import undetermined
from fctd.calibration.misread import misread
from fctd.calibration.predict import SAMPLES, Posterior, posterior_file, predict_rows, read_posterior
from fctd.calibration.result import Calibration
from fctd.calibration.rows import Row, read_rows
from fctd.calibration.rules import left_out_by_rule
from fctd.calibration.setup import Setup, UnknownSpec, read_setup
from fctd.calibration.unknowns import Unknown, check_known, find_unknowns, parse_fits, refuse_edited, refuse_overridden
from fctd.case.errors import Computed, InputError, naming, nearest
from fctd.case.from_python import is_frame
from fctd.case.load import Case, load_case, naming_file
from fctd.results.unit_systems import System

Files = str | PathLike[str]
Order = Literal["all", "first-section"]
ORDERS: Final = get_args(Order)


def calibrate(
    case: Case,
    measured: Files | Sequence[Row],
    fit: Sequence[str] | Mapping[str, UnknownSpec] = (),
    *,
    priors: Sequence[str] = (),
    setup: Files | Setup | None = None,
    strings: Mapping[str, Case] | None = None,
    overrides: Mapping[str, Any] | None = None,
    loss: Loss = "soft_l1",
    order: Order = "all",
    starts: int = 4,
    seed: int = 0,
    refuse: bool = True,
    scatter: bool | None = None,
    units: System | None = None,
    tell: Callable[[str], None] | None = None,
    progress: Callable[[int], None] | None = None,
) -> Calibration:
    """The unknowns of a case that fit measured rows best.

    measured : a file of rows, or rows; strings : their cases by name, where rows are given and not all are of ``case``.
    overrides : with which the case was loaded, for the override sets of its file.
    fit : unknowns, as names with bounds such as "friction.open=0.1:0.5", or as a table; priors : of them, such as
    "friction.open=0.25+-0.05".  setup : a TOML file or a ``Setup``, whose unknowns are added to these.
    order : "all", or "first-section", which fits the rows of the shallowest hole section and predicts the deeper ones.
    starts, seed : of the search.  refuse : whether unknowns that the rows do not tell apart are an error.
    scatter : whether friction and weight differ from day to day (``scatter``); by default where rows name their days.
    units : of a file whose headers name none, which is refused without; tell : called with a sentence that says so.
    progress : called with the number of strings solved so far, in the fit and in what is asked of it afterwards.

    Raises InputError for input that cannot be used.
    """
    with naming_file(case):
        if loss not in LOSSES:
            raise InputError(nearest(loss, LOSSES, "loss"), key="loss", value=loss)
        if order not in ORDERS:
            raise InputError(nearest(order, ORDERS, "order"), key="order", value=order)
        _check_count("starts", starts, 1)
        _check_count("seed", seed, 0)
        told = gather_setup(setup)
        specs = dict(fit) if isinstance(fit, Mapping) else parse_fits(fit, priors)
        with _naming_setup(setup):
            rows, cases = gather_rows(case, measured, told, strings, overrides, units, tell, measured=True)
            unknowns = find_unknowns(specs, told, list(cases.values()))
        out = left_out_by_rule(rows, cases)
        deeper = _deeper_section(rows, cases) if order == "first-section" else []
        reasons = out | dict.fromkeys(deeper, "of a deeper hole section: predicted")
        if scatter is None:
            scatter = any(row.day for k, row in enumerate(rows) if k not in reasons)

        def fitted(unknowns: Sequence[Unknown]) -> Calibration:
            return _fit(rows, cases, unknowns, told, reasons, loss, starts, seed, refuse, scatter, progress)

        found = fitted(unknowns)
        if found.scattered is not None and any(gradient_of(unknown.name) for unknown in unknowns):
            constant = fitted([unknown for unknown in unknowns if not gradient_of(unknown.name)])
            assert constant.scattered is not None
            scores = {"linear in depth": found.scattered.score, "constant": constant.scattered.score}
            is_constant = scores["constant"] >= scores["linear in depth"]
            found = replace(constant if is_constant else found, scores=scores)
        if not deeper:
            return found
        return replace(found, predicted=predict_rows(found.posterior, [rows[k] for k in deeper], cases))


def _fit(
    rows: Sequence[Row], cases: Mapping[str, Case], unknowns: Sequence[Unknown], setup: Setup,
    left_out: Mapping[int, str], loss: Loss, starts: int, seed: int, refuse: bool, scatter: bool | None,
    progress: Callable[[int], None] | None,
) -> Calibration:  # fmt: skip
    """The fit of the rows that are not left out, by index."""
    names = [unknown.name for unknown in unknowns]
    cases = {name: in_pieces(case, names) for name, case in cases.items()}
    forward = Forward(rows, cases, unknowns, setup, progress)
    used = [k for k in range(len(rows)) if k not in left_out]
    # Before the fit, which unknowns without effect would lead astray, and at its end.
    at_start = forward.evaluate(np.array([unknown.start for unknown in unknowns]))
    loose = undetermined(forward, at_start, used)
    if refuse:
        refuse_undetermined(loose)
    found = fit_rows(forward, used, loss, starts, seed)
    loose = undetermined(forward, found.evaluation, found.used)
    if refuse:
        refuse_undetermined(loose)
    reasons = {rows[k].id: reason for k, reason in sorted({**left_out, **found.left_out}.items())}
    if not found.used:
        raise InputError("rows whose strings have loads", key="measured", value=list(reasons.values()))
    doubtful = misread(forward, found.evaluation)
    scattered = None
    if scatter:
        found, scattered = fit_scatter(forward, found)
    return Calibration(cases[""], forward, found, reasons, loss, tuple(loose), scattered=scattered, misread=doubtful)


def predict(
    case: Case,
    rows: Files | Sequence[Row],
    posterior: Posterior | Files | None = None,
    *,
    strings: Mapping[str, Case] | None = None,
    overrides: Mapping[str, Any] | None = None,
    samples: int = SAMPLES,
    seed: int = 0,
    units: System | None = None,
    tell: Callable[[str], None] | None = None,
) -> pd.DataFrame:
    """Bands of the readings of rows, and scores of those that are measured (``predict_rows``).

    case : calibrated, as ``Calibration.case`` or from the file that ``fctd calibrate --out`` writes; posterior : of the
    calibration, or its file, by default the one beside the case.  strings, overrides, units, tell : as in
    ``calibrate``; samples, seed : of the draws.  Raises InputError for input that cannot be used.
    """
    with naming_file(case):
        _check_count("samples", samples, 1)
        _check_count("seed", seed, 0)
        beside = None
        if posterior is None:
            if case.file is None:
                raise InputError("a posterior, since the case is not from a file", key="posterior")
            posterior = beside = posterior_file(Path(case.file))
        known = posterior if isinstance(posterior, Posterior) else read_posterior(Path(posterior))
        refuse_overridden([unknown.name for unknown in known.unknowns], case, overrides or {})
        if beside is not None:
            refuse_edited(dict(zip(known.unknowns, known.best.tolist(), strict=True)), case, beside.name)
        found, cases = gather_rows(case, rows, known.setup, strings, overrides, units, tell, measured=False)
        cases = {name: in_pieces(one, [unknown.name for unknown in known.unknowns]) for name, one in cases.items()}
        with naming(None if isinstance(posterior, Posterior) else posterior):
            check_known(known.unknowns, list(cases.values()))
        return predict_rows(known, found, cases, samples, seed)


def _deeper_section(rows: Sequence[Row], cases: Mapping[str, Case]) -> list[int]:
    """The rows whose bit is in another hole size than that of the shallowest bit; rows without a string are in none."""
    with_string = [k for k, row in enumerate(rows) if row.has_string]
    sizes = {k: _hole_size(cases[rows[k].string], rows[k].bit_depth) for k in with_string}
    first = sizes[min(with_string, key=lambda k: rows[k].bit_depth)] if with_string else None
    return [k for k in with_string if sizes[k] != first]


def _hole_size(case: Case, bit_depth: float) -> float:
    """Diameter of the hole at the bit [m]."""
    return next(i.diameter for i in case.wellbore.intervals if bit_depth <= i.to_md)


def _check_count(key: str, value: int, least: int) -> None:
    if value < least:
        raise InputError(f"at least {least}", key=key, value=value)


@contextmanager
def _naming_setup(setup: Files | Setup | None) -> Iterator[None]:
    """Add the setup's file to the InputError of one of its keys."""
    try:
        yield
    except InputError as error:
        of_setup = isinstance(setup, str | PathLike) and error.key.startswith(("unknowns", "strings."))
        raise (error.in_file(Path(setup)) if of_setup else error) from None  # type: ignore[arg-type]


def gather_setup(setup: Files | Setup | None) -> Setup:
    """The setup of a file, or as it is."""
    if isinstance(setup, Setup):
        return setup
    return Setup() if setup is None else read_setup(Path(setup))


def gather_rows(
    case: Case,
    rows: Files | Sequence[Row],
    setup: Setup,
    strings: Mapping[str, Case] | None,
    overrides: Mapping[str, Any] | None,
    units: System | None = None,
    tell: Callable[[str], None] | None = None,
    *,
    measured: bool,
) -> tuple[list[Row], dict[str, Case]]:
    """The rows and the case of each string; an override set changes the case's file, after the case's overrides."""
    if is_frame(rows):
        expected, key = "a file of rows, as its to_csv writes one", "measured" if measured else "rows"
        raise InputError(expected, key=key, value=Computed("a DataFrame"))
    if not isinstance(rows, str | PathLike):
        return list(rows), {"": case, **(strings or {})}
    sets = dict(strings or {})
    for name, changes in setup.strings.items():
        if case.file is None:
            raise InputError("a case from a file, which override sets change", key=f"strings.{name}")
        try:
            sets[name] = load_case(case.file, {**(overrides or {}), **changes})
        except InputError as error:  # of a key that the set changes
            raise InputError(error.expected, key=f"strings.{name}.{error.key}", value=error.value) from None
    return read_rows(Path(rows), case, sets, measured=measured, units=units, tell=tell)
