"""The margins of several operations at many bit depths, a row for each (margins.py)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Final

import numpy as np

from fctd.case.errors import InputError
from fctd.case.friction import FrictionChoice
from fctd.case.load import Case, naming_file, with_friction
from fctd.case.message import Message, frame_of, within
from fctd.case.operation_names import kinds_of
from fctd.model.depths import depth_of, depths_of
from fctd.model.operations import SteadyRates, rates_of_all
from fctd.results.attrs import attrs_of
from fctd.results.doing import does
from fctd.steady.equilibrium import Solver
from fctd.steady.margins import Loaded, Margin, margins
from fctd.steady.stuck import stuck_string
from fctd.steady.torque_drag import Row

if TYPE_CHECKING:
    import pandas as pd

# Columns of the table by the fields of a margin.
COLUMNS: Final = {
    "margin": "margin", "limit": "limit", "part": "part", "md": "md_m", "share": "share_used",
    "force": "force_at_bit_N", "hookload": "hookload_N", "hookload_left": "hookload_left_N",
    "torque": "torque_at_bit_N_m", "surface_torque": "surface_torque_N_m",
    "surface_torque_left": "surface_torque_left_N_m", "bending_stress": "bending_stress_Pa",
    "cycles_per_hour": "cycles_per_hour", "reason": "reason", "notes": "notes",
}  # fmt: skip
# Columns of a string that is stuck above its bit.
AT_STUCK: Final = {"force_at_bit_N": "force_at_stuck_N", "torque_at_bit_N_m": "torque_at_stuck_N_m"}
# What is looked at where no operation is named: pulling, setting down, turning.
USUAL: Final = ("trip_out", "trip_in", "rotate_off_bottom")
MOST_ON_LINE: Final = 13  # depths of a limit that is drawn as a line, which needs no more
Progress = Callable[[int, int], None]


def limits_of(
    case: Case,
    operation: str | Sequence[str] = USUAL,
    bit_depths: float | str | Sequence[float | str] = "td",
    friction: FrictionChoice | None = None,
    speed: float | str | None = None,
    rpm: float | str | None = None,
    flow: float | str | None = None,
    stuck_at: float | str | None = None,
    progress: Progress | None = None,
) -> pd.DataFrame:
    """A row for every margin of every operation and bit depth, SI.

    operation : kind or kinds.  bit_depths, ``attrs`` : as of ``torque_drag``.  friction : None for the case's own.
    speed [m/s], rpm, flow [m³/s] : see ``equilibrium``.  stuck_at : measured depth [m], or a text, at which the string
    is stuck, in place of its bit; pumps then stand.

    Columns: operation, bit_depth_m, speed_m_s, rpm, flow_m3_s and weight_on_bit_N of the string without more load, and
    those of ``Margin``: margin (overpull, set_down, torque, slips, fatigue, or
    none where no steady string was found), limit (the first that is reached), part and md_m (where), share_used (of
    that limit, without more load), force_at_bit_N and torque_at_bit_N_m (in all, with the case's), hookload_N and
    surface_torque_N_m at the limit, hookload_left_N and surface_torque_left_N_m until then, bending_stress_Pa (its
    amplitude) and cycles_per_hour of a string that turns, reason, and notes, as of ``torque_drag``, on the string
    without more load.  NaN where a number does not apply.  Of a string
    that is stuck, stuck_md_m says where, force_at_stuck_N and torque_at_stuck_N_m are what arrives there, and what is
    left counts from the free string with its bit at that depth.

    Raises InputError for unusable input, and where string and hole fit at none of the depths.
    """
    with naming_file(case):
        kinds = kinds_of(operation)
        depths = depths_of(bit_depths, case, "bit_depths")
        # Of a string that is stuck the pumps stand.
        rates = rates_of_all(case, kinds, speed, rpm, flow if stuck_at is None else 0.0)
        case = with_friction(case, friction)
        sticks = None if stuck_at is None else _stuck_at(stuck_at, case, kinds, flow)
        solver = Solver(case)
        rows: list[Row] = []
        unfit: list[InputError] = []
        for done, depth in enumerate(depths):
            try:
                rows += margin_rows(solver, kinds, rates, depth, sticks)
            except InputError as error:
                unfit.append(error)
                none = Margin("none", "none", reason=Message(f"not_possible: {within(error.message)}"))
                rows += [_row(solver.case, kind, rates[kind], depth, none) for kind in kinds]
            if progress is not None:
                progress(done + 1, len(depths))
        if len(unfit) == len(depths):
            raise unfit[0]
    table = frame_of(rows)
    if sticks is not None:
        table = table.rename(columns=AT_STUCK)
        table.insert(2, "stuck_md_m", sticks)
    table.attrs = attrs_of(case, kinds, {"speed": speed, "rpm": rpm, "flow": flow})
    return table


def of_lines(bit_depths: Sequence[float], most: int = MOST_ON_LINE) -> list[float]:
    """Those of bit depths at which limits are computed that are drawn as lines: evenly spread, with both ends."""
    picked = np.linspace(0, len(bit_depths) - 1, min(most, len(bit_depths))).round().astype(int)
    return [bit_depths[k] for k in np.unique(picked).tolist()]


def _stuck_at(stuck_at: float | str, case: Case, kinds: Sequence[str], flow: float | str | None) -> float:
    """The depth at which a string is stuck [m]; raises InputError for kinds that do not load it, and for a flow."""
    for kind in kinds:
        if kind not in USUAL:
            raise InputError(f"{', '.join(USUAL)} of a string that is stuck", key="operation", value=kind)
    if flow is not None:
        raise InputError("none beside stuck_at: the pumps stand", key="flow")
    return depth_of(stuck_at, case, "stuck_at")


def margin_rows(
    solver: Solver, kinds: Sequence[str], rates: Mapping[str, SteadyRates], depth: float, stuck_at: float | None = None,
    **options: bool,
) -> list[Row]:  # fmt: skip
    """The rows of ``limits_of`` at a bit depth [m]; options : of ``margins``.

    stuck_at : depth at which the string is stuck [m].  Raises InputError where string and hole do not fit.
    """
    loaded: Sequence[Loaded]
    if stuck_at is not None:
        loaded = [stuck_string(solver, kind, rates[kind], depth, stuck_at) for kind in kinds]
    else:
        laid = solver.lay_out(depth)
        loaded = [Loaded(solver, kind, rates[kind], laid) for kind in kinds]
    return [
        _row(solver.case, of.operation, rates[of.operation], depth, one)
        for of in loaded
        for one in margins(of, **options)
    ]


def _row(case: Case, kind: str, rates: SteadyRates, depth: float, margin: Margin) -> Row:
    named = {COLUMNS[name]: value for name, value in margin._asdict().items()}
    return {"operation": kind, "bit_depth_m": depth, **does(case, kind, rates), **named}
