"""What other engines refuse: cases that they would not represent, windows, options, and missing packages."""

import sys
from typing import Any

import pytest

from fctd import InputError
from references import engines, registry
from references.engines import Window
from references.engines.run import check_supported
from tests.cases import make_case, pipe, rotation
from tests.references.engines.turning import BULLET, STATIONS, WINDOW, turning
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


@pytest.mark.parametrize("name", ["bullet", "mujoco"])
@pytest.mark.parametrize(
    ("key", "table"),
    [
        ("contact.law", {"contact": {"law": "power"}}),
        ("contact.friction_law", {"contact": {"friction_law": "karnopp"}}),
        ("rig.drive", {"rig": {"drive": "impedance"}}),
        ("mud.viscosity", {"mud": {"density": 1200.0}}),
    ],
)
def test_another_engine_refuses_what_it_would_leave_out(name: str, key: str, table: dict[str, Any]) -> None:
    case = turning(**table)
    with pytest.raises(InputError, match="in another engine") as caught:
        engines.build(name).run(case, WINDOW)
    assert caught.value.key == key
    check_supported(turning())


@pytest.mark.parametrize("key", ["bend", "eccentricity"])
def test_another_engine_refuses_a_component_that_only_fctd_turns(key: str) -> None:
    """A bent housing, and a mass beside its axis, in the lowest of two components."""
    case = make_case(STATIONS, [pipe(100, 5, **{key: 0.01}), pipe(None, None, segment_length=20.0)], [rotation(500, 2)])
    with pytest.raises(InputError, match="0 in another engine than FCTD's") as caught:
        check_supported(case)
    assert caught.value.key == f"string.components[0].{key}"


@pytest.mark.parametrize(
    ("name", "sections", "key"),
    [
        ("bullet", {"contact": {"friction_law": "paper"}}, "contact.friction_law"),
        ("mujoco", {"contact": {"friction_law": "paper"}}, "contact.friction_law"),
        ("elastica", {"mud": {"axial_damping": 1.0}}, "mud.axial_damping"),
        ("bullet", {"mud": {"lateral_damping": 1.0}}, "mud.lateral_damping"),
        ("bullet", {"mud": {"density": 1200.0}}, "mud.viscosity"),
        ("mujoco_chain", {}, "contact.enabled"),
        ("elastica", {"components": [pipe(450, 15), pipe(1, 1), pipe(49, 1)]}, "string.components[1].contact"),
    ],
)
def test_a_case_that_an_engine_cannot_represent_is_an_input_error(
    name: str, sections: dict[str, Any], key: str
) -> None:
    with pytest.raises(InputError) as error:
        engines.build(name).run(turning(**sections), Window(0.0, 0.1))
    assert error.value.key == key


@BULLET
def test_two_friction_factors_are_refused_by_engines_with_one() -> None:
    intervals = [
        {"to_md": 300, "diameter": 0.2159, "friction": f} | ({"to_md": 600} if f > 0.2 else {}) for f in (0.2, 0.3)
    ]
    with pytest.raises(InputError, match="one friction factor"):
        engines.build("bullet").run(turning(wellbore={"intervals": intervals}), Window(0.0, 0.1))


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
