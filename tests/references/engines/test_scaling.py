"""The 1000:1 model: similitude and relabelling keep the loads, scaling of lengths alone does not."""

import pytest

from fctd import equilibrium
from references.engines.scaling import factors, scaled
from tests.cases import make_case, pipe, rotation

STATIONS = [[0, 0, 0], [100, 0, 0], [400, 60, 30], [600, 60, 30]]


def turning(**sections):
    return make_case(STATIONS, [pipe(500, 20)], [rotation(500, 8, ramp=1)], **sections)


@pytest.mark.parametrize("reading", ["similar", "relabelled"])
def test_loads_scale_back(reading: str) -> None:
    """Exact: forces scale by the cube of the length, to the solver's tolerance."""
    full = equilibrium(turning(), "rotate_off_bottom", 500.0)
    by, model = factors(reading), scaled(turning(), reading)
    point = equilibrium(model, "rotate_off_bottom", 500.0 * by.length)
    assert point.status == "converged"
    assert point.hookload / by.force == pytest.approx(full.hookload, rel=1e-6)
    assert point.surface_torque / by.force / by.length == pytest.approx(full.surface_torque, rel=1e-6)


def test_factors_of_similitude_follow_from_dimensions() -> None:
    """Every factor follows from those of length, time and force; gravity is kept (Froude number)."""
    by = factors("similar", 0.01)
    assert by.length / by.time**2 == pytest.approx(1.0)
    assert by.modulus == pytest.approx(by.force / by.length**2)
    assert by.stiffness == pytest.approx(by.force / by.length)
    assert by.damping == pytest.approx(by.force / (by.length / by.time))


def test_lengths_alone_make_a_stiffer_string() -> None:
    """The naive model at 1:10 equals the similar model of a string with ten times the modulus."""
    by, naive = factors("naive", 0.1), scaled(turning(), "naive", 0.1)
    stiffer = turning()
    component = stiffer.string.components[0].model_copy(update={"youngs_modulus": 2068e9})
    string = stiffer.string.model_copy(update={"components": (component,)})
    stiffer = stiffer.model_copy(update={"string": string})
    small = equilibrium(naive, "rotate_off_bottom", 50.0)
    large = equilibrium(stiffer, "rotate_off_bottom", 500.0)
    full = equilibrium(turning(), "rotate_off_bottom", 500.0)
    assert small.surface_torque / by.force / by.length == pytest.approx(large.surface_torque, rel=0.01)
    assert large.surface_torque != pytest.approx(full.surface_torque, rel=1e-3)
