"""The exact numbers of the rungs against integrals, eigenvalues and minima that were not used to write them."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.linalg import eigvalsh_tridiagonal
from scipy.optimize import brentq, minimize_scalar

from references.beams.beam_column import bending, deflect, grid
from validation.studies.ladder import bends, bha, capstan, fluids, grips, helix, statics, threshold, waves
from validation.studies.ladder.rung import case_of, pipe_of, section


@pytest.mark.parametrize("factors", [(0.3, 0.3), capstan.PAIR, (0.2, 0.4)])
def test_capstan_integrates_one_force_of_friction(factors):
    """dT/dθ = f_a N with N² + (f_r N)² = T²; f of all forces in the ellipse the one that takes most energy."""
    case = case_of(capstan.tables(6.0, factors))
    v = np.array(capstan.shares(case))
    angle = minimize_scalar(
        lambda phi: -factors[0] * np.cos(phi) * v[0] - factors[1] * np.sin(phi) * v[1], bounds=(0, 0.5 * np.pi),
        options={"xatol": 1e-10},
    ).x  # fmt: skip
    along, about = factors[0] * np.cos(angle), factors[1] * np.sin(angle)
    radius = 0.5 * case.string.components[1].contact_diameter

    def slopes(_, y):
        normal = y[0] / np.sqrt(1 + about**2)
        return [along * normal, about * radius * normal]

    pull = capstan.hanging(case)
    end = solve_ivp(slopes, (0, np.radians(capstan.ANGLE)), [pull, 0.0], rtol=1e-9).y[:, -1]
    assert capstan.drag(case) == pytest.approx(end[0] - pull, rel=1e-6)
    assert capstan.torque(case) == pytest.approx(end[1], rel=1e-6)


@pytest.mark.parametrize(("kind", "sign", "exact"), [("trip_out", 1, bends.hoisting), ("trip_in", -1, bends.lowering)])
def test_bends_integrate_along_the_string(kind, sign, exact):
    """dT/ds = w cos I ± μ |T/R − w sin I| from the bit up."""
    case = case_of(bends.build(kind, 6.0))
    w, factor = section(case).weight, bends.friction_of(case)

    def slope(s, tension):
        inclination = np.clip(0.5 * np.pi - (s - bends.LEVEL) / bends.RADIUS, 0.0, 0.5 * np.pi)
        inside = bends.LEVEL <= s <= bends.LEVEL + bends.RADIUS * bends.QUARTER
        side = tension / bends.RADIUS * inside - w * np.sin(inclination)
        return w * np.cos(inclination) + sign * factor * np.abs(side)

    end = solve_ivp(slope, (0, bends.DEPTH), [0.0], rtol=1e-9, max_step=1.0).y[0, -1]
    assert exact(case) == pytest.approx(sign * (end - bends.free(case)), rel=1e-4)


def test_the_torque_of_a_bend_counts_both_sides():
    case = case_of(bends.build("rotate_off_bottom", 6.0))
    share, _ = quad(lambda angle: abs(1 - 2 * np.sin(angle)), 0, 0.5 * np.pi, points=[np.pi / 6])
    factor = bends.friction_of(case)
    level = factor / np.hypot(1, factor) * section(case).weight * bends.radius_of(case)
    assert bends.turning_torque(case) == pytest.approx(level * (bends.LEVEL + share * bends.RADIUS))


def test_a_catenary_needs_no_wall():
    """T/R = w sin α all along, and dT = w cos α ds."""
    weight, s = 1.0, np.linspace(0, 300, 3001)
    left = bends.TANGENT / np.tan(np.radians(bends.FIRST)) - s
    angle = np.arctan2(bends.TANGENT, left)
    tension = weight * bends.TANGENT / np.sin(angle)
    assert np.gradient(tension, s)[1:-1] == pytest.approx(-weight * np.cos(angle)[1:-1], rel=1e-4)
    assert tension * np.gradient(angle, s) == pytest.approx(weight * np.sin(angle), rel=1e-2)


def test_the_depth_of_an_arc_is_integrated_along_it():
    depth = lambda s: s if s < 300 else 300 + 800 * np.sin((s - 300) / 800)  # noqa: E731
    whole, _ = quad(depth, 0, 300 + 400 * np.pi, points=[300.0])
    assert fluids.warm_stretch(case_of(fluids.warmed(50.0))) == pytest.approx(12.42e-6 * 0.06 * whole)


def test_a_falling_column_loses_what_a_slot_and_a_bore_do():
    """The annulus as an unrolled slot of its mean circumference, which is within 1 %; the bore by Poiseuille."""
    rate = fluids.free_fall(case_of(fluids.falling(50.0)))
    gap, around = 0.5 * (0.2159 - 0.127), 0.5 * np.pi * (0.2159 + 0.127)
    lost = 128 * rate / (np.pi * 0.1086**4) + 12 * rate / (around * gap**3)
    assert lost == pytest.approx(300 * 9.80665, rel=0.01)


def test_tool_joints_lose_what_slots_and_bores_do():
    """Annuli as unrolled slots; the narrow one of the tool joints is within 0.1 %."""
    lost = 0.0
    for share, outer, inner in ((0.05, 0.168, 0.07), (0.95, 0.127, 0.1086)):
        gap, around = 0.5 * (0.2159 - outer), 0.5 * np.pi * (0.2159 + outer)
        lost += 480.0 * share * 0.02 * (128 / (np.pi * inner**4) + 12 / (around * gap**3))
    assert fluids.lost_by_joints(case_of(fluids.jointed(4.0))) == pytest.approx(lost, rel=0.01)


@pytest.mark.parametrize(("rpm", "speed"), [(60.0, 0.0), (0.0, 0.4), (60.0, 0.4)])
def test_both_walls_of_a_key_seat_bear_the_string(rpm, speed):
    """Of each wall −N n and −g N a × n: both together are the weight, upwards."""
    case, beta = case_of(grips.key_seat(grips.DEEP, 6.0)), np.radians(grips.DEEP)
    drag, around = grips.shares(case, speed, rpm)
    assert np.hypot(drag, around) == pytest.approx(0.3)
    forces = []
    for side in (1, -1):
        normal = np.array([side * np.sin(beta), -np.cos(beta)])  # to the right and up, looking downhole
        forces.append(-normal - around * np.array([normal[1], -normal[0]]))
    both = np.linalg.solve(np.transpose(forces), [0.0, grips.across(case)])
    assert (both > 0).all()
    assert grips.walls(case, grips.DEEP, around) == pytest.approx(both.sum())


def test_a_flat_key_seat_is_left_by_a_string_that_turns():
    """One wall holds it where its normal is at arctan μ: beyond both planes of the flat seat, within the deep one."""
    assert grips.FLAT < np.degrees(np.arctan(grips.FRICTION)) < grips.DEEP
    beside = np.radians(360.0 / grips.ARMS * np.arange(-2, 3))  # of the arms from the low side
    below = grips.radii(grips.FLAT)[grips.ARMS // 2 - 2 : grips.ARMS // 2 + 3]
    planes = np.cos(np.abs(beside) - np.radians(grips.FLAT))  # a tangent at β has R = r cos(ψ − β)
    assert below * planes == pytest.approx(0.5 * 0.2159)


def test_bows_turn_pipe_about_its_own_axis():
    """Moments about the axis of the hole: μ F R of the place that is touched, less that of the load, aside by e."""
    case = case_of(grips.centred(4.0))
    count, start, stiffness, radius = grips.bows_of(case)
    load = grips.across(case) / count
    force = load / np.linalg.norm([1.0, 0.3])
    lean, angle = force / stiffness, np.arctan(0.3)
    about_hole = 0.3 * force * radius - load * lean * np.sin(angle)
    assert grips.bow_torque(case) - grips.in_mud(case) == pytest.approx(count * (start * radius + about_hole))


def test_an_elastica_is_found_by_shooting_and_by_a_small_load():
    for load in (0.5, 2.0, 8.0):

        def fall(start, load=load):
            end = lambda s, y: [y[1], -load * (1 - s) * np.cos(y[0]), np.sin(y[0])]  # noqa: E731
            return solve_ivp(end, (0, 1), [0.0, start, 0.0], rtol=1e-10, atol=1e-12).y[:, -1]

        start = brentq(lambda start: fall(start)[1], 0.0, load)
        assert statics.elastica(load) == pytest.approx((abs(fall(start)[2]), start), rel=1e-6)
    assert statics.elastica(1e-3)[0] == pytest.approx(1e-3 / 8, rel=1e-5)


def test_stretch_sums_strains_of_a_tube_under_pressure():
    """ε = (σ_z − ν(σ_r + σ_θ))/E, with σ_r = σ_θ = −p in equal mud, and σ_z of the true tension."""
    case = case_of(statics.hung(1400.0, 50.0))
    pipe, part = section(case), case.string.components[0]

    def strain(depth):
        pressure = 1400.0 * 9.80665 * depth
        steel_below = pipe.mass * 9.80665 * (statics.HUNG - depth)
        axial = (steel_below - 1400.0 * 9.80665 * statics.HUNG * pipe.steel) / pipe.steel
        return (axial + 2 * part.poisson_ratio * pressure) / part.youngs_modulus

    assert statics.stretch(case) == pytest.approx(quad(strain, 0, statics.HUNG)[0], rel=1e-9)


def test_a_bent_housing_by_reciprocity():
    """The force of a kink at the bit is the kink times the moment there for a unit lift of the bit (Betti)."""
    case = case_of(bha.housing(0.37))
    lower = bha.HOUSING["below"] + bha.HOUSING["above"]
    x = grid(np.array([0.0, lower, lower + bha.HOUSING["span"]]), 30)
    _, lifted = deflect(bending(x, section(case, 1).EI), np.zeros(122), {0: 1.0, 60: 0.0, 120: 0.0})
    assert bha.housing_force(case) == pytest.approx(np.radians(bha.ANGLE) * lifted[0] * bha.HOUSING["below"], rel=1e-6)


def test_tool_joints_carry_the_mean_curvature():
    """The mean moment between two joints is EI/R, and the moment follows M'' = T/EI M."""
    EI, pull, half = 1.2e6, 4.5e4, 4.7
    K = np.sqrt(pull / EI)
    mean, _ = quad(lambda s: EI / bha.BEND * K * half * np.cosh(K * (half - s)) / np.sinh(K * half), 0, half)
    assert mean / half == pytest.approx(EI / bha.BEND)


def test_a_helix_has_the_least_energy_of_all_rates():
    """EI r²θ'⁴/2 − F r²θ'²/2, and + M r²θ'³/2 for the torque of a bit that turns clockwise."""
    pipe, torque, force = pipe_of(case_of(helix.vertical(5.0, torque=3e3))), 3e3, 9e4

    def energy(rate, torque):
        return 0.5 * (pipe.EI * rate**4 - force * rate**2 + torque * rate**3)

    plain = minimize_scalar(energy, bounds=(0.05, 0.5), args=(0.0,), method="bounded", options={"xatol": 1e-10}).x
    assert plain == pytest.approx(helix.helix.turning(pipe, force), rel=1e-6)
    for low, high in ((0.05, 0.5), (-0.5, -0.05)):
        rate = minimize_scalar(energy, bounds=(low, high), args=(torque,), method="bounded", options={"xatol": 1e-10}).x
        assert 2 * pipe.EI * rate**2 + 1.5 * torque * rate == pytest.approx(force, rel=1e-6)


