"""A calibrated case as a file: the user's file with its comments and units, and the values of the unknowns."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import tomlkit

from fctd.calibration.predict import posterior_file
from fctd.calibration.result import Calibration
from fctd.calibration.unknowns import held, keys_of
from fctd.case import spellings
from fctd.case.errors import MISSING, InputError
from fctd.case.load import Case, load_case
from fctd.case.raw_case import look_up, set_key, split_key
from fctd.case.text import counted
from fctd.case.units import DENSITY, FORCE, LENGTH, LINEAR_MASS, TORQUE, Dimension
from fctd.steady.refined_file import changed_document, survey_from
from fctd.store.whole_file import whole_file

_DIMENSIONS: dict[str, Dimension | None] = {
    "block_weight": FORCE, "guide_friction": FORCE, "torque_offset": TORQUE, "torque_per_rpm": TORQUE,
    "density": DENSITY, "linear_mass": LINEAR_MASS,
}  # fmt: skip


def write_calibrated(found: Calibration, source: Path, overrides: Mapping[str, Any], out: Path) -> list[Path]:
    """Write the case file ``source``, changed by ``overrides``, with the values of the unknowns, and its posterior.

    Returns both files.  A quantity keeps the unit in which it is written.
    """
    raw = changed_document(source, overrides)
    _split_intervals(raw, load_case(source, overrides), found.base)
    for name in found.values:
        for key, value in zip(keys_of(name, found.base), held(name, found.case), strict=False):
            old, last = look_up(raw, *split_key(key)), str(split_key(key)[-1])
            set_key(raw, key, _written(value, old, _DIMENSIONS.get(last)))
            *parents, _ = split_key(key)
            trivia = look_up(raw, *parents).item(last).trivia  # type: ignore[attr-defined]
            trivia.comment = trivia.comment_ws = ""  # it described the value before
    for i, interval in enumerate(found.case.wellbore.intervals):
        key = f"wellbore.intervals[{i}].rotational_friction"
        # Where the factor along the hole alone was fitted, that around it stays what both were.
        if interval.rotational_friction is not None and look_up(raw, *split_key(key)) is MISSING:
            set_key(raw, key, float(interval.rotational_friction))
    survey = survey_from(out, found.base)
    if survey is not None:
        raw["wellbore"]["survey"] = survey
    beside = posterior_file(out)
    found.posterior.write(beside)
    with whole_file(out) as scratch:
        scratch.write_text(_heading(found, beside) + tomlkit.dumps(raw), encoding="utf-8")
    return [out, beside]


def _split_intervals(raw: Any, given: Case, pieces: Case) -> None:
    """Give a document the intervals of a case whose friction is linear in depth, copies of those that they cut."""
    ends = [interval.to_md for interval in given.wellbore.intervals]
    if len(ends) == len(pieces.wellbore.intervals):
        return
    written, found = raw["wellbore"]["intervals"], tomlkit.aot()
    for piece in pieces.wellbore.intervals:
        whole = next(i for i, end in enumerate(ends) if piece.to_md <= end)
        table = tomlkit.table()
        table.update(written[whole].unwrap())
        if piece.to_md < ends[whole]:
            table["to_md"] = _written(piece.to_md, table["to_md"], LENGTH)
        found.append(table)
    raw["wellbore"]["intervals"] = found


def _written(value: float, old: object, dimension: Dimension | None) -> object:
    """A value in the unit of the one before, else in SI."""
    if dimension is None:
        return float(f"{value:.6g}")
    unit = dimension.unit
    if isinstance(old, str):
        try:
            written = spellings.split(old)
        except InputError:
            written = None
        unit = unit if written is None else written.unit
    return f"{value / dimension.factor(unit):.6g} {unit}"


def _heading(found: Calibration, beside: Path) -> str:
    """The comment at the head of the file: how it was made."""
    return (
        f"# Calibrated by fctd calibrate on {counted(len(found.fit.used), 'row')}: {', '.join(found.values)}.\n"
        f"# Intervals and covariance are in {beside.name}, which fctd predict reads.\n"
    )
