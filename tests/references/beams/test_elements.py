"""The finite-element beam converges to exact solutions with its theoretical order."""

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipeinc, ellipk, ellipkinc
from skfem import BilinearForm, LinearForm

from fctd.case.surveys.stations import to_radians
from fctd.model.section import Section
from references.beams.elements import Beam, ConvergenceError, Surroundings, newton, statics
from references.beams.planar_hole import PlanarHole


def section(EA, EI, shear):
    return Section(1.0, 0.0, 1e-4, 1e-4, EA, 1.0, EI, shear, 0.02, 0.01, 0.02, 931e6)


def beam(elements, *, EA=1e4, EI=1.0, shear=4e3, **around):
    return Beam(np.linspace(0.0, 1.0, elements + 1), section(EA, EI, shear), Surroundings(**around))


def orders(errors):
    return np.diff(np.log(errors)) / np.log(0.5)


def clamped(given, q, load=None):
    return statics(given, q, given.dofs(0.0), load)


def test_tangent_is_the_derivative_of_the_forces():
    hole = PlanarHole(to_radians(np.array([[0, 0, 0], [5, 0, 0], [25, 60, 0]], dtype=float)))
    around = Surroundings(hole, 0.02, 3e3, 0.2, 0.025, 0.05, 20.0, 5.0, 9.0)
    bent = Beam(np.linspace(0, 20, 9), section(1e4, 50.0, 4e3), around)
    rng = np.random.default_rng(1)
    q = bent.straight(0.0) + 0.02 * rng.standard_normal(bent.strains.N)
    v = 0.05 * rng.standard_normal(bent.strains.N)
    direction = rng.standard_normal(bent.strains.N)
    rate, h = 7.0, 1e-7
    _, tangent, load = bent.resistance(q, v, rate)
    assert np.mean(load.pressure != 0) > 0.2
    assert load.friction_loss.min() >= 0
    assert load.mud_loss.min() >= 0
    ahead, behind = (bent.resistance(q + s * h * direction, v + s * h * rate * direction)[0] for s in (1, -1))
    assert tangent @ direction == pytest.approx(
        (ahead - behind) / (2 * h), abs=1e-6 * np.abs(tangent @ direction).max()
    )


def test_tables_assemble_as_the_forms_of_scikit_fem():
    """Nodal forces, tangents and masses from the tables equal those of scikit-fem's own assembly."""
    model = Beam(np.array([0.0, 0.6, 1.0]), section(1e4, 50.0, 4e3), Surroundings(weight=3.0))
    rng = np.random.default_rng(2)
    q = rng.standard_normal(model.strains.N)

    def components(field):
        return np.concatenate([field.grad[:, 0], np.asarray(field)[2:]])

    density, derivative = rng.standard_normal((4, 2, 2)), rng.standard_normal((4, 4, 2, 2))
    force = LinearForm(lambda v, w: (components(v) * w.density).sum(axis=0))
    tangent = BilinearForm(lambda u, v, w: np.einsum("iep,ijep,jep->ep", components(v), w.derivative, components(u)))
    inertia = BilinearForm(lambda u, v, w: 1.0 * (u[0] * v[0] + u[1] * v[1]) + 1e-4 * u[2] * v[2])
    weight = LinearForm(lambda v, w: 3.0 * v[0])
    strained = model.strained
    assert strained.of(q) == pytest.approx(components(model.strains.interpolate(q)))
    assert strained.forces(density) == pytest.approx(force.assemble(model.strains, density=density))
    found = strained.matrix(strained.tangents(derivative)).toarray()
    assert found == pytest.approx(tangent.assemble(model.strains, derivative=derivative).toarray())
    assert model.mass.toarray() == pytest.approx(inertia.assemble(model.wall).toarray(), abs=1e-12)
    assert model.gravity == pytest.approx(weight.assemble(model.wall), abs=1e-12)


