"""Strings of long segments with the wall force of the helix in closed form, ``contact.helical_force = "analytic"``."""

from collections.abc import Sequence

import pandas as pd

from fctd import Case, Equilibrium, equilibrium
from references.buckling import helix
from validation.harness.study import Check, Rows, table_of_rows
from validation.parts.buckled_pipe import BELOW_SURFACE, BUCKLING, OPERATION, Rig
from validation.parts.resolved_rows import DEPTH, JOINT, WEIGHT, horizontal_well

SEGMENTS = (20.0, 10.0)  # [m]
FRICTIONS = (0.15, 0.19, 0.23, 0.27)  # at the last one slack-off is spent


def analytic(case: Case, bit_depth: float) -> Equilibrium:
    """The row of a case with the wall force of the helix."""
    changes = {"contact": {"helical_force": "analytic"}}
    return equilibrium(Case.model_validate(case.model_dump(exclude_defaults=True) | changes), OPERATION, bit_depth)


@table_of_rows
def pushed_rows(times_onset: float, friction: float, shares: Sequence[float]) -> Rows:
    """Push at the top of a level pipe that slides through shares of the lock-up length, with the force and without."""
    force = times_onset * BUCKLING.onset
    for share in shares:
        length = share * helix.lock_up_length(BUCKLING, force, friction)
        rig, bit = Rig(length, JOINT, friction=friction), {"bit": {"weight_on_bit": force}}
        case = Case.model_validate(rig.case.model_dump(exclude_defaults=True) | bit)
        points = equilibrium(case, OPERATION, BELOW_SURFACE + length), analytic(case, BELOW_SURFACE + length)
        without, push = (-point.hookload for point in points)
        law = helix.pushed_force(BUCKLING, force, friction, length)
        yield {
            "length_m": length, "share_of_lock_up_percent": 100 * share, "status": str(points[1].status),
            "push_kN": push / 1e3, "reciprocal_kN": law / 1e3, "off_percent": 100 * (push / law - 1),
            "push_without_kN": without / 1e3, "without_off_percent": 100 * (without / law - 1),
        }  # fmt: skip


@table_of_rows
def well_rows() -> Rows:
    """Hook load of the horizontal well without the force, with it and resolved; errors in % of the string's weight."""
    for friction in FRICTIONS:
        fine = equilibrium(horizontal_well(SEGMENTS[0], "resolve", friction), OPERATION, DEPTH).hookload
        for segment in SEGMENTS:
            case = horizontal_well(segment, "detect", friction)
            without, point = equilibrium(case, OPERATION, DEPTH).hookload, analytic(case, DEPTH)
            yield {
                "friction": friction, "segment_m": segment, "status": str(point.status),
                "hookload_resolved_kN": fine / 1e3, "hookload_kN": point.hookload / 1e3,
                "off_percent_of_weight": 100 * (point.hookload - fine) / WEIGHT,
                "hookload_without_kN": without / 1e3,
                "without_off_percent_of_weight": 100 * (without - fine) / WEIGHT,
            }  # fmt: skip


def checks(tables: dict[str, pd.DataFrame]) -> list[Check]:
    """Push against the law, and in the full run hook loads against the resolved ones."""
    pushed = tables["analytic_pushed"]
    found = [
        Check(f"analytic force, push through {share:g} % of the lock-up length", abs(off), 3.0, "at_most", "%",
              "reciprocal law")
        for share, off in zip(pushed["share_of_lock_up_percent"], pushed["off_percent"], strict=True)
    ]  # fmt: skip
    if "analytic_well" in tables:
        worst = tables["analytic_well"].groupby("friction")["off_percent_of_weight"].agg(lambda off: off.abs().max())
        found += [
            Check(f"analytic force, well at friction {friction:g}, against the resolved hook load", off, 2.0, "at_most",
                  "%", "of the string's weight")
            for friction, off in worst.items()
        ]  # fmt: skip
    return found
