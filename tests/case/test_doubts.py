"""Probable mistakes: bounds from both sides, and no warning on the cases that we have."""

from pathlib import Path
from typing import Any

import pytest

from fctd.case.doubts import warnings_of
from fctd.case.friction import FrictionSet, Pair
from fctd.case.load import Case, load_case
from fctd.case.operations import KINDS
from tests.cases import case_files, make_case, pipe

ROOT = Path(__file__).parents[2]
CASES = sorted((*case_files(ROOT / "examples"), *(ROOT / "validation" / "cases").glob("*.toml")))


def codes(case: Case, *kinds: str, **asked: Any) -> set[str]:
    """Codes of the warnings of a case."""
    return {warning.code for warning in warnings_of(case, kinds, **asked)}


def case_of(**more: Any) -> Case:
    """The small vertical case of the tests, in mud."""
    return make_case(**({"mud": {"density": 1200.0}} | more))


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_our_cases_are_not_doubted(path: Path, tmp_path: Path) -> None:
    survey = tmp_path / "survey.csv"  # those of real wells are public data, and not part of the project
    survey.write_text("md_m,inc_deg,azi_deg\n" + "".join(f"{30 * k},0,0\n" for k in range(274)), encoding="utf-8")
    changes = {"wellbore.survey": survey} if path.stem.startswith(("forge_", "nlog_", "s_well_", "volve_")) else {}
    assert load_case(path, changes).warnings == ()


def test_all_cases_are_looked_at() -> None:
    assert len(CASES) >= 9


def hole(
    *rows: tuple[float, float], friction: float = 0.2, around: float | None = None, kind: str | None = None
) -> dict[str, Any]:
    """A hole of lower ends and diameters [m]."""
    factors = {"friction": friction, "rotational_friction": around}
    return {"intervals": [{"to_md": to, "diameter": size, "kind": kind, **factors} for to, size in rows]}


TURNING = {"rpm": 60, "duration": 10}


CASED = {"to_md": 1000, "casing": "9 5/8 in 47 N-80", "friction": 0.2}


