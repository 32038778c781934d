"""A free sphere in rivals of single precision, and the study of it where none is installed."""

import numpy as np
import pytest

from references.engines.free_sphere import SPHERES, Sphere
from validation.harness.study import Context
from validation.parts.single_precision import by_positions, by_velocities, spacing
from validation.studies import rival_precision

# Newton compiles for a minute and a half in a new environment.
COMPILED = [
    pytest.param(name, marks=pytest.mark.slow) if sphere.distribution == "newton" else name
    for name, sphere in SPHERES.items()
]


@pytest.mark.rivals
@pytest.mark.parametrize("rival", COMPILED)
def test_a_sphere_falls_or_freezes_as_its_integrator_in_single_precision(rival: str) -> None:
    """Where places alone are kept a sphere at 600 m does not fall with 1 ms; with 5 ms all of them fall."""
    sphere = SPHERES[rival]
    lines = by_positions if sphere.places_alone else by_velocities
    for height, step in ((1.0, 1e-3), (600.0, 5e-3), (600.0, 1e-3)):
        ours = lines(height, step / sphere.sub_steps, 0.1, np.float32)
        assert sphere.fall(height, step, 0.1) == pytest.approx(ours, abs=2 * spacing(height))
    assert (sphere.fall(600.0, 1e-3, 0.1) == 0) == sphere.places_alone


def test_a_rival_that_is_not_installed_is_a_row(monkeypatch: pytest.MonkeyPatch) -> None:
    """Beside one whose sphere falls by our own lines, or half as far."""

    def of(share: float) -> Sphere:
        return Sphere("numpy", False, 1, lambda *at: share * by_velocities(*at, np.float32))

    absent = Sphere("no-such-package", True, 1, lambda *at: 0.0)
    monkeypatch.setattr(rival_precision, "SPHERES", {"sound": of(1.0), "slow": of(0.5), "absent": absent})
    outcome = rival_precision.run(Context(quick=True))
    rows = outcome.tables["falls"].set_index("engine")
    assert rows.loc["absent", "status"] == "not installed"
    assert (rows.loc["sound", "status"] == "measured").all()
    assert [check.verdict for check in outcome.checks] == ["met", "met", "missed", "missed"]
    monkeypatch.setattr(rival_precision, "SPHERES", {"absent": absent})
    alone = rival_precision.run(Context(quick=True))
    assert alone.checks == []
    assert list(alone.tables["falls"].columns) == list(outcome.tables["falls"].columns)
