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
from tests.references.engines.test_features import run_in
from tests.references.engines.turning import WINDOW, mean, turning
from tests.simulation.features import CROSSED, shown

NAMES = ("exudyn", "rapier")
MODULES = {"exudyn": "exudyn", "rapier": "rapier3d"}
UPRIGHT = turning([[0, 0, 0], [600, 0, 0]], contact={"enabled": False})
HONOURED = [(name, feature) for name in NAMES for feature in FEATURES if feature in engines.engine_class(name).honours]


@pytest.fixture(scope="module")
def own() -> EngineRun:
    return engines.build("fctd").run(turning(), WINDOW)


@pytest.mark.parametrize("name", NAMES)
def test_a_rival_is_an_entry_whose_class_needs_no_package(name: str) -> None:
    assert name in rivals.ENGINES
    found = engines.engine_class(name)
    assert found.name == name
    assert found.honours <= set(FEATURES)
    assert name in engines.REGISTRY.names()


@pytest.mark.parametrize("name", NAMES)
def test_a_rival_that_is_not_installed_says_how_to_have_it(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, MODULES[name], None)
    with pytest.raises(InputError, match="'make rivals' installs it") as error:
        engines.build(name)
    assert (error.value.key, error.value.value) == ("engine", name)


@pytest.mark.parametrize(
    ("name", "options", "key"),
    [
        ("exudyn", {"step": "0 ms"}, "step"),
        ("exudyn", {"facets": 48}, "facets"),
        ("rapier", {"iterations": 0}, "iterations"),
        ("rapier", {"length_unit": "-1 m"}, "length_unit"),
        ("rapier", {"facets": 2}, "facets"),
    ],
)
def test_a_bad_option_is_an_input_error(name: str, options: dict[str, Any], key: str) -> None:
    with pytest.raises(InputError, match=key):
        engines.build(name, **options)


@pytest.mark.parametrize("name", NAMES)
def test_what_a_rival_leaves_out_is_refused(name: str) -> None:
    honours = engines.engine_class(name).honours
    for feature in set(CROSSED) - set(honours) - {"helical_force", "overpull", "packer"}:  # no run has these
        run, _ = prepare(CROSSED[feature].make(True))
        with pytest.raises(InputError, match=f"since {name} leaves out"):
            refuse(run, honours, name)