def test_elastica_tip():
    """A dead load across the end of an inextensible cantilever (Bisshopp & Drucker 1945), α = PL²/EI = 4."""
    alpha = 4.0

    def modulus(theta):
        return 0.5 * (1 + np.sin(theta))

    def angle(theta):
        return np.arcsin(1 / np.sqrt(2 * modulus(theta)))

    theta = brentq(lambda t: ellipk(modulus(t)) - ellipkinc(angle(t), modulus(t)) - np.sqrt(alpha), 0.1, 1.5)
    across = 1 - 2 / np.sqrt(alpha) * (ellipe(modulus(theta)) - ellipeinc(angle(theta), modulus(theta)))
    along = np.sqrt(2 * np.sin(theta) / alpha)
    errors = []
    for elements in (2, 4, 8):
        model = beam(elements, EA=1e7, shear=1e7)
        end, load, q = model.dofs(1.0), np.zeros(model.strains.N), model.straight(0.0)
        for share in (0.25, 0.5, 0.75, 1.0):
            load[end[1]] = share * alpha
            q = clamped(model, q, load)
        errors.append(np.abs(q[end] - [along, across, theta]).max())
    assert across == pytest.approx(0.67000, abs=5e-4)  # Bisshopp & Drucker's curve
    assert errors[-1] < 1e-4
    assert orders(errors) == pytest.approx([4, 4], abs=0.4)


def test_euler_load_with_shear_and_compression():
    """A clamped-free column buckles at P(1 − P/EA + P/κGA) = π²EI/4L²: the second variation at the straight state."""
    EA, shear = 400.0, 50.0
    exact = brentq(lambda p: p * (1 - p / EA + p / shear) - np.pi**2 / 4, 0.1, 3.0)
    errors = []
    for elements in (1, 2, 4):
        model = beam(elements, EA=EA, shear=shear)
        free = np.setdiff1d(np.arange(model.strains.N), model.dofs(0.0))

        def softest(p, model=model, free=free):
            q = model.straight(0.0) * (1 - p / EA)
            tangent = model.resistance(q, 0 * q)[1].toarray()[np.ix_(free, free)]
            return np.linalg.eigvalsh(tangent)[0]

        errors.append(abs(brentq(softest, 1.0, 4.0, xtol=1e-12) / exact - 1))
    assert errors[0] < 0.02
    assert orders(errors) == pytest.approx([4, 4], abs=0.2)


def test_cantilever_with_shear_under_its_weight():
    """A level cantilever: w(s) of Timoshenko's beam; third order in the mean square, fourth at nodes."""
    weight, shear = 1e-5, 20.0
    mean, tip = [], []
    for elements in (2, 4, 8):
        model = beam(elements, EA=1e3, shear=shear, weight=weight)
        s, numbers = model.points()
        q = np.zeros(model.strains.N)
        q[numbers[:, 1]], q[numbers[:, 2]] = s, np.pi / 2
        found = model.wall.interpolate(clamped(model, q))
        s = model.wall.mapping.F(model.wall.X)[0]
        exact = weight * (s**2 * (6 - 4 * s + s**2) / 24 + (s - 0.5 * s**2) / shear)
        mean.append(np.sqrt(model.integrate((np.asarray(found)[0] - exact) ** 2)) / weight)
        tip.append(abs(clamped(model, q)[model.dofs(1.0)[0]] / (weight * (1 / 8 + 0.5 / shear)) - 1))
    assert orders(mean) == pytest.approx([3, 3], abs=0.25)
    assert tip[1] < 1e-4


def test_thin_beam_does_not_lock():
    model = beam(2, EA=1e7, shear=1e7)
    load, end = np.zeros(model.strains.N), model.dofs(1.0)
    load[end[1]] = 1e-2
    q = statics(model, model.straight(0.0), model.dofs(0.0), load)
    assert q[end[1]] == pytest.approx(1e-2 / 3, rel=1e-4)


