"""What other engines refuse: cases that they would not represent, windows, options, and missing packages."""

import sys
from typing import Any

import pytest

from fctd import InputError
from references import engines, registry
from references.engines import Window
from tests.references.engines.turning import BULLET, turning
from validation.cases import load
from validation.harness.study import left_out


@pytest.mark.parametrize("name", ["bullet", "mujoco"])
@pytest.mark.parametrize("options", [{"chord_tolerance": "20 mm"}, {"facets": 4}])
def test_triangles_with_errors_beyond_half_the_clearance_are_refused(name: str, options: dict[str, Any]) -> None:
    with pytest.raises(InputError, match=r"miss the wall by at most 0\.5 of the clearance of 23\.8 mm"):
        engines.build(name, **options).run(load("s_shape"), Window(0.0, 0.1))


@BULLET
def test_more_triangles_than_bullet_accepts_are_refused() -> None:
    with pytest.raises(InputError, match="174762 triangles"):
        engines.build("bullet", facets=600).run(load("s_shape", wellbore__geometry="cylinders"), Window(0.0, 0.1))


@pytest.mark.parametrize("window", [Window(-1.0, 1.0), Window(0.0, 0.0), Window(5.0, 4.0)])
def test_a_window_outside_the_schedule_is_an_input_error(window: Window) -> None:
    with pytest.raises(InputError, match="window"):
        engines.build("fctd").run(turning(), window)


def test_an_unknown_engine_or_option_names_the_nearest() -> None:
    with pytest.raises(InputError, match="bullet"):
        engines.build("bulet")
    with pytest.raises(InputError, match="settings"):
        engines.build("bullet", setings="fair")


@pytest.mark.parametrize(("name", "module"), [("bullet", "pybullet"), ("mujoco", "mujoco"), ("elastica", "elastica")])
def test_a_missing_package_is_named(name: str, module: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(InputError, match="not installed") as error:
        engines.build(name)
    assert error.value.key == "engine"


def test_two_ways_to_install_pybullet_are_named_where_it_has_no_wheels(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pybullet", None)
    monkeypatch.setattr(registry, "NO_PYBULLET", sys.version_info[:2])
    with pytest.raises(InputError, match=r"run on Python 3\.11, or build it by 'make bullet'"):
        engines.build("bullet")
    (note,) = left_out(["Bullet"])
    assert "make bullet" in note
    assert "make bullet" not in left_out(["MuJoCo"])[0]
