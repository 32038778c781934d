"""Each trap is present in the installed library; a release that corrects one makes its test fail."""

import pytest

from fctd.case.errors import InputError
from references.contact import traps
from references.registry import absent

# Least error where the obvious way fails, far above that of the geometry (2 mm of facets and chords).
FAILS = {
    ("python-fcl", "a capsule along the string"): 0.1,
    ("python-fcl", "one contact asked for (the default)"): 4.0,
    ("python-fcl", "distance of a penetrating sphere"): 90.0,
    ("coal", "distance of a penetrating sphere"): 4.0,
    ("mujoco", "fixed (mocap) spheres"): 100.0,
}


@pytest.mark.parametrize("trap", traps.TRAPS, ids=[f"{trap.distribution}-{trap.tried}" for trap in traps.TRAPS])
def test_the_obvious_way_fails_as_recorded(trap: traps.Trap) -> None:
    if not traps.installed(trap):
        pytest.skip(f"package {absent(trap.distribution)}")
    found = traps.measure(trap, traps.scene(40))
    if (trap.distribution, trap.tried) in FAILS:
        assert found >= FAILS[trap.distribution, trap.tried]
    else:
        assert found == 0


def test_a_trap_of_a_missing_package_is_an_input_error(monkeypatch: pytest.MonkeyPatch) -> None:
    at = traps.scene(2)
    monkeypatch.setitem(__import__("sys").modules, "fcl", None)
    with pytest.raises(InputError, match="python-fcl, which is not installed"):
        traps.measure(traps.TRAPS[0], at)
