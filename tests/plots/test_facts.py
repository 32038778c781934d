"""What a picture says beside its curves."""

import numpy as np

from fctd.model.operations import SteadyRates, rates_of_all
from fctd.plots.facts import heading_of_chart, heading_of_profile
from fctd.plots.loads import ChartLook
from fctd.results.doing import facts_of
from tests.plots.made import chart, points, well

CASE = well(bit={"weight_on_bit": 8e4, "torque": 4e3}, rig={"block_weight": 3e4}, mud={"density": 1200.0})


def test_facts_in_both_unit_systems() -> None:
    """1200 kg/m³ are 10.01 ppg, 80 kN are 17.98 klbf, 30 kN 6.744 klbf (NIST SP 811)."""
    rates = {"drill_rotating": SteadyRates(0.003, 4 * np.pi), "trip_out": SteadyRates(-0.5, 0.0)}
    assert facts_of(CASE, rates, "si") == [
        "mud 1200 kg/m³", "weight on bit 80 kN", "bit torque 4 kN·m", "block 30 kN",
        "drilling, rotating 10.8 m/h and 120 rev/min", "picking up 0.5 m/s",
    ]  # fmt: skip
    field = facts_of(CASE, rates, "field")
    assert field[:2] == ["mud 10.01 ppg", "weight on bit 18 klbf"]
    assert field[-2:] == ["drilling, rotating 35.4 ft/h and 120 rev/min", "picking up 98.4 ft/min"]


def test_loads_at_the_bit_are_those_of_drilling() -> None:
    assert not [fact for fact in facts_of(CASE, rates_of_all(CASE, ["trip_in"]), "si") if "bit" in fact]
    assert facts_of(well(), rates_of_all(well(), ["trip_in"]), "si")[0] == "mud none (air)"


def test_shoes_end_intervals_above_the_end_of_the_hole() -> None:
    assert CASE.shoes == [1500.0]


def test_titles_name_what_all_curves_share() -> None:
    one = chart(["trip_in"], [0.2])
    assert heading_of_chart(one, "si", CASE, ChartLook())[0] == "test; slacking off; friction factor 0.2"
    look = ChartLook(told=["a line"], warnings=["w"])
    title, lines = heading_of_chart(chart(["trip_in", "trip_out"], [0.2, 0.3]), "si", None, look)
    assert (title, lines) == ("", ["a line", "", "warning w"])
    assert heading_of_profile(points(), "field", ["w"], 3)[0].endswith("; the first of 3 sets of factors")
    title, lines = heading_of_profile(points(), "field", ["w"])
    assert title.startswith("test; bit at 2887 ft + 1 ft of stretch; friction factor")
    assert lines[1] == "warning w"