@pytest.mark.parametrize(
    ("code", "right", "wrong"),
    [
        ("mud_density", {"mud": {"density": 600.0}}, {"mud": {"density": 599.0}}),
        ("mud_density", {"mud": {"density": 2600.0}}, {"mud": {"density": 2601.0}}),
        ("friction", {"wellbore": hole((1000, 0.3), friction=0.6)}, {"wellbore": hole((1000, 0.3), friction=0.61)}),
        ("hole_size", {"wellbore": hole((1000, 1.5))}, {"wellbore": hole((1000, 1.51))}),
        (
            "wider_below",
            {"wellbore": hole((500, 0.2), (1000, 0.3))},
            {"wellbore": hole((500, 0.2), (1000, 0.301))},
        ),
        (
            "casing_bore",
            {"wellbore": {"intervals": [CASED]}},
            {"wellbore": {"intervals": [CASED | {"diameter": "8.525 in"}]}},
        ),
        (
            "shoe_below_td",
            {"wellbore": hole((999, 0.3), (5000, 0.2))},
            {"wellbore": hole((1000, 0.3), (5000, 0.2))},
        ),
        ("shoe_below_td", {"wellbore": hole((1030, 0.3), kind="cased")}, {"wellbore": hole((1031, 0.3), kind="cased")}),
        ("shoe_below_td", {"wellbore": hole((3000, 0.3))}, {"wellbore": hole((3281, 0.3))}),  # 3281 ft are 1000 m
        ("bit_load", {"bit": {"weight_on_bit": 1e3}}, {"bit": {"weight_on_bit": 999.0}}),
        ("bit_load", {"bit": {"weight_on_bit": 2e6}}, {"bit": {"weight_on_bit": 2.1e6}}),
        ("bit_load", {"bit": {"torque": 20.0}}, {"bit": {"torque": 19.0}}),
        ("damping", {"contact": {"damping": 1e7}}, {"contact": {"damping": 1.1e7}}),
        ("damping", {"mud": {"axial_damping": 1e4}}, {"mud": {"axial_damping": 1.1e4}}),
        ("damping", {"mud": {"lateral_damping": 1e-9}}, {"mud": {"lateral_damping": 1e30}}),
        ("damping", {"mud": {"rotational_damping": 10.0}}, {"mud": {"rotational_damping": 11.0}}),
        ("damping", {"solver": {"joint_damping": 0.1}}, {"solver": {"joint_damping": 3.0}}),
        ("rig_load", {"rig": {"block_weight": 1e3}}, {"rig": {"block_weight": 999.0}}),
        ("rig_load", {"rig": {"guide_friction": 100.0}}, {"rig": {"guide_friction": 99.0}}),
        ("rig_load", {"rig": {"torque_offset": -5.0}}, {"rig": {"torque_offset": -4.0}}),
        ("wear_flat", {"bit": {"rock": {"wear_flat": 0.05}}}, {"bit": {"rock": {"wear_flat": 5}}}),
        (
            "unused_control",
            {"rig": {"drive": "impedance", "control": {"inertia": 1e3}}},
            {"rig": {"control": {"inertia": 1e3}}},
        ),
        ("sheave_efficiency", {"rig": {"sheave_efficiency": 0.7}}, {"rig": {"sheave_efficiency": 0.69}}),
        (
            "youngs_modulus",
            {"components": [pipe(1000, 20, youngs_modulus=10e9)]},
            {"components": [pipe(1000, 20, youngs_modulus=9e9)]},
        ),
        (
            "yield_strength",
            {"components": [pipe(1000, 20, yield_strength=50e6)]},
            {"components": [pipe(1000, 20, yield_strength=49e6)]},
        ),
        (
            "pipe_density",
            {"components": [pipe(1000, 20, density=1201.0)]},
            {"components": [pipe(1000, 20, density=20_001.0)]},
        ),
        # The pipe's body weighs 7850 · π/4 (0.127² − 0.07²) = 69.2 kg/m, and the mud in its place 10.6 kg/m.
        (
            "linear_mass",
            {"components": [pipe(1000, 20, linear_mass=0.86 * 69.23)]},
            {"components": [pipe(1000, 20, linear_mass=0.84 * 69.23)]},
        ),
        (
            "linear_mass",
            {"components": [pipe(1000, 20, linear_mass=2.49 * 69.23)]},
            {"components": [pipe(1000, 20, linear_mass=2.51 * 69.23)]},
        ),
        (  # tool joints add to the body, and a spiral collar lacks some of it
            "linear_mass",
            {"components": [pipe(1000, 20, linear_mass=0.99 * 69.23, contact_diameter=0.168)]},
            {"components": [pipe(1000, 20, linear_mass=0.97 * 69.23, contact_diameter=0.168)]},
        ),
        (
            "short_string",
            {"components": [pipe(1, 1, name="bit"), pipe(999, 20)]},
            {"components": [pipe(1, 1, name="bit"), pipe(998, 20)]},
        ),
        (  # the operations, and not the hole, say how far the string has to reach
            "short_string",
            {"components": [pipe(500, 20)], "operations": [{"kind": "rotate_off_bottom", "at_md": 500, **TURNING}]},
            {"components": [pipe(500, 20)], "operations": [{"kind": "rotate_off_bottom", "at_md": 501, **TURNING}]},
        ),
        (
            "outside_the_hole",
            {"components": [pipe(999, 20), pipe(None, 1, name="pipe")]},
            {"components": [pipe(1000, 20), pipe(None, 1, name="pipe")]},
        ),
        (
            "friction_pair",
            {"wellbore": hole((1000, 0.3), friction=0.02, around=1.0)},
            {"wellbore": hole((1000, 0.3), friction=0.019, around=1.0)},
        ),
        (
            "friction_pair",
            {"wellbore": hole((1000, 0.3), friction=0.0)},
            {"wellbore": hole((1000, 0.3), friction=0.0, around=0.2)},
        ),
        ("rig_load", {"rig": {"stand_length": "94 ft"}}, {"rig": {"stand_length": 94}}),
        (
            "no_tool_joints",
            {"components": [{"pipe": "5 in 19.5 S-135 NC50", "segments": 20}]},
            {"components": [{"pipe": "5 in 19.5 G-105", "segments": 20}]},
        ),
        (
            "no_tool_joints",
            {
                "components": [
                    {
                        "pipe": "5 in 19.5 G-105",
                        "segments": 20,
                        "linear_mass": "21.92 lb/ft",
                        "contact_diameter": "6 5/8 in",
                    }
                ]
            },
            {"components": [{"pipe": "5 in 19.5 G-105", "segments": 20, "linear_mass": "21.92 lb/ft"}]},
        ),
        (
            "no_tool_joints",
            {
                "components": [
                    {
                        "pipe": "5 in 19.5 G-105",
                        "segments": 20,
                        "joint": {"length": 9.5, "tool_joint_length": 0.5, "tool_joint_diameter": 0.168},
                    }
                ]
            },
            {"components": [{"pipe": "7 in 29 N-80 casing", "segments": 20}]},
        ),
        (
            "unlike_pipe",
            {"components": [{"pipe": "5 in 19.5 S-135 NC50", "segments": 20, "outer_diameter": 0.12704}]},
            {"components": [{"pipe": "5 in 19.5 S-135 NC50", "segments": 20, "inner_diameter": "3 in"}]},
        ),
        (
            "unlike_pipe",
            {"components": [{"pipe": "5 in 19.5 S-135 NC50, premium", "segments": 20, "outer_diameter": "4.86 in"}]},
            {"components": [{"pipe": "5 in 19.5 S-135 NC50, premium", "segments": 20, "outer_diameter": "4.8 in"}]},
        ),
        (
            "floating_string",
            {"components": [pipe(1000, 20, linear_mass=10.7)]},
            {"components": [pipe(1000, 20, linear_mass=10.5)]},
        ),
        (
            "bit_size",
            {"components": [pipe(1, 1, name="PDC bit", outer=0.2), pipe(None, 20)]},
            {"components": [pipe(1, 1, name="PDC bit", outer=0.12), pipe(None, 20)]},
        ),
        (  # the wide pipe stays in the wide hole
            "bit_size",
            {
                "wellbore": hole((600, 0.3), (1000, 0.11)),
                "components": [pipe(1, 1, name="bit", outer=0.1), pipe(500, 10, 0.09), pipe(None, 20, 0.12)],
            },
            {
                "wellbore": hole((600, 0.3), (1000, 0.2)),
                "components": [pipe(1, 1, name="bit", outer=0.1), pipe(500, 10, 0.09), pipe(None, 20, 0.12)],
            },
        ),
        (
            "bit_size",
            {"components": [pipe(1, 1, name="bit", outer=0.3), pipe(None, 20)]},
            {
                "wellbore": hole((600, 0.3), (1000, 0.125)),
                "components": [pipe(1, 1, name="bit", outer=0.115), pipe(300, 10, 0.12), pipe(None, 20, 0.09)],
            },
        ),
        (  # 8 m bent by 1 degree: 140 mm aside, with 16 mm of room at gauge
            "bent_along_gauge",
            {"components": [pipe(8, 4, bend=0.0175), pipe(None, 20)]},
            {"components": [pipe(8, 4, bend=0.0175, contact_diameter=0.2), pipe(None, 20)]},
        ),
        (  # a body as wide as the hole
            "bent_along_gauge",
            {"components": [pipe(8, 4, outer=0.19, bend=0.0175), pipe(None, 20)]},
            {"components": [pipe(8, 4, outer=0.2, bend=0.0175), pipe(None, 20)]},
        ),
        (
            "bent_along_gauge",
            {"components": [pipe(1, 1, outer=0.2, bend=0.0175), pipe(None, 20)]},
            {"components": [pipe(1, 1, outer=0.2, bend=0.0175, contact="sleeve"), pipe(None, 20)]},
        ),
        (  # 8 1/2 in bit below casing of 7.2 in
            "does_not_drift",
            {"wellbore": hole((500, 0.216), (1000, 0.216)), "components": [pipe(1, 1, outer=0.216), pipe(None, 20)]},
            {"wellbore": hole((500, 0.183), (1000, 0.216)), "components": [pipe(1, 1, outer=0.216), pipe(None, 20)]},
        ),
        (  # the wide pipe stays above
            "does_not_drift",
            {"wellbore": hole((500, 0.3), (1000, 0.2)), "components": [pipe(600, 20), pipe(None, 20, 0.25)]},
            {
                "wellbore": hole((500, 0.3), (600, 0.2), (1000, 0.3)),
                "components": [pipe(300, 20), pipe(50, 10, 0.25), pipe(None, 20)],
            },
        ),
        (
            "bit_not_first",
            {"components": [pipe(1, 1, name="motor"), pipe(2, 1, name="bit sub"), pipe(None, 20)]},
            {"components": [pipe(900, 20), pipe(None, 1, name="bit")]},
        ),
    ],
)
def test_each_doubt_has_its_bound(code: str, right: dict[str, Any], wrong: dict[str, Any]) -> None:
    assert code not in codes(case_of(**right))
    assert code in codes(case_of(**wrong))


