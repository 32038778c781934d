"""``fctd simulate`` refuses what no rig can do: exit code 2, and a message with key, value and what was expected."""

from pathlib import Path

import pytest

from fctd.cli.options import BAD_INPUT
from tests.cli.tiny import SMALL
from tests.commands import Command

MOVES = (
    SMALL.split("[[operations]]")[0]
    + """
[rig]
feed = "stands"
[[operations]]
kind = "{kind}"
from_md = "700 m"
to_md = "720 m"
speed = "0.01 m/s"
{more}
"""
)
ROTATING, SLIDING, TRIP = {"kind": "drill_rotating", "more": "rpm = 60"}, {"kind": "drill_sliding"}, {"kind": "trip_in"}


@pytest.mark.parametrize(
    ("operation", "tables", "said"),
    [
        (TRIP, {"rig.stand_length": "45 m"}, ["rig.stand_length", "45 m", "rig.derrick_height, 40 m"]),
        (TRIP, {"rig.derrick_height": "20 m"}, ["rig.stand_length", "28.5 m", "rig.derrick_height, 20 m"]),
        (ROTATING, {}, ["bit.rock", "a table [bit.rock], since operations[0] drills"]),
        (
            ROTATING,
            {"bit.weight_on_bit": "900 kN", "bit.rock.law": "given"},
            ["bit.weight_on_bit", "900 kN", "less than the weight of string and block along the hole"],
        ),
        (
            ROTATING,
            {"bit.weight_on_bit": "900 kN", "rig.autodriller": "true", "bit.rock.law": "drag_bit"},
            ["bit.weight_on_bit", "900 kN", "less than the weight"],
        ),
        (SLIDING, {"bit.rock.law": "drag_bit"}, ["bit.motor", "a table [bit.motor] with its flow"]),
        (
            SLIDING,
            {"bit.rock.law": "drag_bit", "bit.motor.revolutions_per_liter": "0.06"},
            ["bit.motor.flow", "is missing"],
        ),
        (
            SLIDING,
            {"bit.rock.law": "drag_bit", "bit.motor.revolutions_per_liter": "0.06", "bit.motor.flow": "0 L/min"},
            ["bit.motor.flow", "0 L/min", "above 0"],
        ),
    ],
)
def test_what_no_rig_can_do(
    operation: dict[str, str], tables: dict[str, str], said: list[str], tmp_path: Path, cli: Command,
) -> None:  # fmt: skip
    path = tmp_path / "small.toml"
    path.write_text(MOVES.format(**({"more": ""} | operation)))
    changes = [part for key, value in tables.items() for part in ("--set", f"{key}={value}")]
    printed = " ".join(cli("simulate", path, "--out", tmp_path / "out", *changes, code=BAD_INPUT).err.split())
    assert all(text in printed for text in ["small.toml", *said]), printed
    assert "Traceback" not in printed
    assert not (tmp_path / "out").exists()