def test_pipe_lies_on_the_low_side_of_an_inclined_hole():
    hole = PlanarHole(to_radians(np.array([[0, 60, 0], [40, 60, 0]], dtype=float)))
    around = Surroundings(hole, clearance=0.05, stiffness=1e5, weight=30.0)
    model = Beam(np.linspace(0, 20, 11), section(1e6, 10.0, 1e6), around)
    s, numbers = model.points()
    # Clamped along the hole at its low side, as deep in the wall as its weight presses.
    sunk = 0.05 + 30 * np.sin(np.pi / 3) / 1e5
    q = np.zeros(model.strains.N)
    q[numbers[:, 0]] = 0.5 * s + sunk * np.sin(np.pi / 3)
    q[numbers[:, 1]] = np.sin(np.pi / 3) * s - 0.5 * sunk
    q[numbers[:, 2]] = np.pi / 3
    q = statics(model, q, model.dofs(0.0))
    load = model.wall_load(q, np.zeros_like(q))
    assert model.integrate(load.pressure) == pytest.approx(-30 * np.sin(np.pi / 3) * 20, rel=1e-6)


@pytest.mark.parametrize("side", [1, -1])
def test_friction_acts_where_the_pipe_touches(side):
    """A section that rotates about its point at the wall does not slide; one that rotates in place does."""
    hole = PlanarHole(to_radians(np.array([[0, 30, 0], [40, 30, 0]], dtype=float)))
    radius, turning, deep = 0.3, 0.7, 1e-3
    around = Surroundings(hole, 0.05, 1e3, friction=0.5, radius=radius, creep=1e-4)
    model = Beam(np.array([0.0, 1.0]), section(1e4, 1.0, 4e3), around)
    along, normal = np.array([np.sqrt(0.75), 0.5]), np.array([-0.5, np.sqrt(0.75)])
    s, numbers = model.points()
    q, rolling = np.zeros(model.strains.N), np.zeros(model.strains.N)
    q[numbers[:, :2]] = s[:, None] * along + side * (0.05 + deep) * normal
    q[numbers[:, 2]] = np.pi / 6
    rolling[numbers[:, 2]] = turning
    # The wall side lies at +side·radius along the normal and turns towards −side·tangent.
    in_place = model.wall_load(q, rolling)
    limit = 0.5 * 1e3 * deep
    assert in_place.resistance[2] == pytest.approx(limit * radius)
    assert in_place.friction_loss == pytest.approx(limit * radius * turning)
    assert np.einsum("i,iep->ep", along, in_place.resistance[:2]) == pytest.approx(-side * limit)
    rolling[numbers[:, :2]] = side * radius * turning * along
    assert model.wall_load(q, rolling).friction_loss == pytest.approx(0.0, abs=1e-9)


def test_a_wall_at_the_ends_of_elements_is_the_trapezoidal_rule():
    hole = PlanarHole(to_radians(np.array([[0, 0, 0], [40, 0, 0]], dtype=float)))
    around = Surroundings(hole, clearance=0.05, stiffness=1e3, weight=3.0)
    coarse = Beam(np.array([0.0, 0.6, 1.0]), section(1e4, 1.0, 4e3), around, at_ends=True)
    q, (s, numbers) = coarse.straight(0.0), coarse.points()
    q[numbers[:, 1]] = 0.1 * s
    load = coarse.wall_load(q, np.zeros_like(q))
    assert coarse.integrate(load.pressure) == pytest.approx(1e3 * ((0.06 - 0.05) * 0.5 + (0.1 - 0.05) * 0.2))
    assert coarse.gravity.sum() == pytest.approx(3.0)
    fine = Beam(coarse.nodes, coarse.section, around)
    assert coarse.mass.toarray() == pytest.approx(fine.mass.toarray())


def test_failed_newton_iteration_is_an_error():
    model = beam(2)
    with pytest.raises(ConvergenceError, match="unbalanced force"):
        newton(lambda q: (q * 0 + np.nan, model.mass), model.straight(0.0), np.array([4, 5]), 1.0)


def test_too_few_iterations_are_said():
    """A dead load that bends a cantilever far takes several; one is not enough."""
    model = beam(2)
    load, free = np.zeros(model.strains.N), np.setdiff1d(np.arange(model.strains.N), model.dofs(0.0))
    load[model.dofs(1.0)[1]] = 1.0

    def residual(q):
        force, tangent, _ = model.resistance(q, 0 * q)
        return force - load, tangent

    _, taken = newton(residual, model.straight(0.0), free, 1e-6)
    assert taken > 2
    with pytest.raises(ConvergenceError, match="N after 2 iterations"):
        newton(residual, model.straight(0.0), free, 1e-6, most=2)