def test_no_mud_is_told_where_the_case_does_not_say_so() -> None:
    shallow = [[0, 0, 0], [500, 0, 0]]
    assert codes(make_case()) == {"no_mud"}
    assert codes(make_case(mud={"density": 0.0})) == set()
    assert codes(make_case(shallow, [pipe(500, 10)])) == set()


def test_drilling_needs_a_bit_load() -> None:
    assert codes(case_of(), "trip_in") == set()
    assert codes(case_of(), "trip_in", "drill_sliding") == {"no_bit_load"}
    assert codes(case_of(bit={"weight_on_bit": 5e4}), *KINDS) == set()
    drilling = {"kind": "drill_sliding", "from_md": 900.0, "to_md": 950.0, "speed": 0.01}
    assert {warning.code for warning in case_of(operations=[drilling]).warnings} == {"no_bit_load"}


def test_a_block_that_weighs_nothing_is_told_where_it_is_asked_for() -> None:
    assert codes(case_of(), indicator=True) == {"no_block_weight"}
    assert codes(case_of(), indicator=False) == set()
    assert codes(case_of(rig={"block_weight": 0.0}), indicator=True) == set()


FIELD = """
name = "A"
[wellbore]
stations = [["0 ft", 0, 0], ["9000 ft", 0, 0]]
[[wellbore.intervals]]
to_md = "9000 ft"
diameter = "8.5 in"
friction = 0.2
[[string.components]]
name = "HWDP"
length = {length}
outer_diameter = "5 in"
inner_diameter = "3 in"
[[string.components]]
name = "pipe"
outer_diameter = '5"'
inner_diameter = "4.276 in"
segment_length = "90 ft"
[mud]
density = "10 ppg"
"""


