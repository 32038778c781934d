"""A caller's contact method in a run: points without contact, and faults of the method that end the run."""

from collections.abc import Callable

import numpy as np
import pytest

from fctd import Case, InputError, simulate
from fctd.arrays import Array, Contacts
from fctd.mechanics import state
from fctd.model.wellbore import build_wellbore, find_contacts
from fctd.simulation.preparation import prepare
from tests.cases import make_case, pipe, rotation

STATIONS = [[0, 0, 0], [100, 0, 0], [400, 60, 30], [600, 60, 30]]


SIZES = [{"to_md": 350, "diameter": 0.24, "friction": 0.3}, {"to_md": 600, "diameter": 0.2159, "friction": 0.2}]


def turning(geometry: str = "cylinders", **sections) -> Case:
    return make_case(
        STATIONS,
        [pipe(500, 25)],
        [rotation(500, 3, ramp=1)],
        wellbore={"geometry": geometry, "intervals": SIZES},
        record={"interval": 0.5},
        **sections,
    )


class Faulty:
    """The hole's own contacts, with a fault after a number of queries."""

    name = "faulty"

    def __init__(self, case: Case, spoil: Callable[[Contacts], Contacts], after: int = 10) -> None:
        self.hole, self.spoil, self.after, self.asked = build_wellbore(case), spoil, after, 0

    def query(self, points: Array, radii: Array) -> Contacts:
        self.asked += 1
        hits = find_contacts(self.hole, np.nan_to_num(points), radii)
        return self.spoil(hits) if self.asked > self.after else hits


def part_way(spoiled: Array, other: float | Array) -> Array:
    """The values of a method of which one in two is another."""
    found = spoiled.copy()
    found[::2] = other
    return found


FAULTS = {
    "a penetration that is not a number": lambda hits: hits._replace(penetration=part_way(hits.penetration, np.nan)),
    "a penetration that is larger than": lambda hits: hits._replace(penetration=1e3 * hits.penetration),
    "normal is no unit vector": lambda hits: hits._replace(normal=np.full_like(hits.normal, np.nan)),
    "normal is no unit vector,": lambda hits: hits._replace(normal=1.1 * hits.normal),
    "depth along the hole is not a number": lambda hits: hits._replace(md=np.full_like(hits.md, np.nan)),
    "normals that point into the hole at": lambda hits: hits._replace(normal=-hits.normal),
    "deep in the wall": lambda hits: hits._replace(penetration=np.full_like(hits.penetration, -np.inf)),
}


@pytest.mark.parametrize("says", FAULTS)
def test_a_method_with_a_fault_stops_the_run_and_keeps_its_rows(says: str) -> None:
    """Whatever is wrong with its answers, the run is not completed, and the message names the method."""
    case = turning()
    # Long enough for a string without a wall to leave a hole of 24 cm, half a metre of fall.
    case = case.model_copy(update={"operations": make_case(operations=[rotation(500, 6, ramp=1)]).operations})
    result = simulate(case, contact=Faulty(case, FAULTS[says], after=1200))
    assert result.status == "unstable"
    assert "contact method 'faulty'" in result.message
    assert says.rstrip(",") in result.message
    assert len(result.history) > 0


@pytest.mark.parametrize(
    "spoil",
    [lambda hits: hits._replace(md=hits.md[:-1]), lambda hits: hits[:2], lambda _: None, lambda _: (["a"], [], [])],
)
def test_what_are_no_contacts_is_an_error(spoil: Callable[[Contacts], Contacts]) -> None:
    case = turning()
    with pytest.raises(InputError, match=r"expected penetration \(25,\), .* from contact method 'faulty'"):
        simulate(case, contact=Faulty(case, spoil))


def test_lists_are_contacts_too() -> None:
    case = turning()
    as_lists = Faulty(case, lambda hits: Contacts(*(part.tolist() for part in hits)), after=0)
    found, expected = simulate(case, contact=as_lists), simulate(case, contact=Faulty(case, lambda hits: hits))
    assert found.history["hookload_N"].to_list() == expected.history["hookload_N"].to_list()


def test_a_name_is_no_method() -> None:
    with pytest.raises(InputError, match='contact = "fcl": expected an object with name and query'):
        simulate(turning(), contact="fcl")  # type: ignore[arg-type]


def test_no_wall_and_another_contact_method_exclude_each_other() -> None:
    case = turning(contact={"enabled": False})
    with pytest.raises(InputError, match=r"contact\.enabled"):
        simulate(case, contact=Faulty(case, lambda hits: hits))


class Nothing:
    """No contact anywhere: values that are not read may be NaN."""

    name = "nothing"

    def query(self, points: Array, radii: Array) -> Contacts:
        return Contacts(np.full(len(points), -1e-3), np.full_like(points, np.nan), np.full(len(points), np.nan))


def test_without_contacts_the_run_is_that_without_a_wall() -> None:
    case = make_case([[0, 0, 0], [300, 0, 0]], [pipe(200, 10)], [rotation(200, 1, ramp=0.5)])
    bare = case.model_copy(update={"contact": case.contact.model_copy(update={"enabled": False})})
    found, expected = simulate(case, contact=Nothing()), simulate(bare)
    assert found.status == expected.status == "completed"
    assert found.history["total_contact_force_N"].to_list() == [0.0] * len(found.history)
    for name in ("hookload_N", "surface_torque_N_m"):
        # The one with a method settles a step longer.
        assert found.history[name].to_numpy() == pytest.approx(expected.history[name].to_numpy(), rel=1e-5, abs=5e-3)


def test_walls_change_size_stiffness_and_friction_over_the_length_of_a_shoe() -> None:
    """The method gives the place of a contact; radius, stiffness and friction of the hole there come from the case."""
    intervals = [
        {"to_md": 100, "diameter": 0.32, "friction": 0.1, "stiffness": 2e7},
        {"to_md": 300, "diameter": 0.22, "friction": 0.3, "rotational_friction": 0.2},
    ]
    case = make_case([[0, 30, 0], [300, 30, 0]], [pipe(None, 30)], wellbore={"intervals": intervals, "overlap": 20.0})
    case = case.model_copy(update={"operations": make_case(operations=[rotation(300, 1)]).operations})
    run, _ = prepare(case, Everywhere(30))
    run.refresh()
    S = run.S
    # Depths of the query: 5, 15, 25 ... m; the shoe leads from 100 to 120 m.
    md = 10.0 * np.arange(30) + 5.0
    share = np.clip((md - 100) / 20, 0, 1)
    np.testing.assert_allclose(state.row(S, state.HOLE, 30), 0.16 - 0.05 * share)
    np.testing.assert_allclose(state.row(S, state.K_WALL, 30), 2e7 - 1e7 * share)
    np.testing.assert_allclose(state.row(S, state.FRICTION, 30), 0.1 + 0.2 * share)
    np.testing.assert_allclose(state.row(S, state.FRICTION_AROUND, 30), 0.1 + 0.1 * share)
    assert run.laws.orthotropic
    reach = state.row(S, state.HOLE, 30) - state.row(S, state.RADIUS, 30) + 0.001
    np.testing.assert_allclose(state.row(S, state.PX, 30), reach)


class Everywhere:
    """A millimetre of penetration towards the north at every point, ten metres apart."""

    name = "everywhere"

    def __init__(self, segments: int) -> None:
        self.md = 10.0 * np.arange(segments) + 5.0

    def query(self, points: Array, radii: Array) -> Contacts:
        return Contacts(np.full(len(points), 1e-3), np.tile([1.0, 0.0, 0.0], (len(points), 1)), self.md)
