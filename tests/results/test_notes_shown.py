"""Every note is raised by a run, and stands with its remedy on the screen, in the files and on the picture."""

import re
from html import unescape
from pathlib import Path
from typing import Any

import pytest
import tomlkit

from fctd import Case, open_result, simulate
from fctd.results.notes import MEANINGS
from tests.cases import pipe, rotation, trip
from tests.commands import run
from validation.cases import load
from validation.cases import trip as moved

BUILD = [[0, 0, 0], [200, 0, 0], [260, 60, 0], [600, 60, 0]]
SOFT = {"stiffness": 5e5}
HARD = {"law": "power", "exponent": 1.5, "reference_penetration": 0.001, "largest_penetration": 0.0005}
CASING = [pipe(None, None, outer=0.3397, inner=0.3153, segment_length=25.0)]


def well(
    stations: list[list[float]], components: list[dict[str, Any]], operation: dict[str, Any], friction: float = 0.2,
    diameter: float = 0.2159, wellbore: dict[str, Any] | None = None, **sections: Any,
) -> dict[str, Any]:  # fmt: skip
    intervals = [{"to_md": stations[-1][0], "diameter": diameter, "friction": friction}]
    return {
        "name": "noted", "wellbore": {"stations": stations, "intervals": intervals, **(wellbore or {})},
        "string": {"components": components}, "operations": [operation], **sections,
    }  # fmt: skip


WEAK = [pipe(None, None, segment_length=20.0, yield_strength=5e6)]
RAISED: dict[str, tuple[set[str], dict[str, Any]]] = {
    "a soft wall and weak steel": (
        {"penetration", "yield", "tensile_capacity"}, well(BUILD, WEAK, trip(450, 452), wellbore=SOFT),
    ),
    "a weak rig": (
        {"hoist", "drive"},
        well(BUILD, [pipe(None, None, segment_length=28.5)], rotation(450, 1, ramp=0.5),
             rig={"hoist_capacity": 1e5, "largest_torque": 50.0}),
    ),
    "a sharp bend in long segments": (
        {"joint"},
        well([[0, 0, 0], [200, 0, 0], [240, 60, 0], [600, 60, 0]], [pipe(None, None, outer=0.06, inner=0.04,
             segment_length=28.5)], rotation(450, 1, ramp=0.5), diameter=0.45),
    ),
    "a wall of another law": (
        {"wall"}, well(BUILD, [pipe(None, None, segment_length=10.0)], rotation(450, 2, ramp=1), contact=HARD),
    ),
    "a winding hole": (
        {"tortuosity"},
        well(BUILD, [pipe(None, None, segment_length=28.5)], rotation(450, 2, ramp=1),
             wellbore={"tortuosity": {"amplitude": 0.005, "wavelength": 30.0}}),
    ),
    "pushed along the level": (
        {"buckling"},
        well([[0, 0, 0], [100, 0, 0], [400, 85, 0], [1500, 85, 0]], [pipe(None, None, outer=0.06, inner=0.045,
             segment_length=20.0)], trip(1300, 1301, speed=0.5, ramp=0.5), friction=0.6),
    ),
    "pushed by a block without weight": (
        {"push"},
        well([[0, 0, 0], [100, 0, 0], [400, 85, 0], [1500, 85, 0]], [pipe(None, None, segment_length=28.5)],
             trip(1300, 1303, speed=0.5, ramp=2.0), friction=0.6, solver={"joint_damping": 0.003}),
    ),
    "pulled through a long bend": (
        {"flutter"},
        well([[0, 0, 0], [300, 0, 0], [900, 90, 0], [1600, 90, 0]], [pipe(None, None, inner=0.1086,
             segment_length=28.5)], trip(1500, 1497, speed=0.5, ramp=2.0), friction=0.5, wellbore={"geometry": "arcs"},
             mud={"density": 1200.0}, rig={"feed": "stands"}, solver={"shape_damping": 0}, contact={"damping": 1e4}),
    ),
    "turned through a bend": (
        {"joint_damping"},
        well([[0, 0, 0], [300, 0, 0], [750, 90, 0], [900, 90, 0]], [pipe(800, 32)], rotation(800, 5, ramp=1),
             solver={"joint_damping": 0.01}),
    ),
    "begun within three steps": ({"ledger"}, well([[0, 0, 0], [1000, 0, 0]], [pipe(1000, 20)], rotation(1000, 0.01))),
    "wound up": (
        {"torque"},
        well([[0, 0, 0], [300, 0, 0], [750, 90, 0], [900, 90, 0]], [pipe(800, 32)], rotation(800, 2, ramp=1.9)),
    ),
    "picked up at once": (
        {"hookload"},
        well([[0, 0, 0], [1000, 0, 0]], [pipe(100, 10), pipe(None, 1)], trip(980, 960, speed=1.0, ramp=0.2),
             record={"interval": 0.05}),
    ),
    "a blunt bit": (
        {"drilling"},
        well([[0, 0, 0], [1000, 0, 0]], [pipe(None, None, segment_length=20.0)],
             {"kind": "drill_rotating", "from_md": 900, "to_md": 900.05, "speed": 0.005, "rpm": 60, "ramp_time": 2},
             bit={"weight_on_bit": 2e4, "torque": 500.0, "rock": {"wear_flat": 0.05}}),
    ),
    "big casing without damping": (
        {"whirl"},
        well([[0, 0, 0], [240, 0, 0], [684, 90, 0], [3000, 90, 0]], CASING, rotation(3000, 27, rpm=120, ramp=10),
             friction=0.5, diameter=0.4445, wellbore={"geometry": "arcs"}, mud={"density": 1200.0, "viscosity": 0}),
    ),
    "over the seams": (
        {"ringing"},
        load("paper_well_b", operations=moved(2155.0, 2215.0, 0.5, 10.0)).model_dump(mode="json", exclude_none=True),
    ),
}  # fmt: skip


