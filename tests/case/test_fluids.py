"""Fluids by depth in a case: what is read, and one sentence for what cannot be."""

import re
from pathlib import Path

import pytest

from fctd.case import load
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.units import EXPANSION, PRESSURE, TEMPERATURE, Quantity
from tests.cases import make_case, pipe


def filled(**mud: object) -> Case:
    return make_case(mud=mud)


def test_rows_and_pressures_are_read_in_their_units() -> None:
    rows = [{"to_md": "500 m", "density": "1.2 sg", "plug": True}, {"density": 0, "pressure": "2 bar"}]
    mud = filled(inside=rows, outside=[{"density": "10 ppg"}], inside_pressure="700 psi", float=True).mud
    assert [(row.to_md, row.density, row.plug, row.pressure) for row in mud.inside] == [
        (500.0, 1200.0, True, None), (None, 0.0, False, 2e5)
    ]  # fmt: skip
    assert mud.outside[0].density == pytest.approx(1198.264, rel=1e-6)
    assert mud.inside_pressure == pytest.approx(700 * 6894.757, rel=1e-6)
    assert mud.given
    assert mud.float
    assert not filled(density=1200).mud.given


def test_a_string_in_fluids_takes_mud_along_though_the_mud_has_no_density() -> None:
    assert filled().mud.unsteady == 0
    assert filled(outside=[{"density": 1000.0}]).mud.unsteady == 0.02
    assert filled(outside=[{"density": 1000.0}], viscosity=0.05).mud.densest == 1000.0
    assert filled(density=1200.0, inside=[{"density": 0}]).mud.densest == 1200.0


@pytest.mark.parametrize("text", ["20 degF", "20 °F", "20 F"])
def test_a_change_of_temperature_has_no_zero(text: str) -> None:
    assert Quantity(dimension=TEMPERATURE).read(text) == pytest.approx(20 / 1.8)
    assert Quantity(dimension=TEMPERATURE).read("-3 °C") == -3.0


def test_the_default_expansion_is_that_of_the_literature() -> None:
    component = make_case().string.components[0]
    assert component.thermal_expansion == pytest.approx(Quantity(dimension=EXPANSION).read("6.9e-6 degF^-1"))
    assert Quantity(dimension=PRESSURE).read("30 kPa") == 3e4


@pytest.mark.parametrize(
    ("mud", "sentence"),
    [
        (
            {"inside": [{"to_md": 500, "density": 0}, {"to_md": 400, "density": 1000}]},
            "mud.inside[1].to_md: expected more than 500 m, where the row above ends",
        ),
        (
            {"outside": [{"density": 0}, {"density": 1000}]},
            "mud.outside[0].to_md: expected a depth, which only the last row may omit",
        ),
        (
            {"inside": [{"density": 0, "plug": True}]},
            "mud.inside[0].plug: expected false in a row without to_md, since `float` closes the end",
        ),
        (
            {"inside": [{"to_md": 500, "density": 0}, {"density": 0, "pressure": 1e5}]},
            "mud.inside[1].pressure: expected left out, since no plug is above the row",
        ),
        (
            {"outside": [{"density": 8000}]},
            "mud.outside[0].density: expected a density below the string's, 7850 kg/m^3 (string.components[0].density)",
        ),
        (
            {"inside": [{"to_md": 500, "density": 1000}, {"density": 0}]},
            "mud.inside[1].density: expected above 0, as what is above air falls without a plug",
        ),
        (
            {"packer_bore": 0.1, "float": True},
            "mud.packer_bore: expected left out beside a float, as the end in the bore is open",
        ),
        ({"inside": [{"density": "12 m"}]}, 'mud.inside[0].density = "12 m": lb/ft^3)'),
        ({"float": "yes"}, "mud.float: true or false"),
    ],
)
def test_fluids_that_cannot_be_are_refused_in_a_sentence(mud: dict[str, object], sentence: str) -> None:
    raw = make_case().model_dump(mode="json", exclude_none=True, exclude={"file", "mud"})
    with pytest.raises(InputError) as caught:
        load.make_case({**raw, "mud": mud}, None)
    text = str(caught.value)
    key, _, expected = sentence.partition(": ")
    assert text.startswith(key)
    assert text.endswith(expected)
    assert "\n" not in text


def test_temperatures_run_downwards() -> None:
    rows = [{"tvd": 0, "change": 0}, {"tvd": "1000 m", "change": "30 K"}]
    assert make_case(temperature=rows).temperature[1].change == 30.0
    with pytest.raises(ValueError, match=r"temperature\[1\].tvd"):
        make_case(temperature=rows[::-1])


def test_who_floats_casing_is_not_doubted() -> None:
    """The casing weighs 47 lb/ft; before fluids by depth only a false mass of 16 kg/m floated it."""
    casing = pipe(None, 40, outer=0.244475, inner=0.2204974, linear_mass="47 lb/ft")
    hole = {"intervals": [{"to_md": 1000.0, "diameter": 0.311, "friction": 0.3}]}
    mud = {"inside": [{"density": 0}], "outside": [{"density": 1200}], "float": True}
    assert make_case(components=[casing], wellbore=hole, mud=mud).warnings == ()
    light = {**casing, "linear_mass": "16.1 kg/m"}
    codes = [one.code for one in make_case(components=[light], wellbore=hole, mud={"density": 1200}).warnings]
    assert codes == ["linear_mass"]


def test_densities_of_rows_are_doubted_as_that_of_the_mud() -> None:
    found = filled(inside=[{"to_md": 500, "density": 0}, {"density": 10.4}], outside=[{"density": 1200}]).warnings
    assert [(one.code, one.key) for one in found] == [("mud_density", "mud.inside[1].density")]


def test_the_guide_shows_the_fluids_of_the_example() -> None:
    root = Path(__file__).parents[2]
    (shown,) = re.findall(
        r"^```toml\n(\[mud\]\n.*?)^```", (root / "docs" / "well.md").read_text(), re.DOTALL | re.MULTILINE
    )
    example = (root / "examples" / "floated_casing.toml").read_text()
    assert shown in example
