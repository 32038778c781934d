"""A small well with synthetic rows, which the tests of calibrations build on."""

import functools
from dataclasses import replace
from typing import Any

import numpy as np

from fctd.calibration.forward import Forward
from fctd.calibration.rows import Range, Row
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import find_unknowns, parse_fits
from fctd.case.load import Case
from fctd.model.operations import SteadyRates, steady_rates
from tests.cases import make_case, pipe

TRUTH = {
    "friction.cased": 0.18, "friction.open": 0.31, "rig.block_weight": 230e3, "rig.sheave_efficiency": 0.97,
    "rig.torque_offset": 800.0, "rig.torque_per_rpm": 8.0,
}  # fmt: skip
TURN = np.pi / 30


def well(**more: Any) -> Case:
    """Build to 60°, shoe at 900 m, 1500 m deep: collars and pipe in 30 segments."""
    intervals = [
        {"to_md": 900, "diameter": 0.2205, "friction": 0.2, "kind": "cased"},
        {"to_md": 1500, "diameter": 0.2159, "friction": 0.3, "kind": "open"},
    ]
    parts = [pipe(100, 4, 0.165, 0.071, name="collars"), pipe(None, None, segment_length=50.0, name="drill pipe")]
    given: dict[str, Any] = {"rig": {"block_weight": 250e3}, "mud": {"density": 1200.0}} | more
    return make_case(
        [[0, 0, 0], [300, 0, 0], [700, 60, 0], [1500, 60, 0]], parts, None, 0.0,
        {"intervals": intervals, "geometry": "arcs"}, **given,
    )  # fmt: skip


def blank_rows(case: Case) -> list[Row]:
    """Ten rows without loads: up, down and rotating at three depths, and in slips; and a tare."""
    rows = []
    for depth in (700.0, 1100.0, 1500.0):
        for kind in ("trip_out", "trip_in"):
            rows.append(Row(f"{kind} {depth:g}", "", depth, kind, steady_rates(case, kind)))
        rpm = 60.0 if depth < 1200 else 130.0
        rates = SteadyRates(0.0, rpm * TURN)
        rows.append(Row(f"rotate {depth:g}", "", depth, "rotate_off_bottom", rates))
    rows.append(Row("slips", "", float("nan"), "in_slips", SteadyRates(0.0, 0.0)))
    rows.append(Row("tare", "", float("nan"), "tare", SteadyRates(0.0, 60.0 * TURN)))
    return rows


def measured_rows(case: Case, truth: dict[str, float], rows: list[Row], seed: int | None = None) -> list[Row]:
    """Rows as a rig with these values would read them, with noise of one standard deviation where seeded."""
    forward = Forward(rows, {"": case}, find_unknowns(parse_fits(truth), Setup(), [case]), Setup())
    value = forward.evaluate(np.array(list(truth.values()))).value
    if seed is not None:
        noise = np.random.default_rng(seed).normal(size=len(value))
        value = value + noise * [reading.noise for reading in forward.readings]
    found = list(rows)
    for reading, read in zip(forward.readings, value, strict=True):
        found[reading.row] = replace(found[reading.row], **{reading.load: Range(float(read), float(read))})
    return found


@functools.cache
def exact_rows() -> list[Row]:
    """The rows of the well without noise; the last but one is of slips."""
    return measured_rows(well(), TRUTH, blank_rows(well()))
