"""Costs of contact methods: fronts, crossovers, batches that are not run."""

import numpy as np
import pandas as pd
import pytest

from fctd.arrays import Contacts
from references import contact
from validation.parts.contact_costs import BATCHES, OWN, Points, batches, crossover, pareto, wrapper_time
from validation.parts.wall_points import RADIUS, points_in, the_case


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


class Slow:
    """A method that takes 20 µs a point, too long for a batch of 100 000."""

    def __init__(self) -> None:
        self.asked: list[int] = []

    def query(self, points: np.ndarray, radii: np.ndarray) -> Contacts:
        import time

        self.asked.append(len(points))
        end = time.perf_counter() + 2e-5 * len(points)
        while time.perf_counter() < end:
            pass
        return Contacts(radii, points, radii)


def test_a_batch_that_would_take_too_long_is_not_run_and_says_so() -> None:
    case, slow = the_case(), Slow()
    sample = points_in(case, 50)
    points = Points(sample[["x", "y", "z"]].to_numpy(), np.full(len(sample), RADIUS))
    table = batches({OWN: contact.build(OWN, case), "slow": slow}, points, most=100_000, rounds=1).set_index("setting")  # type: ignore[dict-item]
    assert table["measured_100000"].to_dict() == {OWN: True, "slow": False}
    assert table["ns_100000"]["slow"] == table["ns_1000"]["slow"] > 1.9e4
    assert max(slow.asked) == 1000
    assert set(BATCHES) >= {1, 1000, 100_000}


def test_the_wrapper_of_a_mesh_is_what_follows_its_query(monkeypatch: pytest.MonkeyPatch) -> None:
    case = the_case()
    sample = points_in(case, 250)
    points = Points(np.ascontiguousarray(sample[["x", "y", "z"]]), np.full(len(sample), RADIUS))
    method = contact.build("libigl", case)
    near = method.nearest(points.places)  # type: ignore[attr-defined]
    assert len(near) == 3
    queries: list[int] = []
    query = type(method).query
    monkeypatch.setattr(type(method), "query", lambda *given: queries.append(1) or query(*given))
    assert wrapper_time(method, points, 3) > 0
    assert len(queries) == 1  # what is timed is the rest
