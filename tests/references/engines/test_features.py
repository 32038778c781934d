"""Each feature of a case has its effect in another engine, or is refused."""

from functools import cache

import pytest

from fctd import Case, InputError, Simulation
from fctd.simulation.features import FEATURES, refuse
from fctd.simulation.preparation import prepare
from fctd.simulation.run import Run
from references import engines
from references.engines import ENGINES, EngineRun, Window
from references.engines.own import Fctd
from tests.cases import pipe, rotation
from tests.references.engines.turning import needs
from tests.simulation.features import CROSSED, UPRIGHT, case, shown

OTHERS = [name for name in ENGINES if name != "fctd"]
HONOURED = [(name, feature) for name in OTHERS for feature in FEATURES if feature in engines.engine_class(name).honours]
# MuJoCo's nested chain has no wall: what it honours is compared as it stands.
ALONE = ("mujoco_chain", "no_wall")


def run_in(name: str, case: Case, **options: str) -> EngineRun:
    return engines.build(name, **options).run(case, Window(0.0, Simulation(case).end))


@cache
def prepared(feature: str) -> Run:
    """The run of a case with a feature, which no refusal changes, once for all engines."""
    return prepare(CROSSED[feature].make(True))[0]


def has_its_effect(name: str, feature: str) -> None:
    """Assert that a feature changes the loads in an engine as it does in FCTD."""
    make, column = CROSSED[feature]
    loads = {(engine, on): shown(run_in(engine, make(on)), column) for engine in ("fctd", name) for on in (True, False)}
    effect = loads["fctd", True] - loads["fctd", False]
    assert abs(loads[name, False] - loads["fctd", False]) < 0.1 * abs(effect), "the case shows its feature too little"
    assert loads[name, True] - loads[name, False] == pytest.approx(effect, rel=0.1)


@pytest.mark.parametrize("name", OTHERS)
def test_what_an_engine_leaves_out_is_refused(name: str) -> None:
    """All of it: a case of the feature is refused by a key of it, or by another one that it cannot do without."""
    needs(name)
    honours = engines.engine_class(name).honours
    for feature in set(CROSSED) - set(honours) - {"helical_force", "overpull", "packer"}:  # no run has these
        with pytest.raises(InputError, match=f"since {name} leaves out"):
            refuse(prepared(feature), honours, name)
    with pytest.raises(InputError, match=f"since engine {name} leaves out"):
        Simulation(CROSSED["cake"].make(True), engine=engines.build(name))


@pytest.mark.slow
@pytest.mark.parametrize(("name", "feature"), [pair for pair in HONOURED if pair != ALONE])
def test_a_feature_has_its_effect_in_another_engine(name: str, feature: str) -> None:
    needs(name)
    has_its_effect(name, feature)


def test_a_chain_hangs_as_the_string_without_a_wall() -> None:
    needs("mujoco_chain")
    hanging = case(
        UPRIGHT, components=[pipe(60, 6)], operations=[rotation(60, 3.0, ramp=1.0)], contact={"enabled": False}
    )
    own, chain = run_in("fctd", hanging), run_in("mujoco_chain", hanging)
    for column in ("hookload_N", "surface_torque_N_m"):
        assert shown(chain, column) == pytest.approx(shown(own, column), rel=0.01)


def test_the_own_stepper_is_an_engine_too() -> None:
    assert set(FEATURES) - Fctd.honours == {"helical_force", "overpull", "packer", "stands"}