@pytest.mark.parametrize(("length", "told"), [("930", True), ("'930 ft'", False), ("'283 m'", False)])
def test_a_bare_length_among_feet(length: str, told: bool, tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    path.write_text(FIELD.format(length=length))
    keys = [warning.key for warning in load_case(path).warnings if warning.code == "bare_length"]
    assert keys == (["string.components[0].length"] if told else [])
    assert load_case(path, {"string.components[0].length": "930 ft"}).warnings == ()
    bare_stand = load_case(path, {"string.components[0].length": "930 ft", "rig.stand_length": 28}).warnings
    assert [warning.key for warning in bare_stand] == ["rig.stand_length"]
    bare_stand = load_case(path, {"string.components[0].length": "930 ft", "rig.stand_length": 94}).warnings
    assert [warning.code for warning in bare_stand] == ["rig_load"]  # which says the same
    path.write_text(FIELD.format(length="'930 ft'").replace('"9000 ft", 0', "9000, 0"))
    assert [warning.key for warning in load_case(path).warnings] == ["wellbore.stations"]


def test_lengths_that_are_all_bare_are_metres() -> None:
    assert make_case(mud={"density": 1200.0}).bare_lengths == []


def test_rates_and_friction_that_are_asked_for() -> None:
    for kind, rates, expected in (
        ("trip_in", {"speed": 3.0, "rpm": 300.0}, set[str]()),
        ("trip_in", {"speed": 3.1}, {"speed"}),
        ("rotate_off_bottom", {"rpm": 301.0}, {"rotation"}),
        ("rotate_off_bottom", {"speed": 3.1}, set[str]()),  # refused
    ):
        assert codes(case_of(), kind, **rates) == expected
    assert codes(case_of(bit={"weight_on_bit": 5e4}), "trip_in", "drill_sliding", speed=0.2) == {"speed"}
    assert codes(case_of(), frictions=[FrictionSet(cased=0.2, open=0.7)]) == {"friction"}
    assert codes(case_of(), frictions=[FrictionSet(every=Pair(0.0, 0.2))]) == {"friction_pair"}
    rough = case_of(wellbore=hole((1000, 0.3), friction=0.9))
    assert codes(rough, frictions=[FrictionSet(every=0.2)]) == set()  # the case's own factor is not used


@pytest.mark.parametrize(
    ("key", "value", "si", "field"),
    [
        # What has its unit is quoted with one, and looks like no other.
        ("rig.hoist_capacity", "10 kN", "a hoist capacity of 10 kN", "a hoist capacity of 10 kN: "),
        ("rig.hoist_capacity", 450, "a hoist capacity of 450 N (450 looks like '450 kN')", "101.2 lbf (450 looks"),
        ("mud.density", 10.4, "a mud of 10.4 kg/m^3 (10.4 looks like '10.4 ppg')", "0.08679 ppg (10.4 looks"),
        ("wellbore.intervals[0].diameter", "63 in", "a hole of 63 in", "a hole of 63 in: write"),
        ("mud.density", "2.7 sg", "a mud of 2.7 sg", "a mud of 2.7 sg: check it; usual is 5.007"),
    ],
)  # fmt: skip
def test_a_value_out_of_its_range_is_told_as_it_was_written(
    key: str, value: object, si: str, field: str, tmp_path: Path
) -> None:
    path = tmp_path / "a.toml"
    path.write_text(FIELD.format(length="'930 ft'"))
    (warning,) = load_case(path, {key: value}).warnings
    assert warning.text == si
    assert field in warning.told("field")
    assert ("looks like" in warning.text) == isinstance(value, int | float)


def test_both_flows_of_a_motor_have_the_units_of_the_reader() -> None:
    """2000 and 1500 L/min are 528.3 and 396.3 gpm (3.785411784 L to the gallon)."""
    drilling = {"kind": "drill_sliding", "from_md": 900.0, "to_md": 950.0, "speed": 0.01, "flow": "2000 L/min"}
    motor = {"flow": "1500 L/min", "revolutions_per_liter": 0.1}
    case = case_of(operations=[drilling], bit={"weight_on_bit": 5e4, "motor": motor})
    (warning,) = [warning for warning in case.warnings if warning.code == "motor_flow"]
    assert "528.3 gpm, where bit.motor.flow turns the motor with 396.3 gpm" in warning.told("field")


def test_a_usual_range_has_the_units_of_the_reader() -> None:
    (warning,) = case_of(mud={"density": 599.0}).warnings
    assert warning.remedy == "write it with its unit; usual is 600 to 2600 kg/m^3"
    assert warning.told("field").endswith("usual is 5.007 to 21.7 ppg")  # 8.345404 lb/gal is 1 g/cm³
