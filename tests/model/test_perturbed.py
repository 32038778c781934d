"""Noise of the size of rounding, by its seed: in the case, by the environment, and what it leaves alone."""

import numpy as np
import pytest

import fctd
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.mechanics.contact import DIRECTION, NORMAL
from fctd.model.drillstring import lay_out
from fctd.model.perturbed import SHARE, perturb_stations
from fctd.model.wellbore import build_wellbore
from tests.cases import make_case, pipe

STATIONS = [[0, 0, 0], [400, 0, 0], [700, 30, 120], [900, 30, 120], [1200, 31, 120]]


def case_of(seed: int | None, geometry: str = "arcs") -> Case:
    return make_case(
        STATIONS, [pipe(None, None, segment_length=30.0)], wellbore={"geometry": geometry}, solver={"perturbed": seed}
    )


def test_each_segment_has_its_own_noise() -> None:
    plain, noisy = (lay_out(case_of(seed), 1100.0).length for seed in (None, 3))
    relative = noisy / plain - 1
    assert 0.5 * SHARE < relative.std() < 2 * SHARE
    assert len(set(relative)) > 0.9 * len(relative)
    np.testing.assert_array_equal(noisy, lay_out(case_of(3), 1100.0).length)
    assert (noisy != lay_out(case_of(4), 1100.0).length).any()


def test_stations_keep_their_order_the_ends_of_the_hole_and_vertical_hole() -> None:
    stations = np.array([[0, 0, 0], [400, 0, 0], [700, 0.5, 2], [900, 0.5, 2]], float)
    noisy = perturb_stations(stations, 3)
    assert (noisy[[0, -1], 0] == [0, 900]).all()
    assert (noisy[:2, 1] == 0).all()
    np.testing.assert_allclose(noisy, stations, rtol=0, atol=2e-9)
    assert (noisy[1:, 0] != stations[1:, 0]).sum() == 2
    assert (noisy[:, 2] != stations[:, 2]).all()


@pytest.mark.parametrize("geometry", ["arcs", "cylinders"])
def test_a_string_with_one_balance_keeps_its_loads(geometry: str) -> None:
    """As far as the springs say: positions of a kilometre are rounded to 1e-13 m, and springs have 1e9 N/m."""
    loads = []
    for seed in (None, 0, 1):
        point = fctd.equilibrium(case_of(seed, geometry), operation="rotate_off_bottom", bit_depth=1100.0)
        loads.append((point.hookload, point.surface_torque))
    np.testing.assert_allclose(loads[1:], loads[:1] * 2, rtol=1e-8)


def test_courses_that_hardly_bend_have_normals_across_the_hole() -> None:
    """What is left of the difference of two tangents is rounding, some of it along the hole: 0.05 % of a hook load."""
    pieces = build_wellbore(case_of(7)).pieces
    along = np.einsum("ij,ij->i", pieces[1:, DIRECTION : DIRECTION + 3], pieces[1:, NORMAL : NORMAL + 3])
    assert np.abs(along).max() < 1e-15


def test_the_environment_sets_the_default(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FCTD_PERTURBED", "5")
    assert make_case().solver.perturbed == 5
    assert make_case(solver={"step": "largest"}).solver.perturbed == 5
    assert make_case(solver={"perturbed": 6}).solver.perturbed == 6
    monkeypatch.setenv("FCTD_PERTURBED", "many")
    with pytest.raises(InputError, match=r"FCTD_PERTURBED = .many.: expected a whole number"):
        make_case()
    monkeypatch.setenv("FCTD_PERTURBED", "")
    assert make_case().solver.perturbed is None