SHOWN = ("a soft wall and weak steel", "picked up at once")  # before the run, and of its records


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in RAISED if name not in SHOWN])
def test_a_note_is_raised(name: str) -> None:
    codes, raw = RAISED[name]
    notes = {note.code: note for note in simulate(Case.model_validate(raw)).notes}
    assert codes <= notes.keys()
    for code in codes:
        assert notes[code].remedy == MEANINGS[code].remedy


@pytest.mark.slow
@pytest.mark.parametrize("name", SHOWN)
def test_a_note_is_shown_everywhere(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    codes, raw = RAISED[name]
    monkeypatch.chdir(tmp_path)
    Path("noted.toml").write_text(tomlkit.dumps({k: v for k, v in raw.items() if k != "file"}))
    run(monkeypatch, "simulate", "noted.toml", "--out", "out", "--plot", "run.svg", "-q")
    said, result = capsys.readouterr().err, open_result("out")
    notes = {note.code: note for note in result.notes}
    assert codes <= notes.keys()
    picture = unescape(" ".join(" ".join(re.findall("<!--(.*?)-->", Path("run.svg").read_text(), re.DOTALL)).split()))
    for code in codes:
        note = notes[code]
        assert note.remedy == MEANINGS[code].remedy
        assert f"{note.text}: {note.remedy}" in said
        assert f"note {code}: {note}" in picture


def test_every_code_is_raised() -> None:
    # tests/steady/test_wave_force.py, tests/results/test_hanging_body.py, tests/model/test_connection.py,
    # tests/results/test_notes.py, tests/model/test_fluids.py, tests/steady/test_steady_string.py,
    # tests/steady/test_several_balances.py, tests/steady/test_equilibrium_assemblies.py
    of_steady_strings = {
        "homogenised",
        "several_balances",
        "bent",
        "tool_joints",
        "body",
        "make_up",
        "slips",
        "burst",
        "collapse",
        "flow_law",
        "falling",
        "flow_lie",
        "sagitta",
        "chord",
    }
    assert set().union(*(codes for codes, _ in RAISED.values()), of_steady_strings) == set(MEANINGS)