def test_friction_of_a_helix_is_an_integral():
    case = case_of(helix.vertical(5.0, friction=0.2))
    pipe = pipe_of(case)
    beta = 0.2 * pipe.clearance / (4 * pipe.EI)
    along = solve_ivp(
        lambda z, force: -pipe.weight + beta * force**2, (0, helix.WINDOW[1]), [helix.WEIGHT], rtol=1e-10,
        t_eval=helix.WINDOW,
    ).y[0]  # fmt: skip
    gained = pipe.weight * (helix.WINDOW[1] - helix.WINDOW[0]) - (along[0] - along[1])
    assert helix.drag(case) == pytest.approx(gained, rel=1e-6)


def test_the_example_of_1962_is_the_published_one():
    """Neutral point 3,441 ft above the end, shortening 5.54 in."""
    case = case_of(helix.tubing(helix.PUSHED, helix.TUBE, 5.0))
    pipe = pipe_of(case, 1)
    assert helix.PUSHED / pipe.weight == pytest.approx(3441 * 0.3048, rel=1e-3)
    assert helix.all_shortening(case) == pytest.approx(5.54 * 0.0254, rel=5e-3)


@pytest.mark.parametrize("kind", [waves.TORSION, waves.AXIAL])
def test_frequencies_are_those_of_a_chain_of_many_lumps(kind):
    case, n = case_of(waves.hanging(5.0)), 1000
    at = (np.arange(n) + 0.5) / n * waves.LENGTH
    parts = [section(case, 1 if s < waves.LENGTH - waves.ASSEMBLY else 0) for s in at]
    k, m = (np.array([getattr(part, name) for part in parts]) for name in (kind.stiffness, kind.inertia))
    h = waves.LENGTH / n
    spring, mass = np.append(2 * k[0], 2 / (1 / k[1:] + 1 / k[:-1])) / h, m * h
    own, beside = spring + np.append(spring[1:], 0), -spring[1:] / np.sqrt(mass[1:] * mass[:-1])
    lumped = eigvalsh_tridiagonal(own / mass, beside, select="i", select_range=(0, 3))
    exact = [waves.squared(kind, mode, case) for mode in (1, 2, 3, 4)]
    assert lumped == pytest.approx(exact, rel=1e-3)


