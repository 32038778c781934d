"""The string in the engines of rivals: loads as FCTD's, friction, what they honour and what they refuse.

``.venv-rivals/bin/python -m pytest -m rivals tests/references/engines`` runs those that need the packages.
"""

import sys
from typing import Any

import numpy as np
import pytest

from fctd import InputError, Simulation
from fctd.mechanics import state
from fctd.simulation.features import FEATURES, refuse
from fctd.simulation.preparation import prepare
from references import engines, rivals
from references.engines import EngineRun, Window
from references.engines.best_step import best_step, ladder
from references.engines.friction_law import sliding
from tests.references.engines.test_features import has_its_effect, run_in
from tests.references.engines.turning import WINDOW, mean, turning
from tests.simulation.features import CROSSED

NAMES = ("exudyn", "rapier")
MODULES = {"exudyn": "exudyn", "rapier": "rapier3d"}
UPRIGHT = turning([[0, 0, 0], [600, 0, 0]], contact={"enabled": False})
HONOURED = [
    (rival, feature) for rival in NAMES for feature in FEATURES if feature in engines.engine_class(rival).honours
]


@pytest.fixture(scope="module")
def own() -> EngineRun:
    return engines.build("fctd").run(turning(), WINDOW)


@pytest.mark.parametrize("rival", NAMES)
def test_a_rival_is_an_entry_whose_class_needs_no_package(rival: str) -> None:
    assert rival in rivals.ENGINES
    found = engines.engine_class(rival)
    assert found.name == rival
    assert found.honours <= set(FEATURES)
    assert rival in engines.REGISTRY.names()


@pytest.mark.parametrize("rival", NAMES)
def test_a_rival_that_is_not_installed_says_how_to_have_it(rival: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, MODULES[rival], None)
    with pytest.raises(InputError, match="'make rivals' installs it") as error:
        engines.build(rival)
    assert (error.value.key, error.value.value) == ("engine", rival)


@pytest.mark.parametrize(
    ("rival", "options", "key"),
    [
        ("exudyn", {"step": "0 ms"}, "step"),
        ("exudyn", {"contact": "sphere"}, "contact"),
        ("rapier", {"iterations": 0}, "iterations"),
        ("rapier", {"length_unit": "-1 m"}, "length_unit"),
        ("rapier", {"facets": 2}, "facets"),
    ],
)
def test_a_bad_option_is_an_input_error(rival: str, options: dict[str, Any], key: str) -> None:
    with pytest.raises(InputError, match=key):
        engines.build(rival, **options)


@pytest.mark.parametrize("rival", NAMES)
def test_what_a_rival_leaves_out_is_refused(rival: str) -> None:
    honours = engines.engine_class(rival).honours
    for feature in set(CROSSED) - set(honours) - {"helical_force", "overpull", "packer"}:  # no run has these
        run, _ = prepare(CROSSED[feature].make(True))
        with pytest.raises(InputError, match=f"since {rival} leaves out"):
            refuse(run, honours, rival)


@pytest.mark.rivals
@pytest.mark.parametrize(("rival", "torque"), [("exudyn", 0.002), ("rapier", 0.03)])
def test_the_same_string_gives_the_same_loads(rival: str, torque: float, own: EngineRun) -> None:
    """In a second the string of single precision, whose positions have steps of 0.03 mm, rings by some percent."""
    run = engines.build(rival).run(turning(), WINDOW)
    assert run.status == "valid", run.message
    assert mean(own, "sum_r_ft_N_m") > 100
    assert mean(run, "hookload_N") == pytest.approx(mean(own, "hookload_N"), rel=0.002)
    assert mean(run, "surface_torque_N_m") == pytest.approx(mean(own, "surface_torque_N_m"), rel=torque)
    assert mean(run, "total_contact_force_N") == pytest.approx(mean(own, "total_contact_force_N"), rel=0.005)
    assert run.history["time_s"].iloc[-1] == pytest.approx(6.0)
    assert len(run.profile) == 17


