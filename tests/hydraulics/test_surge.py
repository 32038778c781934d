"""Surge and swab of trips: a textbook's casing, the ends of a string, and the fastest trip within a window."""

from typing import Any

import numpy as np
import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.hydraulics.pressures import lay
from fctd.hydraulics.surge import ENDS, Trip, fastest_trips, surge_pressures
from tests.cases import make_case, pipe

G, FT, INCH, PSI, PPG = 9.80665, 0.3048, 0.0254, 6894.757, 119.8264
HEAVIER = {"density": 1200.0, "viscosity": 0.03, "float": True, "inside": [{"density": 1500.0}]}
WINDOW = [{"tvd": 0, "pore": 1100.0, "fracture": 1300.0}]


def well(**sections: Any) -> Case:
    """1000 m of 5 in pipe in 8½ in hole below a shoe at 400 m, and a mud of 1.2 sg."""
    hole = {"diameter": 0.2159, "friction": 0.2}
    intervals = [{"to_md": 400, "kind": "cased", **hole}, {"to_md": 1000, "kind": "open", **hole}]
    given: dict[str, Any] = {
        "components": [pipe(None, 20)],
        "wellbore": {"intervals": intervals, "window": WINDOW},
        "mud": {"density": 1200.0, "rheology": {"plastic_viscosity": 0.03, "yield_point": 3.0}},
    }
    return make_case(**(given | sections))


def test_casing_of_a_textbook() -> None:
    """Guo & Liu's example 2.8: 10¾ in in 14¾ in at 110 ft/min, 6,400 ft, 15.5 ppg, 37 cP, 6 lbf/100 ft²: they print 67
    psi with the wrong sign of the clinging speed; with the right one it is 91.0 psi (exactly 88.5)."""
    depth = 6400 * FT
    case = make_case(
        [[0, 0, 0], [depth, 0, 0]],
        [pipe(None, 20, outer=10.75 * INCH, inner=10.05 * INCH)],
        wellbore={"intervals": [{"to_md": depth, "diameter": 14.75 * INCH, "friction": 0.2}]},
        mud={"density": 15.5 * PPG, "rheology": {"plastic_viscosity": 0.037, "yield_point": 6 * 0.478803}},
    )
    found = surge_pressures(case, ["110 ft/min"], end="closed")
    assert found["surge_Pa"].to_numpy() / PSI == pytest.approx([91.0, -91.0], rel=0.002)
    assert found["density_bit_kg_m3"].to_numpy() - 15.5 * PPG == pytest.approx(found["surge_Pa"] / (G * depth))


def test_ends_let_mud_through_as_they_are() -> None:
    """An open bore takes mud in and gives it back, a float gives it back alone."""
    found = surge_pressures(well(), [0.5], end=ENDS).set_index(["operation", "end"])
    surge, into = found["surge_Pa"], found["into_bore_m3_s"]
    for kind, sign in (("trip_in", 1.0), ("trip_out", -1.0)):
        assert 0 < sign * surge[kind, "open"] < sign * surge[kind, "closed"]
        assert sign * into[kind, "open"] > 0
    assert surge["trip_in", "float"] == surge["trip_in", "closed"]
    assert surge["trip_out", "float"] == surge["trip_out", "open"]
    assert (found.loc["trip_in", "lift_N"] > 0).all()
    assert found["shoe_surge_Pa"].abs().lt(found["surge_Pa"].abs()).all()


def test_the_fastest_trip_is_at_the_edge_of_the_window() -> None:
    """At that speed the pressure at its depth is that of pores or fractures, as written down here."""
    narrow = well(wellbore={**well().wellbore.model_dump(exclude_none=True, exclude={"window"}), "window": [
        {"tvd": 0, "pore": 1120.0, "fracture": 1300.0}, {"tvd": 1000, "pore": 1150.0, "fracture": 1260.0},
    ]})  # fmt: skip
    found = fastest_trips(narrow, [600.0, 1000.0], end="closed").set_index(["operation", "bit_depth_m"])
    for kind, sign, density in (("trip_in", 1, 1260.0), ("trip_out", -1, 1150.0)):
        speed, md = found.loc[(kind, 1000.0), ["fastest_m_s", "md_m"]]
        assert 0.05 < speed < 2.0
        assert md == 1000.0
        change = surge_pressures(narrow, [speed], operation=kind, end="closed")["surge_Pa"][0]
        assert change == pytest.approx((density - 1200) * G * 1000, rel=1e-4)
        assert np.sign(change) == sign
        assert found.loc[(kind, 600.0), "fastest_m_s"] >= speed


