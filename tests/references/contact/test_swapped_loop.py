"""Another contact method in FCTD's loop: the same run for the same wall, and a fault that ends a run."""

import numpy as np
import pytest

from fctd import Case, InputError, simulate
from fctd.mechanics import state
from fctd.model.wellbore import Contacts, build_wellbore
from fctd.simulation.run import prepare
from references import contact
from references.contact.for_loop import advance_with_for_loop
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


@pytest.mark.parametrize(
    ("name", "geometry"), [("cylinders", "cylinders"), ("arcs", "arcs"), ("for_loop", "cylinders")]
)
@pytest.mark.parametrize("law", ["coulomb", "paper"])
def test_the_same_wall_gives_the_same_run(name: str, geometry: str, law: str) -> None:
    """With two hole sizes and friction factors: stiffness and friction come from the case, not from the method."""
    case = turning(geometry, contact={"friction_law": law})
    own, swapped = simulate(case), simulate(case, contact=contact.build(name, case))
    assert swapped.status == "completed"
    assert swapped.run["contact"] == name
    assert own.run["contact"] == geometry
    assert swapped.run["step_s"] == own.run["step_s"]
    scale = own.history.select_dtypes("number").abs().max()
    # The remaining difference is that of the start: the run with the other method settles a little longer.
    difference = (own.history.select_dtypes("number") - swapped.history.select_dtypes("number")).abs().max()
    assert (difference <= 2e-3 * scale + 1e-9).all()
    assert own.history["contact_count"].max() > 5


def test_the_compiled_for_loop_equals_fctd_where_its_cylinder_is_unique() -> None:
    case = turning()
    (run, phases), (loop, _) = prepare(case), prepare(case)
    motion, steps = phases[0].motion, 400
    run.advance(motion, steps * run.step)
    advance_with_for_loop(
        loop.S, loop.top, loop.segments, loop.hole.pieces, loop.laws, motion, loop.pipe, loop.step, steps
    )
    for offset in (state.X, state.Y, state.Z):
        places = (state.row(of.S, offset, run.segments) for of in (loop, run))
        np.testing.assert_allclose(*places, atol=1e-9)
    assert state.row(loop.S, state.SUM_NORMAL, run.segments).sum() > 0


def test_loads_of_a_turning_string_with_fcl_are_those_of_fctd() -> None:
    pytest.importorskip("fcl")
    case = turning()
    own = simulate(case).history.iloc[-1]
    mesh = simulate(case, contact=contact.build("fcl", case, facets=96)).history.iloc[-1]
    assert mesh["total_contact_force_N"] == pytest.approx(own["total_contact_force_N"], rel=0.02)
    assert mesh["surface_torque_N_m"] == pytest.approx(own["surface_torque_N_m"], rel=0.1)


class Faulty:
    """Cylinders whose result is changed by ``spoil`` after 1000 queries."""

    name = "faulty"

    def __init__(self, case: Case, spoil) -> None:
        self.good, self.spoil, self.queries = contact.build("cylinders", case), spoil, 0

    def query(self, points, radii) -> Contacts:
        self.queries += 1
        hits = self.good.query(points, radii)
        return self.spoil(hits) if self.queries > 1000 else hits


def test_a_method_with_results_that_are_not_finite_ends_the_run_and_keeps_its_rows() -> None:
    case = turning()

    faulty = Faulty(case, lambda hits: hits._replace(normal=np.full_like(hits.normal, np.nan)))
    result = simulate(case, contact=faulty)
    assert result.status == "unstable"
    assert "not finite" in result.message
    assert len(result.history) > 0


def test_a_result_of_the_wrong_shape_is_an_error() -> None:
    case = turning()
    with pytest.raises(ValueError, match=r"faulty.*25 points"):
        simulate(case, contact=Faulty(case, lambda hits: hits._replace(md=hits.md[:-1])))


def test_another_contact_method_without_contact_is_an_error() -> None:
    case = turning(contact={"enabled": False})
    with pytest.raises(InputError, match=r"contact\.enabled"):
        simulate(case, contact=contact.build("cylinders", case))


def test_the_wall_along_the_hole_changes_from_one_size_to_the_next() -> None:
    wall = build_wellbore(turning()).wall_along()
    np.testing.assert_allclose(wall[:, :2], [[350, 0.12], [350.2, 0.10795]])
    np.testing.assert_allclose(wall[:, 3], [0.3, 0.2])
