"""What the tutorial says of its well is what the engine says, and its pictures are those of its commands."""

from pathlib import Path

import pytest

import fctd
from docs import tutorial

ROOT = Path(__file__).parents[2]
TEXT = " ".join((ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8").split())
FAN = ({"cased": 0.15, "open": 0.20}, {"cased": 0.20, "open": 0.30}, {"cased": 0.25, "open": 0.40})


@pytest.fixture(scope="module")
def case() -> fctd.Case:
    return fctd.load_case(ROOT / "examples" / "my_well.toml")


def test_the_numbers_are_those_of_the_engine(case: fctd.Case) -> None:
    kinds = ["trip_in", "rotate_off_bottom", "trip_out"]
    rows = fctd.torque_drag(case, kinds, [3000]).set_index("operation")
    low, turning, high = rows.loc[kinds, "weight_indicator_N"] / 1e3
    torque = rows.loc["rotate_off_bottom", "surface_torque_N_m"] / 1e3
    assert f"it reads {turning:.0f} kN while the string turns, the block's {case.rig.block_weight / 1e3:.0f} kN" in TEXT
    assert f"the torque is {torque:.1f} kN·m" in TEXT
    assert f"takes {turning - low:.0f} kN of it" in TEXT
    assert f"adds {high - turning:.0f} kN" in TEXT
    fan = fctd.torque_drag(case, "trip_out", [3000], friction=FAN)["hookload_N"] / 1e3
    assert f"span {fan.max() - fan.min():.0f} kN" in TEXT


def test_the_curves_are_one_as_deep_as_the_text_says(case: fctd.Case) -> None:
    depths = range(200, 1001, 100)
    rows = fctd.torque_drag(case, ["trip_in", "rotate_off_bottom", "trip_out"], depths).groupby("bit_depth_m")
    apart = rows["hookload_N"].max() - rows["hookload_N"].min()
    deepest = max(depth for depth in depths if (apart.loc[:depth] < 100.0).all())
    assert f"Up to {deepest} m, in the vertical part, the three curves are one" in TEXT


def test_the_string_lies_where_the_text_says(case: fctd.Case) -> None:
    rows = fctd.equilibrium(case, operation="trip_out", bit_depth=3000).profile
    touching = rows[rows["contact_force_N"] > 0].set_index("md_m")
    high = (touching["contact_angle_deg"] < 90) | (touching["contact_angle_deg"] > 270)
    assert high[500:1500].all()
    assert not high[1650:].any()
    # It changes sides below the shoe at 1,500 m, where the side force is least.
    last = high[high].index.max()
    assert 1500 < last < 1600
    assert touching["contact_force_N"].idxmin() == pytest.approx(last, abs=30)


def test_its_pictures_are_those_of_its_commands() -> None:
    made = {f"pictures/tutorial_{picture}" for command in tutorial.commands() for picture in tutorial.pictures(command)}
    assert made == {part.partition(")")[0] for part in TEXT.split("](") if part.startswith("pictures/")}
    assert all((ROOT / "docs" / picture).is_file() for picture in made)


@pytest.mark.slow
def test_a_picture_is_drawn_by_its_command(tmp_path: Path) -> None:
    command = next(command for command in tutorial.commands() if "chart.png" in command)
    (drawn,) = tutorial.draw(command, tmp_path)
    assert drawn.name == "tutorial_chart.png"
    assert drawn.stat().st_size > 10_000
