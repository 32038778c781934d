"""Costs of contact methods: fronts, crossovers, wrappers."""

import numpy as np
import pandas as pd
import pytest

from references import contact
from validation.parts.contact_costs import OWN, crossover, pareto, wrapper_time
from validation.parts.wall_points import near_wall, the_case


def test_a_front_holds_what_no_other_row_beats_in_both() -> None:
    cost = pd.Series([1.0, 2.0, 3.0, 2.5, np.nan])
    error = pd.Series([3.0, 2.0, 2.5, 1.0, 0.0])
    assert pareto(cost, error).tolist() == [True, True, False, True, False]
    assert pareto(pd.Series([1.0, 1.0]), pd.Series([1.0, 1.0])).all()


def test_a_crossover_is_where_two_straight_lines_of_cost_meet() -> None:
    """Own: 1000 ns a call and 50 ns a point; the other: 9000 ns a call and 10 ns a point: they meet at 200 points."""
    single, many = pd.Series({OWN: 1050.0, "other": 9010.0}), pd.Series({OWN: 50.0, "other": 10.0})
    assert crossover(single, many, "other") == pytest.approx(200.0)
    assert crossover(single, many, OWN) == np.inf
    assert crossover(single, pd.Series({OWN: 5.0, "other": 10.0}), "other") == np.inf


def test_the_wrapper_of_a_mesh_is_what_follows_its_query(monkeypatch: pytest.MonkeyPatch) -> None:
    case = the_case()
    points, _ = near_wall(case, 250)
    method = contact.build("libigl", case)
    near = method.nearest(points.places)  # type: ignore[attr-defined]
    assert len(near) == 3
    queries: list[int] = []
    query = type(method).query
    monkeypatch.setattr(type(method), "query", lambda *given: queries.append(1) or query(*given))
    assert wrapper_time(method, points, 3) > 0
    assert len(queries) == 1  # what is timed is the rest
