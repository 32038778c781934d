"""``calibrate``: unknowns of a case from measured rows."""

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path

from fctd.calibration.fit import LOSSES, Loss
from fctd.calibration.fit import fit as fit_rows
from fctd.calibration.forward import Forward
from fctd.calibration.result import Calibration
from fctd.calibration.rows import Row, read_rows
from fctd.calibration.rules import left_out_by_rule
from fctd.calibration.setup import Setup, UnknownSpec, read_setup
from fctd.calibration.unknowns import find_unknowns, parse_fits
from fctd.case.errors import InputError, nearest
from fctd.case.load import Case, load_case, naming_file

Files = str | PathLike[str]


def calibrate(
    case: Case,
    measured: Files | Sequence[Row],
    fit: Sequence[str] | Mapping[str, UnknownSpec] = (),
    *,
    priors: Sequence[str] = (),
    setup: Files | Setup | None = None,
    strings: Mapping[str, Case] | None = None,
    loss: Loss = "soft_l1",
    starts: int = 4,
    seed: int = 0,
) -> Calibration:
    """The unknowns of a case that fit measured rows best.

    measured : a CSV file, or rows; strings : their cases by name, where rows are given and not all are of ``case``.
    fit : unknowns, as names with bounds such as "friction.open=0.1:0.5", or as a table; priors : of them, such as
    "friction.open=0.25+-0.05".  setup : a TOML file or a ``Setup``, whose unknowns are added to these.

    Raises InputError for input that cannot be used.
    """
    with naming_file(case):
        if loss not in LOSSES:
            raise InputError(nearest(loss, LOSSES, "loss"), key="loss", value=loss)
        if starts < 1:
            raise InputError("at least one start", key="starts", value=starts)
        told = gather_setup(setup)
        rows, cases = gather_rows(case, measured, told, strings, measured=True)
        specs = dict(fit) if isinstance(fit, Mapping) else parse_fits(fit, priors)
        unknowns = find_unknowns(specs, told, list(cases.values()))
        forward = Forward(rows, cases, unknowns, told)
        out = left_out_by_rule(rows, cases)
        used = [k for k in range(len(rows)) if k not in out]
        found = fit_rows(forward, used, loss, starts, seed)
        if not found.used:
            raise InputError(
                "rows whose strings have loads", key="measured", value=list((out | found.left_out).values())
            )
        reasons = {rows[k].id: reason for k, reason in sorted((out | found.left_out).items())}
        return Calibration(case, forward, found, reasons, loss, starts, seed)


def gather_setup(setup: Files | Setup | None) -> Setup:
    """The setup of a file, or as it is."""
    if isinstance(setup, Setup):
        return setup
    return Setup() if setup is None else read_setup(Path(setup))


def gather_rows(
    case: Case, rows: Files | Sequence[Row], setup: Setup, strings: Mapping[str, Case] | None, *, measured: bool
) -> tuple[list[Row], dict[str, Case]]:
    """The rows and the case of each string; an override set changes the case's file."""
    if not isinstance(rows, str | PathLike):
        return list(rows), {"": case, **(strings or {})}
    sets = dict(strings or {})
    for name, changes in setup.strings.items():
        if case.file is None:
            raise InputError("a case from a file, which override sets change", key=f"strings.{name}")
        try:
            sets[name] = load_case(case.file, changes)
        except InputError as error:
            raise error.at(f"strings.{name}") from None
    return read_rows(Path(rows), case, sets, measured=measured)
