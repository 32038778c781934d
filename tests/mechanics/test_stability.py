"""The largest stable step."""

import pytest

from fctd import InputError, equilibrium
from fctd.mechanics import state
from fctd.mechanics.stability import stable_step, stiffest_mode, stiffest_torsion
from fctd.simulation.preparation import prepare
from tests.cases import make_case, pipe, rotation


@pytest.mark.parametrize("frequency", [1e3, 1e7, 1e12, 1e150])
@pytest.mark.parametrize("damping", [0.0, 1e-5])
def test_a_step_at_the_limit_is_at_the_limit(frequency: float, damping: float) -> None:
    """ω²h² + 2ηω²h = 4, each term divided by 4 and written so that ω² does not overflow."""
    step = stable_step(frequency, damping, 0.0)
    assert (0.5 * frequency * step) ** 2 + 0.5 * damping * frequency * (frequency * step) == pytest.approx(1.0)


def test_the_stiffest_torsion_is_that_of_a_uniform_shaft() -> None:
    """2c/Δz for a wave speed c = √(GJ/I) and segments of Δz."""
    run, _ = prepare(make_case(components=[pipe(None, 40)], operations=[rotation(1000.0, 10.0)]))
    (section,) = run.string.sections
    wave = (section.GJ / section.axial_inertia) ** 0.5
    assert stiffest_torsion(run.S, run.segments) == pytest.approx(2 * wave / 25.0)
    assert stiffest_torsion(run.S, run.segments) < stiffest_mode(run.S, run.segments, 0.0)
    assert not state.row(run.S, state.UNBALANCE, run.segments).any()


def test_a_string_too_stiff_to_step_is_refused() -> None:
    """Twenty segments in two centimetres: a run of more steps than the limit."""
    case = make_case(components=[pipe(0.02, 20), pipe(None, 40)], operations=[rotation(900.0, 10.0)])
    with pytest.raises(InputError, match="that need at most"):
        prepare(case)


@pytest.mark.parametrize(("length", "depth"), [(2e-10, 900.0), (10.0, 1e-5), (10.0, 1e-300)])
def test_segments_too_short_to_compute_with_are_refused(length: float, depth: float) -> None:
    """A step of 0 s, and stiffnesses that no float holds."""
    case = make_case(components=[pipe(length, 20), pipe(None, 40)], operations=[rotation(depth, 10.0)])
    with pytest.raises(InputError, match=r"segments of at least 0\.001 m"):
        prepare(case)


@pytest.mark.parametrize(
    ("absurd", "status"), [({"density": 5e-324}, "converged"), ({"youngs_modulus": 1e300}, "not_finite")]
)
def test_masses_and_stiffnesses_out_of_proportion_are_refused(absurd: dict[str, float], status: str) -> None:
    """A weightless string can lie still, but not be stepped."""
    case = make_case(components=[pipe(1000, 20, **absurd)], operations=[rotation(900.0, 10.0)])
    with pytest.raises(InputError, match=r"stable step can be computed|that need at most"):
        prepare(case)
    assert equilibrium(case, "rotate_off_bottom", 900.0).status == status
