"""Another contact method in FCTD's loop: the same run for the same wall, and a fault that ends a run."""

import numpy as np
import pytest

from fctd import simulate
from fctd.mechanics import state
from fctd.model.wellbore import build_wellbore
from fctd.results.columns import BUCKLED
from fctd.simulation.preparation import prepare
from references import contact
from references.contact.for_loop import advance_with_for_loop
from tests.simulation.test_external_contact import turning

EXTENT = [column.name for column in BUCKLED]  # NaN where the string is not buckled


@pytest.mark.slow
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
    assert (swapped.history["buckling"] == own.history["buckling"]).all()
    numbers, others = (of.history.select_dtypes("number").drop(columns=EXTENT) for of in (own, swapped))
    scale = numbers.abs().max()
    # The remaining difference is that of the start: the run with the other method settles a little longer.
    difference = (numbers - others).abs().max()
    assert (difference <= 2e-3 * scale + 1e-9).all()
    assert own.history["contact_count"].max() > 5


@pytest.mark.slow  # half a minute of compiling in a new environment
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


@pytest.mark.slow
def test_loads_of_a_turning_string_with_fcl_are_those_of_fctd() -> None:
    """A facet leans by up to π/96 from the wall.  Force and friction keep that to its square; the torque at the top is
    also that of forces around the hole, of random sign at the contacts: three times their standard deviation."""
    case, facets = turning(), 96
    own = simulate(case).history.iloc[-1]
    mesh = simulate(case, contact=contact.build("fcl", case, facets=facets)).history.iloc[-1]
    lean = np.pi / facets
    for name in ("total_contact_force_N", "sum_r_ft_N_m"):
        assert mesh[name] == pytest.approx(own[name], rel=lean**2)
    assert mesh["surface_torque_N_m"] == pytest.approx(
        own["surface_torque_N_m"], rel=3 * lean / np.sqrt(3 * own["contact_count"])
    )


def test_the_wall_along_the_hole_leads_from_one_size_to_the_next() -> None:
    wall = build_wellbore(turning()).wall_along()
    np.testing.assert_allclose(wall[:, :2], [[350, 0.12], [350.2, 0.10795]])
    np.testing.assert_allclose(wall[:, 3], [0.3, 0.2])
