"""In a copy of the package, one line makes a law stick, one adds a key of a case, and one class adds an operation."""

import os
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

from fctd.mechanics.compile_cache import STORE
from tests.test_additions import ROOT, VISCOUS, WELL, add_line, copy_of_package, fctd


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    return copy_of_package(tmp_path)


def run_in(copy: Path, script: str) -> list[str]:
    """The lines that a script prints in the copy; docs and references are the checkout's."""
    assert STORE.folder is not None
    environment = os.environ | {"PYTHONPATH": f"{copy}{os.pathsep}{ROOT}", "NUMBA_CACHE_DIR": str(STORE.folder)}
    done = subprocess.run([sys.executable, "-c", script], cwd=copy, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


CLASSED = """
from types import SimpleNamespace
import fctd
from fctd.simulation.features import FEATURES

case = fctd.load_case("well.toml", {"contact.friction_law": "viscous"})
print(*[name for name in ("friction_law", "sticking") if FEATURES[name].used(SimpleNamespace(case=case))])
for law in ("viscous", "paper"):
    try:
        fctd.load_case("well.toml", {"contact.friction_law": law, "wellbore.intervals[0].static_friction": 0.3})
        print("sticks")
    except fctd.InputError as error:
        print(error)
"""


@pytest.mark.slow
@pytest.mark.parametrize(("keys", "feature"), [("", "friction_law"), (', ("static_friction",)', "sticking")])
def test_the_line_of_a_law_says_whether_it_sticks(keys: str, feature: str, copy: Path) -> None:
    """Then a static factor may stand beside it, and other engines and contact methods treat it as such a law."""
    laws = copy / "fctd" / "mechanics" / "laws"
    (laws / "viscous.py").write_text(VISCOUS)
    line = f'    "viscous": NamedLaw("viscous.LAW"{keys}),'
    add_line(laws.parent / "law_names.py", '    "paper": NamedLaw("paper.LAW"),', line)
    found, own, other = run_in(copy, CLASSED)
    assert found == feature
    sticking = '"viscous" or "karnopp" or "stribeck"' if keys else '"karnopp" or "stribeck"'
    refused = f"expected {sticking} beside wellbore.intervals[0].static_friction"
    assert own == "sticks" if keys else own.endswith(refused)
    assert other.endswith(refused)


KEYED = """
import fctd
from docs import keys
from fctd.case.schema import case_schema
from fctd.simulation.preparation import prepare
from references import contact, engines

(row,) = [line for line in keys.page().splitlines() if line.startswith("| `roughness`")]
print(row)
print(case_schema()["$defs"]["ContactSpec"]["properties"]["roughness"]["default"])
for value in ("2 mm", "-2 mm"):
    try:
        case = fctd.load_case("well.toml", {"contact.roughness": value})
        print(case.contact.roughness)
    except fctd.InputError as error:
        print(error)
case = fctd.load_case("well.toml", {"contact.roughness": "2 mm"})
run, _ = prepare(case)
print(run.segments > 0)
for make in (
    lambda: prepare(case, contact.build("cylinders", case)),
    lambda: engines.build("elastica").run(case, engines.Window(0.0, 1.0)),
):
    try:
        make()
    except fctd.InputError as error:
        print(error)
"""
ROTATE = '[[operations]]\nkind = "rotate_off_bottom"\nat_md = 700\nduration = 60\nrpm = 60\nramp_time = 5\n'


@pytest.mark.slow
def test_a_key_of_a_case_is_one_line(copy: Path) -> None:
    """It is in schema, table of keys and overrides; a stepper that was not made for it refuses it."""
    pytest.importorskip("elastica")
    line = '    helical_force: Literal["none", "analytic"] = "none"'
    add_line(copy / "fctd" / "case" / "wall.py", line, "    roughness: units.PositiveLength | None = None")
    (copy / "well.toml").write_text(WELL + ROTATE)
    row, default, read, refused, own, asked, engine = run_in(copy, KEYED)
    assert row == "| `roughness` | a length such as '12 m' or '40 ft' | – |"
    assert (default, read, own) == ("None", "0.002", "True")
    assert refused.endswith('contact.roughness = "-2 mm": expected a length above 0')
    for message, by in ((asked, "contact method"), (engine, "engine elastica")):
        assert "contact.roughness = " in message
        assert by in message
    assert STORE.folder is not None
    (checked,) = fctd(copy, STORE.folder, ["check", "well.toml", "--set", 'contact.roughness="2 mm"'])
    assert "tiny" in checked


REAM_DOWN = '''
class ReamDown(_Move):
    """The string moves into the hole and rotates."""

    kind: Literal["ream_down"]
    label = "reaming down"
    direction = 1
    default_speed = 0.2
    default_rpm = 90.0
    turns = True
    rpm: units.PositiveRpm
'''
REAMING = '[[operations]]\nkind = "ream_down"\nfrom_md = 600\nto_md = 601\nspeed = 0.2\nrpm = 30\nramp_time = 1\n'


@pytest.mark.slow(seconds=20)
def test_an_operation_is_one_class(copy: Path) -> None:
    """Charts and their pictures, points and runs have it, with its rates and its own columns of loads."""
    pytest.importorskip("matplotlib")
    pytest.importorskip("plotly")
    file = copy / "fctd" / "case" / "operations.py"
    union = "Operation = TripIn | TripOut | RotateOffBottom | BackReam | ReamIn | DrillRotating | DrillSliding"
    add_line(file, union, f"{REAM_DOWN}\n\n{union} | ReamDown")
    (copy / "well.toml").write_text(WELL + REAMING)
    assert STORE.folder is not None
    chart = ["chart", "well.toml", "--operation", "all", "--depths", "500:800:300", "--out", "chart.csv"]
    point = ["equilibrium", "well.toml", "--operation", "ream_down", "--bit-depth", "800", "--speed", "0.1"]
    pictures = ["--plot", "chart.png"], ["--plot", "chart.html"]
    _, _, point, run, helped = fctd(
        copy, STORE.folder, *([*chart, *picture, "--quiet"] for picture in pictures),
        point, ["simulate", "well.toml", "--out", "run", "--csv"], ["chart", "--help"],
    )  # fmt: skip
    table = pd.read_csv(copy / "chart.csv").set_index(["operation", "bit_depth_m"])
    assert {"trip_in", "ream_down"} < set(table.index.get_level_values("operation"))
    turned, slid = table.loc[("ream_down", 800)], table.loc[("trip_in", 800)]
    assert turned["hookload_N"] > slid["hookload_N"]
    assert turned["surface_torque_N_m"] > 100
    assert "ream_down" in point
    assert pd.read_csv(copy / "run" / "history.csv")["bit_depth_m"].iloc[-1] == pytest.approx(601, abs=0.5)
    assert "ream_down, bit at 601.0 m" in run
    assert "ream_down" in helped
