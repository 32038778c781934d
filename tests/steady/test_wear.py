"""Casing wear: an inclined hole by hand, what schedules share, refusals."""

from typing import Any

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.model.casing_wear import WEAR_UNIT, groove_depth
from fctd.model.section import section_of
from fctd.steady.wear import casing_wear
from tests.cases import make_case

PIPE = {"name": "pipe", "outer_diameter": "5 in", "inner_diameter": "4.276 in", "contact_diameter": "6.5 in",
        "segment_length": 10.0}  # fmt: skip
CASED = {"to_md": 700, "casing": "9 5/8 in 47 N-80", "friction": 0.25}
OPEN = {"to_md": 1000, "diameter": "8.5 in", "friction": 0.25}


def well(*intervals: dict[str, Any], inclination: float = 60.0) -> Case:
    hole = {"intervals": list(intervals) or [CASED, OPEN]}
    return make_case([[0, inclination, 0], [1000, inclination, 0]], [PIPE], wellbore=hole, mud={"density": 1200.0})


def test_an_inclined_hole_wears_by_the_weight_on_it() -> None:
    """The wall bears w sin θ/√(1 + μ²) a metre of a string that turns: V = WF·F·πD·N·t, and the crescent of that."""
    case = well()
    row = casing_wear(case, 1000.0, duration="100 h", rpm=120, wear_factor=5.0, step=5.0).set_index("md_m").loc[402.5]
    force = section_of(case.string.components[0], 1200.0).weight * np.sin(np.pi / 3) / np.hypot(1, 0.25)
    area = 5 * WEAR_UNIT * force * np.pi * 6.5 * 0.0254 * 120 * 60 * 100
    assert row["side_force_N"] == pytest.approx(force * 9.144, rel=1e-3)
    assert row["low_area_m2"] == row["high_area_m2"] == pytest.approx(area, rel=1e-3)
    depth = groove_depth(area, 3.25 * 0.0254, 0.5 * 8.681 * 0.0254, 0.472 * 0.0254)
    assert row["high_groove_m"] == pytest.approx(depth, rel=1e-3)
    assert row["high_worn"] == pytest.approx(row["high_groove_m"] / (0.472 * 0.0254))
    assert row["low_burst_Pa"] == pytest.approx((1 - row["high_worn"]) * row["burst_Pa"])


def test_a_schedule_is_the_sum_of_its_depths() -> None:
    """Drilled from 800 to 1000 m: a quarter of the time near either end, half of it in the middle."""
    case, given = well(), {"rpm": 100, "wear_factor": (1.0, 4.0)}
    drilled = casing_wear(case, [800, 900, 1000], penetration="20 m/h", **given)
    assert drilled.attrs["time_s"] == pytest.approx(36_000)
    assert drilled.attrs["turns"] == pytest.approx(60_000)
    parts = [casing_wear(case, md, duration=hours * 3600, **given) for md, hours in ((800, 2.5), (900, 5), (1000, 2.5))]
    for name in ("low_area_m2", "high_area_m2"):
        together = sum(part[name].to_numpy() for part in parts)
        assert drilled[name].to_numpy() == pytest.approx(together, rel=1e-9)
    assert drilled["high_area_m2"].to_numpy() == pytest.approx(4 * drilled["low_area_m2"].to_numpy())
    timed = casing_wear(case, [800, 900, 1000], duration="10 h", **given)
    assert timed["high_groove_m"].to_numpy() == pytest.approx(drilled["high_groove_m"].to_numpy())


def test_each_casing_has_its_rows_down_to_the_bit() -> None:
    """Tie-back, liner and open hole; the part of the liner below the bit is not worn and has no row."""
    tie_back = {"to_md": 400, "casing": "10 3/4 in 45.5 N-80", "friction": 0.2, "name": "tie-back"}
    table = casing_wear(well(tie_back, CASED, OPEN), 600.0, duration=3600.0, step="50 m")
    rows = table.groupby("casing", sort=False)["md_m"].agg(["min", "max", "size"])
    assert rows.index.tolist() == ["tie-back", "9 5/8 in 47 N-80"]
    assert rows.to_numpy().tolist() == [[25.0, 375.0, 8], [425.0, 575.0, 4]]
    assert (table["low_worn"] < table["high_worn"]).sum() > 10


def test_a_wall_that_is_worn_through_has_no_burst_left() -> None:
    table = casing_wear(well(), 1000.0, duration="1e5 h", rpm=200, wear_factor=1000)
    assert table["high_worn"].max() == 1.0
    assert table["low_burst_Pa"].min() == 0.0
    assert np.isfinite(table.select_dtypes("number").to_numpy()).all()


@pytest.mark.parametrize(("asked", "told"), [
    ({}, "duration is missing: expected duration or penetration"),
    ({"duration": 1.0, "penetration": 1.0}, "penetration is missing: expected duration or penetration"),
    ({"duration": "0 h"}, 'duration = "0 h": expected a time above 0'),
    ({"duration": 1e12}, "duration = 1000000000000.0: expected a time above 0 and at most 100000 h"),
    ({"duration": float("nan")}, "duration = nan: expected a time above 0"),
    ({"penetration": "20 m/h"}, "bit_depths is missing: expected depths that are drilled"),
    ({"penetration": "-1 m/h"}, 'penetration = "-1 m/h": expected a speed above 0'),
    ({"duration": 1.0, "wear_factor": 5e-10}, "a wear factor in 1e-10/psi, 0.01 to 10000 (5e-10 looks like '5')"),
    ({"duration": 1.0, "wear_factor": (5, 2)}, "wear_factor = [5, 2]: expected one wear factor, or the lowest"),
    ({"duration": 1.0, "wear_factor": "5"}, 'wear_factor = "5": expected a wear factor'),
    ({"duration": 1.0, "operation": "trip_in"}, 'operation = "trip_in": expected rotate_off_bottom or'),
    ({"duration": 1.0, "rpm": 0}, "rpm = 0: expected rev/min above 0"),
    ({"duration": 1.0, "step": 0}, "step = 0: expected a length of casing"),
    ({"duration": 1.0, "step": float("inf")}, "step = inf: expected a length of casing"),
    ({"duration": 1.0, "bit_depths": 2000.0}, "bit_depth"),
])  # fmt: skip
def test_what_cannot_be_asked_is_refused(asked: dict[str, Any], told: str) -> None:
    given = {"bit_depths": 900.0} | asked
    with pytest.raises(InputError) as refused:
        casing_wear(well(), **given)
    assert told in str(refused.value)


def test_a_case_without_casing_is_refused() -> None:
    with pytest.raises(
        InputError, match=r"wellbore\.intervals\[0\]\.casing is missing: expected casing whose wall wears"
    ):
        casing_wear(make_case(), 900.0, duration=1.0)
