"""True vertical depths of fluids and temperature: those of the arcs, however few stations a survey has."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd import equilibrium, fastest_trips, hydraulics_of
from fctd.case.load import Case
from fctd.model.survey import tangents
from tests.cases import make_case, pipe

LENGTH, SHOE, BIT = 1500.0, 900.0, 1400.0
UNLIKE = {
    "inside": [{"to_md": 700.0, "density": 1300.0, "plug": True}, {"density": 200.0}], "density": 1250.0, "float": True,
    "outside": [{"to_md": 820.0, "density": 1100.0}, {"density": 1250.0}],
}  # fmt: skip
PUMPED = {"density": 1250.0, "viscosity": 0.03}
WINDOW = [
    {"tvd": 300.0, "pore": 1050.0, "fracture": 1700.0}, {"tvd": 700.0, "pore": 1100.0, "fracture": 1400.0},
    {"tvd": 1100.0, "pore": 1200.0, "fracture": 1500.0},
]  # fmt: skip


def well(stations: list[list[float]], mud: dict[str, Any]) -> Case:
    """A string of which neither the layout nor the friction depends on the stations."""
    intervals = [
        {"to_md": SHOE, "diameter": 0.3, "friction": 0.0, "kind": "cased"},
        {"to_md": LENGTH, "diameter": 0.25, "friction": 0.0},
    ]
    hole = {"geometry": "arcs", "survey_method": "minimum_curvature", "intervals": intervals, "window": WINDOW}
    warm = [{"tvd": 0.0, "change": 0.0}, {"tvd": 1500.0, "change": 90.0}]
    return make_case(stations, [pipe(None, 70)], wellbore=hole, mud=mud, temperature=warm)  # type: ignore[arg-type]


def dense(stations: list[list[float]], parts: int = 25) -> list[list[float]]:
    """Stations on the arcs between others: their tangents turn at a steady rate about one axis."""
    angles = np.radians(np.array(stations)[:, 1:])
    found = [stations[0]]
    of = tangents(np.column_stack([np.zeros(len(angles)), angles]))
    for (md, *_), (to_md, *_), first, last in zip(stations[:-1], stations[1:], of[:-1], of[1:], strict=True):
        turn = np.arccos(np.clip(first @ last, -1.0, 1.0))
        for share in np.arange(1, parts + 1) / parts:
            at = np.sin((1 - share) * turn) * first + np.sin(share * turn) * last if turn > 1e-6 else last
            inclination = np.degrees(np.arctan2(np.hypot(*at[:2]), at[2]))
            azimuth = np.degrees(np.arctan2(at[1], at[0])) % 360
            found.append([md + share * (to_md - md), float(inclination), float(azimuth)])
    return found


@settings(max_examples=6)
@given(st.tuples(*[st.floats(1.0, 89.0)] * 2), st.tuples(*[st.floats(20.0, 100.0)] * 2), st.floats(300.0, 700.0))
def test_stations_on_the_same_arcs_change_nothing(
    inclinations: tuple[float, float], azimuths: tuple[float, float], first: float
) -> None:
    """Pressures, what they use of the pipe, stretch, densities and the fastest trips of a hole with few stations."""
    stations = [
        [0.0, 0.0, azimuths[0]], [0.5 * first, 0.0, azimuths[0]],
        [0.5 * (first + LENGTH), inclinations[0], azimuths[0]], [LENGTH, inclinations[1], azimuths[1]],
    ]  # fmt: skip
    several = [well(of, UNLIKE) for of in (stations, dense(stations))]
    few, many = (equilibrium(case, "trip_in", BIT) for case in several)
    assert few.profile["md_m"].iloc[-1] == pytest.approx(many.profile["md_m"].iloc[-1], abs=1e-6)
    for column in ("inside_pressure_Pa", "outside_pressure_Pa", "true_tension_N"):
        assert few.profile[column].to_numpy() == pytest.approx(many.profile[column].to_numpy(), rel=1e-6, abs=1.0)
    assert few.shares == pytest.approx(many.shares, rel=1e-6, abs=1e-6)
    pumped = [well(of, PUMPED) for of in (stations, dense(stations))]
    for table in (
        lambda case: hydraulics_of(case, [0.03], [600.0, 1000.0, BIT]),
        lambda case: fastest_trips(case, [1000.0, BIT], end="closed"),
    ):
        rows, same = (table(case).select_dtypes("number").to_numpy() for case in pumped)
        assert rows == pytest.approx(same, rel=1e-6, abs=1e-6, nan_ok=True)