@pytest.mark.rivals
@pytest.mark.parametrize("rival", NAMES)
def test_a_hanging_string_has_the_weight_the_torque_and_the_length_of_fctd(rival: str) -> None:
    """The stretch is exact: the weight below each joint over its stiffness.  Readings are one step late."""
    simulation = Simulation(UPRIGHT, window=Window(0.0, 1.0), engine=engines.build(rival))
    simulation.start()
    for _ in simulation:
        pass
    run, history = simulation.run, simulation.result().history
    n = run.segments
    weight, spring = (state.row(run.S, row, n) for row in (state.WEIGHT, state.K_AXIAL))
    stretch = (np.cumsum(weight[::-1])[::-1] / spring).sum()
    length = sum(float(state.row(run.S, row, n).sum()) for row in (state.ARM_TOP, state.ARM_BOTTOM))
    bit = float(run.S[state.Z + n] + run.S[state.ARM_BOTTOM + n])
    assert bit - length == pytest.approx(stretch, rel=0.01)
    reference = engines.build("fctd").run(UPRIGHT, Window(0.0, 1.0)).history
    assert history["hookload_N"].mean() == pytest.approx(float(weight.sum()), rel=1e-3)
    own = reference["surface_torque_N_m"].to_numpy()
    assert np.abs(own).max() > 50
    np.testing.assert_allclose(history["surface_torque_N_m"], own, atol=0.02 * np.abs(own).max())


@pytest.mark.rivals
@pytest.mark.parametrize(("rival", "least"), [("exudyn", 0.9999), ("rapier", 0.995)])
def test_friction_obeys_coulomb_at_an_oblique_azimuth(rival: str, least: float) -> None:
    """Exact, without FCTD's loads: μN opposite to sliding, which is across a straight hole."""
    found = sliding(rival, 30.0, 1.0)
    assert found.status == "valid", found.failed
    assert least < found.share < 1.005
    assert abs(np.degrees(found.lean)) < 0.5


@pytest.mark.rivals
def test_exudyn_touches_a_mesh_of_its_own() -> None:
    """Its contact adds the forces of neighbouring triangles: friction around the string is some percent low."""
    run = engines.build("exudyn", contact="mesh").run(turning(), WINDOW)
    own = engines.build("fctd").run(turning(), WINDOW)
    assert run.status == "valid", run.message
    assert mean(run, "hookload_N") == pytest.approx(mean(own, "hookload_N"), rel=0.005)
    assert mean(run, "total_contact_force_N") == pytest.approx(mean(own, "total_contact_force_N"), rel=0.01)
    assert mean(run, "sum_r_ft_N_m") == pytest.approx(mean(own, "sum_r_ft_N_m"), rel=0.03)
    with pytest.raises(InputError, match="since exudyn with contact = mesh leaves out several friction factors"):
        run_in("exudyn", CROSSED["friction_along_hole"].make(True), contact="mesh")


@pytest.mark.rivals
def test_the_loads_of_rapier_do_not_depend_on_its_substeps() -> None:
    """Its joints tell the impulse of one substep, its contacts that of the step."""
    few, many = (
        engines.build("rapier", iterations=count).run(turning(), Window(5.0, 0.5)).history.mean(numeric_only=True)
        for count in (2, 8)
    )
    for column in ("hookload_N", "total_contact_force_N"):
        assert few[column] == pytest.approx(many[column], rel=0.01)
    assert few["surface_torque_N_m"] == pytest.approx(many["surface_torque_N_m"], rel=0.1)


@pytest.mark.rivals
def test_exudyn_runs_at_the_best_step_of_its_ladder() -> None:
    step = engines.build("exudyn").run(turning(), Window(0.0, 0.2)).step
    table = ladder("exudyn", turning(), Window(0.0, 5.0), 2 * step, 3, 2.0)
    assert best_step(table) == pytest.approx(step)


@pytest.mark.rivals
def test_a_run_of_rapier_that_fails_a_check_says_which() -> None:
    run = engines.build("rapier", step="30 ms", iterations=1).run(turning(), Window(5.0, 0.5))
    assert run.status == "invalid"
    assert "at most" in run.message


@pytest.mark.slow
@pytest.mark.rivals
@pytest.mark.parametrize(("rival", "feature"), HONOURED)
def test_a_feature_has_its_effect_in_a_rival(rival: str, feature: str) -> None:
    has_its_effect(rival, feature)