def test_time_of_a_trip_is_that_of_moving_and_of_connections() -> None:
    """At 0.5 m/s, which the window bears: 800 s of moving and a minute for each stand of 28.5 m."""
    found = fastest_trips(well(), [200.0, 400.0, 600.0], operation="trip_in", most=0.5)
    assert found["fastest_m_s"].tolist() == [0.5] * 3
    assert found["time_s"].iloc[-1] == pytest.approx(400 / 0.5 + 400 / 28.5 * 60)


def test_a_window_that_no_trip_stays_in_says_why() -> None:
    dense = well(mud={"density": 1350.0, "viscosity": 0.03})
    stiff = well(mud={"density": 1299.0, "rheology": {"plastic_viscosity": 0.03, "yield_point": 30.0}})
    for case, reason in ((dense, "mud at rest is outside the window"), (stiff, "yield stress of the mud alone")):
        row = fastest_trips(case, operation="trip_in", end="closed").iloc[0]
        assert (row["fastest_m_s"], row["reason"]) == (0.0, reason)
    assert np.isnan(fastest_trips(dense, [500.0, 1000.0], operation="trip_in")["time_s"].iloc[-1])


def test_rounding_at_the_table_leaves_no_window() -> None:
    """Open hole to the surface: there a window has no width, and a surge of 1e-12 Pa had closed it to all trips."""
    hole = [{"to_md": 1000, "diameter": 0.2159, "friction": 0.2}]
    open_hole = well(wellbore={"intervals": hole, "window": WINDOW})
    found = fastest_trips(open_hole, list(np.arange(400.0, 1000.0, 37.0)), end="closed")
    assert found["fastest_m_s"].min() > 0.5


def test_what_is_left_of_the_window_counts_below_the_bit_too() -> None:
    trip = Trip(lay(well(), 500.0), 1, "closed")
    rest, moving = trip.left(0.0)[0], trip.left(0.5)[0]
    assert rest == pytest.approx(100 * G * 400)  # at the shoe, where least is left
    assert moving < rest


@pytest.mark.parametrize(
    ("case", "asked", "told"),
    [
        ({}, {"operation": "drill_rotating"}, 'operation = "drill_rotating": expected "trip_in" or "trip_out"'),
        ({}, {"end": "shut"}, 'end = "shut": expected "open" or "closed" or "float"'),
        ({"mud": {"density": 1200.0}}, {}, "mud.fann is missing"),
        ({}, {"bit_depths": [2000.0]}, "bit_depths"),
        ({"mud": HEAVIER}, {"end": ["closed", "float"]}, 'end = "float": expected "closed", as .* falls freely at'),
    ],
)
def test_what_cannot_be_tripped_is_told_in_a_sentence(case: dict[str, Any], asked: dict[str, Any], told: str) -> None:
    with pytest.raises(InputError, match=told):
        surge_pressures(well(**case), [0.5], **asked)


def test_a_heavier_column_above_a_closed_end_is_tripped() -> None:
    found = surge_pressures(well(mud=HEAVIER), [0.5], end="closed")
    alone = surge_pressures(well(mud={"density": 1200.0, "viscosity": 0.03}), [0.5], end="closed")
    assert found["surge_Pa"].tolist() == alone["surge_Pa"].tolist()


def test_a_window_is_asked_for() -> None:
    with pytest.raises(InputError, match=r"wellbore.window is missing: expected rows of tvd, pore and fracture"):
        fastest_trips(well(wellbore={}))


def test_one_speed_as_a_text_is_one_speed() -> None:
    """Its letters were speeds: "expected a speed ... speeds = '.'"."""
    for one in ("0.5 m/s", 0.5):
        pd.testing.assert_frame_equal(surge_pressures(well(), one), surge_pressures(well(), [0.5]))