def test_a_swing_begins_to_grow_at_the_threshold():
    """Eigenvalues of a chain with drive and bit: none on the right 3 % above it, some 3 % below it."""
    case, n = case_of(threshold.drilling(20.0)), 150
    h, rock = threshold.DEPTH / n, case.bit.rock
    at = (np.arange(n) + 0.5) * h
    parts = [section(case, 1 if s < threshold.DEPTH - threshold.COLLARS else 0) for s in at]
    GJ, inertia = np.array([[part.GJ, part.inertia] for part in parts]).T
    spring, mass = np.append(2 * GJ[0], 2 / (1 / GJ[1:] + 1 / GJ[:-1])) / h, inertia * h
    near = threshold.by_impedance(case)

    def growth(rpm):
        slope = (
            -case.bit.torque * rock.weakening / (rock.weakening_rpm * np.pi / 30) * np.exp(-rpm / rock.weakening_rpm)
        )
        A = np.zeros((2 * n + 1, 2 * n + 1))  # twists of the springs, spins, and the angle that the drive is behind
        twist, spin = np.arange(n), n + np.arange(n)
        impedance = np.sqrt(GJ[0] * inertia[0])
        # A drive without inertia: P Ω + I ∫Ω = its spring's torque, so that Ω = (k φ − I ψ)/P, ψ' = Ω.
        A[2 * n, [0, 2 * n]] = spring[0] / impedance, -threshold.INTEGRAL / impedance
        A[twist, spin] = 1.0
        A[twist[1:], spin[:-1]] = -1.0
        A[0] -= A[2 * n]
        A[spin, twist] = -spring / mass
        A[spin[:-1], twist[1:]] = spring[1:] / mass[:-1]
        A[spin, spin] = -threshold.MUD_TORQUE * h / mass
        A[spin[-1], spin[-1]] -= slope / mass[-1]
        return np.linalg.eigvals(A).real.max()

    assert growth(1.03 * near) < 0 < growth(0.97 * near)
